//! Three lamps in fog behind a pillar: light that scatters once, with shafts of shadow.
//!
//! All that the integrators ask of a scene is whether two points see each other.
//! `cargo run --release -p lights --example fog` writes `out/fog.png`.

use core::error::Error;

use lights::glam::{Vec2, Vec3};
use lights::media::phase::HenyeyGreenstein;
use lights::media::{
    Homogeneous, LatinHypercube, Phase, Ray, Span, StepSize, Substance, Visibility,
    VolumeIntegrator,
};
use lights::samplers::PowerLightSampler;
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// A pillar of infinite height around the y axis.
struct Pillar {
    radius: f32,
}

impl Visibility for Pillar {
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool {
        let [from, along] = [from, to - from].map(|v| Vec2::new(v.x, v.z));
        let t = -from.dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
        (from + along * t.clamp(0.0, 1.0)).length() > self.radius
    }
}

/// Absorption and scattering of the fog per unit length, and how much it scatters forward.
const SIGMA_A: f32 = 0.01;
const SIGMA_S: f32 = 0.12;
const G: f32 = 0.5;

/// Positions and intensities of the lamps.
const LAMPS: [(Vec3, Vec3); 3] = [
    (Vec3::new(-2.5, 0.5, 3.0), Vec3::new(4.0, 2.0, 1.0)),
    (Vec3::new(0.3, 0.5, 3.0), Vec3::new(12.0, 10.0, 8.0)),
    (Vec3::new(3.0, 0.5, 3.0), Vec3::new(1.5, 3.0, 6.0)),
];

struct Scene {
    lights: LightSet<Rgb>,
    sampler: PowerLightSampler,
    fog: Homogeneous<Rgb>,
    pillar: Pillar,
}

impl Scene {
    fn new() -> Result<Self> {
        let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 20.0)?);
        for (position, intensity) in LAMPS {
            let amount = IntensityAmount::Radiometric(1.0);
            lights.add(PointLightDesc::new(position, intensity, amount))?;
        }
        let lights = lights.build();
        let [sigma_a, sigma_s] = [SIGMA_A, SIGMA_S].map(Vec3::splat);
        Ok(Self {
            sampler: PowerLightSampler::new(&lights.powers())?,
            lights,
            fog: Homogeneous {
                substance: Substance::new(sigma_a, sigma_s, Vec3::ZERO)?,
                phase: Phase::HenyeyGreenstein(HenyeyGreenstein::new(G)?),
                ..Homogeneous::default()
            },
            pillar: Pillar { radius: 0.6 },
        })
    }

    /// The light that the fog scatters toward the start of a ray of length `t1`: the mean of some
    /// marches.
    fn radiance(&self, ray: &Ray, t1: f32, marches: u32, seed: u32) -> Result<Vec3> {
        let integrator = VolumeIntegrator {
            medium: &self.fog,
            lights: &self.lights,
            sampler: &self.sampler,
            scene: &self.pillar,
            wavelengths: &(),
            step: StepSize::new(0.25)?,
            shadow_step: StepSize::new(0.5)?,
        };
        // Points of a Latin hypercube serve as the stream of random numbers.
        let numbers = LatinHypercube::new(1 << 16, seed);
        let mut drawn = 0;
        let mut next_u = || {
            drawn += 1;
            numbers.point_f32::<1>(drawn)[0]
        };
        let span = Span { t0: 0.0, t1 };
        let mut sum = Vec3::ZERO;
        for i in 0..marches {
            sum += integrator
                .single_scattering(ray, span, seed.wrapping_mul(marches) + i, &mut next_u)
                .l;
        }
        Ok(sum / marches as f32)
    }
}

/// Where the camera is.
const EYE: Vec3 = Vec3::new(0.0, 0.0, -8.0);

fn main() -> Result<()> {
    let scene = Scene::new()?;
    // One march fails as all do, so that pixels need no error of their own.
    scene.radiance(&Ray { o: EYE, d: Vec3::Z }, 16.0, 1, 0)?;
    picture::save("fog", [240, 160], |x, y| {
        let at = Vec2::new(x as f32 - 119.5, 79.5 - y as f32) / 240.0;
        let d = at.extend(1.0).normalize();
        // The pillar itself is black.
        let across = Vec2::new(d.x, d.z);
        let nearest = Vec2::new(EYE.x, EYE.z).perp_dot(across) / across.length();
        let t1 = if nearest.abs() < scene.pillar.radius {
            8.0 / across.length() - scene.pillar.radius
        } else {
            16.0
        };
        let ray = Ray { o: EYE, d };
        6.0 * scene
            .radiance(&ray, t1, 32, y * 240 + x)
            .unwrap_or(Vec3::ZERO)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::PI;
    use lights::glam::DVec3;

    /// The integral along the ray by midpoints: at each point all lamps that are seen, dimmed on
    /// the way there and on the way back.
    fn quadrature(scene: &Scene, ray: &Ray, t1: f32) -> Vec3 {
        let points = 20_000;
        let dt = t1 / points as f32;
        let at = |i| {
            let t = (i as f32 + 0.5) * dt;
            let p = ray.o + ray.d * t;
            let mut l = Vec3::ZERO;
            for (lamp, intensity) in LAMPS {
                let r = lamp.distance(p);
                // Between the direction in which the light comes and that in which it goes on.
                let cos = (p - lamp).normalize().dot(-ray.d);
                let phase = (1.0 - G * G) / (4.0 * PI * (1.0 + G * G - 2.0 * G * cos).powf(1.5));
                let dimmed = (-(SIGMA_A + SIGMA_S) * (t + r)).exp();
                if scene.pillar.unoccluded(p, lamp) {
                    l += intensity * (SIGMA_S * phase * dimmed * dt / (r * r));
                }
            }
            l.as_dvec3()
        };
        (0..points).map(at).sum::<DVec3>().as_vec3()
    }

    #[test]
    fn marches_have_the_mean_of_the_integral() -> Result<()> {
        let scene = Scene::new()?;
        for (o, d) in [
            (EYE, Vec3::new(0.15, 0.1, 1.0)),
            (EYE, Vec3::new(-0.3, -0.1, 1.0)),
            (Vec3::new(-5.0, 1.0, 2.0), Vec3::X),
        ] {
            let ray = Ray {
                o,
                d: d.normalize(),
            };
            let mean = scene.radiance(&ray, 14.0, 1 << 12, 1)?;
            let exact = quadrature(&scene, &ray, 14.0);
            let off = (mean / exact - 1.0).abs().max_element();
            assert!(off < 0.02, "{mean}, not {exact}, along {d}");
        }
        Ok(())
    }

    #[test]
    fn the_pillar_hides_what_is_behind_it() {
        let pillar = Pillar { radius: 0.5 };
        let from = Vec3::new(-2.0, 7.0, 0.0);
        let cases = [(0.0, false), (0.9, false), (1.1, true)];
        for (z, is_seen) in cases {
            let to = Vec3::new(2.0, -3.0, z);
            assert_eq!(pillar.unoccluded(from, to), is_seen, "to z = {z}");
        }
    }
}
