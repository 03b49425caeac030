//! A wood in fog with a thousand lamps, made from a seed: they hang among the trunks, which hide
//! most of them from any one point.

use lights::media::phase::HenyeyGreenstein;
use lights::media::{Homogeneous, Phase, Region, Substance};
use lights::sources::{IntensityAmount, LightDesc, MediumInterface, PointLightDesc};

use super::dice::Dice;
use super::modeller::Modeller;
use crate::glam::Vec3;
use crate::{Camera, Material, Scene};

/// The lamps of the scene.
const LAMPS: u16 = 1000;

/// The trunks.
const TRUNKS: u16 = 420;

/// Half the side of the wood, in metres; all lengths of the scene are metres, the ground is at
/// height 0.
const HALF: f32 = 34.0;

/// The width of the path that leads into the wood.
const PATH: f32 = 5.0;

/// The wood; the same scene for the same seed.
pub(super) fn fog(seed: u64) -> Scene {
    let mut dice = Dice::new(seed);
    let mut modeller = Modeller::default();
    let earth = modeller.material(Material::diffuse("earth", Vec3::new(0.10, 0.09, 0.06)));
    let bark = modeller.material(Material::diffuse("bark", Vec3::new(0.13, 0.10, 0.08)));
    let [near, far] = [2.0 * HALF, -2.0 * HALF];
    let ground = [(far, near), (near, near), (near, far), (far, far)];
    modeller.quad(earth, ground.map(|(x, z)| Vec3::new(x, 0.0, z)));
    for _ in 0..TRUNKS {
        let foot = beside_the_path(&mut dice, 0.5);
        let lean = Vec3::new(dice.between(-0.6, 0.6), 14.0, dice.between(-0.6, 0.6));
        let radius = dice.between(0.12, 0.4);
        modeller.bar(bark, [foot, foot + lean], [radius, 0.6 * radius], 9);
    }
    let mut scene = modeller.finish();

    let substance = Substance::new(
        Vec3::splat(0.002),
        Vec3::new(0.040, 0.044, 0.050),
        Vec3::ZERO,
    );
    let phase = HenyeyGreenstein::new(0.55).map(Phase::HenyeyGreenstein);
    let fog = scene.add_medium(
        "fog",
        Homogeneous {
            substance: substance.expect("positive coefficients"),
            phase: phase.expect("between -1 and 1"),
            region: Region::UNBOUNDED,
        },
    );
    scene.camera_medium = Some(fog);
    let media = MediumInterface {
        inside: None,
        outside: Some(fog),
    };
    for _ in 0..LAMPS {
        let foot = beside_the_path(&mut dice, 0.0);
        let tint = [
            Vec3::new(1.0, 0.62, 0.28),
            Vec3::new(1.0, 0.75, 0.45),
            Vec3::new(0.75, 0.85, 1.0),
        ];
        scene.lights.push(LightDesc::Point(PointLightDesc {
            position: foot + Vec3::Y * dice.between(0.4, 4.5),
            emission: dice.pick(&tint),
            // From a candle to a lantern.
            amount: IntensityAmount::Radiometric(0.05 * 60f32.powf(dice.unit())),
            media,
        }));
    }
    let eye = Vec3::new(0.4, 1.7, HALF - 2.0);
    let camera = Camera::look_at(eye, Vec3::new(0.0, 2.2, 0.0), Vec3::Y, 0.75);
    scene.camera = Some(Camera {
        resolution: Some([960, 540]),
        ..camera.expect("two points and an upright vector")
    });
    scene
}

/// A position on the ground, at least `margin` from the path.
fn beside_the_path(dice: &mut Dice, margin: f32) -> Vec3 {
    let x = dice.between(0.5 * PATH + margin, HALF);
    let side = if dice.chance(0.5) { 1.0 } else { -1.0 };
    Vec3::new(side * x, 0.0, dice.between(-HALF, HALF))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_a_thousand_lamps_in_fog_and_is_the_same_each_time() {
        let scene = fog(1);
        assert_eq!(scene.lights.len(), 1000, "as announced");
        assert_eq!(scene.meshes, fog(1).meshes, "the same each time");
        assert_ne!(scene.meshes, fog(2).meshes, "another seed");
        assert!(scene.camera_medium.is_some(), "the camera is in fog");
    }
}
