use crate::{Case, Findings, Malformed};

/// Compares the lines of one kind, from the first to the last; later lines may refer to earlier
/// ones.
pub trait Checker {
    /// Looks at one line and notes in `findings` what holds and what does not.
    ///
    /// # Errors
    /// [`Malformed`] if the line lacks a field or holds something unexpected.
    fn check(&mut self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed>;
}

/// Checkers without memory are plain functions.
impl<F: FnMut(&Case<'_>, &mut Findings) -> Result<(), Malformed>> Checker for F {
    fn check(&mut self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        self(case, findings)
    }
}
