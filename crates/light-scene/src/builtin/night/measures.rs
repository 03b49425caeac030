//! The measures of the canal.

/// From the middle of the canal to the quay wall, in metres; all lengths of the scene are metres,
/// the water is at height 0.
pub(super) const WATER: f32 = 8.5;

/// Height of the quays.
pub(super) const QUAY: f32 = 1.7;

/// From the middle of the canal to the fronts of the houses.
pub(super) const FRONTS: f32 = 14.5;

/// Where along the canal the bridges are.
pub(super) const BRIDGES: [f32; 3] = [33.0, 62.0, 93.0];
