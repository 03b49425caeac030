//! A city of houses that are placed and stored once, and whose windows shine.

use light_testkit::Rng;
use light_testkit::light_sets::{SetLight, SetPoint};
use lights::bounds::{LightExtent, LightSampleContext};
use lights::bvh::{InstancedLightBvh, LightPrototype, Placement};
use lights::glam::{Affine3A, Quat, Vec3};

/// Length of the side of a house; it is twice as high, and a street is as wide.
pub const SIDE: f32 = 12.0;

/// Kinds of houses of a city.
pub const KINDS: usize = 20;

/// Windows in the walls of a house, which face outward: two triangles each.
#[must_use]
pub fn house(lights: usize, rng: &mut Rng) -> Vec<SetLight> {
    let mut windows = Vec::with_capacity(lights);
    while windows.len() < lights {
        let wall = Quat::from_rotation_z(core::f32::consts::FRAC_PI_2 * rng.below(4) as f32);
        let at = Vec3::new(0.5 * SIDE, (rng.f32() - 0.5) * SIDE, 2.0 * SIDE * rng.f32());
        let size = 0.5 * SIDE / (lights as f32).sqrt();
        let radiance = rng.log_range(0.1, 10.0);
        let [a, b, c, d] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(y, z)| wall * (at + Vec3::new(0.0, y, z) * size));
        for vertices in [[a, b, c], [a, c, d]] {
            windows.push(SetLight::Triangle {
                vertices,
                radiance,
                two_sided: false,
            });
        }
    }
    windows.truncate(lights);
    windows
}

/// The extents of lights.
#[must_use]
pub fn extents(lights: &[SetLight]) -> Vec<LightExtent> {
    lights.iter().map(|light| light.bounds().into()).collect()
}

/// Lights to be placed.
///
/// # Panics
/// If one of them is invalid.
#[must_use]
pub fn prototype(lights: &[SetLight]) -> LightPrototype {
    LightPrototype::new(&extents(lights)).expect("valid lights")
}

/// The place of a house on a grid of `across` streets.
#[must_use]
pub fn on_grid(i: usize, across: usize) -> Vec3 {
    Vec3::new((i % across) as f32, (i / across) as f32, 0.0) * (2.0 * SIDE)
}

/// How many streets a city of so many houses has each way.
#[must_use]
pub const fn streets(houses: usize) -> usize {
    houses.isqrt()
}

/// Houses of [`KINDS`] kinds, turned and scaled, with so many lights each.
///
/// # Panics
/// If 2^28 placements do not suffice.
#[must_use]
pub fn city(houses: usize, lights: usize, rng: &mut Rng) -> InstancedLightBvh {
    let (kinds, placements) = placed_houses(houses, lights, rng);
    InstancedLightBvh::build(kinds, &placements).expect("a city")
}

/// What a [`city`] is built from: a house of each kind, and where houses are.
#[must_use]
pub fn placed_houses(
    houses: usize,
    lights: usize,
    rng: &mut Rng,
) -> (Vec<LightPrototype>, Vec<Placement>) {
    let kinds = (0..KINDS).map(|_| prototype(&house(lights, rng))).collect();
    (kinds, places(houses, rng).map(Place::placement).collect())
}

/// Where a house is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Which of the [`KINDS`] it is.
    pub kind: u32,
    /// About the vertical axis.
    pub turn: Quat,
    /// Its size.
    pub scale: f32,
    /// Where the middle of its ground is.
    pub at: Vec3,
}

impl Place {
    /// The same for a tree.
    ///
    /// # Panics
    /// If the transform is none.
    #[must_use]
    pub fn placement(self) -> Placement {
        let placed = Placement::new(self.kind, self.turn, self.scale, self.at);
        placed.expect("a rigid transform")
    }

    /// Takes the house to the city.
    #[must_use]
    pub fn transform(&self) -> Affine3A {
        Affine3A::from_scale_rotation_translation(Vec3::splat(self.scale), self.turn, self.at)
    }
}

/// The places of the houses of a city.
pub fn places(houses: usize, rng: &mut Rng) -> impl Iterator<Item = Place> + '_ {
    (0..houses).map(move |i| Place {
        turn: Quat::from_rotation_z(rng.f32() * core::f32::consts::TAU),
        scale: 0.8 + 0.4 * rng.f32(),
        kind: rng.below(KINDS) as u32,
        at: on_grid(i, streets(houses)),
    })
}

/// A receiver on the ground, or on a wall, of a city of so many streets each way.
#[must_use]
pub fn receiver(rng: &mut Rng, streets: usize) -> SetPoint {
    let side = 2.0 * SIDE * streets as f32;
    let p = Vec3::new(rng.f32() * side, rng.f32() * side, 0.01);
    if rng.below(2) == 0 {
        return SetPoint { p, n: Vec3::Z };
    }
    let n = Vec3::new(rng.f32() - 0.5, rng.f32() - 0.5, 0.0).normalize_or(Vec3::X);
    let p = p + Vec3::Z * (2.0 * SIDE * rng.f32());
    SetPoint { p, n }
}

/// What a light sampler is asked at a receiver.
#[must_use]
pub fn context(point: &SetPoint) -> LightSampleContext {
    LightSampleContext::surface(point.p, point.n, point.n)
}
