//! Skies do not depend on the number of threads that build them.

use light_sources::glam::Vec3;
use light_sources::*;
use light_testkit::Rng;
use rayon::ThreadPoolBuilder;

/// Every number of a sky that is large enough to be built on several threads.
fn sky(threads: usize) -> String {
    let mut rng = Rng::new(86);
    let texels: Vec<f32> = (0..512 * 256).map(|_| rng.log_range(1e-3, 1e3)).collect();
    let image = Image::from_f32([512, 256], Channels::Gray, texels).expect("an image");
    let desc = ImageInfiniteLightDesc::new(EnvironmentMap::LatLong(image));
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let build = || ImageInfiniteLight::<Rgb>::new(desc, scene).expect("a sky");
    format!("{:?}", pool.expect("threads").install(build))
}

#[test]
fn one_thread_and_four_build_the_same_sky() {
    let [one, four] = [1, 4].map(sky);
    assert!(one.len() > 512 * 256, "all sums are compared");
    assert!(one == four, "other bits on other numbers of threads");
}
