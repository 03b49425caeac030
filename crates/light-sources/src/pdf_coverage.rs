/// The directions that light samples have to cover.
///
/// The same value goes to [`sample_li`](crate::Light::sample_li) and to
/// [`pdf_li`](crate::Light::pdf_li).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PdfCoverage {
    /// Every direction from which light arrives has a positive density: the estimator is unbiased
    /// on its own.
    #[default]
    Complete,
    /// Directions of little light may be left out, because other samples (of the BSDF, say) cover
    /// them and multiple importance sampling combines both.
    ///
    /// # Source
    /// `[Karlik2019]`.
    Incomplete,
}
