//! Small scenes and the means of their pictures.

use core::num::NonZeroU32;
use core::ops::RangeInclusive;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, RenderSettings, Rendering, SamplerKind, View, World, render};
use light_scene::glam::{DVec3, Vec2, Vec3};
use light_scene::{Camera, Emission, Material, Mesh, Scene, Surface};

/// The corners of a box `[0, 1]^3`, face by face, counter-clockwise seen from inside: floor,
/// ceiling, back, left, right, front.
pub(crate) fn room() -> [[Vec3; 4]; 6] {
    let v = |x: u8, y: u8, z: u8| Vec3::new(f32::from(x), f32::from(y), f32::from(z));
    [
        [v(0, 0, 0), v(0, 0, 1), v(1, 0, 1), v(1, 0, 0)],
        [v(0, 1, 0), v(1, 1, 0), v(1, 1, 1), v(0, 1, 1)],
        [v(0, 0, 0), v(1, 0, 0), v(1, 1, 0), v(0, 1, 0)],
        [v(0, 0, 0), v(0, 1, 0), v(0, 1, 1), v(0, 0, 1)],
        [v(1, 0, 0), v(1, 0, 1), v(1, 1, 1), v(1, 1, 0)],
        [v(0, 0, 1), v(0, 1, 1), v(1, 1, 1), v(1, 0, 1)],
    ]
}

/// A room in the manner of the Cornell box: one red and one green wall, a lamp under the ceiling, a
/// block.
pub(crate) fn cornell() -> Scene {
    let mut scene = Scene::default();
    let [white, red, green] = [
        ("white", Vec3::splat(0.75)),
        ("red", Vec3::new(0.6, 0.1, 0.1)),
        ("green", Vec3::new(0.1, 0.5, 0.1)),
    ]
    .map(|(name, color)| scene.add_material(Material::diffuse(name, color)));
    let lamp = scene.add_material(Material {
        emission: Some(Emission::one_sided(Vec3::new(9.0, 7.0, 5.0))),
        ..Material::diffuse("lamp", Vec3::splat(0.5))
    });
    let materials = [white, white, white, red, green, white];
    for (corners, material) in room().into_iter().zip(materials) {
        scene.meshes.push(Mesh::quad("wall", material, corners));
    }
    let lamp_corners =
        room()[1].map(|p| Vec3::new(0.35, 0.98, 0.35) + p * Vec3::new(0.3, 0.0, 0.3));
    scene.meshes.push(Mesh::quad("lamp", lamp, lamp_corners));
    for face in room() {
        let [a, b, c, d] = face.map(|p| Vec3::new(0.2, 0.0, 0.3) + p * Vec3::new(0.3, 0.5, 0.3));
        scene.meshes.push(Mesh::quad("block", white, [a, d, c, b]));
    }
    scene.camera = Camera::look_at(
        Vec3::new(0.5, 0.5, 0.97),
        Vec3::new(0.5, 0.4, 0.0),
        Vec3::Y,
        1.3,
    )
    .ok();
    scene
}

/// A room with a floor that mirrors roughly, and under its ceiling many small lamps, each fourth of
/// them strong, beside a block that hides half of them from most places.
pub(crate) fn lamps() -> Scene {
    let mut scene = cornell();
    let floor = scene.add_material(Material::new(
        "rough mirror",
        Surface::Conductor {
            eta: Vec3::splat(1.3),
            k: Vec3::ZERO,
            alpha: Vec2::splat(0.15),
        },
    ));
    scene.meshes[0].material = floor;
    for (i, strength) in (0u8..32).zip([1.0, 2.0, 1.0, 20.0].into_iter().cycle()) {
        let lamp = scene.add_material(Material {
            emission: Some(Emission::one_sided(Vec3::new(4.0, 3.0, 2.0) * strength)),
            ..Material::diffuse("lamp", Vec3::splat(0.5))
        });
        let place = Vec3::new(f32::from(i % 8) * 0.12, f32::from(i / 8) * 0.2, 0.05);
        let corners = room()[1].map(|p| Vec3::new(0.05, 0.3, 0.0) + place + p * 0.02);
        scene.meshes.push(Mesh::quad("lamp", lamp, corners));
    }
    scene
}

/// A matt square of `albedo` around the origin, seen from straight above: its normal is +y.
pub(crate) fn plane(albedo: f32, half_size: f32) -> Scene {
    let mut scene = Scene::default();
    let matt = scene.add_material(Material::diffuse("matt", Vec3::splat(albedo)));
    let corners = room()[0].map(|p| (p - Vec3::new(0.5, 0.0, 0.5)) * 2.0 * half_size);
    scene.meshes.push(Mesh::quad("plane", matt, corners));
    scene.camera = Camera::look_at(Vec3::Y * 2.0, Vec3::ZERO, Vec3::Z, 0.02).ok();
    scene
}

/// How a picture is made.
pub(crate) struct Shot {
    pub(crate) size: u32,
    pub(crate) spp: u32,
    pub(crate) max_depth: u32,
    pub(crate) estimator: Estimator,
    pub(crate) sampler: SamplerKind,
    pub(crate) light_samples: NonZeroU32,
    /// By default the one for the scene.
    pub(crate) integrator: Option<Integrator>,
}

impl Default for Shot {
    fn default() -> Self {
        Self {
            size: 16,
            spp: 16,
            max_depth: 6,
            estimator: Estimator::Mis,
            sampler: SamplerKind::BvhReference,
            light_samples: NonZeroU32::MIN,
            integrator: None,
        }
    }
}

impl Shot {
    /// A small picture of direct light, its lights chosen by the default tree.
    pub(crate) fn of_direct_light(estimator: Estimator) -> Self {
        Self {
            size: 8,
            spp: 64,
            max_depth: 2,
            estimator,
            sampler: SamplerKind::Bvh,
            ..Self::default()
        }
    }

    /// Renders `scene` with this seed.
    pub(crate) fn render(&self, scene: &Scene, seed: u32) -> Rendering {
        let mut pictures = self.render_each(scene, seed..=seed);
        pictures.next().expect("one seed")
    }

    /// Renders `scene` with each of the seeds, in their order. What no seed changes is built once.
    pub(crate) fn render_each(
        &self,
        scene: &Scene,
        seeds: RangeInclusive<u32>,
    ) -> impl Iterator<Item = Rendering> {
        let camera = scene.camera_or_default();
        let world = World::new(scene.clone()).expect("valid lights");
        let view = View::new(&camera, self.size, self.size).expect("a valid view");
        let sampler = AnyLightSampler::new(self.sampler, world.lights()).expect("valid lights");
        let path = PathSettings {
            max_depth: self.max_depth,
            estimator: self.estimator,
            light_samples: self.light_samples,
            integrator: self.integrator.unwrap_or(Integrator::fitting(&world)),
        };
        let spp = self.spp;
        seeds.map(move |seed| {
            let settings = RenderSettings {
                samples: 0..spp,
                time_limit: None,
                seed,
                path,
            };
            let rendering = render(&world, &view, &sampler, &settings, |_| ());
            assert_eq!(rendering.rejected, 0, "every sample is finite");
            rendering
        })
    }

    /// The mean of the picture over pixels, and its standard error from sixteen independent
    /// pictures.
    pub(crate) fn mean(&self, scene: &Scene) -> (DVec3, DVec3) {
        const RUNS: u32 = 16;
        let means: Vec<DVec3> = self
            .render_each(scene, 0..=RUNS - 1)
            .map(|rendering| {
                let pixels = rendering.film.develop();
                pixels.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / pixels.len() as f64
            })
            .collect();
        let n = f64::from(RUNS);
        let mean = means.iter().sum::<DVec3>() / n;
        let squares = means
            .iter()
            .map(|&m| (m - mean) * (m - mean))
            .sum::<DVec3>();
        (mean, (squares / (n * (n - 1.0))).map(f64::sqrt))
    }

    /// The mean of the picture is `expected`.
    pub(crate) fn assert_mean(&self, scene: &Scene, expected: DVec3, what: &str) {
        let mean = self.mean(scene);
        assert!(
            agree(mean, (expected, DVec3::ZERO)),
            "{what}: {mean:?}, expected {expected}"
        );
    }

    /// Light samples, material samples with so many a pixel, and both weighted have one mean.
    pub(crate) fn assert_estimators_agree(&self, scene: &Scene, material_spp: u32) {
        let of = |estimator, spp| {
            let shot = Self {
                estimator,
                spp,
                ..*self
            };
            shot.mean(scene)
        };
        let mis = of(Estimator::Mis, self.spp);
        let light = of(Estimator::Light, self.spp);
        let bsdf = of(Estimator::Bsdf, material_spp);
        assert!(agree(light, mis), "light {light:?} and both {mis:?}");
        assert!(agree(bsdf, mis), "scattered {bsdf:?} and both {mis:?}");
    }
}

/// Whether two means agree within four and a half of their common standard errors, in every
/// channel.
pub(crate) fn agree((a, a_error): (DVec3, DVec3), (b, b_error): (DVec3, DVec3)) -> bool {
    let error = (a_error * a_error + b_error * b_error).map(f64::sqrt);
    // What f32 arithmetic may be off by, where there is no noise at all.
    let rounding = b.abs() * 2e-5;
    (a - b).abs().cmple(error * 4.5 + rounding).all()
}

/// All ways to find light.
pub(crate) const ALL: [Estimator; 3] = [Estimator::Light, Estimator::Bsdf, Estimator::Mis];

/// Light samples, material samples, and both weighted have one mean in `scene`.
pub(crate) fn assert_estimators_agree(scene: &Scene) {
    Shot::default().assert_estimators_agree(scene, 64);
}

/// One thread and two make the same picture.
pub(crate) fn assert_threads_change_nothing(scene: &Scene) {
    let picture = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        let shot = Shot {
            spp: 5,
            ..Shot::default()
        };
        pool.install(|| shot.render(scene, 3).film.develop())
    };
    assert!(picture(1) == picture(2), "one thread and two");
}
