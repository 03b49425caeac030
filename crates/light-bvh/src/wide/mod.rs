//! The default tree: wide nodes of quantised moments.

mod beside;
#[cfg(feature = "alloc")]
mod bins;
#[cfg(feature = "alloc")]
mod brood;
#[cfg(feature = "alloc")]
mod build;
#[cfg(feature = "alloc")]
mod clusters;
mod cut;
mod cut_choose;
mod cut_grow;
#[cfg(feature = "alloc")]
mod emission;
#[cfg(feature = "alloc")]
mod encode;
mod glossy;
#[cfg(feature = "alloc")]
mod group;
mod importance;
#[cfg(feature = "alloc")]
mod lamp;
mod lane;
#[cfg(feature = "alloc")]
mod lanewise;
#[cfg(feature = "alloc")]
mod light_bvh;
#[cfg(feature = "alloc")]
mod lights;
#[cfg(feature = "alloc")]
mod looseness;
#[cfg(feature = "alloc")]
mod moments;
#[cfg(feature = "alloc")]
mod morton;
mod node;
#[cfg(feature = "alloc")]
mod options;
#[cfg(feature = "alloc")]
mod prim;
mod query;
#[cfg(feature = "alloc")]
mod radix;
#[cfg(feature = "alloc")]
mod refit;
#[cfg(feature = "alloc")]
mod run;
#[cfg(feature = "alloc")]
mod scan;
mod segment;
mod select;
#[cfg(feature = "alloc")]
mod skeleton;
mod tree;
mod vectors;
mod weights;

pub use cut::{CutDetail, CutDetailError, LightCut};
pub use glossy::GlossyReceiver;
pub use importance::{MediumReceiver, Receiver, SurfaceReceiver, TwoSidedReceiver, is_far};
pub use lane::Lane;
#[cfg(feature = "alloc")]
pub use light_bvh::LightBvh;
pub use node::WideNode;
#[cfg(feature = "alloc")]
pub use options::{BuildMode, DarkLights, LightBvhOptions};
pub use segment::SegmentReceiver;
pub use tree::{LightBvhRef, MAX_DEPTH};
pub use vectors::prefetch_item;
