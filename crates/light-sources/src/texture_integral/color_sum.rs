use crate::bilinear_cells::ShownCell;
use crate::glam::{DVec2, DVec3};
use crate::level_quadrature::each_node;
use crate::shape::UvDensity;
use crate::triangle_rules::{DEGREE_5, Node};
use crate::uv_polygon::{Corner, UvPolygon, doubled_area};

/// The size in surface parameters below which a density counts as uniform within a block.
const EVEN: f64 = 1.0 / 1024.0;

/// A sum of colours over polygons of a surface, by the density of its area.
pub(super) struct ColorSum {
    pub(super) density: UvDensity,
    pub(super) sum: DVec3,
    pub(super) total: f64,
}

impl ColorSum {
    pub(super) const fn new(density: UvDensity) -> Self {
        Self {
            density,
            sum: DVec3::ZERO,
            total: 0.0,
        }
    }

    /// Adds a polygon of one colour, or of a mean that is independent of the density.
    pub(super) fn add(&mut self, color: DVec3, polygon: &UvPolygon) {
        let weight = self.weight(polygon);
        self.sum += color * weight;
        self.total += weight;
    }

    /// Adds a polygon between the kinks of the texture, whose colour is multiplied with `color`, by
    /// the nodes of `rule` in each of its triangles.
    pub(super) fn add_cell(
        &mut self,
        cell: &ShownCell,
        piece: &UvPolygon,
        rule: &[Node],
        color: impl Fn(DVec2) -> DVec3,
    ) {
        let mut add = |Corner { uv, place }: Corner, area: f64| {
            let weight = area * self.density.at(uv);
            self.sum += cell.at(place.x, place.y) * color(uv) * weight;
            self.total += weight;
        };
        if let Some(level) = cell.level() {
            return each_node(piece, &level, add);
        }
        for corners in piece.triangles() {
            let area = 0.5 * doubled_area(corners);
            for ([a, b, c], share) in rule {
                let [p, q, r] = corners;
                let at = |of: fn(&Corner) -> DVec2| of(&p) * *a + of(&q) * *b + of(&r) * *c;
                let corner = Corner {
                    uv: at(|corner| corner.uv),
                    place: at(|corner| corner.place),
                };
                add(corner, share * area);
            }
        }
    }

    /// The area of a polygon, by the density.
    pub(super) fn weight(&self, polygon: &UvPolygon) -> f64 {
        let triangles = polygon.triangles();
        let even = |corners| 0.5 * doubled_area(corners);
        if self.density == UvDensity::Even {
            return triangles.map(even).sum();
        }
        let triangles = triangles.map(|corners| {
            let [p, q, r] = corners.map(|corner| corner.uv);
            let density = DEGREE_5
                .iter()
                .map(|([a, b, c], share)| share * self.density.at(p * *a + q * *b + r * *c));
            even(corners) * density.sum::<f64>()
        });
        triangles.sum()
    }

    /// Whether the density hardly changes over a polygon.
    pub(super) fn is_even(&self, polygon: &UvPolygon) -> bool {
        let uvs = || polygon.corners().iter().map(|corner| corner.uv);
        let min = uvs().fold(DVec2::INFINITY, DVec2::min);
        let max = uvs().fold(DVec2::NEG_INFINITY, DVec2::max);
        self.density == UvDensity::Even || (max - min).max_element() <= EVEN
    }
}
