use light_bounds::{LightBounds, LightExtent, LightSampleContext, ReceiverKind, ReceiverSides};
use light_bvh::{LightBvhOptions, LightPrototype, Placement};
use light_math::Aabb;
use light_math::glam::{Quat, Vec3};
use light_sets::glam::{DQuat, DVec3};

use super::input::Input;
use super::sampler_kind::power;
use crate::may_contribute::may_contribute;

/// Prototypes, lights of one, and placements that one input may hold.
const MAX_PROTOTYPES: usize = 3;
const MAX_LIGHTS: usize = 20;
const MAX_PLACEMENTS: usize = 4;

/// How far a light is at least, as a share of the receiver's coordinates, where it is tested: these
/// are rounded, and angles have to stay right.
const LEAST_DISTANCE: f64 = 1e-3;

/// Lights as prototypes have them, and where these are placed.
#[derive(Clone, Debug)]
pub(super) struct PlacedScene {
    pub(super) kinds: Vec<Vec<LightExtent>>,
    pub(super) places: Vec<Place>,
}

/// A placement, as double precision knows it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) placement: Placement,
    turn: DQuat,
    scale: f64,
    translation: Vec3,
    /// The factor of powers.
    power: f32,
}

impl PlacedScene {
    pub(super) fn new(input: &mut Input<'_>) -> Self {
        let kinds = (0..=input.below(MAX_PROTOTYPES)).map(|_| {
            let lights = (0..input.below(MAX_LIGHTS)).map(|_| input.scene_extent());
            lights.collect()
        });
        let kinds: Vec<_> = kinds.collect();
        let count = input.below(MAX_PLACEMENTS + 1);
        let places = (0..count).map(|_| {
            let prototype = input.below(kinds.len());
            Place::new(prototype as u32, input)
        });
        Self {
            places: places.collect(),
            kinds,
        }
    }

    pub(super) fn prototypes(&self, options: &LightBvhOptions) -> Vec<LightPrototype> {
        let prototype =
            |lights: &Vec<_>| LightPrototype::with_options(lights, options).expect("valid");
        self.kinds.iter().map(prototype).collect()
    }

    pub(super) fn placements(&self) -> Vec<Placement> {
        self.places.iter().map(|place| place.placement).collect()
    }

    /// The lights of a placement, as its prototype has them.
    pub(super) fn lights_of(&self, place: &Place) -> &[LightExtent] {
        &self.kinds[place.placement.prototype() as usize]
    }

    /// All placed lights, in the order of their ids.
    pub(super) fn lights(&self) -> impl Iterator<Item = (&Place, &LightExtent)> {
        let lights = |place| {
            self.lights_of(place)
                .iter()
                .map(move |light| (place, light))
        };
        self.places.iter().flat_map(lights)
    }

    /// Whether some light of a placement may be beyond the reach of trees.
    pub(super) fn may_be_far(&self, place: &Place) -> bool {
        let corners = self.lights_of(place).iter().filter_map(|light| {
            let Aabb { min, max } = light.bounded()?.bounds;
            Some(norm(min) + norm(max))
        });
        let size = corners.fold(0.0, f64::max);
        norm(place.translation) + place.scale.abs() * 10.0 * size > 1e35
    }
}

impl Place {
    pub(super) fn new(prototype: u32, input: &mut Input<'_>) -> Self {
        let turn = match input.byte() % 4 {
            0 => Quat::IDENTITY,
            _ => Quat::from_axis_angle(input.axis(), input.number()).normalize(),
        };
        let scale = if input.byte() % 4 == 0 {
            1.0
        } else {
            input.number()
        };
        let translation = input.place();
        let whole = Placement::at(prototype, translation);
        let turned = Placement::new(prototype, turn, scale, translation);
        let (placement, turn, scale) = match turned {
            Ok(turned) => (turned, turn, scale),
            Err(_) => (whole, Quat::IDENTITY, 1.0),
        };
        let power = match input.byte() % 4 {
            0 => input.amount(1e30),
            1 => 0.0,
            _ => (scale * scale).min(f32::MAX),
        };
        let [x, y, z, w] = turn.to_array().map(f64::from);
        Self {
            placement: placement.with_power(power).expect("finite, not negative"),
            turn: DQuat::from_xyzw(x, y, z, w).normalize(),
            scale: f64::from(scale),
            translation,
            power,
        }
    }

    /// Whether a light of the prototype has power where it is placed.
    pub(super) fn is_lit(&self, light: &LightExtent) -> bool {
        light.infinite().is_none() && power(light) > 0.0 && self.power > 0.0
    }

    /// Whether a light of the prototype certainly contributes at a receiver of the scene.
    pub(super) fn may_contribute(&self, light: &LightExtent, ctx: &LightSampleContext) -> bool {
        let bounds = match light {
            LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _) => bounds,
            LightExtent::Infinite(_) => return false,
        };
        let Some((ctx, ends)) = self.in_prototype(ctx) else {
            return false;
        };
        let Aabb { min, max } = bounds.bounds;
        let corner = |i: u8| {
            let axis = |k: usize| if i >> k & 1 == 0 { min[k] } else { max[k] };
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let coordinates = norm(ctx.p) + norm(ends[1] - ends[0]);
        (0..8).map(corner).any(|at| {
            let dist = nearest(at.as_dvec3(), ends.map(Vec3::as_dvec3));
            let there = dist * self.scale.abs();
            let irradiance = f64::from(bounds.phi) * f64::from(self.power) / (there * there);
            dist >= LEAST_DISTANCE * coordinates
                && irradiance > f64::from(f32::MIN_POSITIVE)
                && may_contribute(&LightExtent::Bounded(at_point(bounds, at)), &ctx)
        })
    }

    /// A receiver in the frame of the prototype, and its two ends.
    fn in_prototype(&self, ctx: &LightSampleContext) -> Option<(LightSampleContext, [Vec3; 2])> {
        let back = self.turn.inverse();
        let length = |v: DVec3| (back * v / self.scale).as_vec3();
        let direction = |v: Vec3| (back * v.as_dvec3() * self.scale.signum()).as_vec3();
        let p = length(ctx.p.as_dvec3() - self.translation.as_dvec3());
        let (receiver, along) = match *ctx.kind() {
            ReceiverKind::Medium => (LightSampleContext::medium(p), Vec3::ZERO),
            ReceiverKind::Segment { extent, .. } => {
                let extent = length(extent.as_dvec3());
                (LightSampleContext::segment(p, extent), extent)
            }
            ReceiverKind::Surface { ns, sides, .. } => {
                let ns = direction(ns);
                let receiver = match sides {
                    ReceiverSides::Front => LightSampleContext::surface(p, ns, ns),
                    ReceiverSides::Both => LightSampleContext::two_sided(p, ns, ns),
                };
                (receiver, Vec3::ZERO)
            }
            _ => return None,
        };
        Some((receiver, [p, p + along]))
    }
}

/// The same light in one point.
fn at_point(bounds: &LightBounds, p: Vec3) -> LightBounds {
    LightBounds {
        bounds: Aabb::from_point(p),
        ..*bounds
    }
}

/// The distance of a point to the line between two ends.
fn nearest(p: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let along = end - start;
    let t = (p - start).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    p.distance(start + t.clamp(0.0, 1.0) * along)
}

fn norm(v: Vec3) -> f64 {
    v.as_dvec3().abs().element_sum()
}
