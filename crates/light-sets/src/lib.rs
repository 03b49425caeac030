#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub use light_bounds;
pub use light_math::glam;

mod adversarial;
mod bench_set;
mod families;
mod generate;
mod random;
mod set_light;
mod set_point;

pub use bench_set::BenchSet;
pub use families::Family;
pub use generate::SetKind;
pub use set_light::SetLight;
pub use set_point::SetPoint;
