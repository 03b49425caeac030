//! `Include` and `Import`.

use super::state::Reader;
use super::tokens::Tokens;
use crate::Diagnostic;
use crate::gunzip::gunzipped;
use crate::text::text_of;

/// The largest depth of inclusion: deeper files include themselves.
const DEEPEST: usize = 32;

impl Reader {
    /// `Include "name"`: the text of the file replaces the directive.
    pub(super) fn include(
        &mut self,
        tokens: &mut Tokens<'_>,
        depth: usize,
    ) -> Result<(), Diagnostic> {
        let name = tokens.quoted("a file name")?.into_owned();
        if depth == DEEPEST {
            let message = format!(
                "expected a file that does not include itself, or fewer than {DEEPEST} in each \
                 other"
            );
            return Err(tokens.diagnostic(message));
        }
        let file = self.resolve(&name);
        let refuse = |error: Diagnostic| tokens.diagnostic(error.to_string());
        let bytes = self.files.read(&file).map_err(refuse)?;
        let plain = gunzipped(&file, &bytes).map_err(refuse)?;
        let counted = self.included.add(plain.len());
        counted.map_err(|message| tokens.diagnostic(message))?;
        self.file(&file, &text_of(&plain), depth + 1)
    }

    /// `Import "name"`: the state is restored after the file.
    pub(super) fn import(
        &mut self,
        tokens: &mut Tokens<'_>,
        depth: usize,
    ) -> Result<(), Diagnostic> {
        let before = self.state.clone();
        let open = self.open_blocks();
        self.include(tokens, depth)?;
        if self.open_blocks() != open {
            let message = "expected a file that ends what it begins, and nothing else";
            return Err(tokens.diagnostic(message));
        }
        self.state = before;
        Ok(())
    }
}
