/// One of the equally likely bins of an [`AliasTable`](super::AliasTable): 12 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct AliasBin {
    /// How many of the 2^16 parts of the bin belong to its own index.
    pub own: u32,
    /// The index to which the rest of the bin belongs.
    pub alias: u32,
    /// The probability of the bin's own index.
    pub pmf: f32,
}
