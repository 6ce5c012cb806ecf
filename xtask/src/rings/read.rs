//! Reading the modules of a crate from its files.

use super::cfg;
use super::module::{Glob, Id, Mention, Module, Modules, Name, shown};
use super::paths::Paths;
use anyhow::{Context, Result, anyhow, bail};
use proc_macro2::TokenTree;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Reads a crate from its root file; `open` has the text of a file, if there is one.
///
/// # Errors
/// A file that is not there or is no Rust.
pub fn read(root: &Path, open: &dyn Fn(&Path) -> Option<String>) -> Result<Modules> {
    let mut reader = Reader {
        open,
        modules: Modules::default(),
    };
    let folder = root.parent().context("a root file lies in a folder")?;
    reader.file("crate", None, root, folder)?;
    Ok(reader.modules)
}

struct Reader<'a> {
    open: &'a dyn Fn(&Path) -> Option<String>,
    modules: Modules,
}

/// Where a module's code and the files of those inside it are.
#[derive(Clone, Copy)]
struct Place<'a> {
    /// The file of the code.
    file: &'a Path,
    /// The folder of the files of the modules inside.
    folder: &'a Path,
    /// Whether the module has a file of its own.
    own: bool,
}

impl Reader<'_> {
    fn file(&mut self, name: &str, parent: Option<Id>, file: &Path, folder: &Path) -> Result<Id> {
        let text = (self.open)(file).with_context(|| format!("no file {}", shown(file)))?;
        let at = |error: &syn::Error| format!("{}:{}", shown(file), error.span().start().line);
        let parsed = syn::parse_file(&text).map_err(|error| anyhow!("{}: {error}", at(&error)))?;
        let items: Vec<&syn::Item> = parsed.items.iter().collect();
        self.module(
            name,
            parent,
            &items,
            Place {
                file,
                folder,
                own: true,
            },
        )
    }

    fn module(&mut self, name: &str, parent: Option<Id>, items: &[&syn::Item], place: Place) -> Result<Id> {
        let id = self.modules.all.len();
        self.modules.all.push(Module {
            name: name.to_owned(),
            parent,
            file: place.file.to_owned(),
            names: BTreeMap::new(),
            globs: Vec::new(),
            mentions: Vec::new(),
        });
        for item in items.iter().filter(|item| !cfg::for_tests(cfg::of_item(item))) {
            match item {
                syn::Item::Mod(inner) => {
                    let child = self.inner(inner, id, place)?;
                    self.modules.all[id].bind(inner.ident.to_string(), Name::Module(child), is_open(&inner.vis));
                }
                syn::Item::Use(import) => self.modules.all[id].import(import),
                other => self.modules.all[id].item(other),
            }
        }
        Ok(id)
    }

    /// A module inside another one: inline, or with a file of its own.
    fn inner(&mut self, inner: &syn::ItemMod, parent: Id, place: Place) -> Result<Id> {
        let name = inner.ident.to_string();
        let below = place.folder.join(&name);
        if let Some((_, items)) = &inner.content {
            let items: Vec<&syn::Item> = items.iter().collect();
            return self.module(
                &name,
                Some(parent),
                &items,
                Place {
                    file: place.file,
                    folder: &below,
                    own: false,
                },
            );
        }
        if let Some(named) = named_file(inner) {
            let from = if place.own {
                place.file.parent().unwrap_or(place.folder)
            } else {
                place.folder
            };
            let file = from.join(named);
            let folder = file.parent().unwrap_or(from).to_owned();
            return self.file(&name, Some(parent), &file, &folder);
        }
        let places: [PathBuf; 2] = [place.folder.join(format!("{name}.rs")), below.join("mod.rs")];
        match places.iter().find(|file| (self.open)(file).is_some()) {
            Some(file) => self.file(&name, Some(parent), file, &below),
            None => bail!("{}: module {name} has no file", shown(place.file)),
        }
    }
}

/// The file that `#[path]` names.
fn named_file(module: &syn::ItemMod) -> Option<String> {
    let attribute = module
        .attrs
        .iter()
        .find(|attribute| attribute.path().is_ident("path"))?;
    match &attribute.meta.require_name_value().ok()?.value {
        syn::Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Str(text),
            ..
        }) => Some(text.value()),
        _ => None,
    }
}

fn is_open(visibility: &syn::Visibility) -> bool {
    match visibility {
        syn::Visibility::Inherited => false,
        syn::Visibility::Restricted(restricted) => !restricted.path.is_ident("self"),
        syn::Visibility::Public(_) => true,
    }
}

impl Module {
    /// Takes up an item that is neither a module nor an import.
    fn item(&mut self, item: &syn::Item) {
        if let Some((name, open)) = defined(item) {
            self.bind(name, Name::Item, open);
        }
        if let syn::Item::Macro(item) = item {
            // Its calls define the types whose names it states.
            for name in types_of(item.mac.tokens.clone()) {
                self.bind(name, Name::Item, true);
            }
        }
        let seen = Paths::of(item);
        seen.imports.iter().for_each(|import| self.import(import));
        let mentions = seen.code.into_iter();
        self.mentions.extend(mentions.map(|(path, line)| Mention {
            path,
            line,
            reexport: false,
        }));
    }

    fn import(&mut self, import: &syn::ItemUse) {
        // What begins with `::` is another crate's.
        if import.leading_colon.is_none() {
            self.tree(&import.tree, &mut Vec::new(), is_open(&import.vis));
        }
    }

    fn tree(&mut self, tree: &syn::UseTree, before: &mut Vec<String>, open: bool) {
        match tree {
            syn::UseTree::Path(path) => {
                before.push(path.ident.to_string());
                self.tree(&path.tree, before, open);
                before.pop();
            }
            syn::UseTree::Name(name) => self.named(&name.ident, &name.ident, before, open),
            syn::UseTree::Rename(rename) => self.named(&rename.ident, &rename.rename, before, open),
            syn::UseTree::Glob(glob) => {
                let line = glob.star_token.spans[0].start().line;
                self.mentions.push(Mention {
                    path: before.clone(),
                    line,
                    reexport: open,
                });
                self.globs.push(Glob {
                    path: before.clone(),
                    open,
                });
            }
            syn::UseTree::Group(group) => group.items.iter().for_each(|item| self.tree(item, before, open)),
        }
    }

    /// An import binds a name and mentions what it names; `self` in braces is the module before them.
    fn named(&mut self, ident: &syn::Ident, name: &syn::Ident, before: &[String], open: bool) {
        let mut path = before.to_vec();
        if ident != "self" || before.is_empty() {
            path.push(ident.to_string());
        }
        let name = if name == "self" {
            path.last().cloned().unwrap_or_default()
        } else {
            name.to_string()
        };
        self.mentions.push(Mention {
            path: path.clone(),
            line: ident.span().start().line,
            reexport: open,
        });
        self.bind(name, Name::Import(path), open);
    }
}

/// The name that an item defines, and whether it is seen beyond its module.
fn defined(item: &syn::Item) -> Option<(String, bool)> {
    let (name, visibility) = match item {
        syn::Item::Const(item) => (&item.ident, &item.vis),
        syn::Item::Enum(item) => (&item.ident, &item.vis),
        syn::Item::Fn(item) => (&item.sig.ident, &item.vis),
        syn::Item::Static(item) => (&item.ident, &item.vis),
        syn::Item::Struct(item) => (&item.ident, &item.vis),
        syn::Item::Trait(item) => (&item.ident, &item.vis),
        syn::Item::TraitAlias(item) => (&item.ident, &item.vis),
        syn::Item::Type(item) => (&item.ident, &item.vis),
        syn::Item::Union(item) => (&item.ident, &item.vis),
        // A macro is seen wherever an import of it is.
        syn::Item::Macro(item) => return Some((item.ident.as_ref()?.to_string(), true)),
        _ => return None,
    };
    Some((name.to_string(), is_open(visibility)))
}

/// The names that follow `enum` and `struct` anywhere in the text of a macro.
fn types_of(text: proc_macro2::TokenStream) -> Vec<String> {
    let mut names = Vec::new();
    let mut after_keyword = false;
    for token in text {
        match token {
            TokenTree::Group(group) => names.extend(types_of(group.stream())),
            TokenTree::Ident(ident) if after_keyword => {
                names.push(ident.to_string());
                after_keyword = false;
            }
            TokenTree::Ident(ident) => after_keyword = ident == "enum" || ident == "struct",
            _ => after_keyword = false,
        }
    }
    names
}
