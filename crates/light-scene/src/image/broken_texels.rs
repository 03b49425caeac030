/// What becomes of texels that cannot be light: negative ones, NaN and infinity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BrokenTexels {
    /// NaN and infinity refuse the image, negative numbers become 0.
    Refuse,
    /// NaN and infinity refuse the image, negative numbers stay: the image is compared, not lit by.
    KeepNegative,
    /// As long as they are at most one of a hundred, NaN becomes 0, and infinity the largest number
    /// of the image; negative numbers become 0.
    Clamp,
}
