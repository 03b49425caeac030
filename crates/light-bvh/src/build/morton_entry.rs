/// A light and its place on the curve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct MortonEntry {
    /// Its kind, and three interleaved coordinates of 21 bits.
    pub(crate) key: u64,
    pub(crate) light: u32,
    /// As a share of the power of all lights.
    pub(crate) power: f32,
}
