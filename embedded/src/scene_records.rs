/// A shading point as it lies in flash: position and unit normal.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct PointRecord {
    pub(crate) p: [f32; 3],
    pub(crate) n: [f32; 3],
}

/// What is known of the sky beside its texels and its table.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct SkyRecord {
    /// Columns, and rows.
    pub(crate) size: u32,
    /// The mean of the texels.
    pub(crate) mean: f32,
    /// The fluence, in the unit of the powers of the other lights.
    pub(crate) fluence: f32,
    /// The mean direction toward the light.
    pub(crate) direction: [f32; 3],
    /// Its place among the lights of the sampler.
    pub(crate) id: u32,
}

/// How many numbers of the web of a lamp are of which kind.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct WebRecord {
    pub(crate) vertical: u32,
    pub(crate) horizontal: u32,
}
