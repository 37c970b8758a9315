//! Texts in two languages: English in the source, Chinese in the catalogue `po/zh.po` of the crate.
//!
//! [`zh!`] and [`zh_format!`] replace an English text by its translation while the crate is
//! compiled, so a text without a translation, or a translation that names an unknown value, does
//! not compile. The macros `both!`, `say!`, `tr!` and `each!` of `hodograph-base` are built on them.
//!
//! A catalogue is a file of GNU gettext: `msgid "English"`, `msgstr "Chinese"`, and `msgctxt` where
//! one English text has several translations.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod catalogue;

use catalogue::{Catalogue, Key, unescaped};
use proc_macro::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

/// Returns the Chinese text of an English literal: `zh!("stroke")`, `zh!("gear" => "pitch")`.
#[proc_macro]
pub fn zh(input: TokenStream) -> TokenStream {
    match translated(&mut input.into_iter().peekable()) {
        Ok(text) => TokenTree::Literal(text).into(),
        Err(fault) => fault.into_error(),
    }
}

/// Formats values with the Chinese text of an English format string: `zh_format!("link {}", name)`.
#[proc_macro]
pub fn zh_format(input: TokenStream) -> TokenStream {
    let mut tokens = input.into_iter().peekable();
    match translated(&mut tokens) {
        Ok(text) => {
            let values = std::iter::once(TokenTree::Literal(text)).chain(tokens).collect();
            let format = [
                TokenTree::Ident(Ident::new("format", Span::mixed_site())),
                TokenTree::Punct(Punct::new('!', Spacing::Alone)),
                TokenTree::Group(Group::new(Delimiter::Parenthesis, values)),
            ];
            format.into_iter().collect()
        }
        Err(fault) => fault.into_error(),
    }
}

/// A call without a translation.
struct Fault {
    message: String,
    span: Span,
}

impl Fault {
    /// Returns `compile_error!` at the English text.
    fn into_error(self) -> TokenStream {
        let mut message = Literal::string(&self.message);
        message.set_span(self.span);
        let body = Group::new(Delimiter::Brace, TokenTree::Literal(message).into());
        let mut name = Ident::new("compile_error", self.span);
        name.set_span(self.span);
        let mut mark = Punct::new('!', Spacing::Alone);
        mark.set_span(self.span);
        [TokenTree::Ident(name), TokenTree::Punct(mark), TokenTree::Group(body)]
            .into_iter()
            .collect()
    }
}

type Tokens = std::iter::Peekable<proc_macro::token_stream::IntoIter>;

/// Reads `"text"` or `"context" => "text"` from the tokens and returns the translation, with the
/// span of the English text: values captured by name are those of the caller.
fn translated(tokens: &mut Tokens) -> Result<Literal, Fault> {
    let (first, mut span) = literal(tokens.next())?;
    let with_context = matches!(tokens.peek(), Some(TokenTree::Punct(p)) if p.as_char() == '=');
    let key = if with_context {
        tokens.next();
        tokens.next();
        let (text, at) = literal(tokens.next())?;
        span = at;
        Key { context: Some(first), text }
    } else {
        Key { context: None, text: first }
    };
    let fault = |message| Fault { message, span };
    let text = Catalogue::of_crate().map_err(fault)?.get(&key).map_err(fault)?;
    let mut text = Literal::string(&text);
    text.set_span(span);
    Ok(text)
}

/// Returns the value and the span of a string literal. A literal that comes through another macro
/// is in a group without delimiters.
fn literal(token: Option<TokenTree>) -> Result<(String, Span), Fault> {
    let span = token.as_ref().map_or_else(Span::call_site, TokenTree::span);
    let value = match token {
        Some(TokenTree::Literal(text)) => unescaped(&text.to_string()),
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::None => {
            return literal(group.stream().into_iter().next());
        }
        Some(TokenTree::Group(_) | TokenTree::Ident(_) | TokenTree::Punct(_)) | None => None,
    };
    value.map(|v| (v, span)).ok_or_else(|| Fault { message: "not a string literal".into(), span })
}
