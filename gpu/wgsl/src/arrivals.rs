//! What arrives from lights of each kind, against light-sources.

use light_gpu::light_set_rows;
use light_math::glam::{Affine3A, Quat, Vec3};
use light_sources::shape::ShapeDesc;
use light_sources::{
    AreaLightDesc, Channels, DiffuseEmissionDesc, DistantLightDesc, EnvironmentMap, Image,
    ImageInfiniteLightDesc, IntensityAmount, IrradianceAmount, Light, LightDesc, LightDescError,
    LightSet, LightSetBuilder, MediumInterface, MeshLightDesc, PdfCoverage, PointLightDesc,
    RadianceAmount, Rgb, SceneSphere, Sides, SpotLightDesc, SurfaceColor, UniformInfiniteLightDesc,
};

use crate::device::Device;
use crate::query::{Arrived, Query, Random};

/// The kinds of lights.
const KINDS: [&str; 10] = [
    "point",
    "spot",
    "distant",
    "uniform",
    "triangle",
    "mesh",
    "rectangle",
    "sphere",
    "lat-long picture",
    "equal-area picture",
];

/// Lights of each kind.
const LIGHTS: u32 = 1000;

/// How far radiance, density and direction may be off, as a part of themselves.
const ERROR: f32 = 1e-4;

/// The cosine below which a sample of a flat light has the density that a query has for its
/// direction: nearly `GRAZING` of light-sources.
const LOW: f32 = 0.999e-3;

/// The share of the queries of a kind that may be off by more, and that of those that only one side
/// answers.
const OFF: f64 = 1e-3;

/// What differs between the answers about the lights of a kind.
#[derive(Clone, Copy, Debug, Default)]
struct Kind {
    queries: u32,
    /// Samples of which one side has none.
    unlike: u32,
    /// Samples of which density, radiance, direction or place are off by more than [`ERROR`].
    off: u32,
    /// Densities of a sample's direction that are off by more, or 0 on one side alone.
    pdf_off: u32,
    /// Those of a direction that has nothing to do with the light.
    other_off: u32,
    /// Radiance along a ray that leaves the scene, off by more, or 0 on one side alone.
    le_off: u32,
    /// Samples whose density the shader does not find again by their direction: of a picture, bit
    /// for bit, which rounding moved into another texel; of a flat light, seen at a low angle.
    unequal: u32,
    /// The largest differences of a density and of a direction among the samples.
    largest: [f32; 2],
}

/// Prints a row a kind; whether all of them keep what is promised.
///
/// # Errors
/// One line by the driver, or by a light.
pub fn check(device: &Device, count: u32) -> Result<bool, String> {
    let head = "\
| lights | alike within 1e-4 | largest density, direction | one side alone | pdf_li off | \
of any direction, le | not found again |
| --- | ---: | ---: | ---: | ---: | ---: | ---: |";
    println!("\n{head}");
    let mut all = true;
    for kind in KINDS {
        let lights = lights(kind).map_err(|e| e.to_string())?;
        let rows = light_set_rows(&lights).map_err(|e| e.to_string())?;
        let queries: Vec<Query> = (0..count).map(|i| query(kind, &lights, i)).collect();
        let (answers, _) = device.run::<Arrived>(("arrive", 4), &rows, &queries)?;
        let mut tally = Kind::default();
        for (query, theirs) in queries.iter().zip(&answers) {
            // At the edge of a texel rounding decides which of two a direction is in.
            if kind.ends_with("picture") && query.is_at_end() {
                tally.queries += 1;
            } else {
                tally.add(&lights, query, theirs, is_flat(kind));
            }
            let is_equal = if kind.ends_with("picture") {
                theirs.again.to_bits() == theirs.pdf.to_bits()
            } else {
                let cos_theta = Vec3::from(theirs.wi).dot(theirs.n_light.into());
                !is_flat(kind) || cos_theta.abs() >= LOW || is_near(theirs.pdf, theirs.again, ERROR)
            };
            tally.unequal += u32::from(theirs.pdf > 0.0 && !is_equal);
        }
        println!("{}", tally.row(kind));
        all &= tally.holds();
    }
    Ok(all)
}

impl Kind {
    fn add(&mut self, lights: &LightSet<Rgb>, query: &Query, theirs: &Arrived, is_flat: bool) {
        self.queries += 1;
        let light = lights.get(query.other()).expect("a light");
        let ctx = &query.context();
        let complete = PdfCoverage::Complete;
        let toward = light.pdf_li(ctx, query.wo(), complete);
        self.other_off += u32::from(!is_near(toward, theirs.toward, ERROR));
        let le = light.le(ctx.p, query.wo(), &()).element_sum();
        self.le_off += u32::from(!is_near(le, theirs.le, ERROR));
        let ours = light.sample_li(ctx, query.place(), &(), complete);
        let Some(ours) = ours.filter(|_| theirs.pdf > 0.0) else {
            self.unlike += u32::from(ours.is_some() || theirs.pdf > 0.0);
            return;
        };
        let wi = Vec3::from(theirs.wi);
        // What rounding of the coordinates changes in the height over a flat light.
        let blur = if is_flat {
            let coordinates = ours.p_light.length() + ctx.p.length();
            4.0 * f32::EPSILON * coordinates / (ours.p_light - ctx.p).dot(ours.n_light).abs()
        } else {
            0.0
        };
        let pdf = ((theirs.pdf / ours.pdf - 1.0).abs() - blur).max(0.0);
        let turn = wi.distance(ours.wi);
        self.largest = [self.largest[0].max(pdf), self.largest[1].max(turn)];
        let l = Vec3::from(theirs.l).distance(ours.l) / ours.l.length();
        let way = (ours.p_light - ctx.p).length();
        let place = Vec3::from(theirs.p_light).distance(ours.p_light) / way.max(1.0);
        let n = Vec3::from(theirs.n_light).distance(ours.n_light);
        let is_off = !([pdf, l, turn, place].iter().all(|&error| error <= ERROR) && n <= 0.01);
        self.off += u32::from(is_off);
        let again = light.pdf_li(ctx, wi, complete);
        self.pdf_off += u32::from(!is_near(again, theirs.again, ERROR + blur));
    }

    fn holds(&self) -> bool {
        let few = |count: u32| f64::from(count) <= OFF * f64::from(self.queries);
        self.unequal == 0
            && few(self.unlike)
            && few(self.off)
            && few(self.pdf_off)
            && few(self.other_off)
            && few(self.le_off)
    }

    fn row(&self, kind: &str) -> String {
        let percent = |count: u32| 100.0 * f64::from(count) / f64::from(self.queries);
        let [pdf, turn] = self.largest;
        format!(
            "| {kind} | {:.4} % | {pdf:.1e}, {turn:.1e} | {:.4} % | {:.4} % | {:.4} %, {:.4} % | {} |",
            100.0 - percent(self.off),
            percent(self.unlike),
            percent(self.pdf_off),
            percent(self.other_off),
            percent(self.le_off),
            self.unequal,
        )
    }
}

/// Whether both are 0, or differ by at most the part `error` of the first.
fn is_near(ours: f32, theirs: f32, error: f32) -> bool {
    (ours > 0.0) == (theirs > 0.0) && (ours - theirs).abs() <= error * ours
}

/// Whether lights of a kind lie in a plane.
fn is_flat(kind: &str) -> bool {
    ["triangle", "mesh", "rectangle"].contains(&kind)
}

/// Query `i` about one of the lights of a kind, every eighth where rounding counts: nearly within
/// the plane of a flat light, or a sample at the edge of a texel.
fn query(kind: &str, lights: &LightSet<Rgb>, i: u32) -> Query {
    let query = Query::about((i / 5) % LIGHTS, i);
    if i % 8 != 0 {
        return query;
    }
    if kind.ends_with("picture") {
        return query.at_ends();
    }
    let bounds = lights.get(query.other()).and_then(|light| light.bounds());
    match bounds.filter(|_| is_flat(kind)) {
        Some(bounds) => query.near_plane(bounds.bounds.center(), bounds.w),
        None => query,
    }
}

/// Lights of a kind, of all sizes from 0.001 to 3, in a cube of the edge 4.
fn lights(kind: &str) -> Result<LightSet<Rgb>, LightDescError> {
    let scene = SceneSphere::new(Vec3::ZERO, 4.0).expect("a sphere");
    let mut lights = LightSetBuilder::<Rgb>::new(scene);
    let mut random = Random(7);
    for i in 0..LIGHTS {
        lights.add(light(kind, i, &mut || random.unit()))?;
    }
    Ok(lights.build())
}

/// A picture of very unlike texels, of which a third are black.
fn picture([width, height]: [u32; 2], unit: &mut impl FnMut() -> f32) -> Image {
    let mut texel = || {
        let brightness = (unit() * 1.5 - 0.5).max(0.0) * 1e4f32.powf(unit());
        [unit(), unit(), unit()].map(|channel| channel * brightness)
    };
    let texels: Vec<f32> = (0..width * height).flat_map(|_| texel()).collect();
    Image::from_f32([width, height], Channels::Rgb, texels).expect("finite texels")
}

fn light(kind: &str, i: u32, unit: &mut impl FnMut() -> f32) -> LightDesc<Rgb> {
    let mut vector = || Vec3::new(unit(), unit(), unit()) * 2.0 - 1.0;
    let (place, turn, color) = (2.0 * vector(), vector(), (vector() + 1.1) * 3.0);
    let [a, b] = [vector(), vector()];
    let size = 1e-3 * 3e3f32.powf(unit());
    let turn = Quat::from_scaled_axis(3.0 * turn);
    let sides = [Sides::Front, Sides::Back, Sides::Both][i as usize % 3];
    let emission = DiffuseEmissionDesc {
        sides,
        ..DiffuseEmissionDesc::new(
            SurfaceColor::Uniform(color),
            RadianceAmount::Radiometric(1.0),
        )
    };
    let corners = [place, place + size * a, place + size * b];
    let transform = Affine3A::from_rotation_translation(turn, place);
    let shape = match kind {
        "point" => {
            let amount = IntensityAmount::Radiometric(1.0);
            return PointLightDesc::new(place, color, amount).into();
        }
        "spot" => {
            let angle = 0.01 + 2.0 * unit();
            return SpotLightDesc {
                transform,
                angle,
                falloff_start: angle * unit(),
                emission: color,
                amount: IntensityAmount::Radiometric(1.0),
                media: MediumInterface::default(),
            }
            .into();
        }
        "distant" => {
            let amount = IrradianceAmount::Radiometric(1.0);
            return DistantLightDesc::new(a, color, amount).into();
        }
        "uniform" => {
            let amount = RadianceAmount::Radiometric(1.0);
            return UniformInfiniteLightDesc::new(color, amount).into();
        }
        "lat-long picture" | "equal-area picture" => {
            let map = if kind == "lat-long picture" {
                EnvironmentMap::LatLong(picture([1 + i % 37, 1 + i % 19], unit))
            } else {
                EnvironmentMap::EqualArea(picture([1 + i % 23; 2], unit))
            };
            // Of those that are not turned, directions along an axis are at an edge of the map.
            let turn = if i % 4 == 0 { Quat::IDENTITY } else { turn };
            return ImageInfiniteLightDesc {
                transform: Affine3A::from_quat(turn),
                map,
                amount: RadianceAmount::default(),
            }
            .into();
        }
        "mesh" => return MeshLightDesc::new(corners, vec![[0, 1, 2]], emission).into(),
        "triangle" => ShapeDesc::Triangle(corners),
        "rectangle" => {
            let edges = [
                turn * Vec3::X * size,
                turn * Vec3::Y * (size * (0.1 + unit())),
            ];
            ShapeDesc::Rectangle {
                corner: place,
                edges,
            }
        }
        _ => ShapeDesc::Sphere {
            transform,
            radius: 0.5 * size,
        },
    };
    AreaLightDesc::new(shape, emission).into()
}
