//! The paths that code names beside its `use` items: in expressions, types, attributes and macros.

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, ItemUse, Macro, Meta, Path, Visibility};

use crate::sources::{Names, Reference, leaves};

/// Collects the paths of a module.
#[derive(Debug)]
pub struct Paths {
    scope: Names,
    file: String,
    /// What was found so far.
    pub found: Vec<Reference>,
}

impl Paths {
    /// Of a module in a file.
    pub fn new(scope: Names, file: &str) -> Self {
        Self { scope, file: file.to_owned(), found: Vec::new() }
    }

    /// Adds a path.
    pub fn add(&mut self, path: Names, line: usize, import: bool) {
        let (file, scope) = (self.file.clone(), self.scope.clone());
        self.found.push(Reference { file, line, scope, path, import });
    }

    /// Paths of two segments or more among tokens, whose grammar is a macro's own.
    fn tokens(&mut self, stream: TokenStream) {
        let all: Vec<_> = stream.into_iter().collect();
        let colon =
            |at: usize| matches!(all.get(at), Some(TokenTree::Punct(p)) if p.as_char() == ':');
        let mut at = 0;
        while let Some(token) = all.get(at) {
            at += 1;
            match token {
                TokenTree::Group(group) => self.tokens(group.stream()),
                TokenTree::Ident(first) => {
                    let mut path = vec![first.to_string()];
                    while let (true, true, Some(TokenTree::Ident(next))) =
                        (colon(at), colon(at + 1), all.get(at + 2))
                    {
                        path.push(next.to_string());
                        at += 3;
                    }
                    if path.len() > 1 {
                        self.add(path, first.span().start().line, false);
                    }
                }
                _ => {}
            }
        }
    }
}

impl<'a> Visit<'a> for Paths {
    fn visit_path(&mut self, path: &'a Path) {
        let names = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        // `self` by itself is a value.
        if let Some(first) = path.segments.first().filter(|_| !path.is_ident("self")) {
            self.add(names, first.ident.span().start().line, false);
        }
        visit::visit_path(self, path);
    }

    /// `pub(in crate::scene)` imports nothing.
    fn visit_visibility(&mut self, _: &'a Visibility) {}

    fn visit_macro(&mut self, call: &'a Macro) {
        self.visit_path(&call.path);
        self.tokens(call.tokens.clone());
    }

    fn visit_attribute(&mut self, attribute: &'a Attribute) {
        if let Meta::List(list) = &attribute.meta {
            self.tokens(list.tokens.clone());
        }
    }

    /// Within a function.
    fn visit_item_use(&mut self, import: &'a ItemUse) {
        for (path, _, line) in leaves(&import.tree) {
            self.add(path, line, true);
        }
    }
}
