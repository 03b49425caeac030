use std::path::PathBuf;

use clap::Args;
use light_sets::SetKind;

use crate::SamplerKind;
use crate::bench::{BenchReceiverKind, GroundTruth};

use super::arguments::{named, threads};
use super::sampler_list::list;
use super::scene_input::SceneChanges;
use super::whole::whole;

/// What is said of a scene, and not of a set.
const OF_A_SCENE: [&str; 7] = [
    "scene",
    "env",
    "env_rotate",
    "sky",
    "env_scale",
    "light_scale",
    "emit",
];

/// Measure light samplers side by side on the lights of a scene, or on a set of lights.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights bench room.obj --shadows
  lights bench chair.glb --sky clear-noon
  lights bench --generate clusters --n 100000 --samplers bvh-reference,bvh
  lights bench --lights a.lights --points a.points --json

Columns:
  set, lights     name of the set or scene, and its number of lights
  sampler, k      how lights are chosen, and how many a call chooses
  build ms        milliseconds to build the sampler, with --threads threads
  bytes, B/light  bytes that a choice may touch, in all and a light
  depth           nodes on the longest path from the root of a tree
  ns/sample       nanoseconds to choose a light
  ns/pmf          nanoseconds to find the probability of a light
  V mean, median  variance of the estimate of one choice, over the square of what all lights give
                  at the point; mean and median over the points. With --k it is K times the
                  variance of the mean of K choices. Points that no light reaches do not count; - is
                  shown where there is no other
  V 99 %          what 99 of 100 points stay below
  V within        variance that is left within lights whichever is chosen, for lights with an area
  V best          variance of the best choice there is; --shadows shows how much of it they cause
  lost            share of the light that comes from lights that are never chosen: 0 if right
  no light        share of choices that choose none, where bounds grow tighter on the way down"
)]
pub(crate) struct BenchArgs {
    /// The scene, whose lights are seen from points on its surfaces: an .obj, .pbrt, .gltf or .glb
    /// file, or one that ships, as for lights render.
    pub(super) scene: Option<PathBuf>,
    #[command(flatten)]
    pub(super) changes: SceneChanges,
    /// Let the surfaces of the scene hide its lights.
    #[arg(long, requires = "scene", conflicts_with_all = ["generate", "lights"])]
    pub(super) shadows: bool,
    /// Lights of the set to read; needs --points.
    #[arg(
        long,
        value_name = "FILE",
        requires = "points",
        conflicts_with_all = OF_A_SCENE
    )]
    pub(super) lights: Option<PathBuf>,
    /// Shading points of the set to read; needs --lights.
    #[arg(long, value_name = "FILE", requires = "lights")]
    pub(super) points: Option<PathBuf>,
    /// Make a set: of plain lights, a place, or an adversarial set.
    #[arg(
        long,
        value_name = "KIND",
        conflicts_with_all = ["lights", "points"].into_iter().chain(OF_A_SCENE),
        value_parser = named::<SetKind>(SetKind::all().map(SetKind::name))
    )]
    pub(super) generate: Option<SetKind>,
    /// Lights of the set to make.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 10_000,
        conflicts_with_all = ["scene", "lights"],
        value_parser = whole(1..=u32::MAX)
    )]
    pub(super) n: u32,
    /// Seed of the set to make, or of the points on surfaces.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1,
        conflicts_with = "lights",
        value_parser = seed
    )]
    pub(super) seed: u64,
    /// Keep the set as PREFIX.lights and PREFIX.points.
    #[arg(long, value_name = "PREFIX", conflicts_with = "scene")]
    pub(super) write: Option<PathBuf>,
    /// Samplers to measure, with commas between: uniform, power, exhaustive, bvh-reference, bvh,
    /// bvh-morton.
    #[arg(long, value_name = "LIST", default_value_t = list(&SamplerKind::SUBLINEAR))]
    pub(super) samplers: String,
    /// Samples of one call, at most 4096.
    #[arg(long, default_value_t = 1, value_parser = whole(1..=1 << 12))]
    pub(super) k: u32,
    /// Points that the variance is taken over. By default all, or 256 above 10 thousand lights; in
    /// a scene 4096, or fewer of more than 512 lights.
    #[arg(long, value_name = "M", value_parser = whole(1..=u32::MAX))]
    pub(super) var_points: Option<u32>,
    /// Threads for building, at most 1024.
    #[arg(long, value_name = "T", default_value_t = 1, value_parser = threads)]
    pub(super) threads: usize,
    /// Contribution of a triangle: `centroid`, or `area` for the mean over sixteen points of it.
    #[arg(long = "truth", default_value = "centroid", conflicts_with = "scene")]
    pub(super) ground_truth: GroundTruth,
    /// The receivers: `diffuse`, `two-sided`, `medium`, or `glossy:ROUGHNESS` for half diffuse,
    /// half microfacets.
    #[arg(long, default_value = "diffuse", conflicts_with = "scene")]
    pub(super) receiver: BenchReceiverKind,
    /// Spheres that block light, a tenth of the set's volume together; at most 65536.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        conflicts_with = "scene",
        value_parser = whole(0..=1 << 16)
    )]
    pub(super) occluders: u32,
    /// Move the lights in N steps, at most 20, each twice as far as the last, and compare
    /// hierarchies that follow with new ones.
    #[arg(
        long,
        value_name = "N",
        conflicts_with_all = ["k", "scene"],
        value_parser = whole(0..=20)
    )]
    pub(super) refits: Option<u32>,
    /// One JSON object a line instead of a table.
    #[arg(long)]
    pub(super) json: bool,
}

/// Any number of 64 bits.
fn seed(text: &str) -> Result<u64, String> {
    let seed = text.parse();
    seed.map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
}
