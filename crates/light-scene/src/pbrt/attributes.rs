use alloc::rc::Rc;
use std::path::Path;

use super::attribute_target::Target;
use super::file_loc::{FileLoc, Typed};
use super::parameters::Parameters;
use super::state::Reader;
use super::tokens::Tokens;
use crate::Diagnostic;
use crate::text::shown;

/// How many may be in force: each directive looks through all of them.
pub(super) const MOST_ATTRIBUTES: usize = 256;

impl Reader {
    /// The type in quotes and the parameters of a directive, with those that attributes add.
    pub(super) fn typed<'a>(
        &self,
        path: &'a Path,
        tokens: &mut Tokens<'_>,
        directive: &str,
    ) -> Result<Typed<'a>, Diagnostic> {
        let kind = tokens.quoted("a type")?.into_owned();
        let at = FileLoc {
            path,
            line: tokens.line(),
        };
        let mut parameters = Parameters::read(tokens)?;
        parameters.load_spectra(&self.root, self.files)?;
        let target = Target::of_directive(directive);
        let attributes = self.state.attributes.iter().rev();
        let spoken_to = attributes.filter(|(to, _)| Some(*to) == target);
        parameters.inherit(spoken_to.map(|(_, said)| Rc::clone(said)));
        Ok(Typed {
            at,
            kind,
            parameters,
        })
    }

    /// `Attribute "target"` and parameters that the directives of that kind take over which do not
    /// state them.
    pub(super) fn attribute(&mut self, typed: Typed<'_>) -> Result<(), Diagnostic> {
        let target = Target::of_name(&typed.kind).ok_or_else(|| {
            let found = shown(&typed.kind);
            let expected = "expected \"shape\", \"light\", \"material\", \"medium\" or \"texture\"";
            typed
                .at
                .diagnostic(format!("{expected}, found \"{found}\""))
        })?;
        if self.state.attributes.len() == MOST_ATTRIBUTES {
            let message = format!("expected at most {MOST_ATTRIBUTES} `Attribute`s in force");
            return Err(typed.at.diagnostic(message));
        }
        let said = Rc::new(typed.parameters);
        self.attributes
            .push((typed.at.path.to_path_buf(), Rc::clone(&said)));
        self.state.attributes.push((target, said));
        Ok(())
    }

    /// Names the parameters of attributes that no directive asked for.
    pub(super) fn warn_unused_attributes(&mut self) {
        for (path, said) in core::mem::take(&mut self.attributes) {
            let at = FileLoc {
                path: &path,
                line: 0,
            };
            self.warn_unused(at, "Attribute", &said);
        }
    }
}
