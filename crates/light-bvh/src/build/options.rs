/// How a [`LightBvh`](crate::LightBvh) is built.
///
/// ```
/// use light_bvh::{LightBvh, LightBvhOptions};
///
/// let tree = LightBvh::build_with(&[], &LightBvhOptions::FAST)?;
/// assert_eq!(tree.depth(), 0);
/// # Ok::<(), light_bvh::LightBvhError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightBvhOptions {
    /// How lights are grouped.
    pub mode: BuildMode,
    /// Whether lights that are off have a place in the tree.
    pub dark: DarkLights,
}

/// How lights are grouped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum BuildMode {
    /// Where the groups cost least: by power, by how far they spread, and by how little their axes
    /// agree.
    #[default]
    Binned,
    /// By the cells of an octree that they lie in: built in less time, sampled with more noise.
    Morton,
}

/// Whether lights without power have a place in a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum DarkLights {
    /// They have no place in the tree: they take no memory, and a refit cannot switch them on.
    #[default]
    LeftOut,
    /// They have a place, unreachable until a [refit](crate::LightBvh::refit) switches them on.
    Kept,
}

impl LightBvhOptions {
    /// The least noise: the default.
    pub const QUALITY: Self = Self {
        mode: BuildMode::Binned,
        dark: DarkLights::LeftOut,
    };

    /// The least time to build.
    pub const FAST: Self = Self {
        mode: BuildMode::Morton,
        ..Self::QUALITY
    };

    /// For lights that move, are switched on and off, or are added and removed: every light gets a
    /// place, and lights that are off are the room for those to come. What is added far from the
    /// place that its spare light had makes the groups there larger:
    /// [`degradation`](crate::LightBvh::degradation) says when to build a new tree.
    pub const DYNAMIC: Self = Self {
        dark: DarkLights::Kept,
        ..Self::QUALITY
    };
}
