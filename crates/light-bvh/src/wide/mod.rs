//! The default tree: wide nodes of quantised moments.

#[cfg(feature = "alloc")]
mod build;
mod cut;
#[cfg(feature = "alloc")]
mod encode;
mod glossy;
mod importance;
mod lane;
#[cfg(feature = "alloc")]
mod light_bvh;
#[cfg(feature = "alloc")]
mod moments;
mod node;
#[cfg(feature = "alloc")]
mod prim;
mod segment;
mod select;
#[cfg(feature = "alloc")]
mod split;
mod tree;

pub use cut::{CutDetail, LightCut};
pub use glossy::GlossyReceiver;
pub use importance::{MediumReceiver, Receiver, SurfaceReceiver, TwoSidedReceiver, is_far};
pub use lane::Lane;
#[cfg(feature = "alloc")]
pub use light_bvh::LightBvh;
pub use node::WideNode;
pub use segment::SegmentReceiver;
pub use tree::{LightBvhRef, MAX_DEPTH};
