//! The power of a surface with an alpha mask that has a mapping of its own, a cutoff or values
//! above 1 is that of the part that emits.

mod own_mapping;

use core::f32::consts::PI;

use light_sources::glam::{Affine2, Vec2, Vec3};
use light_sources::shape::{
    AnyShape, BilinearPatch, Rectangle, Shape, ShapeSample, Sphere, Triangle,
};
use light_sources::*;
use light_testkit::Rng;

/// Between the four centres of 2 x 2 texels.
fn between_texels() -> TextureMapping {
    TextureMapping {
        transform: Affine2::from_scale_angle_translation(Vec2::splat(0.5), 0.0, Vec2::splat(0.25)),
        wrap: [Wrap::Clamp; 2],
    }
}

fn gray(size: [u32; 2], texels: &[f32]) -> Image {
    Image::from_f32(size, Channels::Gray, texels).expect("an image")
}

/// `u v` on the unit square.
fn saddle() -> AlphaMask {
    AlphaMask {
        mapping: Some(between_texels()),
        ..gray([2, 2], &[0.0, 1.0, 0.0, 0.0]).into()
    }
}

/// `u` on the unit square, by another mapping than that of masks.
fn ramp() -> (SurfaceColor<Rgb>, TextureMapping) {
    let texture = gray([2, 1], &[1.0, 0.0]).into();
    let turned = TextureMapping {
        transform: Affine2::from_scale_angle_translation(Vec2::splat(0.5), PI, Vec2::splat(0.75)),
        wrap: [Wrap::Clamp; 2],
    };
    let tint = Vec3::ONE;
    (SurfaceColor::Image { texture, tint }, turned)
}

fn white() -> (SurfaceColor<Rgb>, TextureMapping) {
    (SurfaceColor::Uniform(Vec3::ONE), TextureMapping::default())
}

fn emission(
    (color, mapping): (SurfaceColor<Rgb>, TextureMapping),
    mask: AlphaMask,
) -> DiffuseEmission<Rgb> {
    let desc = DiffuseEmissionDesc {
        mask: EmissionMask::Alpha(mask),
        mapping,
        ..DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(1.0))
    };
    DiffuseEmission::new(desc, [] as [AnyShape; 0]).expect("an emission")
}

/// The mean radiance of a shape, by its power.
fn mean(emission: &DiffuseEmission<Rgb>, shape: &impl Shape) -> f64 {
    f64::from(emission.phi(shape, &()).x / (PI * shape.area()))
}

fn square() -> Rectangle {
    Rectangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y]).expect("a square")
}

fn assert_near(found: f64, expected: f64, what: &str) {
    let near = (found - expected).abs() < 2e-6;
    assert!(near, "{what}: {found}, {expected}");
}

/// Where `u v` is at least `c`.
#[test]
fn a_cutoff_along_a_hyperbola() {
    for c in [0.9f32, 0.5, 0.1, 1e-3] {
        let mask = AlphaMask {
            cutoff: Some(c),
            ..saddle()
        };
        let c = f64::from(c);
        let uniform = mean(&emission(white(), mask.clone()), &square());
        assert_near(uniform, 1.0 - c + c * c.ln(), "uniform");
        // The integral of u (1 - c / u) from c to 1.
        let image = mean(&emission(ramp(), mask), &square());
        assert_near(image, 0.5 * (1.0 - c * c) - c * (1.0 - c), "an image");
    }
    for (cutoff, expected) in [(2.0, 0.0), (0.0, 1.0), (-1.0, 1.0)] {
        let mask = AlphaMask {
            cutoff: Some(cutoff),
            ..saddle()
        };
        let found = mean(&emission(white(), mask), &square());
        assert_eq!(found, expected, "cutoff {cutoff}");
    }
}

/// A value that is the cutoff itself emits, also below the normal floats.
#[test]
fn a_mask_that_is_its_cutoff_everywhere() {
    for value in [0.5, 0.3, 1e-39] {
        let mask = AlphaMask {
            cutoff: Some(value),
            ..gray([1, 1], &[value]).into()
        };
        let found = mean(&emission(white(), mask), &square());
        assert_eq!(found, 1.0, "{value}");
    }
}

/// The lesser of `s u v` and 1.
#[test]
fn values_above_1() {
    for scale in [0.25f32, 1.0, 2.0, 30.0] {
        let mask = AlphaMask { scale, ..saddle() };
        let s = f64::from(scale);
        let c = (1.0 / s).min(1.0);
        let below = s * (0.25 * c * c - 0.5 * c * c * c.ln());
        let expected = 1.0 - c + c * c.ln() + below;
        let found = mean(&emission(white(), mask.clone()), &square());
        assert_near(found, expected, &format!("uniform, {scale}"));
        let along_v = |u: f64| {
            let bend = (c / u).min(1.0);
            u * (0.5 * s * u * bend * bend + 1.0 - bend)
        };
        let steps = 100_000;
        let middles = (0..steps).map(|i| (f64::from(i) + 0.5) / f64::from(steps));
        let expected = middles.map(along_v).sum::<f64>() / f64::from(steps);
        let found = mean(&emission(ramp(), mask), &square());
        assert_near(found, expected, &format!("an image, {scale}"));
    }
}

/// The power of triangles, squares, patches and spheres is the mean of the radiance at places
/// spread evenly over them, whatever lies on them and however.
#[test]
fn any_masks_on_any_shapes() {
    let mut rng = Rng::new(91);
    let wraps = [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black];
    for round in 0..32 {
        let mapping = |rng: &mut Rng| {
            let scale = Vec2::new(rng.range(0.5, 1.5), -rng.range(0.5, 1.5));
            let (turn, offset) = (rng.range(0.0, 6.0), (rng.vec2() - 0.5) * 0.6);
            TextureMapping {
                transform: Affine2::from_scale_angle_translation(scale, turn, offset),
                wrap: [0, 1].map(|_| wraps[rng.below(4)]),
            }
        };
        let image = |rng: &mut Rng, most: usize| {
            let size = [0, 1].map(|_| 1 + rng.below(most));
            let texels = (0..size[0] * size[1]).map(|_| rng.range(0.0, 1.0));
            gray(
                size.map(|n| u32::try_from(n).expect("few")),
                &texels.collect::<Vec<_>>(),
            )
        };
        let color = if round % 4 == 3 {
            white()
        } else {
            let texture = image(&mut rng, 6).into();
            let tint = Vec3::ONE;
            (SurfaceColor::Image { texture, tint }, mapping(&mut rng))
        };
        let is_apart = round % 4 != 2;
        let mask = AlphaMask {
            scale: [1.0, 0.5, 3.0][round % 3],
            mapping: is_apart.then(|| mapping(&mut rng)),
            cutoff: (round % 2 == 0).then(|| rng.range(0.2, 1.0)),
            ..image(&mut rng, 12).into()
        };
        let what = format!("{round}: {color:?}, {mask:?}");
        let emission = emission(color, mask);
        match round % 8 {
            0..4 => {
                let uvs = [0, 1, 2].map(|_| (rng.vec2() - 0.3) * 1.6);
                let triangle = Triangle::new([Vec3::ZERO, Vec3::X, Vec3::Y], uvs);
                check(&what, &emission, &triangle.expect("a triangle"), 3e-4);
            }
            4 | 5 => check(&what, &emission, &square(), 3e-4),
            6 => {
                let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.9, 1.4, 0.8)];
                let patch = BilinearPatch::new(corners).expect("a patch");
                check(&what, &emission, &patch, 3e-4);
            }
            _ => {
                let sphere = Sphere::new(RigidTransform::IDENTITY, 0.7).expect("a sphere");
                check(&what, &emission, &sphere, 3e-4);
            }
        }
    }
}

/// Two million places: the more they differ from their neighbours, the larger the error of their
/// mean.
fn check(what: &str, emission: &DiffuseEmission<Rgb>, shape: &impl Shape, error: f64) {
    const SIDE: u16 = 1448;
    let mut rng = Rng::new(7);
    let (mut sum, mut area) = (0.0, 0.0);
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let u = (Vec2::new(x.into(), y.into()) + rng.vec2()) / f32::from(SIDE);
        let ShapeSample { at, pdf } = shape.sample(u).expect("a place");
        sum += f64::from(emission.l(&at, at.n, &()).x / pdf);
        area += f64::from(1.0 / pdf);
    }
    let expected = sum / area;
    let found = mean(emission, shape);
    let near = (found - expected).abs() <= error * expected + 1e-6;
    assert!(near, "{what}: {found}, {expected}");
    assert!(expected == 0.0 || found > 0.0, "{what}: {found}");
}
