use std::path::PathBuf;

use clap::Args;

use super::arguments::threads;
use super::checkpoint::CheckpointArgs;
use super::display_args::DisplayArgs;
use super::layer_args::LayerArgs;
use super::live_args::LiveArgs;
use super::render_settings::SettingsArgs;
use super::scene_input::SceneInput;
use super::view_args::ViewArgs;

/// Render a scene into an image.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights render room.obj -o room.png --width 960 --spp 256
  lights render car.glb --env studio.exr --env-scale 0.5 -o car.exr -o car.png
  lights render model.obj --sky overcast --exposure auto --tone-map reinhard -o model.png
  lights render scene.pbrt --time 60 --light-sampler bvh -o scene.exr
  lights render night --samples 0..64 -o part-0.exr   (lights merge adds the parts)
  lights render night --checkpoint night.part.exr --spp 1024 -o night.exr

Exit status: 0 done, 2 bad usage or bad input, 130 interrupted."
)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    pub(super) input: SceneInput,
    /// The image to write: .exr (float32 linear RGB) or .png; more than once for more than one.
    #[arg(short, long, value_name = "IMAGE", required = true)]
    pub(super) output: Vec<PathBuf>,
    /// Write .exr files of half floats.
    #[arg(long)]
    pub(super) half: bool,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
    /// Threads, at most 1024; 0 = one a core.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads)]
    pub(super) threads: usize,
    #[command(flatten)]
    pub(super) view: ViewArgs,
    #[command(flatten)]
    pub(super) display: DisplayArgs,
    #[command(flatten)]
    pub(super) checkpoint: CheckpointArgs,
    #[command(flatten)]
    pub(super) layers: LayerArgs,
    /// Do nothing if the output holds the --samples of this picture already.
    #[arg(long, requires = "samples")]
    pub(super) skip_existing: bool,
    #[command(flatten)]
    pub(super) live: LiveArgs,
    /// Print one line of JSON about the rendering; `seconds` include `visibility_seconds`.
    #[arg(long)]
    pub(super) json: bool,
    /// Print nothing but results: no progress, no warnings.
    #[arg(long, short)]
    pub(super) quiet: bool,
}
