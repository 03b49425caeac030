use alloc::vec::Vec;
use core::fmt;

use light_sources::glam::{Vec2, Vec3};
use light_sources::light_bounds::{LightId, LightSampleContext};
use light_sources::shape::AnyShape;
use light_sources::{
    DiffuseEmission, InfiniteLight, Light, LightRef, LightSet, PdfCoverage, PointSource, Rgb, Sides,
};

/// Rows of a light.
const ROWS: usize = 4;

/// What stands in the last word of a light's first row.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Point = 1,
    Spot,
    Distant,
    Uniform,
    Triangle,
    Rectangle,
    Sphere,
}

/// The kinds of lights and sides, by the names that shaders know them by.
pub(crate) const KINDS: [(&str, u32); 9] = [
    ("KIND_POINT", Kind::Point as u32),
    ("KIND_SPOT", Kind::Spot as u32),
    ("KIND_DISTANT", Kind::Distant as u32),
    ("KIND_UNIFORM", Kind::Uniform as u32),
    ("KIND_TRIANGLE", Kind::Triangle as u32),
    ("KIND_RECTANGLE", Kind::Rectangle as u32),
    ("KIND_SPHERE", Kind::Sphere as u32),
    ("SIDES_FRONT", FRONT),
    ("SIDES_BACK", BACK),
];

const FRONT: u32 = 1;
const BACK: u32 = 2;
const BOTH: u32 = 3;

/// Rows of the lights of a set: a head, and four rows a light in the order of ids.
///
/// In a buffer from row `first` on they are what `light_set(first)` reads. The head holds the
/// number of lights and the radius of the scene. A light takes 64 bytes: place and kind, what it
/// emits, and two rows of its shape.
///
/// # Errors
/// [`UnsupportedLight`] for the first light that shaders do not sample.
///
/// # Panics
/// If there are more than 2^30 lights, whose rows a shader cannot count.
pub fn light_set_rows(lights: &LightSet<Rgb>) -> Result<Vec<[u32; 4]>, UnsupportedLight> {
    let count = u32::try_from(lights.len()).ok().filter(|&n| n < 1 << 30);
    let count = count.expect("fewer than 2^32 rows");
    let mut rows = Vec::with_capacity(1 + ROWS * lights.len());
    rows.push([count, lights.scene().radius().to_bits(), 0, 0]);
    for (id, light) in lights.iter() {
        rows.extend(record(&light).ok_or(UnsupportedLight(id))?);
    }
    Ok(rows)
}

/// A light of a set that shaders do not sample: with an image or an alpha mask, by a photometric
/// web, of another shape, a sun, behind a portal, or of a type of your own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnsupportedLight(pub LightId);

impl fmt::Display for UnsupportedLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "light {} is of a kind that shaders do not sample",
            self.0.0
        )
    }
}

impl core::error::Error for UnsupportedLight {}

fn record(light: &LightRef<'_, Rgb>) -> Option<[[u32; 4]; ROWS]> {
    Some(match light {
        LightRef::Point(point) => {
            let intensity = point.intensity(Vec3::Z, &());
            rows(Kind::Point, 0, point.position(), intensity, [0.0; 9])
        }
        LightRef::Spot(spot) => {
            let axis = spot.transform().axis();
            let [start, end] = spot.one_minus_cosines();
            let more = [start, axis.x, axis.y, axis.z, end, 0.0, 0.0, 0.0, 0.0];
            let intensity = spot.intensity(axis, &());
            rows(Kind::Spot, 0, spot.position(), intensity, more)
        }
        LightRef::Distant(distant) => {
            let ctx = LightSampleContext::medium(Vec3::ZERO);
            let sample = distant.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete)?;
            rows(Kind::Distant, 0, sample.wi, sample.l, [0.0; 9])
        }
        LightRef::UniformInfinite(sky) => {
            let radiance = sky.le(Vec3::ZERO, Vec3::Z, &());
            rows(Kind::Uniform, 0, Vec3::ZERO, radiance, [0.0; 9])
        }
        LightRef::Triangle(light) => triangle(light.emission(), light.shape().vertices())?,
        LightRef::Area(light) => match light.shape() {
            AnyShape::Triangle(shape) => triangle(light.emission(), shape.vertices())?,
            AnyShape::Rectangle(shape) => {
                let [x, y] = shape.edges();
                let more = [0.0, x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0];
                area(Kind::Rectangle, light.emission(), shape.corner(), more)?
            }
            AnyShape::Sphere(shape) => {
                let axes = [Vec3::X, Vec3::Y, Vec3::Z].map(|v| shape.transform().vector(v));
                let [x, y, z] = axes;
                let hand = z.cross(x).dot(y).signum();
                let more = [shape.radius(), x.x, x.y, x.z, hand, z.x, z.y, z.z, 0.0];
                area(Kind::Sphere, light.emission(), shape.center(), more)?
            }
            _ => return None,
        },
        _ => return None,
    })
}

fn triangle(emission: &DiffuseEmission<Rgb>, [a, b, c]: [Vec3; 3]) -> Option<[[u32; 4]; ROWS]> {
    let more = [0.0, b.x, b.y, b.z, 0.0, c.x, c.y, c.z, 0.0];
    area(Kind::Triangle, emission, a, more)
}

fn area(
    kind: Kind,
    emission: &DiffuseEmission<Rgb>,
    place: Vec3,
    more: [f32; 9],
) -> Option<[[u32; 4]; ROWS]> {
    let sides = match emission.sides() {
        Sides::Front => FRONT,
        Sides::Back => BACK,
        Sides::Both => BOTH,
    };
    let radiance = emission.uniform_radiance(&())?;
    Some(rows(kind, sides, place, radiance, more))
}

/// The rows of a light: its place and kind, what it emits, and nine numbers more.
fn rows(kind: Kind, sides: u32, place: Vec3, l: Vec3, more: [f32; 9]) -> [[u32; 4]; ROWS] {
    let [a, b, c, d, e, f, g, h, i] = more.map(f32::to_bits);
    let [x, y, z] = place.to_array().map(f32::to_bits);
    let [red, green, blue] = l.to_array().map(f32::to_bits);
    [
        [x, y, z, kind as u32 | sides << 8],
        [red, green, blue, a],
        [b, c, d, e],
        [f, g, h, i],
    ]
}
