//! A tree of trees: lights that are placed many times are stored once.

pub(crate) mod by_direction;
pub(crate) mod error;
pub(crate) mod frames;
pub(crate) mod instanced_at;
pub(crate) mod instanced_bvh;
pub(crate) mod leaf_ids;
pub(crate) mod light_ranges;
pub(crate) mod openings;
pub(crate) mod overlaps;
pub(crate) mod part;
pub(crate) mod placed;
pub(crate) mod placed_frame;
pub(crate) mod placed_light;
pub(crate) mod placed_moments;
pub(crate) mod placed_part;
pub(crate) mod placed_receiver;
pub(crate) mod placement;
pub(crate) mod prototype;
