//! light-bvh
