use alloc::vec::Vec;

use super::*;
use crate::channels::Channels;
use crate::glam::{Affine2, DVec2};
use crate::image::Image;
use crate::mask_share::MaskShare;
use light_testkit::Rng;

const ONCE: TextureMapping = TextureMapping {
    transform: Affine2::IDENTITY,
    wrap: [Wrap::Clamp; 2],
};

const WRAPS: [Wrap; 4] = [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Black];

fn gray([width, height]: [u32; 2], texel: impl Fn(u32) -> f32) -> Image {
    let texels: Vec<f32> = (0..width * height).map(texel).collect();
    Image::from_f32([width, height], Channels::Gray, texels).expect("an image")
}

/// Left half black, right half white.
fn halves() -> Image {
    gray([64, 32], |i| if i % 64 < 32 { 0.0 } else { 1.0 })
}

/// The mean by the blocks that a texture has.
fn over(image: &Image, mapping: &TextureMapping, area: &UvArea) -> f32 {
    let shown = |wrap| Shown {
        image: Some(image),
        mask: None,
        wrap,
    };
    let blocks = BlockMeans::new(&shown([Wrap::Clamp; 2]));
    mean(&shown(mapping.wrap), &blocks, mapping, None, area).x
}

fn triangle(uv: [[f32; 2]; 3]) -> UvArea {
    UvArea::Triangle(uv.map(Vec2::from))
}

const SQUARE: UvArea = UvArea::Square(UvDensity::Even);

fn assert_near(value: f32, expected: f32, what: &str) {
    assert!(
        (value - expected).abs() <= 1e-6 * expected.max(1.0),
        "{what}: {value}, {expected}"
    );
}

#[test]
fn the_whole_texture_has_its_mean() {
    assert_near(over(&halves(), &ONCE, &SQUARE), 0.5, "halves");
    for size in [[64, 64], [61, 37], [1, 301], [1, 1]] {
        let image = gray(size, |i| (i % 97 * 31 % 89) as f32 / 89.0);
        let mean = image.mean().x;
        for wrap in [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror] {
            for turn in [0.0, core::f32::consts::PI] {
                let transform = Affine2::from_angle_translation(turn, Vec2::ONE * turn.signum());
                let wrap = [wrap; 2];
                let mapping = TextureMapping { transform, wrap };
                if wrap[0] != Wrap::Clamp {
                    assert_near(over(&image, &mapping, &SQUARE), mean, "all of it");
                }
            }
            let wrap = [wrap; 2];
            let once = TextureMapping { wrap, ..ONCE };
            assert_near(over(&image, &once, &SQUARE), mean, "once");
        }
    }
}

/// A shape of a caller may say that its area is 0 everywhere.
#[test]
fn a_shape_without_area_shows_nothing() {
    let nowhere = UvArea::Square(UvDensity::Length([Vec3::ZERO; 3]));
    for wrap in WRAPS {
        let mapping = TextureMapping {
            wrap: [wrap; 2],
            ..ONCE
        };
        assert_eq!(over(&halves(), &mapping, &nowhere), 0.0, "{wrap:?}");
    }
}

#[test]
fn a_triangle_sees_its_part() {
    let part = |uv| over(&halves(), &ONCE, &triangle(uv));
    let left = part([[0.0, 0.0], [0.4, 0.0], [0.0, 1.0]]);
    assert!(left < 1e-9, "black, but for what lies nearby: {left}");
    let tiny = [[0.6, 0.1], [0.61, 0.1], [0.6, 0.11]];
    assert_eq!(part(tiny), 1.0, "right, tiny");
    // The half of a triangle beyond its middle line has a quarter of the area. What the edge
    // between the halves blurs, 1/64 wide on both sides, adds as much as it takes, but for how the
    // triangle narrows.
    let quarter = part([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    let blur: f32 = 1.0 / 64.0;
    assert_near(quarter, 0.25 + blur * blur / 12.0, "a quarter");
}

#[test]
fn a_mapping_moves_the_part() {
    let right = triangle([[0.6, 0.1], [0.9, 0.1], [0.6, 0.9]]);
    let by = |transform, wrap| {
        let wrap = [wrap; 2];
        over(&halves(), &TextureMapping { transform, wrap }, &right)
    };
    let left = Affine2::from_translation(Vec2::new(-0.5, 0.0));
    assert!(by(left, Wrap::Repeat) < 1e-9, "to the left half");
    let beyond = Affine2::from_translation(Vec2::new(0.5, 0.0));
    assert!(by(beyond, Wrap::Repeat) < 1e-9, "the left half again");
    assert_near(by(beyond, Wrap::Mirror), 1.0, "the right half, mirrored");
    assert_near(by(beyond, Wrap::Clamp), 1.0, "the edge goes on");
    assert_eq!(by(beyond, Wrap::Black), 0.0, "nothing");
    let many = Affine2::from_scale(Vec2::splat(5000.0));
    assert!(
        (by(many, Wrap::Repeat) - 0.5).abs() < 1e-3,
        "many halves of both kinds"
    );
}

/// One bright texel that no triangle may lose, however little of it shows.
#[test]
fn whatever_shows_a_texel_has_a_mean_above_zero() {
    let size = [301, 257];
    let bright = 140 * 301 + 150;
    let image = gray(size, |i| if i == bright { 1.0 } else { 0.0 });
    let [x, y] = [150.5 / 301.0, 1.0 - 140.5 / 257.0];
    for (dx, dy) in [
        (0.45, 0.001),
        (0.002, 0.4),
        (0.2, 0.2),
        (1e-4, 1e-4),
        (30.0, 0.1),
    ] {
        let sliver = [[x - dx, y - dy], [x + dx, y + dy], [x + dx, y + dy * 0.98]];
        for wrap in [Wrap::Repeat, Wrap::Mirror] {
            let wrap = [wrap; 2];
            let mapping = TextureMapping { wrap, ..ONCE };
            assert!(
                over(&image, &mapping, &triangle(sliver)) > 0.0,
                "{dx}, {dy}"
            );
        }
    }
    let black = triangle([[0.1, 0.1], [0.2, 0.1], [0.1, 0.2]]);
    assert_eq!(over(&image, &ONCE, &black), 0.0, "black stays black");
    // Beside the texel by less than single precision tells: a lookup may find it.
    let edge = 151.5 / 301.0 + 2e-8;
    let beside = triangle([[edge, y], [edge + 1e-3, y], [edge, y + 1e-4]]);
    assert!(over(&image, &ONCE, &beside) > 0.0, "beside");
    // On the other side of the image, which the edges repeat.
    let image = gray([16, 16], |i| if i % 16 == 15 { 1.0 } else { 0.0 });
    let left = triangle([[0.0, 0.1], [0.01, 0.1], [0.0, 0.2]]);
    assert!(
        over(&image, &TextureMapping::REPEAT, &left) > 0.1,
        "across the seam"
    );
    assert_eq!(over(&image, &ONCE, &left), 0.0, "there is no seam");
}

/// Subnormal light is light.
#[test]
fn the_darkest_texture_is_not_black() {
    let image = gray([2, 2], |_| f32::from_bits(1));
    assert!(over(&image, &ONCE, &SQUARE) > 0.0, "dark");
}

/// With and without blocks, in one part and in many, the integral is the same.
#[test]
fn blocks_change_nothing() {
    let image = gray([37, 70], |i| (i % 97 * 31 % 89) as f32);
    let mask = gray([90, 20], |i| (i % 7) as f32 / 7.0);
    let uvs = [
        [[0.1, -0.3], [1.7, 0.2], [0.4, 1.3]],
        [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]],
    ];
    for (wrap, uv) in WRAPS.into_iter().flat_map(|w| uvs.map(|uv| (w, uv))) {
        for mask in [None, Some((&mask, MaskShare::Linear))] {
            let shown = Shown {
                image: Some(&image),
                mask,
                wrap: [wrap, WRAPS[3]],
            };
            let mapping = TextureMapping {
                wrap: shown.wrap,
                ..ONCE
            };
            let blocks = BlockMeans::new(&shown);
            let whole = mean(&shown, &blocks, &mapping, None, &triangle(uv));
            let mut integral = Integral::new(&shown, &blocks, UvDensity::Even);
            let corner = |i: usize| Corner {
                uv: [DVec2::ZERO, DVec2::X, DVec2::Y][i],
                place: mapping.place(Vec2::from(uv[i])).as_dvec2(),
            };
            integral.cells(&UvPolygon::new(&[0, 1, 2].map(corner)));
            let ratio = whole / integral.mean();
            assert!(
                ratio.abs_diff_eq(Vec3::ONE, 1e-6),
                "{wrap:?}, {uv:?}: {ratio}"
            );
        }
    }
}

/// By rows, along the edges, the mean is that by cells, wherever the triangle lies and whatever its
/// size.
#[test]
fn rows_change_nothing() {
    let image = gray([37, 23], |i| (i % 97 * 31 % 89) as f32);
    let mut rng = Rng::new(1);
    let mut by_rows = 0;
    for i in 0..800 {
        let shown = Shown {
            image: Some(&image),
            mask: None,
            wrap: [WRAPS[i % 4], WRAPS[i / 4 % 4]],
        };
        let size = [0.8, 0.1, 0.01, 1e-4][i / 16 % 4];
        let low = rng.vec2() * 4.0 - 2.0;
        let corner = |uv| Corner {
            uv,
            place: (low + rng.vec2() * size).as_dvec2(),
        };
        let triangle = UvPolygon::new(&[DVec2::ZERO, DVec2::X, DVec2::Y].map(corner));
        let Some(mean) = mean_by_rows(&image, shown.wrap, &triangle) else {
            continue;
        };
        by_rows += 1;
        let blocks = BlockMeans::new(&shown);
        let mut integral = Integral::new(&shown, &blocks, UvDensity::Even);
        integral.cells(&triangle);
        let exact = integral.colors.sum / integral.colors.total;
        let near = mean.abs_diff_eq(exact, 1e-8 * exact.x.max(1.0));
        assert!(near, "{:?}, {triangle:?}: {mean}, {exact}", shown.wrap);
    }
    assert!(by_rows > 750, "{by_rows} of 800");
}

#[test]
fn places_that_are_no_numbers_or_far_away_are_survived() {
    let image = halves();
    for uv in [f32::NAN, f32::INFINITY, f32::MAX, -1e30, 1e20, 3e9] {
        for wrap in WRAPS {
            let mapping = TextureMapping {
                wrap: [wrap; 2],
                ..ONCE
            };
            for corners in [[[uv; 2]; 3], [[0.0, 0.0], [uv, 0.0], [0.3, uv]]] {
                let mean = over(&image, &mapping, &triangle(corners));
                assert!((0.0..=1.0).contains(&mean), "{uv}, {wrap:?}: {mean}");
            }
        }
    }
}

/// Parts of a sphere weigh what their area is, of a part of a disk its distance from the middle.
#[test]
fn uneven_densities_weigh_parts() {
    let along_u = UvDensity::Length([Vec3::ZERO, Vec3::X, Vec3::ZERO]);
    for [u, v] in [[0.0, 0.0], [0.25, 0.125], [0.5, 0.75]] {
        let (low, side) = (DVec2::new(u, v), 0.125);
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|corner| Corner {
            uv: low + corner * side,
            place: corner,
        });
        let polygon = UvPolygon::new(&corners);
        let weight = |density| ColorSum::new(density).weight(&polygon);
        let pi = core::f64::consts::PI;
        let sine = ((pi * v).cos() - (pi * (v + side)).cos()) / pi * side;
        for (density, expected) in [
            (UvDensity::Even, side * side),
            (UvDensity::Sine, sine),
            (along_u, side * side * (u + 0.5 * side)),
        ] {
            let found = weight(density);
            let near = (found - expected).abs() < 1e-6 * side * side;
            assert!(near, "{u}, {v}, {density:?}: {found}, {expected}");
        }
    }
}
