//! Functions that are too long.

use std::path::Path;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, Block, ImplItemFn, ItemFn, ItemMod, Signature, TraitItemFn};

use super::files::Source;

/// The most lines from `fn` to the closing brace, both counted.
const LINES_MOST: usize = 80;

/// All functions outside tests that are longer than [`LINES_MOST`], with their numbers of lines.
pub(crate) fn find(files: &[Source]) -> Vec<String> {
    let mut long = Long { path: Path::new(""), found: Vec::new() };
    for file in files.iter().filter(|file| file.is_rust() && !file.is_test()) {
        long.path = &file.path;
        match syn::parse_file(&file.text) {
            Ok(parsed) => long.visit_file(&parsed),
            Err(error) => long.found.push(format!("{}: {error}", file.path.display())),
        }
    }
    long.found
}

/// Whether an item is compiled only for tests.
pub(crate) fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let is_cfg_test = || attribute.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test"));
        attribute.path().is_ident("test") || attribute.path().is_ident("cfg") && is_cfg_test()
    })
}

struct Long<'a> {
    path: &'a Path,
    found: Vec<String>,
}

impl Long<'_> {
    fn look(&mut self, signature: &Signature, body: &Block) {
        let first = signature.fn_token.span().start().line;
        let lines = body.brace_token.span.close().end().line + 1 - first;
        if lines > LINES_MOST {
            self.found.push(format!(
                "{}:{first}: {} has {lines} lines",
                self.path.display(),
                signature.ident
            ));
        }
    }
}

impl<'ast> Visit<'ast> for Long<'_> {
    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        if !is_test(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_fn(&mut self, function: &'ast ItemFn) {
        if !is_test(&function.attrs) {
            self.look(&function.sig, &function.block);
            visit::visit_item_fn(self, function);
        }
    }

    fn visit_impl_item_fn(&mut self, function: &'ast ImplItemFn) {
        self.look(&function.sig, &function.block);
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_trait_item_fn(&mut self, function: &'ast TraitItemFn) {
        if let Some(body) = &function.default {
            self.look(&function.sig, body);
        }
        visit::visit_trait_item_fn(self, function);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tests functions of 80 and 81 lines in each place where a function may stand.
    #[test]
    fn the_first_line_too_many_counts() {
        let body = |lines: usize| format!("{{\n{}}}", "    f();\n".repeat(lines - 2));
        for (before, after) in [
            ("", ""),
            ("impl A {\n    /// Says.\n    pub(crate) ", "}"),
            ("trait A {\n", "}"),
            ("mod a {\n", "}"),
            ("fn outer() {\n", "}"),
        ] {
            for lines in [80, 81] {
                let text = format!("{before}fn inner() {}{after}", body(lines));
                let file = Source { path: "a.rs".into(), text };
                let found = find(&[file]);
                let told = found.iter().filter(|found| found.contains("inner has 81 lines")).count();
                assert_eq!(told, usize::from(lines == 81), "{before}: {found:?}");
            }
        }
    }

    #[test]
    fn tests_may_be_long() {
        let body = format!("{{\n{}}}", "    f();\n".repeat(100));
        for (path, before, after) in [
            ("a.rs", "#[cfg(test)]\nmod tests {\n", "}"),
            ("a.rs", "#[test]\n", ""),
            ("a/tests/b.rs", "", ""),
            ("a/tests.rs", "", ""),
        ] {
            let text = format!("{before}fn inner() {body}{after}");
            assert_eq!(find(&[Source { path: path.into(), text }]), Vec::<String>::new(), "{path}: {before}");
        }
    }
}
