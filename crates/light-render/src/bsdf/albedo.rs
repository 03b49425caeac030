use std::sync::LazyLock;

use lights::glam::{Vec2, Vec3};

use super::conductor::reflect;
use super::microfacets::Microfacets;

/// Roughnesses of the table, evenly from 0 to 1.
const ROWS: u8 = 24;
/// Cosines of the table: the squares of even steps from 0 to 1, so that most are grazing.
const COLUMNS: u8 = 24;

/// The share of light that GGX microfacets with Schlick's Fresnel factor reflect, over all
/// directions of incidence: `f0 * a + f90 * b`, where `a` and `b` depend on the viewer's cosine and
/// the roughness alone.
///
/// # Source
/// `[Karis2013]`, "Environment BRDF", by quadrature over visible normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Albedo {
    row: u8,
    /// The weight of the row behind `row`.
    part: f32,
}

/// `a` and `b` by roughness and cosine, and their means over cosine-weighted directions.
struct Table {
    values: [[Vec2; COLUMNS as usize]; ROWS as usize],
    means: [Vec2; ROWS as usize],
}

static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

impl Albedo {
    /// That of a roughness in `[0, 1]`, of which the square is the width of the facets.
    #[inline]
    pub(super) fn new(roughness: f32) -> Self {
        let (row, part) = step(roughness, ROWS);
        Self { row, part }
    }

    /// `a` and `b` seen under the cosine `cos`, in `[0, 1]`.
    #[inline]
    pub(super) fn at(self, cos: f32) -> Vec2 {
        let table = &*TABLE;
        let (column, part) = step(cos.sqrt(), COLUMNS);
        let [row, column] = [usize::from(self.row), usize::from(column)];
        let of_row = |row: usize| {
            let values = &table.values[row];
            values[column].lerp(values[column + 1], part)
        };
        of_row(row).lerp(of_row(row + 1), self.part)
    }

    /// The means of `a` and `b` over cosine-weighted directions.
    #[inline]
    pub(super) fn mean(self) -> Vec2 {
        let row = usize::from(self.row);
        TABLE.means[row].lerp(TABLE.means[row + 1], self.part)
    }
}

/// The node below `x`, in `[0, 1]`, of `count` even ones, and how far `x` is on the way to the
/// next.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "from 0 to the number of nodes"
)]
fn step(x: f32, count: u8) -> (u8, f32) {
    let place = x.clamp(0.0, 1.0) * f32::from(count - 1);
    let node = (place as u8).min(count - 2);
    (node, place - f32::from(node))
}

impl Table {
    fn new() -> Self {
        let node = |i: usize, count: u8| i as f32 / f32::from(count - 1);
        let values = core::array::from_fn(|row| {
            let roughness = node(row, ROWS);
            let facets = Microfacets::new(Vec2::splat(roughness * roughness));
            core::array::from_fn(|column| {
                let cos = node(column, COLUMNS).powi(2);
                reflected(&facets, cos)
            })
        });
        let mut table = Self {
            values,
            means: [Vec2::ZERO; ROWS as usize],
        };
        // As queries interpolate: linear in the root t of the cosine, which has the weight
        // 2 cos d cos = 4 t^3 dt.
        for (mean, values) in table.means.iter_mut().zip(&table.values) {
            for column in 0..values.len() - 1 {
                let [t0, t1] = [column, column + 1].map(|i| node(i, COLUMNS));
                // The integrals of 4 t^3 and of 4 t^3 times the weight of the second node.
                let whole = t1.powi(4) - t0.powi(4);
                let moment = 0.8 * (t1.powi(5) - t0.powi(5));
                let second = (moment - t0 * whole) / (t1 - t0);
                *mean += values[column] * (whole - second) + values[column + 1] * second;
            }
        }
        table
    }
}

/// `a` and `b` for the viewer's cosine `cos`.
fn reflected(facets: &Microfacets, cos: f32) -> Vec2 {
    const STEPS: u8 = 16;
    // Nothing is seen of facets exactly edge-on.
    let cos = cos.max(1e-3);
    let wo = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
    let mut sum = Vec2::ZERO;
    for i in 0..STEPS {
        for j in 0..STEPS {
            let u = Vec2::new(f32::from(i) + 0.5, f32::from(j) + 0.5) / f32::from(STEPS);
            let wm = facets.sample_visible(wo, u);
            let wi = reflect(wo, wm);
            if wi.z > 0.0 {
                let edge = (1.0 - wo.dot(wm).clamp(0.0, 1.0)).powi(5);
                let seen = facets.g(wo, wi) / facets.g1(wo);
                sum += Vec2::new(1.0 - edge, edge) * seen;
            }
        }
    }
    sum / f32::from(STEPS).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_surface_reflects_by_the_fresnel_factor() {
        let smooth = Albedo::new(0.0);
        for cos in [0.1f32, 0.3, 0.7, 1.0] {
            let edge = (1.0 - cos).powi(5);
            let Vec2 { x, y } = smooth.at(cos);
            assert!((x - (1.0 - edge)).abs() < 3e-3, "{cos}: {x}");
            assert!((y - edge).abs() < 3e-3, "{cos}: {y}");
        }
        let mean = smooth.mean();
        let (x, y) = (mean.x - 20.0 / 21.0, mean.y - 1.0 / 21.0);
        assert!(x.abs() < 1e-3 && y.abs() < 1e-3, "{mean}");
    }

    #[test]
    fn rough_facets_lose_what_they_reflect_twice() {
        // The integral of 2 c / (1 + c) over half of the disk, c the cosine of incidence.
        let exact = 1.0 - 2.0f32.ln();
        let sum = Albedo::new(1.0).at(1.0).element_sum();
        assert!((sum - exact).abs() < 0.01, "{sum}, not {exact}");
        // By 200,000 random normals.
        let Vec2 { x, y } = Albedo::new(0.5).at(0.5);
        let (x, y) = (x - 0.831, y - 0.0228);
        assert!(x.abs() < 0.01 && y.abs() < 2e-3, "{x} and {y} too much");
    }
}
