use crate::bytes::header::{Header, TreeBytesError};
use crate::bytes::links::{are_groups_sound, are_links_sound};
use crate::query::bvh_ref::LightBvhRef;

/// A tree that lies in bytes: in a mapped file, in flash, or in a buffer.
///
/// 32 bytes of head, the nodes, the entries of [`LightBvhRef::order`] and [`LightBvhRef::slots`],
/// and the groups of the lights if they have some, as little-endian machines hold them. Nothing is
/// copied. The example [`tree_in_a_file`][1] writes a tree and reads it.
///
/// Queries of a tree far above the caches wait for page tables too. On Linux ask for huge pages
/// (`madvise` with `MADV_HUGEPAGE`, in `memmap2` `Mmap::advise(Advice::HugePage)`) before the first
/// read of a mapped file: see *More lights than memory holds* in `docs/light-bvh.md`.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/tree_in_a_file.rs
#[derive(Clone, Copy, Debug)]
pub struct StoredLightBvh<'a> {
    view: LightBvhRef<'a>,
    power: f32,
}

impl<'a> StoredLightBvh<'a> {
    /// The tree in `bytes`, which [`LightBvh::to_bytes`](crate::LightBvh::to_bytes) made and which
    /// begin at a multiple of 32. Those of a mapped file do, those of a `Vec<u8>` need not:
    /// [`LightBvh::from_bytes`](crate::LightBvh::from_bytes) takes bytes from anywhere, and copies.
    ///
    /// # Errors
    /// The first thing that is wrong: see [`TreeBytesError`]. Looks at every node and light once;
    /// what nodes say of their lights is not checked: wrong codes give wrong probabilities, but
    /// neither a panic nor an endless loop.
    pub fn from_bytes(bytes: &'a [u8]) -> Result<Self, TreeBytesError> {
        let (header, [nodes, order, slots, groups]) = Header::split(bytes)?;
        let unaligned = |_| TreeBytesError::Alignment;
        let view = LightBvhRef::new(
            bytemuck::try_cast_slice(nodes).map_err(unaligned)?,
            bytemuck::try_cast_slice(order).map_err(unaligned)?,
            bytemuck::try_cast_slice(slots).map_err(unaligned)?,
        );
        let groups = bytemuck::try_cast_slice(groups).map_err(unaligned)?;
        Self::checked(view.with_groups(groups), header.power())
    }

    /// The tree of `view`, if it is one.
    pub(super) fn checked(view: LightBvhRef<'a>, power: f32) -> Result<Self, TreeBytesError> {
        let has_power = power.is_finite() && power >= 0.0;
        if has_power && are_links_sound(&view) && are_groups_sound(&view) {
            Ok(Self { view, power })
        } else {
            Err(TreeBytesError::Links)
        }
    }

    /// What queries need.
    #[must_use]
    pub const fn view(&self) -> LightBvhRef<'a> {
        self.view
    }

    /// The power of all lights of the tree.
    #[must_use]
    pub const fn power(&self) -> f32 {
        self.power
    }
}
