use core::time::Duration;
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::bench::{PictureBench, RelativeError};
use crate::integrator::{Estimator, Integrator, PathSettings};
use crate::{AnyLightSampler, Progress, RenderSettings, SamplerKind, ToneMap, View, World, render};
use light_scene::glam::Vec3;
use light_scene::{BuiltinScene, Camera, Image, write_exr, write_png};

use super::failure::Failure;
use super::output_file::make_folder;
use super::output_image::shown;
use super::progress::{ProgressLine, Volume};
use super::references::reference_halves;
use super::stdout::say;

/// Where the pictures go.
const FOLDER: &str = "out";

/// One picture of the demo: a scene, a way to choose lights, and how long it may take.
struct Shot {
    scene: BuiltinScene,
    sampler: SamplerKind,
    seconds: f32,
}

/// Where many lights are, each sampler has the same time; then the best one goes on.
const SHOTS: [Shot; 6] = [
    Shot::new(BuiltinScene::CornellBox, SamplerKind::Bvh, 7.0),
    Shot::new(BuiltinScene::Rotunda, SamplerKind::Bvh, 9.0),
    Shot::new(BuiltinScene::Night, SamplerKind::Uniform, 8.0),
    Shot::new(BuiltinScene::Night, SamplerKind::Power, 8.0),
    Shot::new(BuiltinScene::Night, SamplerKind::BvhReference, 8.0),
    Shot::new(BuiltinScene::Night, SamplerKind::Bvh, 8.0),
];

/// What one picture took, and how far it is from its reference.
struct Row {
    scene: BuiltinScene,
    sampler: SamplerKind,
    samples: u32,
    elapsed: Duration,
    rel_mse: f64,
    /// That of the reference.
    own_rel_mse: f64,
}

/// A scene ready to be rendered, kept between shots.
struct Stage {
    scene: BuiltinScene,
    bench: PictureBench,
    /// Two halves of the reference.
    halves: [Image; 2],
    /// Of the pixels that show no light: the edges of small lamps are noise that no light sampler
    /// can take away.
    relative: RelativeError,
    tone_map: ToneMap,
}

/// Keeps dark pixels from ruling the relative error.
const FLOOR: f64 = 0.01;

/// Renders three of the shipped scenes into [`FOLDER`], and prints one table.
///
/// # Errors
/// When the pictures cannot be written.
pub(crate) fn run() -> Result<(), Failure> {
    let folder = PathBuf::from(FOLDER);
    make_folder(&folder)?;
    say!(
        "{:<13} {:<14} {:>5} {:>8} {:>9} {:>10}",
        "scene",
        "sampler",
        "spp",
        "seconds",
        "relMSE",
        "reference"
    )?;
    let mut rows: Vec<Row> = Vec::new();
    let mut stage: Option<Stage> = None;
    for shot in &SHOTS {
        let ready = match stage.take() {
            Some(stage) if stage.scene == shot.scene => stage,
            _ => Stage::new(shot.scene)?,
        };
        let row = ready.shoot(shot, &folder)?;
        say!(
            "{:<13} {:<14} {:>5} {:>8.1} {:>9.5} {:>10.5}",
            row.scene.name(),
            row.sampler.name(),
            row.samples,
            row.elapsed.as_secs_f64(),
            row.rel_mse,
            row.own_rel_mse
        )?;
        rows.push(row);
        stage = Some(ready);
    }
    print_point(&rows)?;
    let shown = folder.canonicalize().unwrap_or(folder);
    say!(
        "relMSE is taken over the pixels in which no light is seen directly, from the differences \
         to two halves of a reference, so that its noise cancels on average; the last column is \
         the relMSE of the reference itself."
    )?;
    say!(
        "The pictures, PNG to look at and EXR to measure, are in {}.",
        shown.display()
    )?;
    Ok(())
}

impl Shot {
    const fn new(scene: BuiltinScene, sampler: SamplerKind, seconds: f32) -> Self {
        Self {
            scene,
            sampler,
            seconds,
        }
    }

    /// The name of the picture's files, without ending.
    fn name(&self) -> String {
        let compared = SHOTS.iter().filter(|shot| shot.scene == self.scene).count() > 1;
        if compared {
            format!("{}-{}", self.scene, self.sampler)
        } else {
            self.scene.to_string()
        }
    }
}

impl Stage {
    fn new(scene: BuiltinScene) -> Result<Self, Failure> {
        let halves = reference_halves(scene)?;
        let [a, b] = &halves;
        let pixels = a.texels().iter().zip(b.texels());
        let whole: Vec<Vec3> = pixels.map(|(a, b)| 0.5 * (*a + *b)).collect();
        let description = scene.load();
        let camera: Camera = description.camera_or_default();
        let view = View::new(&camera, a.width(), a.height()).map_err(Failure::input)?;
        let world = World::new(description).map_err(Failure::input)?;
        let bench = PictureBench::new(world, view).map_err(Failure::input)?;
        let fit = || ToneMap::fit(&whole);
        Ok(Self {
            scene,
            relative: bench.error(&whole, FLOOR),
            bench,
            tone_map: camera.exposure.map_or_else(fit, ToneMap::new),
            halves,
        })
    }

    /// Renders within the shot's time, the building of the sampler included, and writes the
    /// picture.
    fn shoot(&self, shot: &Shot, folder: &Path) -> Result<Row, Failure> {
        let start = Instant::now();
        let sampler = AnyLightSampler::new(shot.sampler, self.bench.world().lights());
        let sampler = sampler.map_err(Failure::input)?;
        let time = Duration::from_secs_f32(shot.seconds);
        let settings = RenderSettings {
            samples: 0..u32::MAX,
            time_limit: Some(time.saturating_sub(start.elapsed())),
            seed: 0,
            path: PathSettings {
                max_depth: 6,
                estimator: Estimator::Mis,
                light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
                integrator: Integrator::Path,
            },
        };
        let line = ProgressLine::new(format!("{}, {}", shot.scene, shot.sampler), Volume::Normal);
        let show = |p: Progress| line.show(p.done, format!("{} spp", p.samples));
        let (world, view) = (self.bench.world(), self.bench.view());
        let film = render(world, view, &sampler, &settings, show).film;
        let elapsed = start.elapsed();
        drop(line);
        let (width, height) = film.resolution();
        let image = Image::new(width, height, film.develop()).map_err(Failure::input)?;
        let [a, b] = self.halves.each_ref().map(Image::texels);
        let path = folder.join(shot.name());
        write_exr(&path.with_extension("exr"), &image).map_err(Failure::input)?;
        write_png(&path.with_extension("png"), &shown(&image, &self.tone_map)?)
            .map_err(Failure::input)?;
        Ok(Row {
            scene: shot.scene,
            sampler: shot.sampler,
            samples: film.samples(),
            elapsed,
            rel_mse: self.relative.against(image.texels(), [a, b]),
            // The mean of two has half the variance of each.
            own_rel_mse: 0.5 * self.relative.of_pair(a, b),
        })
    }
}

/// Says what the table shows about many lights.
fn print_point(rows: &[Row]) -> Result<(), Failure> {
    let night = |sampler| {
        rows.iter()
            .find(|row| row.scene == BuiltinScene::Night && row.sampler == sampler)
            .map(|row| row.rel_mse)
    };
    let kinds = [
        SamplerKind::Uniform,
        SamplerKind::Power,
        SamplerKind::BvhReference,
    ];
    let (Some(best), [Some(uniform), Some(power), Some(published)]) =
        (night(SamplerKind::Bvh), kinds.map(night))
    else {
        return Ok(());
    };
    say!("")?;
    say!(
        "In the same time the light hierarchy's error on the night scene is {:.0} times below that \
         of uniform sampling, {:.0} times below that of sampling by power, {:.1} times below that \
         of the published hierarchy.",
        uniform / best,
        power / best,
        published / best
    )
}
