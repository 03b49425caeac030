use light_bvh::StoredLightBvh;
use light_samplers::{BvhLightSampler, BvhLightSamplerRef};

/// `sampler` with its tree in bytes, which are queried where they lie; they stay until the program
/// ends.
///
/// # Panics
/// If the tree does not come back from its bytes.
#[must_use]
pub fn stored(sampler: &BvhLightSampler) -> BvhLightSamplerRef<'static> {
    in_bytes(sampler, &sampler.tree().to_bytes())
}

/// The tree in `bytes` beside the lights of `sampler` at infinity; they stay until the program ends.
///
/// # Panics
/// If they are not the bytes of a tree of as many lights.
#[must_use]
pub fn in_bytes(sampler: &BvhLightSampler, bytes: &[u8]) -> BvhLightSamplerRef<'static> {
    let tree = StoredLightBvh::from_bytes(aligned(bytes)).expect("the bytes of a tree");
    let infinite = sampler.view().infinite_lights().to_vec().leak();
    let stored = BvhLightSamplerRef::new(tree.view(), tree.power(), infinite);
    stored.expect("the lights of a sampler")
}

/// A copy at a multiple of 32.
fn aligned(bytes: &[u8]) -> &'static [u8] {
    const ALIGNMENT: usize = 32;
    let room = vec![0; bytes.len() + ALIGNMENT].leak();
    let start = room.as_ptr().align_offset(ALIGNMENT);
    let place = &mut room[start..start + bytes.len()];
    place.copy_from_slice(bytes);
    place
}
