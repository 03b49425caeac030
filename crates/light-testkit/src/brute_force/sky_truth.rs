use core::f64::consts::{FRAC_PI_2, PI, TAU};

use light_math::glam::{DVec2, DVec3};

use super::arrival::{Arriving, BACKWARD_ERROR};
use super::model::Values;
use super::receiver::Receiver;
use super::sphere_maps::{equal_area_direction, lat_long_direction};
use super::stratified::Stratified;
use super::surface::RigidFrame;
use crate::Rng;

/// A light at infinity, in double precision.
pub(super) struct SkyTruth {
    pub(super) sky: Sky,
    /// The centre and the radius of the scene.
    pub(super) scene: (DVec3, f64),
    pub(super) coordinates: f64,
}

/// Radiance by direction toward the light.
pub(super) enum Sky {
    /// All from one direction, of this irradiance.
    Distant(DVec3, Values),
    /// An axis, half the angle of the disk, and its radiance.
    Sun(DVec3, f64, Values),
    Uniform(Values),
    /// The map in light space.
    Image(RigidFrame, Map, Texels),
    Portal(Window, Texels),
}

/// How a picture lies around the sphere.
#[derive(Clone, Copy)]
pub(super) enum Map {
    EqualArea,
    LatLong,
}

/// The radiance of each texel, row by row.
pub(super) struct Texels {
    pub(super) size: [u32; 2],
    pub(super) values: Vec<Values>,
}

/// A rectangle through which light comes from the side of `z`.
pub(super) struct Window {
    pub(super) corner: DVec3,
    /// Edges from the corner.
    pub(super) edges: [DVec3; 2],
    /// Unit vectors.
    pub(super) axes: [DVec3; 3],
}

/// A direction toward the light, its solid angle if all of a cell were like it, and the radiance.
pub(super) struct Part {
    pub(super) w: DVec3,
    pub(super) solid_angle: f64,
    pub(super) l: Values,
}

impl Texels {
    fn at(&self, p: DVec2) -> Values {
        let [x, y] = [0, 1].map(|i| {
            let n = self.size[i];
            ((p[i] * f64::from(n)) as u32).min(n - 1)
        });
        self.values[(y * self.size[0] + x) as usize]
    }
}

impl Window {
    /// Radiance by direction, from the map of angles of the portal.
    fn l(&self, texels: &Texels, w: DVec3) -> Values {
        let [x, y, z] = self.axes.map(|axis| axis.dot(w));
        let angle = |along: f64| (along.atan2(z) + FRAC_PI_2) / PI;
        texels.at(DVec2::new(angle(x), angle(y)))
    }

    /// The part of the half space at a point of the square of angles.
    fn part(&self, texels: &Texels, at: DVec2) -> Part {
        let tan = ((at - 0.5) * PI).map(f64::tan);
        let w = (self.axes[0] * tan.x + self.axes[1] * tan.y + self.axes[2]).normalize();
        let square = 1.0 + tan.length_squared();
        let solid_angle =
            PI * PI * (1.0 + tan.x * tan.x) * (1.0 + tan.y * tan.y) / (square * square.sqrt());
        Part {
            w,
            solid_angle,
            l: texels.at(at),
        }
    }
}

impl SkyTruth {
    /// The part of the sky at a point of the unit square, seen from `p` or in all.
    pub(super) fn part(&self, at: [f64; 2], p: Option<DVec3>) -> Option<Part> {
        let [x, y] = at;
        let at = DVec2::from(at);
        Some(match &self.sky {
            Sky::Distant(w, l) => Part {
                w: *w,
                solid_angle: 1.0,
                l: *l,
            },
            Sky::Sun(axis, half, l) => {
                let most = 2.0 * (0.5 * half).sin().powi(2);
                let from_axis = most * x;
                let sin = (from_axis * (2.0 - from_axis)).sqrt();
                let (across, other) = axis.any_orthonormal_pair();
                let around = across * (TAU * y).cos() + other * (TAU * y).sin();
                Part {
                    w: *axis * (1.0 - from_axis) + around * sin,
                    solid_angle: TAU * most,
                    l: *l,
                }
            }
            Sky::Uniform(l) => Part {
                w: equal_area_direction(at),
                solid_angle: 4.0 * PI,
                l: *l,
            },
            Sky::Image(frame, map, texels) => {
                let (w, solid_angle) = match map {
                    Map::EqualArea => (equal_area_direction(at), 4.0 * PI),
                    Map::LatLong => lat_long_direction(at),
                };
                Part {
                    w: frame.vector(w),
                    solid_angle,
                    l: texels.at(at),
                }
            }
            Sky::Portal(window, texels) => {
                let Some(p) = p else {
                    return Some(window.part(texels, at));
                };
                let to = window.corner + window.edges[0] * x + window.edges[1] * y - p;
                let w = to.normalize();
                let cos_theta = window.axes[2].dot(w);
                let area = window.edges[0].cross(window.edges[1]).length();
                if !(cos_theta > 0.0) {
                    return None;
                }
                Part {
                    w,
                    solid_angle: area * cos_theta / to.length_squared(),
                    l: window.l(texels, w),
                }
            }
        })
    }

    /// Rows of cells, about `side`, so many that no cell crosses the edge of a texel.
    pub(super) fn side(&self, side: u32) -> u32 {
        match &self.sky {
            Sky::Image(_, _, texels) => {
                let rows = texels.size[0] * texels.size[1];
                rows * side.div_ceil(rows)
            }
            Sky::Portal(_, texels) => texels.size[0] * side.div_ceil(texels.size[0]),
            _ => side,
        }
    }

    /// What enters the scene: the power, then the integrals of direction and of the origin of rays
    /// from the scene's centre.
    pub(super) fn leaving(&self, side: u32, rng: &mut Rng) -> Stratified<10> {
        let (center, radius) = self.scene;
        Stratified::over_square(self.side(side), rng, |at, rng| {
            let Some(Part { w, solid_angle, l }) = self.part(at, None) else {
                return [0.0; 10];
            };
            let (area, origin) = match &self.sky {
                // Rays start beyond the portal, so far that they are outside of the scene.
                Sky::Portal(window, _) => {
                    let [x, y] = window.edges;
                    let on = window.corner + x * rng.f64() + y * rng.f64();
                    let away = radius + on.distance(center);
                    let area = x.cross(y).length() * window.axes[2].dot(w);
                    (area, on + w * away - center)
                }
                _ => (PI * radius * radius, w * radius),
            };
            let power = l.map(|l| l * solid_angle * area);
            let [[a, b, c], [d, e, f]] = [-w * power[3], origin * power[3]].map(|v| v.to_array());
            let [r, s, t, u] = power;
            [r, s, t, u, a, b, c, d, e, f]
        })
    }
}

impl Arriving for SkyTruth {
    fn arriving(&self, receiver: &Receiver, detail: u32, rng: &mut Rng) -> Stratified<4> {
        let side = match self.sky {
            Sky::Distant(..) => 1,
            // The portal has edges of texels that move with the receiver.
            Sky::Portal(..) => 64 * detail,
            _ => self.side(48 * detail.isqrt()),
        };
        Stratified::over_square(side, rng, |at, _| {
            self.part(at, Some(receiver.p)).map_or([0.0; 4], |part| {
                let weight = receiver.weight(part.w) * part.solid_angle;
                part.l.map(|l| l * weight)
            })
        })
    }

    fn share_of_edges(&self, receiver: &Receiver, _: &mut Rng) -> f64 {
        match &self.sky {
            Sky::Portal(window, _) => {
                let size = receiver.p.length().max(self.coordinates);
                let shortest = window.edges[0].length().min(window.edges[1].length());
                // Seen from its edge the portal is as much narrower.
                let middle = window.corner + (window.edges[0] + window.edges[1]) * 0.5;
                let cos_theta = window.axes[2].dot((middle - receiver.p).normalize());
                16.0 * BACKWARD_ERROR * size / (shortest * cos_theta.abs())
            }
            _ => 0.0,
        }
    }

    /// Only texels behind a portal can be missed by all cells.
    fn most(&self, _: &Receiver, _: &mut Rng) -> f64 {
        match &self.sky {
            Sky::Portal(_, texels) => {
                let values = texels.values.iter().flatten();
                TAU * values.copied().fold(0.0, f64::max)
            }
            _ => 0.0,
        }
    }

    fn coordinates(&self) -> f64 {
        self.coordinates
    }
}
