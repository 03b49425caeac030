use core::f32::consts::{PI, TAU};
use core::str::FromStr;

use glam::Vec3;
use light_math::float;

use crate::bench_set::{BenchSet, POINTS};
use crate::families::Family;
use crate::random::{Random, repeat};
use crate::set_light::SetLight;
use crate::set_point::SetPoint;

/// The number of lights of a mixed set with a thousand times the power of the rest.
const STRONG: usize = 8;

/// The kind of a generated set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SetKind {
    /// Small triangles all over the unit cube, over three decades of power.
    Uniform,
    /// A city by night: lamps that face down and windows that face out, in clusters on a plane of
    /// 10 by 10.
    Clusters,
    /// Spot lights that point roughly down, one in five a point light, over a floor of 10 by 10.
    Spots,
    /// A quarter each of one-sided triangles, two-sided triangles, points and spots of 5 to 70
    /// degrees, over a floor of 10 by 10; eight of them a thousand times as strong.
    Mixed,
    /// Points and spots at one position.
    OnePoint,
    /// Points and spots along one line.
    Line,
    /// Clusters of triangles within clusters, each an eighth as wide, over 24 scales.
    Nested,
    /// Triangles of 2 cm in towns of a world of 10 km.
    LargeWorld,
    /// Points with coordinates from 1e-20 to 1e18.
    Magnitudes,
    /// Lamps in two places that are 10 to 100 times as far from each other as they are wide.
    TwinPlaces,
    /// Lamps in one place, and a point 1,000 times as far away that gives as much as all of them.
    FarLamp,
    /// A place of the given family.
    Place(Family),
}

impl SetKind {
    /// The kinds that are no places, in the order of the tables: four that are like scenes, and
    /// seven that are adversarial.
    const PLAIN: [Self; 11] = [
        Self::Uniform,
        Self::Clusters,
        Self::Spots,
        Self::Mixed,
        Self::OnePoint,
        Self::Line,
        Self::Nested,
        Self::LargeWorld,
        Self::Magnitudes,
        Self::TwinPlaces,
        Self::FarLamp,
    ];

    /// The kind's name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Clusters => "clusters",
            Self::Spots => "spots",
            Self::Mixed => "mixed",
            Self::OnePoint => "one-point",
            Self::Line => "line",
            Self::Nested => "nested",
            Self::LargeWorld => "large-world",
            Self::Magnitudes => "magnitudes",
            Self::TwinPlaces => "twin-places",
            Self::FarLamp => "far-lamp",
            Self::Place(family) => family.name(),
        }
    }

    /// All kinds: the plain ones, and the families.
    pub fn all() -> impl Iterator<Item = Self> {
        let families = Family::ALL.into_iter().map(Self::Place);
        Self::PLAIN.into_iter().chain(families)
    }

    /// Tells kinds apart in seeds.
    const fn number(self) -> u64 {
        match self {
            Self::Uniform => 0,
            Self::Clusters => 1,
            Self::Spots => 2,
            Self::Mixed => 3,
            Self::OnePoint => 4,
            Self::Line => 5,
            Self::Nested => 6,
            Self::LargeWorld => 7,
            Self::Magnitudes => 8,
            Self::TwinPlaces => 9,
            Self::FarLamp => 10,
            Self::Place(family) => 16 + family as u64,
        }
    }
}

impl FromStr for SetKind {
    type Err = String;

    fn from_str(s: &str) -> Result<Self, Self::Err> {
        Self::all().find(|kind| kind.name() == s).ok_or_else(|| {
            let plain = Self::PLAIN.map(Self::name).join(", ");
            let places = Family::ALL.map(Family::name).join(", ");
            format!("expected {plain}, or a place: {places}")
        })
    }
}

impl BenchSet {
    /// Generates the set of `kind` with `n` lights and 4096 points; a function of its arguments.
    #[must_use]
    pub fn generate(kind: SetKind, n: usize, seed: u64) -> Self {
        let mut random = Random::new(seed ^ kind.number() << 56 ^ (n as u64) << 24);
        let r = &mut random;
        match kind {
            SetKind::Uniform => Self {
                lights: uniform_lights(r, n),
                points: repeat(POINTS, || SetPoint {
                    p: r.cube(),
                    n: r.direction(),
                }),
            },
            SetKind::Clusters => Self {
                lights: cluster_lights(r, n),
                points: repeat(POINTS, || {
                    if r.unit() < 0.75 {
                        r.on_floor()
                    } else {
                        SetPoint {
                            p: r.over_floor(0.0, 3.0),
                            n: r.direction(),
                        }
                    }
                }),
            },
            SetKind::Spots => Self {
                lights: repeat(n, || {
                    if r.unit() < 0.8 {
                        r.spot(10.0, 45.0)
                    } else {
                        r.point_light()
                    }
                }),
                points: repeat(POINTS, || r.on_floor()),
            },
            SetKind::Mixed => Self {
                lights: mixed_lights(r, n),
                points: repeat(POINTS, || {
                    if r.unit() < 0.5 {
                        r.on_floor()
                    } else {
                        SetPoint {
                            p: r.over_floor(0.0, 3.0),
                            n: r.direction(),
                        }
                    }
                }),
            },
            SetKind::OnePoint => Self::one_point(r, n),
            SetKind::Line => Self::line(r, n),
            SetKind::Nested => Self::nested(r, n),
            SetKind::LargeWorld => Self::large_world(r, n),
            SetKind::Magnitudes => Self::magnitudes(r, n),
            SetKind::TwinPlaces => Self::twin_places(r, n),
            SetKind::FarLamp => Self::far_lamp(r, n),
            SetKind::Place(family) => family.generate(r, n),
        }
    }
}

fn uniform_lights(r: &mut Random, n: usize) -> Vec<SetLight> {
    let size = 0.3 * float::powf(n as f32, -1.0 / 3.0);
    repeat(n, || {
        let power = r.log_uniform(3.0);
        let (center, normal) = (r.cube(), r.direction());
        r.triangle(center, normal, size, power, false)
    })
}

fn cluster_lights(r: &mut Random, n: usize) -> Vec<SetLight> {
    struct Cluster {
        center: Vec3,
        radius: f32,
        power: f32,
        lamp: bool,
    }
    let count = (n.isqrt() / 2).max(1);
    let mut lamp = false;
    let clusters = repeat(count, || {
        lamp = !lamp;
        Cluster {
            center: r.over_floor(if lamp { 1.5 } else { 0.2 }, if lamp { 3.0 } else { 2.0 }),
            radius: 0.1 + 0.3 * r.unit(),
            power: r.log_uniform(1.0),
            lamp,
        }
    });
    // The spacing of the lights of a cluster is about their size.
    let size = 0.3 / float::sqrt((n / count).max(1) as f32);
    let mut next = 0;
    repeat(n, || {
        let cluster = &clusters[next % count];
        next += 1;
        let power = cluster.power * r.log_uniform(2.0);
        let (s, c) = float::sin_cos(TAU * r.unit());
        let around = Vec3::new(c, s, 0.0);
        let (center, normal) = if cluster.lamp {
            let spread = cluster.radius * float::sqrt(r.unit());
            let tilt = r.direction() * 0.2;
            let height = 0.05 * r.unit();
            (
                cluster.center + around * spread + Vec3::Z * height,
                (Vec3::NEG_Z + tilt).normalize(),
            )
        } else {
            let height = cluster.center.z * (2.0 * r.unit() - 1.0);
            (
                cluster.center + around * cluster.radius + Vec3::Z * height,
                around,
            )
        };
        let two_sided = r.unit() < 0.05;
        r.triangle(center, normal, size * cluster.radius, power, two_sided)
    })
}

fn mixed_lights(r: &mut Random, n: usize) -> Vec<SetLight> {
    let size = 0.5 * float::powf(300.0 / n as f32, 1.0 / 3.0);
    let mut index = 0;
    repeat(n, || {
        let kind = index % 4;
        let strong = if index < STRONG { 1000.0 } else { 1.0 };
        index += 1;
        let light = match kind {
            2 => r.point_light(),
            3 => r.spot(5.0, 70.0),
            _ => {
                let power = 4.0 * PI * r.log_uniform(2.0);
                let (center, normal) = (r.over_floor(0.5, 3.0), r.direction());
                r.triangle(center, normal, 0.3 * size, power, kind == 1)
            }
        };
        scaled(light, strong)
    })
}

fn scaled(light: SetLight, factor: f32) -> SetLight {
    let mut light = light;
    match &mut light {
        SetLight::Triangle { radiance, .. } => *radiance *= factor,
        SetLight::Point { intensity, .. } | SetLight::Spot { intensity, .. } => {
            *intensity *= factor;
        }
    }
    light
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn same_seed_same_set() {
        for kind in SetKind::all() {
            let set = BenchSet::generate(kind, 100, 7);
            assert_eq!(
                set,
                BenchSet::generate(kind, 100, 7),
                "{} is determined",
                kind.name()
            );
            assert_ne!(
                set,
                BenchSet::generate(kind, 100, 8),
                "{} depends on the seed",
                kind.name()
            );
            assert_eq!(set.lights.len(), 100, "as many as asked for");
            assert_eq!(set.points.len(), POINTS, "points");
            assert_eq!(kind.name().parse(), Ok(kind), "name");
        }
    }

    #[test]
    fn all_lights_emit_however_small_they_are() {
        for kind in SetKind::all() {
            let set = BenchSet::generate(kind, 300, 3);
            for bounds in set.lights.iter().map(SetLight::bounds) {
                assert_eq!(bounds.validate(), Ok(()), "{}", kind.name());
                assert!(bounds.phi > 0.0, "{}: {bounds:?}", kind.name());
            }
        }
    }
}
