//! A canal by night, made from a seed: tall narrow houses with lit windows, arched bridges outlined
//! with bulbs, lanterns along the quays, festoons between them, trees full of small lights, and
//! boats.
//!
//! Twenty thousand emissive triangles, most of them hidden from any one point by houses, bridges
//! and boats, none of them far brighter than the rest: the case for a light hierarchy.

mod boat;
mod bridge;
mod corners;
mod course;
mod facade;
mod festoon;
mod gable;
mod gable_style;
mod house;
mod lantern;
mod measures;
mod palette;
mod quay;
mod tower;
mod tree;
mod window;

use lights::sources::{LightDesc, RadianceAmount, UniformInfiniteLightDesc};

use super::dice::Dice;
use super::modeller::Modeller;
use crate::glam::Vec3;
use crate::{Camera, Scene};

use course::{Bank, Course};
use measures::BRIDGES;
use palette::Palette;

/// The emissive triangles of the scene.
const LIGHTS: usize = 20_000;

/// The canal and all around it; the same scene for the same seed.
pub(super) fn night(seed: u64) -> Scene {
    let mut dice = Dice::new(seed);
    let mut modeller = Modeller::default();
    let palette = Palette::new(&mut modeller);
    let course = Course { radius: 105.0 };
    quay::water_and_quays(&mut modeller, &palette, &course);
    for bank in Bank::BOTH {
        house::row(&mut modeller, &palette, &mut dice, &course, bank);
        lantern::row(&mut modeller, &palette, &course, bank);
    }
    for along in BRIDGES {
        bridge::bridge(&mut modeller, &palette, &course.at(along, 0.0));
    }
    tower::tower(&mut modeller, &palette, &course);
    boat::boats(&mut modeller, &palette, &mut dice, &course);
    festoon::festoons(&mut modeller, &palette, &course);
    let branches = tree::trees(&mut modeller, &palette, &mut dice, &course);
    // The trees take the bulbs that make the number round.
    let left = LIGHTS.saturating_sub(modeller.emissive_triangle_count());
    tree::bulbs(&mut modeller, &palette, &mut dice, &branches, left);
    let mut scene = modeller.finish();
    let sky = UniformInfiniteLightDesc {
        emission: Vec3::new(0.009, 0.015, 0.034),
        amount: RadianceAmount::default(),
    };
    scene.lights.push(LightDesc::UniformInfinite(sky));
    scene.camera = Some(camera());
    scene
}

/// From a bridge behind the picture, over the water, toward the bend.
fn camera() -> Camera {
    let eye = Vec3::new(0.6, 6.4, 8.5);
    let target = eye + Vec3::new(0.15, -0.035, -1.0);
    let camera = Camera::look_at(eye, target, Vec3::Y, 40f32.to_radians());
    Camera {
        resolution: Some([960, 540]),
        crop: None,
        // The night stays dark.
        exposure: Some(1.25),
        ..camera.expect("two points and an upright vector")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_twenty_thousand_lights_and_is_the_same_each_time() {
        let scene = night(1);
        assert_eq!(scene.emissive_triangle_count(), LIGHTS, "as announced");
        assert_eq!(scene.meshes, night(1).meshes, "the same each time");
        assert_ne!(scene.meshes, night(2).meshes, "another seed");
        assert_eq!(night(2).emissive_triangle_count(), LIGHTS, "as announced");
    }

    #[test]
    fn every_light_has_an_area_and_is_small() {
        let scene = night(1);
        for mesh in &scene.meshes {
            assert!(mesh.bounds().is_finite(), "{} is finite", mesh.name);
            if scene.material(mesh.material).emission.is_none() {
                continue;
            }
            for index in 0..mesh.indices.len() {
                let [a, b, c] = mesh.triangle(index);
                let area = 0.5 * (b - a).cross(c - a).length();
                assert!(area > 1e-5 && area < 0.5, "{area} m2 in {}", mesh.name);
            }
        }
    }
}
