//! The city as a scene for programs that render.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use benches::city::{KINDS, SIDE, house, places, streets};
use light_testkit::Rng;
use light_testkit::light_sets::SetLight;
use lights::glam::Vec3;

/// Where windows lie before the walls, so that both are seen.
const DEPTH: f32 = 0.02;

/// The two colours of windows.
const COLORS: [&str; 2] = ["1 .72 .42", ".55 .7 1"];

/// Writes a city of so many houses with so many lights each: a ground, a dim sky, and for each kind
/// of house an object of walls and of windows in two colours.
pub(crate) fn write(path: &Path, houses: usize, lights: usize) -> io::Result<()> {
    let mut rng = Rng::new(1);
    let mut out = BufWriter::new(File::create(path)?);
    let side = 2.0 * SIDE * streets(houses) as f32;
    let middle = 0.5 * side;
    writeln!(
        out,
        "LookAt {} {} 40  {middle} {} 4  0 0 1\n\
         Camera \"perspective\" \"float fov\" 50\n\
         Film \"rgb\" \"integer xresolution\" 160 \"integer yresolution\" 90 \"string filename\" \
         \"city.exr\"\n\
         WorldBegin\n\
         Material \"diffuse\" \"rgb reflectance\" [.4 .4 .4]\n\
         Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n  \
         \"point3 P\" [-{SIDE} -{SIDE} 0  {side} -{SIDE} 0  {side} {side} 0  -{SIDE} {side} 0]",
        middle + 0.5 * SIDE,
        middle - 70.0,
        middle + 30.0
    )?;
    for kind in 0..KINDS {
        writeln!(out, "ObjectBegin \"house {kind}\"")?;
        walls(&mut out)?;
        let windows = house(lights, &mut rng);
        // Both triangles of a window have its colour.
        let mut colors: [Vec<[Vec3; 3]>; 2] = Default::default();
        for pair in windows.chunks(2) {
            let color = &mut colors[rng.below(2)];
            for light in pair {
                if let SetLight::Triangle { vertices, .. } = light {
                    color.push(*vertices);
                }
            }
        }
        for (color, triangles) in COLORS.iter().zip(&colors) {
            let strength = rng.log_range(1.0, 10.0);
            if !triangles.is_empty() {
                shape(&mut out, color, strength, triangles)?;
            }
        }
        writeln!(out, "ObjectEnd")?;
    }
    for place in places(houses, &mut rng) {
        let (kind, to_scene) = (place.kind, place.transform());
        write!(out, "AttributeBegin Transform [")?;
        let [x, y, z] = [
            to_scene.matrix3.x_axis,
            to_scene.matrix3.y_axis,
            to_scene.matrix3.z_axis,
        ];
        for column in [x, y, z] {
            write!(out, "{} {} {} 0 ", column.x, column.y, column.z)?;
        }
        let at = to_scene.translation;
        writeln!(
            out,
            "{} {} {} 1] ObjectInstance \"house {kind}\" AttributeEnd",
            at.x, at.y, at.z
        )?;
    }
    out.flush()
}

/// Four walls and a roof.
fn walls(out: &mut impl Write) -> io::Result<()> {
    let (half, high) = (0.5 * SIDE, 2.0 * SIDE + 1.0);
    write!(
        out,
        "Shape \"trianglemesh\" \"integer indices\" \
         [0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7 4 5 6 4 6 7]\n  \"point3 P\" ["
    )?;
    for z in [0.0, high] {
        for (x, y) in [(-half, -half), (half, -half), (half, half), (-half, half)] {
            write!(out, "{x} {y} {z} ")?;
        }
    }
    writeln!(out, "]")
}

/// Triangles that shine.
fn shape(
    out: &mut impl Write,
    color: &str,
    strength: f32,
    triangles: &[[Vec3; 3]],
) -> io::Result<()> {
    write!(
        out,
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [{color}] \"float scale\" {strength}\n\
         Shape \"trianglemesh\" \"integer indices\" ["
    )?;
    for i in 0..3 * triangles.len() {
        write!(out, "{i} ")?;
    }
    write!(out, "]\n  \"point3 P\" [")?;
    for [a, b, c] in triangles {
        let out_of_wall = (b - a).cross(c - a).normalize_or_zero() * DEPTH;
        for p in [a, b, c].map(|p| p + out_of_wall) {
            write!(out, "{} {} {} ", p.x, p.y, p.z)?;
        }
        writeln!(out)?;
    }
    writeln!(out, "] AttributeEnd")
}
