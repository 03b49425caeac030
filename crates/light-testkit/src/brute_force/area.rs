use core::f64::consts::PI;

use light_math::glam::{DVec2, DVec3, Vec3};
use light_sources::{
    DiffuseEmissionDesc, EmissionMask, RadianceAmount, Sides, SurfaceAmount, SurfaceColor,
};

use super::arrival::{Arriving, BACKWARD_ERROR};
use super::model::{Model, Values};
use super::picture::{color_at, opacity};
use super::receiver::Receiver;
use super::stratified::Stratified;
use super::surface::{Place, Surface};
use crate::Rng;

/// A surface that emits, in double precision.
#[derive(Debug)]
pub(super) struct EmittingSurface<'a, M: Model> {
    pub(super) surface: Surface,
    pub(super) emission: &'a DiffuseEmissionDesc<M>,
    pub(super) wavelengths: &'a M::Wavelengths,
    pub(super) coordinates: f64,
}

/// Halvings of the unit square before distances count; of a texture.
const DEPTHS: [u32; 2] = [3, 5];

/// The most halvings.
const DEEPEST: u32 = 14;

impl<M: Model> EmittingSurface<'_, M> {
    /// Radiance that leaves `place` toward `w`.
    pub(super) fn radiance(&self, place: &Place, w: DVec3) -> Values {
        let cos_theta = place.n.dot(w);
        let emits = match self.emission.sides {
            Sides::Front => cos_theta > 0.0,
            Sides::Back => cos_theta < 0.0,
            Sides::Both => true,
        };
        if emits {
            self.brightness(place.uv)
        } else {
            [0.0; 4]
        }
    }

    /// Radiance on a side that emits.
    pub(super) fn brightness(&self, uv: DVec2) -> Values {
        let emission = self.emission;
        let scale = f64::from(scale(emission.amount)) * self.opacity(uv);
        let color = match &emission.color {
            SurfaceColor::Uniform(color) => M::values_of(color, self.wavelengths),
            SurfaceColor::Image { texture, tint } => {
                let texel = color_at(texture.image(), &emission.mapping, uv) * tint.as_dvec3();
                M::values(M::emit_texel(texel.as_vec3(), self.wavelengths))
            }
        };
        color.map(|value| value * scale)
    }

    /// The part of the surface that emits at `uv`.
    pub(super) fn opacity(&self, uv: DVec2) -> f64 {
        match &self.emission.mask {
            EmissionMask::Opaque | EmissionMask::Invisible => 1.0,
            EmissionMask::Alpha(mask) => opacity(mask, &self.emission.mapping, uv),
        }
    }

    /// The mean over the area of the image times the mask, in linear RGB, times the area; of a
    /// uniform colour that of the mask.
    pub(super) fn mean_times_area(&self, side: u32, rng: &mut Rng) -> Stratified<4> {
        Stratified::over_square(side, rng, |u, _| {
            let place = self.surface.at(u);
            let color = match &self.emission.color {
                SurfaceColor::Uniform(_) => DVec3::ONE,
                SurfaceColor::Image { texture, tint } => {
                    color_at(texture.image(), &self.emission.mapping, place.uv) * tint.as_dvec3()
                }
            };
            let weight = place.density * self.opacity(place.uv);
            let [r, g, b] = (color * weight).to_array();
            [r, g, b, weight]
        })
    }

    /// How many sides emit, and the sum of their normals as a multiple of the front's.
    pub(super) const fn sides(&self) -> (f64, f64) {
        match self.emission.sides {
            Sides::Front => (1.0, 1.0),
            Sides::Back => (1.0, -1.0),
            Sides::Both => (2.0, 0.0),
        }
    }

    /// What leaves the surface: the power over the channels, then the integrals of direction and of
    /// position from `center`, weighted by the power in the last channel.
    pub(super) fn leaving(&self, side: u32, center: DVec3, rng: &mut Rng) -> Stratified<10> {
        let (count, turn) = self.sides();
        Stratified::over_square(side, rng, |u, _| {
            let place = self.surface.at(u);
            let power = self
                .brightness(place.uv)
                .map(|l| l * place.density * PI * count);
            // The mean of a direction that follows the cosine is 2/3 of the normal.
            let direction = place.n * (2.0 / 3.0 * turn * power[3]);
            let position = (place.p - center) * power[3];
            let [[a, b, c], [d, e, f]] = [direction, position].map(|v| v.to_array());
            let [r, s, t, u] = power;
            [r, s, t, u, a, b, c, d, e, f]
        })
    }

    /// A bound of the texels, in any channel, of the integral over a spectrum too.
    pub(super) fn brightest(&self) -> f64 {
        match &self.emission.color {
            SurfaceColor::Uniform(color) => f64::from(M::maximum(color)).max(M::radiant(color)[0]),
            SurfaceColor::Image { texture, tint } => {
                let texels = texture
                    .image()
                    .texels()
                    .map(|texel| (texel * *tint).max_element());
                let texel = texels.fold(0.0, f32::max);
                let flux = M::flux_of_texel(Vec3::splat(texel)).radiant;
                f64::from(texel.max(flux))
            }
        }
    }

    /// The area, nearly.
    pub(super) fn area(&self) -> f64 {
        let mut rng = Rng::new(1);
        let area = Stratified::over_square(8, &mut rng, |u, _| [self.surface.at(u).density]);
        area.values()[0]
    }

    /// The distance of a point from the surface, nearly.
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        let mut nearest = f64::INFINITY;
        self.cells(p, 1, |low, width| {
            let middle = low.map(|low| low + 0.5 * width);
            nearest = nearest.min(self.surface.at(middle).p.distance(p));
        });
        nearest
    }

    fn has_texture(&self) -> bool {
        let is_uniform = matches!(self.emission.color, SurfaceColor::Uniform(_));
        !is_uniform || matches!(self.emission.mask, EmissionMask::Alpha(_))
    }

    /// Calls `each` with the lower corner and the width of square cells that are small compared
    /// with their distance from `p`.
    pub(super) fn cells(&self, p: DVec3, detail: u32, mut each: impl FnMut([f64; 2], f64)) {
        let least = DEPTHS[usize::from(self.has_texture())] + detail.ilog2() / 2;
        let reach = 2.0 / f64::from(detail).sqrt();
        let mut stack = vec![([0.0; 2], 1.0, 0)];
        while let Some((low, width, depth)) = stack.pop() {
            let at = |x: f64, y: f64| self.surface.at([low[0] + width * x, low[1] + width * y]).p;
            let is_small = || {
                let middle = at(0.5, 0.5);
                let corners = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
                let size = corners
                    .map(|c| c.distance(middle))
                    .into_iter()
                    .fold(0.0, f64::max);
                size < 0.25 * reach * middle.distance(p)
            };
            if depth >= DEEPEST || (depth >= least && is_small()) {
                each(low, width);
                continue;
            }
            let half = 0.5 * width;
            for corner in 0..4u8 {
                let up = [corner & 1, corner >> 1].map(|bit| half * f64::from(bit));
                stack.push(([low[0] + up[0], low[1] + up[1]], half, depth + 1));
            }
        }
    }

    /// A point of a cell that is seen from `p`: the unit direction toward it, and its solid angle
    /// if all of the cell were like it.
    pub(super) fn seen(&self, p: DVec3, at: [f64; 2], width: f64) -> Option<(Place, DVec3, f64)> {
        let place = self.surface.at(at);
        let to_light = place.p - p;
        let wi = to_light.normalize_or_zero();
        let cos_theta = wi.dot(place.n).abs();
        let solid_angle = place.density * width * width * cos_theta / to_light.length_squared();
        let is_seen = solid_angle.is_finite() && self.surface.is_seen(p, &place);
        is_seen.then_some((place, wi, solid_angle))
    }
}

impl<M: Model> Arriving for EmittingSurface<'_, M> {
    fn arriving(&self, receiver: &Receiver, detail: u32, rng: &mut Rng) -> Stratified<4> {
        let mut integral = Stratified::default();
        self.cells(receiver.p, detail, |low, width| {
            integral.add_cell([(); 2].map(|()| {
                let at = low.map(|low| low + width * rng.f64());
                self.seen(receiver.p, at, width)
                    .map_or([0.0; 4], |(place, wi, solid_angle)| {
                        let weight = receiver.weight(wi) * solid_angle;
                        self.radiance(&place, -wi).map(|l| l * weight)
                    })
            }));
        });
        integral
    }

    fn most(&self, receiver: &Receiver, rng: &mut Rng) -> f64 {
        let mut sum = 0.0;
        self.cells(receiver.p, 1, |low, width| {
            let at = low.map(|low| low + width * rng.f64());
            if let Some((_, wi, solid_angle)) = self.seen(receiver.p, at, width) {
                sum += receiver.weight(wi) * solid_angle;
            }
        });
        sum * self.brightest() * f64::from(scale(self.emission.amount))
    }

    fn share_of_edges(&self, receiver: &Receiver, rng: &mut Rng) -> f64 {
        let size = receiver.p.length().max(self.coordinates);
        let places = (0..25u8).map(|i| [i % 5, i / 5].map(|i| f64::from(i) * 0.25));
        let places: Vec<Place> = places.map(|at| self.surface.at(at)).collect();
        let distances = || places.iter().map(|place| place.p.distance(receiver.p));
        let nearest = distances().fold(f64::INFINITY, f64::min);
        let wi = |place: &Place| (place.p - receiver.p).normalize_or_zero();
        let angles = places
            .iter()
            .map(|place| wi(place).distance(wi(&places[12])));
        let widest = angles.fold(0.0, f64::max);
        let (mut solid_angle, mut cosine) = (0.0, 0.0);
        self.cells(receiver.p, 1, |low, width| {
            let at = low.map(|low| low + width * rng.f64());
            if let Some((place, wi, part)) = self.seen(receiver.p, at, width) {
                solid_angle += part;
                cosine += part / wi.dot(place.n).abs();
            }
        });
        // An outline of twice the diameter on both sides moves by the angle of the rounding; hits
        // move along the surface by as much as it is tilted.
        let angle = 2.0 * BACKWARD_ERROR * (1.0 + size / nearest);
        let mean_tilt = cosine / solid_angle;
        4.0 * angle * widest / solid_angle + angle * mean_tilt
    }

    fn coordinates(&self) -> f64 {
        self.coordinates
    }
}

/// The factor of a radiometric amount.
pub(super) fn scale(amount: SurfaceAmount) -> f32 {
    match amount {
        SurfaceAmount::Radiance(RadianceAmount::Radiometric(scale)) => scale,
        other => unreachable!("{other:?} is not drawn"),
    }
}

/// The extent of points in space: the largest coordinate.
pub(super) fn largest(points: &[Vec3]) -> f64 {
    let largest = points.iter().map(|p| p.abs().max_element());
    largest.fold(0.0, f32::max).into()
}
