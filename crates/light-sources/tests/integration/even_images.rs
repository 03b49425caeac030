//! An image of one colour, or a mask of one value, emits the same wherever the mapping puts it: cuts
//! along rows and columns leave slivers of no width, which change nothing.

use core::f32::consts::{PI, TAU};
use core::fmt;

use light_sources::glam::{Affine2, DVec2, Vec2, Vec3};
use light_sources::shape::{AnyShape, Rectangle, Shape, Triangle};
use light_sources::*;
use light_testkit::Rng;

const WRAPS: [Wrap; 4] = [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black];

fn white(size: [u32; 2]) -> Image {
    let count = size[0] * size[1];
    Image::from_f32(size, Channels::Gray, vec![1.0; count as usize]).expect("an image")
}

/// The power of a shape that shows `image` as its colour, and as its mask, relative to that of a
/// shape without.
fn shares(image: &Image, mapping: TextureMapping, shape: &impl Shape) -> [f64; 2] {
    let texture = SurfaceColor::Image {
        texture: image.clone().into(),
        tint: Vec3::ONE,
    };
    let masked = SurfaceColor::Uniform(Vec3::ONE);
    let mask = EmissionMask::Alpha(image.clone().into());
    [(texture, EmissionMask::default()), (masked, mask)].map(|(color, mask)| {
        let desc = DiffuseEmissionDesc::<Rgb> {
            mask,
            mapping,
            ..DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(1.0))
        };
        let emission = DiffuseEmission::new(desc, [] as [AnyShape; 0]).expect("an emission");
        f64::from(emission.phi(shape, &()).x / (PI * shape.area()))
    })
}

/// What is seen of a white image at a place: less than all only beyond its edges.
fn seen(wrap: [Wrap; 2], size: [u32; 2], place: DVec2) -> f64 {
    let along = |i: usize| {
        let n = f64::from(size[i]);
        match wrap[i] {
            Wrap::Black => (n * place[i].min(1.0 - place[i]) + 0.5).clamp(0.0, 1.0),
            _ => 1.0,
        }
    };
    along(0) * along(1)
}

/// The mean of `seen` over a parallelogram of the image, or over half of it.
fn mean_seen(wrap: [Wrap; 2], size: [u32; 2], corners: [Vec2; 3], is_half: bool) -> f64 {
    if !wrap.contains(&Wrap::Black) {
        return 1.0;
    }
    const STEPS: u32 = 128;
    let [a, b, c] = corners.map(Vec2::as_dvec2);
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let mut sum = 0.0;
    for i in 0..STEPS {
        for j in 0..STEPS {
            let (mut u, mut v) = (middle(i), middle(j));
            if is_half {
                (u, v) = (u.sqrt() * (1.0 - v), u.sqrt() * v);
            }
            sum += seen(wrap, size, a + (b - a) * u + (c - a) * v);
        }
    }
    sum / f64::from(STEPS * STEPS)
}

fn check(shares: [f64; 2], expected: f64, mapping: &TextureMapping, what: impl fmt::Debug) {
    // The sum over places is less exact than the power.
    let is_sum = mapping.wrap.contains(&Wrap::Black);
    let tolerance = if is_sum { 5e-3 } else { 1e-5 };
    for share in shares {
        assert!(
            (share - expected).abs() <= tolerance,
            "{mapping:?}, {what:?}: {share} of {expected}"
        );
    }
}

#[test]
fn a_sliver_of_no_height_is_not_the_whole_mean() {
    let size = [64, 64];
    let square = Rectangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y]).expect("a square");
    let scale = Vec2::new(2.049_975, 0.885_380_74);
    let translation = Vec2::new(-0.300_029_04, 0.221_470_36);
    let mapping = TextureMapping {
        transform: Affine2::from_scale_angle_translation(scale, 0.0, translation),
        wrap: [Wrap::Clamp; 2],
    };
    check(shares(&white(size), mapping, &square), 1.0, &mapping, size);

    let uv = [
        Vec2::new(-1.609_876_2, 1.106_919_5),
        Vec2::new(1.915_424_3, 0.415_861_85),
        Vec2::new(1.128_739_4, 1.005_264),
    ];
    let wrap = [Wrap::Repeat, Wrap::Black];
    let mapping = TextureMapping {
        wrap,
        ..TextureMapping::REPEAT
    };
    let triangle = Triangle::new([Vec3::ZERO, 2.0 * Vec3::X, Vec3::Y], uv).expect("a triangle");
    let expected = mean_seen(wrap, size, uv, true);
    check(
        shares(&white(size), mapping, &triangle),
        expected,
        &mapping,
        uv,
    );
}

#[test]
fn any_mapping_of_one_color_has_its_power() {
    let mut rng = Rng::new(3);
    let square = Rectangle::new(Vec3::ZERO, [Vec3::X, Vec3::Y]).expect("a square");
    let sizes = [[64, 64], [5, 4], [16, 1], [1, 1]];
    for (size, image) in sizes.map(|size| (size, white(size))) {
        for i in 0..800 {
            let wrap = [WRAPS[i % 4], WRAPS[i / 4 % 4]];
            let scale = rng.vec2() * 4.0;
            let angle = if rng.below(2) == 0 {
                0.0
            } else {
                rng.f32() * TAU
            };
            let translation = rng.vec2() * 4.0 - 2.0;
            let transform = Affine2::from_scale_angle_translation(scale, angle, translation);
            let mapping = TextureMapping { transform, wrap };
            let corners = [Vec2::ZERO, Vec2::X, Vec2::Y].map(|uv| mapping.place(uv));
            let expected = mean_seen(wrap, size, corners, false);
            check(shares(&image, mapping, &square), expected, &mapping, size);
        }
    }
}

#[test]
fn any_triangle_of_one_color_has_its_power() {
    let mut rng = Rng::new(4);
    let sizes = [[64, 64], [5, 4], [16, 1], [1, 1]];
    for (size, image) in sizes.map(|size| (size, white(size))) {
        for i in 0..800 {
            let wrap = [WRAPS[i % 4], WRAPS[i / 4 % 4]];
            let mapping = TextureMapping {
                wrap,
                ..TextureMapping::REPEAT
            };
            let reach = [1.0, 4.0, 20.0, 200.0][i / 16 % 4];
            let uv = [(); 3].map(|()| (rng.vec2() - 0.5) * reach);
            let triangle = Triangle::new([Vec3::ZERO, Vec3::X, Vec3::Y], uv).expect("a triangle");
            let expected = mean_seen(wrap, size, uv, true);
            check(
                shares(&image, mapping, &triangle),
                expected,
                &mapping,
                (size, uv),
            );
        }
    }
}
