use core::f32::consts::{PI, TAU};

use super::file_loc::Typed;
use super::parameter::ParameterType;
use super::state::Reader;
use crate::glam::{Vec2, Vec3};
use crate::text::shown;
use crate::{Diagnostic, MaterialId, Mesh};

/// How many corners the section of a tube has.
const SIDES: u16 = 6;

/// How many straight parts stand for a segment of a curve.
const PARTS: usize = 4;

impl Reader {
    /// `Shape "curve"` as a tube, whose width is the curve's from all sides.
    ///
    /// # Source
    /// `[PBRT4]`, `shapes.cpp`: how many points make how many segments, and how the width runs from
    /// one end to the other.
    pub(super) fn curve(&mut self, typed: &Typed<'_>) -> Result<Mesh, Diagnostic> {
        let curve = Curve::of(typed)?;
        for name in ["type", "splitdepth", "N"] {
            typed.parameters.accept(name);
        }
        self.warn(typed.at, "Shape \"curve\"", "was made a tube of triangles");
        Ok(curve.tube())
    }
}

/// The segments of a curve, each by the four points of a cubic Bézier curve.
struct Curve {
    segments: Vec<[Vec3; 4]>,
    /// The widths of both ends.
    widths: [f32; 2],
}

impl Curve {
    fn of(typed: &Typed<'_>) -> Result<Self, Diagnostic> {
        let parameters = &typed.parameters;
        let refuse = |message: String| Err(typed.at.diagnostic(message));
        let width = parameters.positive_or("width", 1.0);
        let widths = ["width0", "width1"].map(|name| parameters.amount_or(name, width));
        let degree = parameters.numbers("degree", ParameterType::Integer);
        let is_cubic = match degree.unwrap_or([3.0]) {
            [2.0] => false,
            [3.0] => true,
            [other] => return refuse(format!("expected a `degree` of 2 or 3, found {other}")),
        };
        let is_spline = match parameters.string("basis").unwrap_or("bezier") {
            "bezier" => false,
            "bspline" => true,
            other => {
                let other = shown(other);
                return refuse(format!(
                    "expected a `basis` of \"bezier\" or \"bspline\", found \"{other}\""
                ));
            }
        };
        let points = parameters.vec3s("P");
        let Some(points) = points else {
            return refuse("expected \"point3 P\"".to_owned());
        };
        let degree = if is_cubic { 3 } else { 2 };
        let step = if is_spline { 1 } else { degree };
        let count = points.len();
        if count <= degree || (count - 1) % step != 0 {
            return refuse(format!(
                "expected {} points and {step} for each further segment, found {count}",
                degree + 1
            ));
        }
        let windows = points.windows(degree + 1).step_by(step);
        let segments = windows.map(|p| match (is_cubic, is_spline) {
            (true, false) => [p[0], p[1], p[2], p[3]],
            (true, true) => spline([p[0], p[1], p[2], p[3]]),
            (false, false) => raised([p[0], p[1], p[2]]),
            (false, true) => raised([p[0].midpoint(p[1]), p[1], p[1].midpoint(p[2])]),
        });
        Ok(Self {
            segments: segments.collect(),
            widths,
        })
    }

    /// A tube around the curve, with the normals of a round one.
    fn tube(&self) -> Mesh {
        let mut mesh = Mesh::new("", MaterialId(0));
        let (mut normals, mut uvs) = (Vec::new(), Vec::new());
        // So much wider than a hexagon within the tube is one that looks as wide as it on average.
        let sides = f32::from(SIDES);
        let wider = PI / (sides * (PI / sides).sin());
        let mut side = Vec3::ZERO;
        let count = self.segments.len() * PARTS;
        let mut last_tangent = None;
        for row in 0..=count {
            let segment = (row / PARTS).min(self.segments.len() - 1);
            let t = (row - segment * PARTS) as f32 / PARTS as f32;
            let (center, tangent) = point(&self.segments[segment], t);
            let tangent = tangent.or(last_tangent).unwrap_or(Vec3::Z);
            last_tangent = Some(tangent);
            // The section turns as little as it can.
            side = (side - tangent * side.dot(tangent))
                .try_normalize()
                .unwrap_or_else(|| tangent.any_orthonormal_vector());
            let other = tangent.cross(side);
            let u = row as f32 / count as f32;
            let radius = 0.5 * wider * (self.widths[0] + (self.widths[1] - self.widths[0]) * u);
            for corner in 0..SIDES {
                let v = f32::from(corner) / sides;
                let (sin, cos) = (TAU * v).sin_cos();
                let normal = side * cos + other * sin;
                mesh.positions.push(center + normal * radius);
                normals.push(normal);
                uvs.push(Vec2::new(u, v));
            }
        }
        let around = u32::from(SIDES);
        for row in 0..u32::try_from(count).expect("fewer rows than 2^32") {
            for corner in 0..around {
                let next = (corner + 1) % around;
                let [a, b] = [corner, next].map(|corner| row * around + corner);
                let [c, d] = [a + around, b + around];
                mesh.indices.extend([[a, b, d], [a, d, c]]);
            }
        }
        (mesh.normals, mesh.uvs) = (Some(normals), Some(uvs));
        mesh
    }
}

/// The place at `t` of a cubic Bézier curve, and its direction, if it has one there.
fn point(&[a, b, c, d]: &[Vec3; 4], t: f32) -> (Vec3, Option<Vec3>) {
    let [ab, bc, cd] = [a.lerp(b, t), b.lerp(c, t), c.lerp(d, t)];
    let [abc, bcd] = [ab.lerp(bc, t), bc.lerp(cd, t)];
    let direction = (bcd - abc).try_normalize();
    // Where two points are one, the direction is that toward the next.
    let direction = direction.or_else(|| (d - a).try_normalize());
    (abc.lerp(bcd, t), direction)
}

/// The cubic Bézier curve that a quadratic one is.
fn raised([a, b, c]: [Vec3; 3]) -> [Vec3; 4] {
    [a, a.lerp(b, 2.0 / 3.0), c.lerp(b, 2.0 / 3.0), c]
}

/// The cubic Bézier curve that a segment of a uniform cubic B-spline is.
fn spline([a, b, c, d]: [Vec3; 4]) -> [Vec3; 4] {
    let thirds = |p: Vec3, q: Vec3| [p.lerp(q, 1.0 / 3.0), p.lerp(q, 2.0 / 3.0)];
    let ([_, ab], [b1, b2], [cd, _]) = (thirds(a, b), thirds(b, c), thirds(c, d));
    [ab.midpoint(b1), b1, b2, b2.midpoint(cd)]
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::parse_pbrt;
    use super::*;
    use crate::Files;

    fn curve(parameters: &str) -> Result<Mesh, String> {
        let text = format!("WorldBegin Shape \"curve\" {parameters}");
        let scene = parse_pbrt(Path::new("a"), &text, Files::NONE).map_err(|e| e.to_string())?;
        let warnings: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
        assert_eq!(
            warnings,
            ["Shape \"curve\" was made a tube of triangles"],
            "named"
        );
        Ok(scene.meshes[0].clone())
    }

    /// The middles of the rows of a tube.
    fn rows(mesh: &Mesh) -> Vec<Vec3> {
        let sections = mesh.positions.chunks(usize::from(SIDES));
        sections
            .map(|section| section.iter().sum::<Vec3>() / f32::from(SIDES))
            .collect()
    }

    #[test]
    fn a_straight_curve_is_a_cylinder_that_looks_as_wide() {
        let mesh =
            curve("\"point3 P\" [0 0 0  0 0 1  0 0 2  0 0 3] \"float width\" .2").expect("a curve");
        let round = PI * 0.2 * 3.0;
        assert!(
            (mesh.area() / round - 1.0).abs() < 1e-4,
            "the area of a round one"
        );
        for index in 0..mesh.indices.len() {
            let [a, b, c] = mesh.triangle(index);
            let outward = (a + b + c) * Vec3::new(1.0, 1.0, 0.0);
            assert!(
                (b - a).cross(c - a).dot(outward) > 0.0,
                "its front is outside"
            );
        }
    }

    #[test]
    fn curves_run_where_their_points_say() {
        let at = |mesh: &Mesh, row: usize, expected: Vec3| {
            let found = rows(mesh)[row];
            assert!(found.distance(expected) < 1e-5, "{found}, not {expected}");
        };
        let square = "\"point3 P\" [0 0 0  0 2 0  2 2 0] \"integer degree\" 2";
        let quadratic = curve(square).expect("a curve");
        at(&quadratic, PARTS / 2, Vec3::new(0.5, 1.5, 0.0));
        // (1 p0 + 4 p1 + 1 p2) / 6 at the start, and so on.
        let points =
            "\"point3 P\" [0 0 0  6 0 0  6 6 0  0 6 0  0 0 0] \"string basis\" \"bspline\"";
        let spline = curve(points).expect("a curve");
        at(&spline, 0, Vec3::new(5.0, 1.0, 0.0));
        at(&spline, PARTS, Vec3::new(5.0, 5.0, 0.0));
        at(&spline, 2 * PARTS, Vec3::new(1.0, 5.0, 0.0));
        let points = format!("{points} \"integer degree\" 2");
        at(
            &curve(&points).expect("a curve"),
            0,
            Vec3::new(3.0, 0.0, 0.0),
        );
    }

    #[test]
    fn the_width_runs_from_end_to_end() {
        let points = "\"point3 P\" [0 0 0  0 0 1  0 0 2  0 0 3  0 0 4  0 0 5  0 0 6]";
        let mesh =
            curve(&format!("{points} \"float width0\" 1 \"float width1\" 0")).expect("a curve");
        let radius = |row: usize| mesh.positions[row * usize::from(SIDES)].truncate().length();
        assert!(
            (radius(0) / radius(PARTS) - 2.0).abs() < 1e-5,
            "half in the middle"
        );
    }

    #[test]
    fn what_is_no_curve_is_named() {
        let four = "expected 4 points and 3 for each further segment, found 5";
        let points = "\"point3 P\" [0 0 0  0 0 1  0 0 2  0 0 3  0 0 4]";
        assert_eq!(
            curve(points).err(),
            Some(format!("a:1: {four}")),
            "five points"
        );
        let degree = format!("{points} \"integer degree\" 4");
        let expected = "a:1: expected a `degree` of 2 or 3, found 4".to_owned();
        assert_eq!(curve(&degree).err(), Some(expected), "degree");
    }
}
