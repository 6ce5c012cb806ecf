//! The paths in some code.

use super::cfg;
use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use std::collections::BTreeSet;
use syn::visit::{self, Visit};

/// A path, and the line that it stands in.
pub type Path = (Vec<String>, usize);

/// What some code names.
#[derive(Default)]
pub struct Paths {
    /// Paths of code.
    pub code: Vec<Path>,
    /// Imports inside functions.
    pub imports: Vec<syn::ItemUse>,
    /// Names of arguments and variables, by the functions that the visit is inside of.
    variables: Vec<BTreeSet<String>>,
}

impl Paths {
    /// What an item names.
    pub fn of(item: &syn::Item) -> Self {
        let mut paths = Self::default();
        paths.visit_item(item);
        paths
    }

    fn add(&mut self, path: Vec<String>, span: Span) {
        self.code.push((path, span.start().line));
    }

    fn is_variable(&self, path: &[String]) -> bool {
        matches!(path, [name] if self.variables.iter().any(|names| names.contains(name)))
    }

    fn inside(&mut self, names: BTreeSet<String>, visit: impl FnOnce(&mut Self)) {
        self.variables.push(names);
        visit(self);
        self.variables.pop();
    }

    /// Paths in what a macro is given, which may be anything.
    fn tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            match &tokens[at] {
                TokenTree::Group(group) => self.tokens(group.stream()),
                TokenTree::Ident(first) => {
                    let (path, end) = path_at(&tokens, at);
                    if begins_path(&tokens, at, first) && self.counts(&path, tokens.get(end)) {
                        self.add(path, first.span());
                    }
                    at = end;
                    continue;
                }
                _ => {}
            }
            at += 1;
        }
    }

    /// A single small word in a macro may be anything; followed by arguments it is a function.
    fn counts(&self, path: &[String], next: Option<&TokenTree>) -> bool {
        let called = matches!(next, Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
        path.len() > 1 || called || path.iter().any(|name| name.starts_with(char::is_uppercase))
    }
}

/// The path that begins at a token, and where it ends.
fn path_at(tokens: &[TokenTree], start: usize) -> (Vec<String>, usize) {
    let mut path = Vec::new();
    let mut at = start;
    while let Some(TokenTree::Ident(ident)) = tokens.get(at) {
        path.push(ident.to_string());
        at += 1;
        let more = matches!(tokens.get(at + 2), Some(TokenTree::Ident(_)));
        if !(is(tokens.get(at), ':') && is(tokens.get(at + 1), ':') && more) {
            break;
        }
        at += 2;
    }
    (path, at)
}

/// Whether a word begins a path: it is no field, no method, no lifetime, no argument of a macro and not in another crate.
fn begins_path(tokens: &[TokenTree], at: usize, word: &Ident) -> bool {
    let before = |back: usize| at.checked_sub(back).and_then(|place| tokens.get(place));
    let member = is(before(1), '.') && !is(before(2), '.');
    let argument = is(before(1), '$') && word != "crate";
    let elsewhere = is(before(1), ':') && is(before(2), ':');
    !(member || argument || elsewhere || is(before(1), '\''))
}

fn is(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

fn segments(path: &syn::Path) -> Vec<String> {
    path.segments.iter().map(|segment| segment.ident.to_string()).collect()
}

impl<'ast> Visit<'ast> for Paths {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        let named = segments(path);
        if path.leading_colon.is_none()
            && !self.is_variable(&named)
            && let Some(first) = path.segments.first()
        {
            self.add(named, first.ident.span());
        }
        visit::visit_path(self, path);
    }

    /// What is called is a function though a variable may bear its name: `let tilt = tilt(x)`.
    fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
        if let syn::Expr::Path(function) = &*call.func
            && let Some(name) = function.path.get_ident()
        {
            self.add(vec![name.to_string()], name.span());
        }
        visit::visit_expr_call(self, call);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.visit_path(&call.path);
        self.tokens(call.tokens.clone());
    }

    fn visit_attribute(&mut self, attribute: &'ast syn::Attribute) {
        if let syn::Meta::List(list) = &attribute.meta {
            self.tokens(list.tokens.clone());
            if list.path.is_ident("serde") {
                self.code.extend(quoted(list.tokens.clone()));
            }
        }
    }

    fn visit_item_use(&mut self, import: &'ast syn::ItemUse) {
        self.imports.push(import.clone());
    }

    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        let mut names = Variables::default();
        names.visit_item_fn(function);
        self.inside(names.0, |paths| visit::visit_item_fn(paths, function));
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        let mut names = Variables::default();
        names.visit_impl_item_fn(function);
        self.inside(names.0, |paths| visit::visit_impl_item_fn(paths, function));
    }

    fn visit_trait_item_fn(&mut self, function: &'ast syn::TraitItemFn) {
        let mut names = Variables::default();
        names.visit_trait_item_fn(function);
        self.inside(names.0, |paths| visit::visit_trait_item_fn(paths, function));
    }

    fn visit_item(&mut self, item: &'ast syn::Item) {
        if !cfg::for_tests(cfg::of_item(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, item: &'ast syn::ImplItem) {
        if !cfg::for_tests(cfg::of_impl_item(item)) {
            visit::visit_impl_item(self, item);
        }
    }

    fn visit_trait_item(&mut self, item: &'ast syn::TraitItem) {
        if !cfg::for_tests(cfg::of_trait_item(item)) {
            visit::visit_trait_item(self, item);
        }
    }

    fn visit_stmt(&mut self, statement: &'ast syn::Stmt) {
        if !cfg::for_tests(cfg::of_statement(statement)) {
            visit::visit_stmt(self, statement);
        }
    }
}

/// Functions that an attribute of serde names: `serialize_with = "paths::lossy"`.
fn quoted(tokens: TokenStream) -> Vec<Path> {
    let texts = tokens.into_iter().filter_map(|token| match token {
        TokenTree::Literal(text) => syn::parse2::<syn::LitStr>(TokenTree::Literal(text).into()).ok(),
        _ => None,
    });
    let paths = texts.filter_map(|text| Some((segments(&text.parse().ok()?), text.span().start().line)));
    paths.collect()
}

/// Names that patterns give: those of constants have capitals.
#[derive(Default)]
struct Variables(BTreeSet<String>);

impl<'ast> Visit<'ast> for Variables {
    fn visit_pat_ident(&mut self, pattern: &'ast syn::PatIdent) {
        let name = pattern.ident.to_string();
        if !name.starts_with(char::is_uppercase) {
            self.0.insert(name);
        }
        visit::visit_pat_ident(self, pattern);
    }
}
