//! Hierarchies that were built out of core obey the laws of light samplers.

use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicUsize, Ordering};
use std::io::Cursor;
use std::{env, fs, process};

use light_bvh::out_of_core::{OutOfCoreBuild, SliceChunks};
use light_samplers::light_bounds::LightExtent;
use light_samplers::{BvhLightSampler, BvhLightSamplerRef};
use light_testkit::in_bytes;

light_testkit::sampler_laws! {
    /// The default hierarchy, built with at most seven lights in memory.
    mod bvh_out_of_core {
        |set| built_out_of_core(&set.extents(), 7)
    }
}

/// A sampler of `lights` whose tree is built with at most so many of them in memory.
fn built_out_of_core(lights: &[LightExtent], lights_at_once: usize) -> BvhLightSamplerRef<'static> {
    static BUILDS: AtomicUsize = AtomicUsize::new(0);
    let number = BUILDS.fetch_add(1, Ordering::Relaxed);
    let scratch = env::temp_dir().join(format!("lights-{}-{number}", process::id()));
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
