//! Loop subdivision: the smooth surface of a control mesh.

use std::collections::HashMap;

use super::file_loc::Typed;
use super::meshes::{check, triangle_mesh};
use crate::glam::Vec3;
use crate::{Diagnostic, Mesh};

/// The most rounds of subdivision.
const MOST_LEVELS: u32 = 8;

/// The most triangles of one subdivided mesh.
const MOST_SUBDIVIDED: usize = 1 << 22;

/// `Shape "loopsubdiv"`: triangles of the limit surface, with its normals.
///
/// # Source
/// `[PBRT4]`, `loopsubdiv.cpp`; normals are those of the fine triangles, weighted by area. As there
/// the front is where the vertices of the control mesh run clockwise.
pub(super) fn loop_subdivision(typed: &Typed<'_>) -> Result<Mesh, Diagnostic> {
    typed.parameters.accept("scheme");
    let levels = typed.parameters.whole("levels", MOST_LEVELS).unwrap_or(3);
    let mut mesh = triangle_mesh(typed)?;
    check(typed.at, &mesh)?;
    mesh.indices.retain(|[a, b, c]| a != b && b != c && c != a);
    if mesh.indices.len() > MOST_SUBDIVIDED >> (2 * levels) {
        let message = format!("expected at most {MOST_SUBDIVIDED} triangles after subdivision");
        return Err(typed.at.diagnostic(message));
    }
    for _ in 0..levels {
        subdivide(&mut mesh);
    }
    let rings = Rings::of(&mesh);
    mesh.positions = (0..mesh.positions.len())
        .map(|vertex| rings.moved(&mesh, vertex, interior_limit, 0.2))
        .collect();
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    for (index, triangle) in mesh.indices.iter().enumerate() {
        let [a, b, c] = mesh.triangle(index);
        for &vertex in triangle {
            normals[vertex as usize] -= (b - a).cross(c - a);
        }
    }
    mesh.normals = Some(normals);
    mesh.uvs = None;
    Ok(mesh)
}

/// An edge, the vertex with the lower number first.
type Edge = [u32; 2];

/// The vertices opposite an edge, in the triangles that have it.
#[derive(Clone, Copy, Debug, Default)]
struct Opposite {
    count: u32,
    sum: Vec3,
}

/// What a vertex knows of its neighbours.
#[derive(Clone, Copy, Debug, Default)]
struct Ring {
    valence: u32,
    sum: Vec3,
    /// Those along edges that do not have two triangles.
    on_boundary: u32,
    boundary_sum: Vec3,
}

struct Rings {
    edges: HashMap<Edge, Opposite>,
    rings: Vec<Ring>,
}

impl Rings {
    fn of(mesh: &Mesh) -> Self {
        let mut edges: HashMap<Edge, Opposite> = HashMap::with_capacity(2 * mesh.indices.len());
        for triangle in &mesh.indices {
            for (edge, opposite) in edges_of(triangle) {
                let known = edges.entry(edge).or_default();
                known.count += 1;
                known.sum += mesh.positions[opposite as usize];
            }
        }
        let mut rings = vec![Ring::default(); mesh.positions.len()];
        // Sums in one order, whatever the map's.
        let mut sorted: Vec<(Edge, u32)> = edges.iter().map(|(&e, o)| (e, o.count)).collect();
        sorted.sort_unstable();
        for ([a, b], count) in sorted {
            for (vertex, other) in [(a, b), (b, a)] {
                let (ring, other) = (&mut rings[vertex as usize], mesh.positions[other as usize]);
                ring.valence += 1;
                ring.sum += other;
                if count != 2 {
                    ring.on_boundary += 1;
                    ring.boundary_sum += other;
                }
            }
        }
        Self { edges, rings }
    }

    /// A vertex between itself and its neighbours, which weigh what `interior` says of their
    /// number, or `boundary` at the rim. Where rims meet it stays.
    fn moved(
        &self,
        mesh: &Mesh,
        vertex: usize,
        interior: impl Fn(u32) -> f32,
        boundary: f32,
    ) -> Vec3 {
        let (at, ring) = (mesh.positions[vertex], &self.rings[vertex]);
        match (ring.on_boundary, ring.valence) {
            (_, 0) => at,
            (0, valence) => {
                let weight = interior(valence);
                at * (1.0 - valence as f32 * weight) + ring.sum * weight
            }
            (2, _) => at * (1.0 - 2.0 * boundary) + ring.boundary_sum * boundary,
            _ => at,
        }
    }
}

/// One round: four triangles for each.
fn subdivide(mesh: &mut Mesh) {
    let rings = Rings::of(mesh);
    let count = mesh.positions.len();
    let mut positions: Vec<Vec3> = (0..count)
        .map(|vertex| rings.moved(mesh, vertex, interior_weight, 0.125))
        .collect();
    let mut middles: HashMap<Edge, u32> = HashMap::with_capacity(rings.edges.len());
    let mut indices = Vec::with_capacity(4 * mesh.indices.len());
    for triangle in &mesh.indices {
        let [ab, bc, ca] = edges_of(triangle).map(|(edge, _)| {
            *middles.entry(edge).or_insert_with(|| {
                let ends = edge.map(|end| mesh.positions[end as usize]);
                let opposite = &rings.edges[&edge];
                positions.push(if opposite.count == 2 {
                    (ends[0] + ends[1]) * 0.375 + opposite.sum * 0.125
                } else {
                    (ends[0] + ends[1]) * 0.5
                });
                u32::try_from(positions.len() - 1).expect("fewer vertices than 2^32")
            })
        });
        let [a, b, c] = *triangle;
        indices.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    (mesh.positions, mesh.indices) = (positions, indices);
}

/// The edges ab, bc and ca of a triangle, each with the vertex opposite.
fn edges_of(&[a, b, c]: &[u32; 3]) -> [(Edge, u32); 3] {
    [(a, b, c), (b, c, a), (c, a, b)].map(|(from, to, opposite)| {
        let edge = [from.min(to), from.max(to)];
        (edge, opposite)
    })
}

/// What each of `valence` neighbours weighs in a round.
fn interior_weight(valence: u32) -> f32 {
    match valence {
        6 => 1.0 / 16.0,
        3 => 3.0 / 16.0,
        valence => 3.0 / (8.0 * valence as f32),
    }
}

/// What each of `valence` neighbours weighs in the place that a vertex moves to in the end.
fn interior_limit(valence: u32) -> f32 {
    let beta = if valence == 3 {
        3.0 / 16.0
    } else {
        3.0 / (8.0 * valence as f32)
    };
    1.0 / (valence as f32 + 3.0 / (8.0 * beta))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::parse_pbrt;
    use crate::glam::Vec3;
    use crate::{Files, Mesh};

    const OCTAHEDRON: &str = "\"point3 P\" [1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1]
        \"integer indices\" [0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5]";

    fn subdivided(shape: &str) -> Mesh {
        let text = format!("WorldBegin Shape \"loopsubdiv\" {shape}");
        let scene = parse_pbrt(Path::new("a"), &text, Files::NONE).expect("a scene");
        assert_eq!(scene.warnings, [], "all read");
        scene.meshes[0].clone()
    }

    /// By hand: a vertex of valence 4 moves to (1 - 4 w) p + w times the sum of its neighbours,
    /// which is 0, with w = 1 / (4 + 4) in the limit.
    #[test]
    fn an_octahedron_becomes_round() {
        let flat = subdivided(&format!("{OCTAHEDRON} \"integer levels\" 0"));
        assert_eq!(flat.indices.len(), 8, "no round");
        assert!(
            flat.positions[0].distance(Vec3::X * 0.5) < 1e-6,
            "at its limit"
        );
        let mesh = subdivided(OCTAHEDRON);
        assert_eq!(
            mesh.indices.len(),
            8 * 64,
            "three rounds unless the file says how many"
        );
        // The limit of a vertex does not depend on the round in which it is taken.
        assert!(
            mesh.positions[0].distance(Vec3::X * 0.5) < 1e-6,
            "the same place"
        );
        let radii: Vec<f32> = mesh.positions.iter().map(|p| p.length()).collect();
        let (low, high) = (0.41, 0.501);
        assert!(radii.iter().all(|r| (low..high).contains(r)), "{radii:?}");
        // The front is where the vertices of the control mesh run clockwise: here inside.
        let inward = mesh
            .positions
            .iter()
            .zip(mesh.normals.as_ref().expect("normals"));
        assert!(inward.clone().all(|(p, n)| p.dot(*n) < 0.0), "inward");
        for index in 0..mesh.indices.len() {
            let [a, b, c] = mesh.triangle(index);
            assert!(
                (b - a).cross(c - a).dot(a) < 0.0,
                "and so are the triangles"
            );
        }
    }

    #[test]
    fn a_rim_is_a_curve_of_its_own() {
        let square = "\"point3 P\" [0 0 0  4 0 0  4 4 0  0 4 0] \"integer indices\" [0 1 2 0 2 3]";
        let mesh = subdivided(&format!("{square} \"integer levels\" 1"));
        assert_eq!(mesh.indices.len(), 8, "one round");
        // A round moves a corner to 3/4 of itself and 1/8 of its neighbours on the rim, and halves
        // the edges; the limit takes 3/5 and 1/5 of these.
        let corner = Vec3::new(0.5, 0.5, 0.0) * 0.6 + (Vec3::X * 2.0 + Vec3::Y * 2.0) * 0.2;
        assert!(
            mesh.positions[0].distance(corner) < 1e-6,
            "{}",
            mesh.positions[0]
        );
    }
}
