use core::f32::consts::TAU;
use std::path::Path;

use super::modeller::Modeller;
use crate::glam::{Affine3A, Quat, Vec2, Vec3};
use crate::image::parse_exr;
use crate::{Camera, Color, Image, Material, MaterialId, Scene, Surface};

/// Columns of the full ring; the ones before the camera have fallen.
const COLUMNS: u16 = 12;

/// Radius of the ring of columns, in metres.
const RING: f32 = 4.0;

/// Height of the floor above the water, in metres.
const FLOOR: f32 = 0.6;

/// A ring of columns in still water around four spheres, lit by a photographed sky with a small,
/// strong sun.
pub(super) fn rotunda() -> Scene {
    let mut modeller = Modeller::default();
    let marble = modeller.material(Material::diffuse("marble", Vec3::new(0.72, 0.69, 0.63)));
    let water = modeller.material(Material::new(
        "water",
        // No absorption index: light that is not reflected is lost.
        Surface::Conductor {
            eta: Vec3::splat(1.33),
            k: Vec3::ZERO,
            alpha: Vec2::splat(0.05),
        },
    ));
    let sea = [Vec2::ZERO, Vec2::new(600.0, 0.0)];
    modeller.turned_with_edges(water, &Affine3A::IDENTITY, &sea, 64);
    plinth(&mut modeller, marble);
    for k in 0..COLUMNS {
        let angle = TAU * (f32::from(k) + 0.5) / f32::from(COLUMNS);
        let foot = Vec3::new(RING * angle.sin(), FLOOR, -RING * angle.cos());
        // The camera looks in from +z.
        if foot.z > 0.72 * RING {
            stump(
                &mut modeller,
                marble,
                foot,
                0.3 + 0.2 * f32::from((k + 1) % 3),
            );
        } else {
            column(&mut modeller, marble, foot);
        }
    }
    entablature(&mut modeller, marble);
    spheres(&mut modeller, marble);
    sky(&mut modeller);
    let eye = Vec3::new(2.7, 1.75, 13.2);
    let target = Vec3::new(0.1, 2.45, 0.0);
    let camera = Camera::look_at(eye, target, Vec3::Y, 36f32.to_radians());
    let mut scene = modeller.finish();
    scene.camera = Some(Camera {
        resolution: Some([960, 640]),
        crop: None,
        ..camera.expect("two points and an upright vector")
    });
    scene
}

/// Three round steps out of the water.
fn plinth(modeller: &mut Modeller, marble: MaterialId) {
    let step = FLOOR / 3.0;
    let profile = [
        (0.0, FLOOR),
        (RING + 0.7, FLOOR),
        (RING + 0.7, FLOOR - step),
        (RING + 1.1, FLOOR - step),
        (RING + 1.1, FLOOR - 2.0 * step),
        (RING + 1.5, FLOOR - 2.0 * step),
        (RING + 1.5, -0.5),
    ];
    let profile = profile.map(Vec2::from);
    modeller.turned_with_edges(marble, &Affine3A::IDENTITY, &profile, 96);
}

/// Plinth, base, a shaft that swells and tapers, and a capital.
fn column(modeller: &mut Modeller, marble: MaterialId, foot: Vec3) {
    let transform = Affine3A::from_translation(foot);
    base(modeller, marble, &transform);
    shaft(modeller, marble, &transform, 3.3);
    let capital = [(0.27, 3.3), (0.31, 3.36), (0.27, 3.42)];
    modeller.turned(marble, &transform, &from_the_top(&capital), 32);
    let bell = [(0.26, 3.42), (0.28, 3.5), (0.36, 3.58)];
    modeller.turned(marble, &transform, &from_the_top(&bell), 32);
    let abacus = (Vec3::new(-0.4, 3.58, -0.4), Vec3::new(0.4, 3.7, 0.4));
    modeller.block(marble, &turned_to_centre(foot), abacus.0, abacus.1);
}

/// What is left of a column: base and the lower part of the shaft.
fn stump(modeller: &mut Modeller, marble: MaterialId, foot: Vec3, height: f32) {
    let transform = Affine3A::from_translation(foot);
    base(modeller, marble, &transform);
    shaft(modeller, marble, &transform, height);
    let radius = shaft_radius(height);
    let cap = [Vec2::new(0.0, height), Vec2::new(radius, height)];
    modeller.turned_with_edges(marble, &transform, &cap, 32);
}

fn base(modeller: &mut Modeller, marble: MaterialId, transform: &Affine3A) {
    let foot = Vec3::from(transform.translation);
    let (low, high) = (Vec3::new(-0.44, 0.0, -0.44), Vec3::new(0.44, 0.12, 0.44));
    modeller.block(marble, &turned_to_centre(foot), low, high);
    for (height, radius, thickness) in [(0.12, 0.40, 0.12), (0.24, 0.36, 0.08)] {
        modeller.turned(marble, transform, &torus(height, radius, thickness), 32);
    }
}

fn shaft(modeller: &mut Modeller, marble: MaterialId, transform: &Affine3A, top: f32) {
    let at = |k: u16| 0.32 + (top - 0.32) * f32::from(k) / 12.0;
    let profile: Vec<Vec2> = (0..=12)
        .rev()
        .map(|k| Vec2::new(shaft_radius(at(k)), at(k)))
        .collect();
    modeller.turned(marble, transform, &profile, 32);
}

/// Entasis: the shaft is widest at a third of its height.
fn shaft_radius(height: f32) -> f32 {
    let t = (height - 1.1) / 2.2;
    0.325 - 0.065 * t * t.abs()
}

/// The outer half of a ring of this thickness, from its top down.
fn torus(height: f32, radius: f32, thickness: f32) -> Vec<Vec2> {
    let half = 0.5 * thickness;
    let at = |k: u16| {
        let angle = core::f32::consts::PI * f32::from(k) / 8.0;
        let out = radius - half + half * angle.sin();
        Vec2::new(out, height + half + half * angle.cos())
    };
    (0..=8).map(at).collect()
}

/// The beam that the columns carry, open above; it has fallen where they have.
fn entablature(modeller: &mut Modeller, marble: MaterialId) {
    let transform = Affine3A::from_translation(Vec3::Y * (FLOOR + 3.7));
    let profile = [
        (3.62, 0.0),
        (3.62, 0.75),
        (4.55, 0.75),
        (4.55, 0.62),
        (4.38, 0.5),
        (4.38, 0.0),
        (3.62, 0.0),
    ];
    modeller.turned_with_edges(marble, &transform, &profile.map(Vec2::from), 96);
}

/// Steel on a pedestal, and gold, glazed clay and clay around it. Nothing is so smooth that it
/// throws the sun where only a lucky ray finds it.
fn spheres(modeller: &mut Modeller, marble: MaterialId) {
    let transform = Affine3A::from_translation(Vec3::Y * FLOOR);
    let pedestal = [
        (0.95, 0.5),
        (0.95, 0.42),
        (0.8, 0.36),
        (0.8, 0.1),
        (0.95, 0.0),
    ];
    modeller.turned_with_edges(marble, &transform, &pedestal.map(Vec2::from), 64);
    let top = [Vec2::new(0.0, 0.5), Vec2::new(0.95, 0.5)];
    modeller.turned_with_edges(marble, &transform, &top, 64);
    let steel = Surface::conductor_of_reflectance(Vec3::splat(0.75), Vec2::splat(0.2));
    let gold = Vec3::new(0.94, 0.72, 0.33);
    let gold = Surface::conductor_of_reflectance(gold, Vec2::splat(0.25));
    let glaze = Surface::CoatedDiffuse {
        reflectance: Color::Constant(Vec3::new(0.05, 0.16, 0.35)),
        eta: 1.5,
        alpha: Vec2::splat(0.2),
    };
    let clay = Surface::Diffuse {
        reflectance: Color::Constant(Vec3::new(0.55, 0.12, 0.06)),
    };
    let standing = |x: f32, z: f32, radius: f32| Vec3::new(x, FLOOR + radius, z);
    let spheres = [
        (
            Material::new("steel", steel),
            Vec3::Y * (FLOOR + 0.5 + 1.15),
            1.15,
        ),
        (
            Material::new("gold", gold),
            standing(-1.75, 1.35, 0.62),
            0.62,
        ),
        (
            Material::new("glazed clay", glaze),
            standing(1.35, 1.9, 0.5),
            0.5,
        ),
        (
            Material::new("clay", clay),
            standing(-0.35, 2.35, 0.36),
            0.36,
        ),
    ];
    for (material, center, radius) in spheres {
        let material = modeller.material(material);
        modeller.sphere(material, center, radius);
    }
}

fn sky(modeller: &mut Modeller) {
    let bytes = include_bytes!("../../assets/sky.exr");
    let file = parse_exr(Path::new("sky.exr"), bytes).expect("the sky that ships is an image");
    let scene = modeller.scene();
    scene.warnings.extend(file.warning);
    let turn = Affine3A::from_rotation_y(SUN_TURN);
    let added = scene.add_sky(&magnified(&file.image, 4), turn);
    added.expect("readers make every texel finite and at least 0");
}

/// Brings the sun of the map to the left, a little behind the columns.
const SUN_TURN: f32 = -0.75;

/// The image with each texel divided in `factor` by `factor`, smoothly, so that the small map that
/// ships shows no squares.
///
/// Between texel centres it is a quadratic B-spline, whose weights are positive and keep the
/// image's sum; columns go around, rows end at the poles.
fn magnified(image: &Image, factor: u32) -> Image {
    let (width, height) = (image.width(), image.height());
    let weights = |k: u32| {
        let d = (k as f32 + 0.5) / factor as f32 - 0.5;
        [
            0.5 * (0.5 - d).powi(2),
            0.75 - d * d,
            0.5 * (0.5 + d).powi(2),
        ]
    };
    let texel = |x: u32, y: u32| {
        let columns = [x + width - 1, x, x + 1].map(|x| x % width);
        let rows = [y.saturating_sub(1), y, (y + 1).min(height - 1)];
        rows.map(|y| columns.map(|x| image.texel(x, y)))
    };
    let mix =
        |values: [Vec3; 3], w: [f32; 3]| values[0] * w[0] + values[1] * w[1] + values[2] * w[2];
    let rows = (0..height * factor).flat_map(|y| (0..width * factor).map(move |x| (x, y)));
    let texels = rows.map(|(x, y)| {
        let row = texel(x / factor, y / factor).map(|row| mix(row, weights(x % factor)));
        mix(row, weights(y % factor))
    });
    let (width, height) = (width * factor, height * factor);
    Image::new(width, height, texels.collect()).expect("as many texels as the size says")
}

/// At `foot`, with the z axis away from the middle of the ring.
fn turned_to_centre(foot: Vec3) -> Affine3A {
    let angle = foot.x.atan2(foot.z);
    Affine3A::from_rotation_translation(Quat::from_rotation_y(angle), foot)
}

/// A profile that is written from the bottom up, from the top down.
fn from_the_top(profile: &[(f32, f32)]) -> Vec<Vec2> {
    profile.iter().rev().map(|&at| Vec2::from(at)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_a_sky_and_no_lamp() {
        let scene = rotunda();
        assert_eq!(scene.emissive_triangle_count(), 0, "no lamp");
        assert_eq!(scene.lights.len(), 1, "the sky");
        assert_eq!(scene.warnings.len(), 1, "the sky's negative texels");
        let finite = scene.meshes.iter().all(|mesh| mesh.bounds().is_finite());
        assert!(finite, "finite");
    }

    #[test]
    fn magnifying_keeps_the_sum() {
        let texels = (0u8..15).map(|i| Vec3::splat(f32::from(i * i)));
        let small = Image::new(5, 3, texels.collect()).expect("5 x 3");
        let large = magnified(&small, 4);
        let sum = |image: &Image| image.texels().iter().map(|t| t.x).sum::<f32>();
        assert_eq!([large.width(), large.height()], [20, 12], "four times");
        assert!(
            (sum(&large) / (16.0 * sum(&small)) - 1.0).abs() < 1e-5,
            "sum"
        );
    }
}
