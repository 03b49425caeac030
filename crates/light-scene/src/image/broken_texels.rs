/// What becomes of texels that are NaN or infinite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BrokenTexels {
    /// The image is refused.
    Refuse,
    /// As long as they are at most one of a hundred, NaN becomes 0, and infinity the largest number
    /// of the image.
    Clamp,
}
