use std::time::Instant;

use crate::choice_variance::{ChoiceVariance, choice_variance};
use crate::{AnyLightSampler, AnyLightSamplerError, LightInventory, SamplerKind, World, inventory};
use clap::Args;
use light_scene::Diagnostic;
use serde_json::{Map, Value, json};

use super::failure::Failure;
use super::render_settings::DEFAULT_DEPTH;
use super::scene_input::SceneInput;
use super::stdout::{complain, say};
use super::view_args::ViewArgs;
use super::visibility::VisibilityName;
use super::visible::Visible;

/// Show what a scene holds: lights, bounds, the light hierarchy, what was ignored.
#[derive(Args, Debug)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  lights info scene.pbrt
  lights info car.glb --json"
)]
pub(crate) struct InfoArgs {
    #[command(flatten)]
    input: SceneInput,
    /// Measure the share of light that arrives at what the scene's camera sees and how noisy choices
    /// of lights are there, or fill the cells of visibility for it, as `lights render --visibility`
    /// does, and show what was found; pilot is the same as share.
    #[arg(long, value_enum, default_value_t = VisibilityName::Off)]
    visibility: VisibilityName,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

/// The light hierarchy over a scene's lights.
struct Tree {
    sampler: SamplerKind,
    /// Whether it is a tree of placed trees.
    is_placed: bool,
    build_ms: f64,
    depth: usize,
    bytes: usize,
    /// The relative variance of one choice; `None` where no light arrives.
    quality: Option<ChoiceVariance>,
    /// How little a step down the tree narrows a group.
    degradation: Option<f64>,
}

impl InfoArgs {
    /// Reads the scene and prints what it holds.
    ///
    /// # Errors
    /// Bad input.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if let Some(note) = self.visibility.note() {
            complain(format_args!("{note}"));
        }
        let mut scene = self.input.read()?;
        let warnings = core::mem::take(&mut scene.warnings);
        let max_depth = scene.max_depth.unwrap_or(DEFAULT_DEPTH);
        let view = match self.visibility {
            VisibilityName::Off => None,
            _ => Some(ViewArgs::default().view(&scene)?),
        };
        let world = self.input.build(scene)?;
        let tree = Tree::over(&world).map_err(|error| self.input.refuse_choice(&error))?;
        let visible = |view| Visible::over(self.visibility, &world, &view, max_depth);
        let visible = view.map(visible).transpose()?;
        let kinds = inventory(world.lights());
        if self.json {
            let mut report = self.report(&world, &kinds, &tree, &warnings);
            report["visibility"] = visible.map_or(Value::Null, |visible| visible.report());
            say!("{report}")?;
        } else {
            self.print(&world, &kinds, &tree, &warnings)?;
            visible.map_or(Ok(()), |visible| visible.print())?;
        }
        Ok(())
    }

    fn report(
        &self,
        world: &World,
        kinds: &[LightInventory],
        tree: &Tree,
        warnings: &[Diagnostic],
    ) -> Value {
        let count = world.lights().len();
        let kinds: Vec<Value> = kinds.iter().map(kind_report).collect();
        let bounds = world.bounds();
        let bytes = world.lights().bytes();
        let placed = world.lights().placed_counts();
        json!({
            "scene": self.input.scene.display().to_string(),
            "triangles": world.triangle_count(),
            "stored_triangles": world.stored_triangle_count(),
            "quadrics": world.quadric_count(),
            "stored_quadrics": world.stored_quadric_count(),
            "prototypes": world.prototype_count(),
            "placements": world.instance_count(),
            "bounds": (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()]),
            "lights": count,
            "kinds": kinds,
            "placed_lights": {
                "meshes": placed.prototypes,
                "stored": placed.stored_lights,
                "placements": placed.placements,
                "lights": placed.lights,
            },
            "tree": {
                "sampler": tree.sampler.name(),
                "placed": tree.is_placed,
                "build_ms": tree.build_ms,
                "depth": tree.depth,
                "bytes": tree.bytes,
                "bytes_per_light": tree.bytes as f64 / count.max(1) as f64,
                "quality": tree.quality.map(|quality| quality.median),
                "quality_samples": tree.quality.and_then(|quality| quality.samples),
                "degradation": tree.degradation,
            },
            "bytes": {
                "vertices": bytes.vertices,
                "images": bytes.images,
                "lights": bytes.lights,
                "per_light": tree.bytes_per_light(world),
            },
            "warnings": warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        })
    }

    fn print(
        &self,
        world: &World,
        kinds: &[LightInventory],
        tree: &Tree,
        warnings: &[Diagnostic],
    ) -> Result<(), Failure> {
        let bounds = world.bounds();
        say!("{}", self.input.scene.display())?;
        say!("  triangles  {}", world.triangle_count())?;
        if world.quadric_count() > 0 {
            say!("  quadrics   {}", world.quadric_count())?;
        }
        if world.instance_count() > 0 {
            say!(
                "  objects    {} stored once, in {} places: {} triangles, {} quadrics stored",
                world.prototype_count(),
                world.instance_count(),
                world.stored_triangle_count(),
                world.stored_quadric_count()
            )?;
        }
        if bounds.is_empty() {
            say!("  bounds     none")?;
        } else {
            say!("  bounds     {} to {}", bounds.min, bounds.max)?;
        }
        say!("  lights     {}", world.lights().len())?;
        let placed = world.lights().placed_counts();
        if placed.placements > 0 {
            say!(
                "    of them {} placed: {} of {} meshes stored once, in {} places",
                placed.lights,
                placed.stored_lights,
                placed.prototypes,
                placed.placements
            )?;
        }
        for k in kinds {
            let [r, g, b] = k.power.to_array();
            say!(
                "    {:<12} {:>8}   power {r:.4e} {g:.4e} {b:.4e} W   area {:.4e}",
                k.kind,
                k.count,
                k.area
            )?;
            for (shape, count) in k.shapes.iter() {
                say!("      {shape:<10} {count:>8}")?;
            }
        }
        say!(
            "  hierarchy  {}{}: depth {}, {} bytes, built in {:.2} ms",
            tree.sampler,
            if tree.is_placed {
                " of placed trees"
            } else {
                ""
            },
            tree.depth,
            tree.bytes,
            tree.build_ms
        )?;
        let bytes = world.lights().bytes();
        say!(
            "  memory     {:.1} bytes a light: hierarchy {}, lights {}, images {}; {} of vertices",
            tree.bytes_per_light(world),
            tree.bytes,
            bytes.lights,
            bytes.images,
            bytes.vertices
        )?;
        if let Some(ChoiceVariance { median, samples }) = tree.quality {
            let how = samples.map_or_else(String::new, |samples| {
                format!(
                    ", estimated from {samples} choices at each, too low where they miss lights"
                )
            });
            say!(
                "  quality    {median:.3}: relative variance of one choice, nothing in the way, \
                 the median over points{how}"
            )?;
        }
        if let Some(degradation) = tree.degradation {
            say!(
                "  degradation  {degradation:.3}: spread of a group over that of its parent; \
                 lights that move raise it"
            )?;
        }
        for warning in warnings {
            say!("  ignored    {warning}")?;
        }
        Ok(())
    }
}

/// All lights of a kind; area lights by shape too.
fn kind_report(lights: &LightInventory) -> Value {
    let mut report = json!({
        "kind": lights.kind,
        "count": lights.count,
        "power": lights.power.to_array(),
        "area": lights.area,
    });
    let shapes: Map<String, Value> = lights
        .shapes
        .iter()
        .map(|(shape, count)| (shape.to_owned(), count.into()))
        .collect();
    if !shapes.is_empty() {
        report["shapes"] = shapes.into();
    }
    report
}

impl Tree {
    fn over(world: &World) -> Result<Self, AnyLightSamplerError> {
        let kind = SamplerKind::DEFAULT;
        let start = Instant::now();
        let sampler = AnyLightSampler::new(kind, world.lights())?;
        let build_ms = start.elapsed().as_secs_f64() * 1e3;
        Ok(Self {
            sampler: kind,
            is_placed: matches!(sampler, AnyLightSampler::BvhPlaced(_)),
            build_ms,
            quality: choice_variance(world, &sampler),
            degradation: sampler.degradation(),
            depth: sampler.depth(),
            bytes: sampler.bytes(world.lights().len()),
        })
    }

    /// What a light takes beyond its vertices, images that several share counted once.
    fn bytes_per_light(&self, world: &World) -> f64 {
        let bytes = world.lights().bytes();
        let all = self.bytes + bytes.lights + bytes.images;
        all as f64 / world.lights().len().max(1) as f64
    }
}
