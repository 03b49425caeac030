//! Light sets for measuring light samplers: lights of three simple kinds and shading points,
//! without any geometry.
//!
//! A set is generated from a [`SetKind`], a count and a seed ([`LightSetFile::generate`]), or read
//! from two text files, and written back to them. Lengths and powers have an arbitrary but
//! consistent unit.

mod adversarial;
mod families;
mod generate;
mod light;
mod random;
mod reader;
mod writer;

pub use families::Family;
pub use generate::SetKind;
pub use light::SetLight;
pub use reader::{LightSetError, LightSetProblem};

use glam::Vec3;

/// Shading points of a generated set.
const POINTS: usize = 4096;

/// A shading point, with its unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetPoint {
    /// Position.
    pub p: Vec3,
    /// Unit surface normal.
    pub n: Vec3,
}

/// A set of lights, and the points at which a sampler is measured on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightSetFile {
    /// The lights; the index is the light's id.
    pub lights: Vec<SetLight>,
    /// The shading points.
    pub points: Vec<SetPoint>,
}
