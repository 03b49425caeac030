//! The default tree chooses among projected and measured lights by their lobes, and far better than
//! by their bounds.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small positive numbers"
)]

use core::f32::consts::TAU;

use lights::bounds::{LightExtent, LightSampleContext};
use lights::glam::{Affine3A, Quat, Vec2, Vec3};
use lights::math::equal_area::square_to_sphere;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::*;

/// Numbers of `[0, 1)` that fill any range evenly: the multiples of the plastic number.
struct Even(f64);

impl Even {
    fn next(&mut self) -> f32 {
        self.0 = (self.0 + 0.754_877_666_246_692_8) % 1.0;
        (self.0 * 16_777_216.0) as u32 as f32 / 16_777_216.0
    }

    fn over_floor(&mut self) -> Vec3 {
        // Three numbers of one sequence depend on each other: a second turn mixes them.
        let [x, y, z] = [self.next(), self.next(), self.next()];
        Vec3::new(x, (y * 7.3 + x * 3.1).fract(), 0.0) * 10.0 + Vec3::Z * (0.5 + 2.5 * z)
    }
}

/// A picture that is bright in one corner: a ninth of it emits all but a tenth.
fn slide() -> Image {
    let texel = |i: u16| if i % 24 < 8 && i / 24 < 8 { 1.0 } else { 0.01 };
    let texels: Vec<f32> = (0..24 * 24).flat_map(|i| [texel(i); 3]).collect();
    Image::from_f32([24, 24], Channels::Rgb, texels).expect("an image")
}

/// A luminaire with a beam along -z in its own space, and a little stray light behind.
fn luminaire() -> Image {
    let n = 32u16;
    let texels = (0..n * n).map(|i| {
        let at = Vec2::new(f32::from(i % n), f32::from(i / n)) + 0.5;
        let w = square_to_sphere(at / f32::from(n));
        0.01 + f32::max(0.0, -w.z).powi(12)
    });
    Image::from_f32([32, 32], Channels::Gray, texels.collect::<Vec<_>>()).expect("an image")
}

/// As many projectors as luminaires and points over a floor, all kinds about alike strong on their
/// axes.
fn lights() -> LightSet<Rgb> {
    let scene = SceneSphere::new(Vec3::new(5.0, 5.0, 1.0), 10.0).expect("a sphere");
    let mut builder = LightSetBuilder::new(scene);
    let mut even = Even(0.5);
    let (slide, luminaire) = (slide(), luminaire());
    for i in 0..300 {
        let position = even.over_floor();
        let strength = 0.5 + even.next();
        let tilt = Quat::from_rotation_z(TAU * even.next()) * Quat::from_rotation_x(even.next());
        let aimed = |turn: Quat| Affine3A::from_rotation_translation(tilt * turn, position);
        let amount = IntensityAmount::Radiometric(strength);
        let media = MediumInterface::default();
        let desc = match i % 3 {
            0 => LightDesc::Projection(ProjectionLightDesc {
                // Its own space looks along +z.
                transform: aimed(Quat::from_rotation_x(0.5 * TAU)),
                image: slide.clone(),
                fov: 1.2,
                amount,
                media,
            }),
            1 => LightDesc::Goniometric(GoniometricLightDesc {
                transform: aimed(Quat::IDENTITY),
                distribution: luminaire.clone(),
                emission: Vec3::ONE,
                amount,
                media,
            }),
            _ => LightDesc::Point(PointLightDesc {
                position,
                emission: Vec3::splat(0.1),
                amount,
                media,
            }),
        };
        builder.add(desc).expect("a light");
    }
    builder.build()
}

/// The exact relative variance of one choice, mean over points of the floor. No light that
/// contributes has probability 0.
fn variance(set: &LightSet<Rgb>, extents: &[LightExtent]) -> f64 {
    let sampler = BvhLightSampler::new(extents).expect("valid lights");
    let points = 12u8;
    let mut sum_of_variances = 0.0;
    for i in 0..points * points {
        let at = Vec2::new(f32::from(i % points), f32::from(i / points)) + 0.5;
        let p = (at * (10.0 / f32::from(points))).extend(0.0);
        let ctx = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
        let (mut sum, mut squares) = (0.0, 0.0);
        for (id, light) in set.iter() {
            let sample = light.sample_li(&ctx, Vec2::splat(0.5), &(), PdfCoverage::Complete);
            let f = sample.map_or(0.0, |li| f64::from(li.l.x * li.wi.z));
            let pmf = f64::from(sampler.pmf(&ctx, id));
            if f > 0.0 {
                assert!(pmf > 0.0, "{id:?} lights {p}: {:?}", extents[id.index()]);
                sum += f;
                squares += f * f / pmf;
            }
        }
        sum_of_variances += squares / (sum * sum) - 1.0;
    }
    sum_of_variances / f64::from(points) / f64::from(points)
}

#[test]
fn lobes_make_choices_far_better_than_bounds_do() {
    let set = lights();
    let lobes = set.extents();
    let bounds: Vec<LightExtent> = lobes
        .iter()
        .map(|extent| LightExtent::Bounded(*extent.bounded().expect("no light at infinity")))
        .collect();
    let (with_lobes, with_bounds) = (variance(&set, &lobes), variance(&set, &bounds));
    println!("V {with_lobes:.2} by lobes, {with_bounds:.2} by bounds");
    assert!(
        with_lobes < 0.25 * with_bounds,
        "{with_lobes} against {with_bounds}"
    );
}
