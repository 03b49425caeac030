//! Which lights of a prototype are told apart by the direction that they emit in.

use alloc::vec;
use alloc::vec::Vec;

use light_bounds::{LightBounds, LightExtent};
use light_math::float;
use light_math::glam::Vec3;

use crate::build::lights::phi;
use crate::build::quality::spread_sq;

/// The most parts: the faces of a box.
const MOST_PARTS: usize = 6;

/// Lights of a part, at least, on average: the choice among fewer is nearly exact.
const LEAST_LIGHTS: usize = 16;

/// The cosine of the angle within which all axes of a part are from one of them.
const COS_SAME: f32 = 0.95;

/// The cube of how much less parts by direction are spread, at least, than parts by position.
const LEAST_GAIN: f32 = 0.6;

/// How far before the middle of all lights a part is that faces outward, at least, in standard
/// deviations of the positions.
const LEAST_OUTWARD: f64 = 0.25;

/// The part of each light, counted from 0; empty if all lights are one part. Lights of no interest
/// are in any part.
///
/// Parts are by direction where all of them face outward, and where that lessens the spread of the
/// groups more than as many parts by position do where lights fill a cube: each wall of a house is
/// a part. Receivers among lights that face inward are near all of them, and tell them apart by
/// position. Parts are compared by power and by number, for those by power alone are small of any
/// groups of which each has a light that outshines the rest.
pub(crate) fn parts(
    lights: &[LightExtent],
    is_of_interest: impl Fn(&LightExtent) -> bool,
) -> Vec<u8> {
    let lights = || lights.iter();
    let of_interest = || lights().filter(|light| is_of_interest(light));
    if of_interest().any(|light| axis(light).is_none()) {
        return Vec::new();
    }
    let directions = match directions(of_interest()) {
        Some(directions) if directions.len() > 1 => directions,
        _ => return Vec::new(),
    };
    if of_interest().count() < LEAST_LIGHTS * directions.len() {
        return Vec::new();
    }
    let part = |light: &LightExtent| axis(light).map_or(0, |axis| nearest(&directions, axis).0);
    let mut by_power = vec![Sums::default(); directions.len()];
    let mut by_number = by_power.clone();
    for light in of_interest() {
        let part = part(light);
        by_power[part].add(light, phi(light));
        by_number[part].add(light, 1.0);
    }
    if are_apart(&by_power) && are_apart(&by_number) {
        lights().map(|light| number(part(light))).collect()
    } else {
        Vec::new()
    }
}

/// Whether parts of these sums face outward, and are told apart better than parts by position.
fn are_apart(parts: &[Sums]) -> bool {
    let whole = parts.iter().copied().reduce(Sums::and).unwrap_or_default();
    let lit = || parts.iter().filter(|part| part.weight > 0.0);
    // By position a cube falls to parts that are so much smaller.
    let spread: f32 = lit().map(|part| part.spread_in(&whole)).sum();
    let is_less_spread = spread * spread * spread * f32::from(number(parts.len())) < LEAST_GAIN;
    is_less_spread && lit().all(|part| part.is_outward_of(&whole))
}

/// Axes of lights, of which each other axis is near one; `None` if that takes too many. Each is the
/// farthest from those before it (T. F. Gonzalez, "Clustering to Minimize the Maximum Intercluster
/// Distance", 1985).
fn directions<'a>(lights: impl Iterator<Item = &'a LightExtent> + Clone) -> Option<Vec<Vec3>> {
    let axes = lights.filter_map(axis);
    let mut directions = Vec::from_iter(axes.clone().next());
    loop {
        let (mut farthest, mut least) = (None, COS_SAME);
        for axis in axes.clone() {
            let (_, cos) = nearest(&directions, axis);
            if cos < least {
                (farthest, least) = (Some(axis), cos);
            }
        }
        match farthest {
            None => return Some(directions),
            Some(axis) if directions.len() < MOST_PARTS => directions.push(axis),
            Some(_) => return None,
        }
    }
}

/// The nearest of the directions, and the cosine of the angle to it.
fn nearest(directions: &[Vec3], axis: Vec3) -> (usize, f32) {
    let cosines = directions.iter().map(|direction| direction.dot(axis));
    let none = (0, f32::NEG_INFINITY);
    cosines
        .enumerate()
        .fold(none, |best, next| if next.1 > best.1 { next } else { best })
}

/// The axis of a light that emits to one side of a plane only.
fn axis(light: &LightExtent) -> Option<Vec3> {
    /// Round-off of the cosine of a right angle.
    const ROUND_OFF: f32 = 1e-3;
    let &LightBounds {
        w,
        cos_theta_o,
        cos_theta_e,
        two_sided,
        ..
    } = light.bounded()?;
    let sine = |cos: f32| float::sqrt((1.0 - cos * cos).max(0.0));
    let cos_edge = cos_theta_o * cos_theta_e - sine(cos_theta_o) * sine(cos_theta_e);
    (!two_sided && cos_theta_o > 0.0 && cos_edge > -ROUND_OFF).then_some(w)
}

/// Sums over lights.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    weight: f64,
    position: VectorSums,
    axis: VectorSums,
}

impl Sums {
    fn add(&mut self, light: &LightExtent, weight: f32) {
        let (Some(bounds), Some(axis)) = (light.bounded(), axis(light)) else {
            return;
        };
        let weight = f64::from(weight);
        self.weight += weight;
        self.position.add(weight, bounds.bounds.center());
        self.axis.add(weight, axis);
    }

    fn and(self, other: Self) -> Self {
        Self {
            weight: self.weight + other.weight,
            position: self.position.and(other.position),
            axis: self.axis.and(other.axis),
        }
    }

    fn spread_sq(&self) -> f64 {
        let disagreement = rounded(self.axis.variance(self.weight));
        spread_sq(self.position.variance(self.weight), disagreement)
    }

    /// The spread as a share of that of `whole`, times the share of the weight.
    fn spread_in(&self, whole: &Self) -> f32 {
        let share = rounded(self.weight / whole.weight);
        share * float::sqrt(rounded(self.spread_sq() / whole.spread_sq()))
    }

    /// Whether the lights face away from the middle of `whole`.
    fn is_outward_of(&self, whole: &Self) -> bool {
        let axis = self.axis.mean(self.weight);
        let [own, all] = [self, whole].map(|sums| sums.position.mean(sums.weight));
        let along = |i: usize| axis[i] * (own[i] - all[i]);
        let outward = along(0) + along(1) + along(2);
        let least = LEAST_OUTWARD * LEAST_OUTWARD * whole.position.variance(whole.weight);
        outward > 0.0 && outward * outward >= least
    }
}

/// Weighted sums of vectors and of their squares.
#[derive(Clone, Copy, Debug, Default)]
struct VectorSums {
    linear: [f64; 3],
    square: f64,
}

impl VectorSums {
    fn add(&mut self, weight: f64, vector: Vec3) {
        for (sum, x) in self.linear.iter_mut().zip(vector.to_array()) {
            *sum += weight * f64::from(x);
            self.square += weight * f64::from(x) * f64::from(x);
        }
    }

    fn and(mut self, other: Self) -> Self {
        for (sum, more) in self.linear.iter_mut().zip(other.linear) {
            *sum += more;
        }
        self.square += other.square;
        self
    }

    /// The variance, where all weights together are `weight`.
    fn variance(&self, weight: f64) -> f64 {
        let square_of_mean: f64 = self.mean(weight).iter().map(|x| x * x).sum();
        (self.square / weight - square_of_mean).max(0.0)
    }

    fn mean(&self, weight: f64) -> [f64; 3] {
        self.linear.map(|sum| sum / weight)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
const fn rounded(x: f64) -> f32 {
    x as f32
}

#[expect(clippy::cast_possible_truncation, reason = "at most six")]
const fn number(part: usize) -> u8 {
    part as u8
}
