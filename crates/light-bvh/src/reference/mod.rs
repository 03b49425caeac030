//! The published tree, made robust: the baseline that everything is measured against.
//!
//! Binary, 32 bytes a node, one importance per child and level. It keeps the published importance
//! and cost where they are merely weak. For rendering use the default tree.

#[cfg(feature = "alloc")]
mod all_pmfs;
mod bit_trail;
#[cfg(feature = "alloc")]
mod builder;
#[cfg(feature = "alloc")]
mod cost;
mod descend;
mod fork;
mod node;
#[cfg(feature = "alloc")]
mod owned;
mod pmf;
#[cfg(feature = "alloc")]
mod split;
mod stats;
mod view;

pub use bit_trail::{BitTrail, Side};
pub use node::{Link, ReferenceNode};
#[cfg(feature = "alloc")]
pub use owned::ReferenceLightBvh;
pub use stats::ReferenceStats;
pub use view::{MalformedTree, ReferenceLightBvhRef};
