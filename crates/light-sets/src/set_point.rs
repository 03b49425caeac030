use glam::Vec3;

/// A shading point, with its unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetPoint {
    /// Position.
    pub p: Vec3,
    /// Unit surface normal.
    pub n: Vec3,
}
