use core::f64::consts::{PI, TAU};

use light_math::glam::{DVec2, DVec3};
use light_sources::Image;

use super::arrival::Arriving;
use super::model::Values;
use super::receiver::Receiver;
use super::sphere_maps::{equal_area_direction, equal_area_place};
use super::stratified::Stratified;
use super::surface::RigidFrame;
use crate::Rng;

/// A light in a point, in double precision.
pub(super) struct PointTruth {
    pub(super) frame: RigidFrame,
    pub(super) beam: Beam,
    /// Values where the beam is 1; of an image in colour unused.
    pub(super) values: Values,
    pub(super) coordinates: f64,
}

/// Intensity by direction in light space.
pub(super) enum Beam {
    Even,
    /// Angles of the falloff and of the rim.
    Spot([f64; 2]),
    /// Half the size on the plane z = 1, and values of texels.
    Projection(DVec2, [u32; 2], Vec<Values>),
    /// A square of relative intensities.
    Goniometric(Image),
}

impl PointTruth {
    pub(super) fn intensity(&self, w: DVec3) -> Values {
        let w = self.frame.inverse_vector(w);
        let share = match &self.beam {
            Beam::Even => 1.0,
            Beam::Spot([start, end]) => {
                let angle = w.truncate().length().atan2(w.z);
                // 1 minus a cosine, without cancellation.
                let x = |angle: f64| 2.0 * (0.5 * angle).sin().powi(2);
                let t = (x(*end) - x(angle)) / (x(*end) - x(*start));
                if angle <= *start {
                    1.0
                } else if angle >= *end {
                    0.0
                } else {
                    t * t * (3.0 - 2.0 * t)
                }
            }
            Beam::Projection(half, [width, height], texels) => {
                let p = w.truncate() / w.z;
                let uv = p / *half * 0.5 + 0.5;
                if !(w.z > 0.0 && uv.clamp(DVec2::ZERO, DVec2::ONE) == uv) {
                    return [0.0; 4];
                }
                let at = |u: f64, n: u32| ((u * f64::from(n)) as u32).min(n - 1);
                return texels[(at(uv.y, *height) * width + at(uv.x, *width)) as usize];
            }
            Beam::Goniometric(image) => {
                let place = equal_area_place(w);
                let n = image.size()[0];
                let [x, y] = [place.x, place.y].map(|u| ((u * f64::from(n)) as u32).min(n - 1));
                image.texel(x, y).x.into()
            }
        };
        self.values.map(|value| value * share)
    }

    /// Rows of cells, at least `side`: a multiple of the rows of a picture, so that no cell crosses an
    /// edge.
    pub(super) fn rows(&self, side: u32) -> u32 {
        match &self.beam {
            Beam::Projection(_, [width, height], _) => {
                width * height * side.div_ceil(width * height)
            }
            Beam::Goniometric(image) => image.size()[0] * side.div_ceil(image.size()[0]),
            _ => side,
        }
    }

    /// A direction of the beam at a point of the unit square, and its solid angle if all of the square
    /// were like it.
    pub(super) fn direction(&self, [x, y]: [f64; 2]) -> (DVec3, f64) {
        let (w, solid_angle) = match &self.beam {
            Beam::Even | Beam::Goniometric(_) => (equal_area_direction(DVec2::new(x, y)), 4.0 * PI),
            Beam::Spot([_, end]) => {
                let most = 2.0 * (0.5 * end).sin().powi(2);
                let from_axis = most * x;
                let sin = (from_axis * (2.0 - from_axis)).sqrt();
                let around = DVec2::from_angle(TAU * y) * sin;
                (around.extend(1.0 - from_axis), TAU * most)
            }
            Beam::Projection(half, ..) => {
                let on_plane = (DVec2::new(x, y) * 2.0 - 1.0) * *half;
                let w = on_plane.extend(1.0);
                (w.normalize(), 4.0 * half.x * half.y / w.length().powi(3))
            }
        };
        (self.frame.vector(w), solid_angle)
    }

    /// The integrals of intensity, and of direction weighted by that of the last channel.
    pub(super) fn leaving(&self, side: u32, rng: &mut Rng) -> Stratified<10> {
        Stratified::over_square(self.rows(side), rng, |at, _| {
            let (w, solid_angle) = self.direction(at);
            let power = self.intensity(w).map(|i| i * solid_angle);
            let [a, b, c] = (w * power[3]).to_array();
            let [r, s, t, u] = power;
            [r, s, t, u, a, b, c, 0.0, 0.0, 0.0]
        })
    }
}

impl Arriving for PointTruth {
    fn arriving(&self, receiver: &Receiver, _: u32, _: &mut Rng) -> Stratified<4> {
        let to_light = self.frame.origin - receiver.p;
        let wi = to_light.normalize();
        let weight = receiver.weight(wi) / to_light.length_squared();
        let mut sum = Stratified::default();
        sum.add_cell([self.intensity(-wi).map(|i| i * weight); 2]);
        sum
    }

    fn share_of_edges(&self, _: &Receiver, _: &mut Rng) -> f64 {
        0.0
    }

    fn most(&self, _: &Receiver, _: &mut Rng) -> f64 {
        0.0
    }

    fn coordinates(&self) -> f64 {
        self.coordinates
    }
}
