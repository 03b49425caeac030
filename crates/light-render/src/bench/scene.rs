use super::candidate::Candidate;
use super::measure::Plan;
use super::measurement::Measurement;
use super::row::BenchRow;
use super::scene_query::SceneQuery;
use super::scene_receiver::Shadows;
use super::surface_points::on_surfaces;
use crate::{AnyLightSamplerError, World};

/// How many points of surfaces are drawn at most.
const MOST_POINTS: usize = 4096;

/// How samplers are measured on the lights of a scene. By default with nothing in the way.
#[derive(Clone, Debug)]
pub struct SceneBenchOptions {
    /// What is measured. The variance is taken over at most 4096 points of surfaces; without a
    /// number of its own over as many as [`points_for`](Self::points_for) says.
    pub measurement: Measurement,
    /// Chooses the points.
    pub seed: u64,
    /// Whether surfaces of the scene hide lights.
    pub shadows: Shadows,
}

impl Default for SceneBenchOptions {
    fn default() -> Self {
        Self {
            measurement: Measurement::default(),
            seed: 1,
            shadows: Shadows::default(),
        }
    }
}

impl SceneBenchOptions {
    /// The points of each light, as the root of their number: 16 up to 16,384 lights, 4 up to
    /// 262,144, then one.
    #[must_use]
    pub const fn strata_for(lights: usize) -> u16 {
        match lights {
            0..=0x4000 => 4,
            0x4001..=0x4_0000 => 2,
            _ => 1,
        }
    }

    /// Points of surfaces that the variance is taken over: so many that 2^25 points of lights are
    /// looked at, 2^22 with shadows, but 16 to 4096.
    #[must_use]
    pub fn points_for(&self, lights: usize) -> usize {
        let looks: usize = match self.shadows {
            Shadows::Off => 1 << 25,
            Shadows::Cast => 1 << 22,
        };
        let strata = usize::from(Self::strata_for(lights));
        let fitting = (looks / (lights.max(1) * strata * strata)).clamp(16, MOST_POINTS);
        self.measurement
            .var_points
            .unwrap_or(fitting)
            .min(MOST_POINTS)
    }
}

/// One row for each sampler over the lights of `world`, as [`bench`](super::bench) makes them for a
/// set. The receivers are points on its surfaces, uniform in area, with the materials there.
///
/// The variance is exact in the choice: it is a sum over all lights, however many. What a light
/// gives is the mean over some points of it, as [`SceneBenchOptions::strata_for`] says. No rows if
/// no surface scatters light into more than single directions.
///
/// # Errors
/// The first light that a sampler refuses.
///
/// # Panics
/// If the system refuses to start the threads.
pub fn bench_scene(
    name: &str,
    world: &World,
    options: &SceneBenchOptions,
) -> Result<Vec<BenchRow>, AnyLightSamplerError> {
    let lights = world.lights();
    let receivers = on_surfaces(world, MOST_POINTS, options.seed);
    if receivers.is_empty() {
        return Ok(Vec::new());
    }
    let plan = Plan {
        set: name,
        measurement: &options.measurement,
        points: options.points_for(lights.len()).min(receivers.len()),
        extents: &lights.extents(),
    };
    let strata = SceneBenchOptions::strata_for(lights.len());
    let query = SceneQuery::new(world, receivers, strata, options.shadows);
    plan.measure(&query, |kind| Candidate::for_lights(kind, lights))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SamplerKind;
    use light_scene::{BuiltinScene, Emission, Material, Mesh, Scene, Surface};
    use lights::glam::Vec3;

    fn rows(scene: Scene, options: &SceneBenchOptions) -> Vec<BenchRow> {
        let world = World::new(scene).expect("valid");
        bench_scene("scene", &world, options).expect("lights")
    }

    fn options(samplers: &[SamplerKind]) -> SceneBenchOptions {
        SceneBenchOptions {
            measurement: Measurement {
                samplers: samplers.to_vec(),
                var_points: Some(64),
                ..Measurement::default()
            },
            ..SceneBenchOptions::default()
        }
    }

    /// A floor of 2 x 2 and two lamps of 0.2 x 0.2 over it that look down, the second three times
    /// as strong; a board above the floor hides both.
    fn two_lamps(floor: Material, board: bool) -> Scene {
        let mut scene = Scene::default();
        let floor = scene.add_material(floor);
        let quad = |y: f32, x: f32, half: f32| {
            [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
                .map(|(s, t)| Vec3::new(x + half * s, y, half * t))
        };
        scene
            .meshes
            .push(Mesh::quad("floor", floor, quad(0.0, 0.0, 1.0)));
        for (x, l) in [(-0.5, 1.0), (0.5, 3.0)] {
            let lamp = scene.add_material(Material {
                emission: Some(Emission::one_sided(Vec3::splat(l))),
                ..Material::diffuse("lamp", Vec3::ZERO)
            });
            let mut corners = quad(1.0, x, 0.1);
            corners.reverse();
            scene.meshes.push(Mesh::quad("lamp", lamp, corners));
        }
        if board {
            let corners = quad(0.5, 0.0, 3.0);
            scene.meshes.push(Mesh::quad("board", floor, corners));
        }
        scene
    }

    #[test]
    fn the_sum_over_choices_is_the_variance() {
        let options = options(&[SamplerKind::Uniform, SamplerKind::Exhaustive]);
        let floor = || Material::diffuse("floor", Vec3::ONE);
        let [uniform, exhaustive] = &rows(two_lamps(floor(), false), &options)[..] else {
            panic!("two rows");
        };
        assert_eq!((uniform.n_lights, uniform.points), (4, 64), "two quads");
        // Four lights, of which at best one gives all and at worst all the same.
        let v = uniform.variance;
        assert!(v.mean > 0.0 && v.mean < 3.0, "{v:?}");
        assert!(exhaustive.variance.mean < 0.5 * v.mean, "{exhaustive:?}");
        let ceiling = v.ceiling.expect("one sample a call");
        assert_eq!(ceiling.arriving, 1.0, "nothing in the way");
        assert!(ceiling.within > 0.0 && ceiling.best < v.mean, "{ceiling:?}");
        assert_eq!(v.lost_energy, 0.0, "each is chosen");
        assert!(uniform.laws.hold(), "{:?}", uniform.laws);
    }

    #[test]
    fn shadows_hide_lights() {
        let options = options(&[SamplerKind::Uniform]);
        let floor = || Material::diffuse("floor", Vec3::ONE);
        let arriving = |shadows| {
            let options = SceneBenchOptions {
                shadows,
                ..options.clone()
            };
            let row = &rows(two_lamps(floor(), true), &options)[0];
            (
                row.variance.ceiling.expect("one sample a call").arriving,
                row.variance.mean,
            )
        };
        assert_eq!(arriving(Shadows::Off).0, 1.0, "nothing is in the way");
        // Points of the floor are dark then, those of the board see both lamps.
        let (seen, mean) = arriving(Shadows::Cast);
        assert!(
            seen > 0.99 && mean > 0.0,
            "points that see nothing do not count: {seen}"
        );
    }

    #[test]
    fn mirrors_and_lamps_receive_nothing() {
        let mut mirror = Material::diffuse("mirror", Vec3::ONE);
        mirror.surface = Surface::Mirror {
            reflectance: Vec3::ONE,
        };
        let scene = two_lamps(mirror, false);
        assert!(
            rows(scene, &SceneBenchOptions::default()).is_empty(),
            "no point"
        );
    }

    #[test]
    fn points_spread_by_area_and_are_the_same_for_a_seed() {
        let world = World::new(BuiltinScene::CornellBox.load()).expect("valid");
        let places = |seed| -> Vec<Vec3> {
            let all = on_surfaces(&world, 512, seed);
            all.iter().map(|receiver| receiver.ctx.p).collect()
        };
        assert_eq!(places(3), places(3), "a function of the seed");
        assert_ne!(places(3), places(4), "another seed");
        let bounds = world.bounds();
        let low = places(3).iter().filter(|p| p.y < bounds.center().y).count();
        assert!((150..400).contains(&low), "on both halves: {low} of 512");
    }

    #[test]
    fn more_lights_have_fewer_points() {
        let options = SceneBenchOptions::default();
        let points = [10, 10_000, 1_000_000, 100_000_000].map(|n| options.points_for(n));
        assert_eq!(points, [4096, 209, 33, 16], "by the looks at lights");
    }
}
