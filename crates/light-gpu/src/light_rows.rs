use alloc::vec::Vec;
use core::fmt;

use light_sources::glam::{Vec2, Vec3};
use light_sources::light_bounds::{LightId, LightSampleContext};
use light_sources::light_math::SphereMap;
use light_sources::shape::AnyShape;
use light_sources::{
    DiffuseEmission, ImageInfiniteLight, InfiniteLight, Light, LightRef, LightSet, PdfCoverage,
    PointSource, Rgb, Sides,
};

use crate::rows::push_words;

/// Rows of a light.
const ROWS: usize = 4;

/// What is in the last word of a light's first row.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Point = 1,
    Spot,
    Distant,
    Uniform,
    Triangle,
    Rectangle,
    Sphere,
    LatLong,
    EqualArea,
}

/// The kinds of lights and sides, by the names that shaders know them by.
pub(crate) const KINDS: [(&str, u32); 11] = [
    ("KIND_POINT", Kind::Point as u32),
    ("KIND_SPOT", Kind::Spot as u32),
    ("KIND_DISTANT", Kind::Distant as u32),
    ("KIND_UNIFORM", Kind::Uniform as u32),
    ("KIND_TRIANGLE", Kind::Triangle as u32),
    ("KIND_RECTANGLE", Kind::Rectangle as u32),
    ("KIND_SPHERE", Kind::Sphere as u32),
    ("KIND_LAT_LONG", Kind::LatLong as u32),
    ("KIND_EQUAL_AREA", Kind::EqualArea as u32),
    ("SIDES_FRONT", FRONT),
    ("SIDES_BACK", BACK),
];

const FRONT: u32 = 1;
const BACK: u32 = 2;
const BOTH: u32 = 3;

/// Rows of the lights of a set: a head, four rows a light in the order of ids, and the tables of
/// environment maps.
///
/// In a buffer from row `first` on they are what `light_set(first)` reads. The head holds the
/// number of lights and the radius of the scene. A light takes 64 bytes: place and kind, what it
/// emits, and two rows of its shape. An environment map takes 20 bytes a texel besides, also where
/// lights share a picture.
///
/// # Errors
/// [`UnsupportedLight`] for the first light that shaders do not sample.
///
/// # Panics
/// If there are more than 2^32 rows, which a shader cannot count.
pub fn light_set_rows(lights: &LightSet<Rgb>) -> Result<Vec<[u32; 4]>, UnsupportedLight> {
    let count = u32::try_from(lights.len()).ok().filter(|&n| n < 1 << 30);
    let count = count.expect("fewer than 2^32 rows");
    let mut rows = Vec::with_capacity(1 + ROWS * lights.len());
    rows.push([count, lights.scene().radius().to_bits(), 0, 0]);
    let mut tables = Vec::new();
    for (id, light) in lights.iter() {
        if let LightRef::ImageInfinite(sky) = light {
            let first = 1 + ROWS * lights.len() + tables.len();
            let first = u32::try_from(first).expect("fewer than 2^32 rows");
            rows.extend(environment(sky, first, &mut tables));
        } else {
            rows.extend(record(&light).ok_or(UnsupportedLight(id))?);
        }
    }
    rows.extend(tables);
    Ok(rows)
}

/// A light of a set that shaders do not sample: a surface with an image or an alpha mask, a
/// projector, a photometric web, another shape, a sun, a portal, or a light of a type of your own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnsupportedLight(pub LightId);

impl fmt::Display for UnsupportedLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "light {}: expected a kind that shaders sample: a point or spot light, a distant, uniform \
             or image light, or a triangle, rectangle or sphere without image or mask",
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

/// The rows of an environment map, whose table goes into `tables`: of the set it begins in row
/// `first`.
fn environment(
    sky: &ImageInfiniteLight<Rgb>,
    first: u32,
    tables: &mut Vec<[u32; 4]>,
) -> [[u32; 4]; ROWS] {
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| sky.transform().vector(axis));
    let table = sky.table(PdfCoverage::Complete);
    let kind = match table.as_ref().map(|table| table.map) {
        Some(SphereMap::EqualArea) => Kind::EqualArea,
        // A black picture has no table, and no texels.
        Some(SphereMap::LatLong) | None => Kind::LatLong,
    };
    let [width, height] = table.as_ref().map_or([0; 2], |table| table.size);
    if let Some(table) = &table {
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        tables.extend(texels.zip(&table.densities).map(|(texel, density)| {
            let radiance = sky.texel_radiance(texel, &());
            radiance.extend(*density).to_array().map(f32::to_bits)
        }));
        for numbers in [&table.columns, &table.rows, &table.caps] {
            push_words(tables, bytemuck::cast_slice(numbers));
        }
    }
    let [head, l, mut b, _] = rows(kind, 0, x, y, [0.0; 9]);
    b[..3].copy_from_slice(&z.to_array().map(f32::to_bits));
    [head, l, b, [first, width, height, 0]]
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
