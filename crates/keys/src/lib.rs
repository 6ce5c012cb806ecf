//! `#[derive(Section)]`: a key of a scenario file is stated once, at its field.
//!
//! ```ignore
//! #[derive(Section)]
//! #[section("wash")]
//! pub struct WashSection {
//!     /// Height of the tip above the washing surface.
//!     #[key(unit = "m", domain = Number(0.0, 1.0), default = 0.05)]
//!     pub height_m: f64,
//! }
//! ```
//!
//! The doc comment is the key's meaning, as messages, the page's form and the reference print it. The macro writes
//! `impl Default` with the defaults, which are `Default::default()` where none is stated, and a constant `KEYS` with a
//! `crate::keys::key::Key` for each field that has a `#[key]`, in their order.

use proc_macro::{Delimiter, Group, TokenStream, TokenTree};

/// Derives the keys and the defaults of a section, a struct with named fields; see the crate.
///
/// Any other item is a compile error at the derive.
#[proc_macro_derive(Section, attributes(section, key))]
pub fn section(input: TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = input.into_iter().collect();
    let Some((section, name, fields)) = of_struct(&tokens) else {
        return error("#[derive(Section)] needs #[section(\"NAME\")] and a struct with named fields");
    };
    let (mut defaults, mut keys) = (String::new(), String::new());
    for field in split(fields.stream()) {
        let Some(field) = Field::parse(&field) else {
            return error("a field of a section needs a name");
        };
        defaults += &format!("{}: {},", field.name, field.default);
        if let Some(domain) = &field.domain {
            // The keys at the top of a file are in no section.
            let dot = if section == "\"\"" { "" } else { "." };
            let path = format!("concat!({section}, \"{dot}{}\")", field.name);
            let meaning = format!("concat!({})", field.meaning.join(", \" \", "));
            keys += &format!("crate::keys::key::key({path}, {}, {domain}, {meaning}),", field.unit);
        }
    }
    let text = format!(
        "impl ::core::default::Default for {name} {{ fn default() -> Self {{ Self {{ {defaults} }} }} }}
         impl {name} {{
             /// The keys of the section, in the order of the reference.
             pub(crate) const KEYS: &'static [crate::keys::key::Key] = {{ use crate::keys::key::Domain::*; &[{keys}] }};
         }}"
    );
    text.parse()
        .unwrap_or_else(|_| error("a key or a default is no expression"))
}

/// A field of a section, as its attributes describe it.
struct Field {
    name: String,
    /// The lines of its doc comment, as string literals.
    meaning: Vec<String>,
    unit: String,
    /// `None` for a field that is no key.
    domain: Option<String>,
    default: String,
}

impl Field {
    /// The field that these tokens declare.
    fn parse(tokens: &[TokenTree]) -> Option<Self> {
        let colon = tokens.iter().position(|token| is(token, ':'))?;
        let mut field = Self {
            name: tokens[..colon].last()?.to_string(),
            meaning: Vec::new(),
            unit: "\"\"".to_owned(),
            domain: None,
            default: "::core::default::Default::default()".to_owned(),
        };
        for (name, inside) in attributes(tokens) {
            match name.as_str() {
                "doc" => field.meaning.extend(inside.last().map(unindented)),
                "key" => {
                    let Some(TokenTree::Group(stated)) = inside.last() else {
                        continue;
                    };
                    for stated in split(stated.stream()) {
                        let value: TokenStream = stated.iter().skip(2).cloned().collect();
                        match stated.first()?.to_string().as_str() {
                            "unit" => field.unit = value.to_string(),
                            "domain" => field.domain = Some(value.to_string()),
                            "default" => field.default = value.to_string(),
                            _ => return None,
                        }
                    }
                }
                _ => {}
            }
        }
        Some(field)
    }
}

/// The literal of its section, the name and the fields of a struct.
fn of_struct(tokens: &[TokenTree]) -> Option<(String, String, &Group)> {
    let section = attributes(tokens).find(|(name, _)| name == "section")?.1;
    let Some(TokenTree::Group(section)) = section.last() else {
        return None;
    };
    let at = tokens.iter().position(|token| token.to_string() == "struct")?;
    match tokens.get(at + 1..)? {
        [TokenTree::Ident(name), TokenTree::Group(fields)] if fields.delimiter() == Delimiter::Brace => {
            Some((section.stream().to_string(), name.to_string(), fields))
        }
        _ => None,
    }
}

/// The attributes among tokens: their names and the tokens in their brackets.
fn attributes(tokens: &[TokenTree]) -> impl Iterator<Item = (String, Vec<TokenTree>)> {
    tokens.windows(2).filter_map(|pair| match pair {
        [hash, TokenTree::Group(inside)] if is(hash, '#') => {
            let inside: Vec<TokenTree> = inside.stream().into_iter().collect();
            Some((inside.first()?.to_string(), inside))
        }
        _ => None,
    })
}

/// Tokens between commas, but for those within angle brackets.
fn split(tokens: TokenStream) -> Vec<Vec<TokenTree>> {
    let (mut all, mut one, mut depth) = (Vec::new(), Vec::new(), 0);
    for token in tokens {
        depth += i32::from(is(&token, '<')) - i32::from(is(&token, '>'));
        if is(&token, ',') && depth == 0 {
            all.push(std::mem::take(&mut one));
        } else {
            one.push(token);
        }
    }
    all.push(one);
    all.retain(|one| !one.is_empty());
    all
}

/// A line of a doc comment without the space behind its slashes.
fn unindented(literal: &TokenTree) -> String {
    literal.to_string().replacen("\" ", "\"", 1)
}

fn is(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(found) if found.as_char() == sign)
}

/// A compile error with this message.
fn error(words: &str) -> TokenStream {
    format!("compile_error!({words:?});").parse().unwrap_or_default()
}
