use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicUsize, Ordering};
use std::io::Cursor;
use std::{env, fs, process};

use light_bounds::LightExtent;
use light_bvh::StoredLightBvh;
use light_bvh::out_of_core::{OutOfCoreBuild, SliceChunks};
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

/// A sampler of `lights` whose tree is built with at most so many of them in memory.
///
/// # Panics
/// If the lights are not valid, or the folder of temporary files cannot be written.
#[must_use]
pub fn built_out_of_core(
    lights: &[LightExtent],
    lights_at_once: usize,
) -> BvhLightSamplerRef<'static> {
    static BUILDS: AtomicUsize = AtomicUsize::new(0);
    let name = format!(
        "lights-{}-{}",
        process::id(),
        BUILDS.fetch_add(1, Ordering::Relaxed)
    );
    let scratch = env::temp_dir().join(name);
    fs::create_dir(&scratch).expect("a folder for scratch files");
    let build = OutOfCoreBuild::new(&scratch).with_lights_at_once(lights_at_once);
    let mut bytes = Cursor::new(Vec::new());
    let mut chunks = SliceChunks::new(lights, const { NonZeroUsize::new(1000).unwrap() });
    let written = build.write(&mut chunks, &mut bytes, |_, _| {});
    written.expect("valid lights");
    fs::remove_dir(&scratch).expect("an empty folder");
    let in_memory = BvhLightSampler::new(lights).expect("valid lights");
    in_bytes(&in_memory, bytes.get_ref())
}

/// The tree in `bytes` beside the lights of `sampler` at infinity.
fn in_bytes(sampler: &BvhLightSampler, bytes: &[u8]) -> BvhLightSamplerRef<'static> {
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
