use core::f32::consts::{PI, TAU};

use lights::math::Aabb;

use crate::QuadricKind;
use crate::glam::{Vec2, Vec3};

/// The part of a quadric that is there, by the texture coordinates of the whole. Those of the part
/// run from 0 to 1 over it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct QuadricPart {
    /// Where u ends, in `(0, 1]`: the share of a full turn around +z, from +x toward +y.
    pub turn: f32,
    /// The first and the last v, from 0 to 1, the first below the last.
    pub v: [f32; 2],
}

impl QuadricPart {
    /// Whether the point of the whole with the texture coordinates `uv` is there.
    #[inline]
    #[must_use]
    pub fn contains(&self, uv: Vec2) -> bool {
        uv.x <= self.turn && (self.v[0]..=self.v[1]).contains(&uv.y)
    }

    /// The texture coordinates on the part, in `[0, 1]`, of the point of the whole that has `uv`.
    #[inline]
    #[must_use]
    pub fn uv(&self, uv: Vec2) -> Vec2 {
        let [first, last] = self.v;
        let part = Vec2::new(uv.x / self.turn, (uv.y - first) / (last - first));
        part.clamp(Vec2::ZERO, Vec2::ONE)
    }

    /// The texture coordinates on the whole of the point of the part that has `uv`.
    pub(crate) fn of_whole(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let [first, last] = self.v;
        [u * self.turn, first + (last - first) * v]
    }

    /// Its share of the area of `kind`.
    pub(crate) fn area_share(&self, kind: QuadricKind) -> f32 {
        let [first, last] = self.v;
        let across = match kind {
            // A zone has the area of the cylinder around it.
            QuadricKind::Sphere => 0.5 * ((PI * first).cos() - (PI * last).cos()),
            QuadricKind::Disk { inner_radius } => {
                let r_sq = |v: f32| (1.0 + (inner_radius - 1.0) * v).powi(2);
                (r_sq(first) - r_sq(last)) / (1.0 - inner_radius * inner_radius)
            }
            QuadricKind::Cylinder { .. } => last - first,
        };
        across * self.turn
    }

    /// A box around it, in the space of `kind`.
    pub(crate) fn bounds(&self, kind: QuadricKind) -> Aabb {
        let [low, high] = match kind {
            QuadricKind::Sphere => self.v.map(|v| -(PI * v).cos()),
            QuadricKind::Disk { .. } => [0.0; 2],
            QuadricKind::Cylinder { length } => self.v.map(|v| length * (v - 0.5)),
        };
        // The corners of the sector: its centre, its ends, and where it crosses an axis.
        let quarters = [0.0, 0.25, 0.5, 0.75];
        let turns = quarters.into_iter().filter(|turn| *turn <= self.turn);
        let around = turns.chain([self.turn]).map(|turn| {
            let (sin, cos) = (turn * TAU).sin_cos();
            Vec3::new(cos, sin, low)
        });
        let sector = Aabb::from_points(around).extend(Vec3::Z * low);
        sector.extend(Vec3::new(sector.min.x, sector.min.y, high))
    }
}

#[cfg(test)]
mod tests {
    use crate::glam::Affine3A;
    use crate::{MaterialId, Quadric};

    use super::*;

    const KINDS: [QuadricKind; 3] = [
        QuadricKind::Sphere,
        QuadricKind::Disk { inner_radius: 0.25 },
        QuadricKind::Cylinder { length: 3.0 },
    ];

    const PARTS: [QuadricPart; 3] = [
        QuadricPart {
            turn: 0.3,
            v: [0.0, 1.0],
        },
        QuadricPart {
            turn: 1.0,
            v: [0.2, 0.7],
        },
        QuadricPart {
            turn: 0.8,
            v: [0.4, 1.0],
        },
    ];

    #[test]
    fn area_and_box_are_those_of_its_triangles() {
        let turn = Affine3A::from_axis_angle(Vec3::new(1.0, 2.0, 2.0) / 3.0, 0.8);
        let transform = Affine3A::from_translation(Vec3::X) * turn;
        for kind in KINDS {
            for part in PARTS {
                let quadric = Quadric {
                    part: Some(part),
                    ..Quadric::new("part", MaterialId(0), kind, transform)
                };
                let mesh = quadric.mesh(512);
                let share = mesh.area() / quadric.area();
                assert!((share - 1.0).abs() < 1e-3, "{kind:?}, {part:?}: {share}");
                let upright = Quadric {
                    transform: Affine3A::IDENTITY,
                    ..quadric.clone()
                };
                for quadric in [quadric, upright] {
                    let grown = Vec3::splat(1e-5);
                    let bounds = quadric.bounds();
                    let bounds = Aabb::new(bounds.min - grown, bounds.max + grown);
                    let mesh = quadric.mesh(512).bounds();
                    assert!(bounds.contains_box(&mesh), "{kind:?}: {bounds:?}, {mesh:?}");
                }
            }
        }
    }

    #[test]
    fn its_box_is_smaller_than_that_of_the_whole() {
        let [quarter, zone, _] = PARTS;
        let bounds = quarter.bounds(QuadricKind::Sphere);
        assert!(
            bounds.min.y.abs() < 1e-6 && bounds.max.z > 0.999,
            "{bounds:?}"
        );
        assert!(bounds.min.x > -0.31, "little beyond a quarter: {bounds:?}");
        let bounds = zone.bounds(QuadricKind::Sphere);
        assert!((bounds.max.z + (0.7 * PI).cos()).abs() < 1e-6, "{bounds:?}");
    }

    #[test]
    fn coordinates_run_over_the_part() {
        for part in PARTS {
            for uv in [[0.0, 0.0], [0.25, 0.5], [1.0, 1.0]] {
                let whole = Vec2::from_array(part.of_whole(uv));
                assert!(part.contains(whole), "{part:?}: {whole}");
                let again = part.uv(whole);
                assert!(again.distance(uv.into()) < 1e-6, "{part:?}: {again}");
            }
        }
        assert!(!PARTS[0].contains(Vec2::new(0.31, 0.5)), "beyond its turn");
        assert!(!PARTS[1].contains(Vec2::new(0.5, 0.1)), "below");
        assert!(!PARTS[1].contains(Vec2::new(0.5, 0.8)), "above");
    }
}
