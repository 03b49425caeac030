use core::cmp::Ordering;
use core::ops::RangeInclusive;

use light_math::glam::Vec3;
use light_math::{Aabb, float};

use super::node::WIDTH;
use super::prim::{Prim, Run, Sums};

/// Bins on each axis.
const BINS: usize = 12;

/// Runs of so many lights are split where full nodes come out.
const SNAP: RangeInclusive<usize> = WIDTH + 1..=16;

/// Variance of the axes beyond which lights are also split by how narrow their cones are. Diffuse lights stay below 1.
const MIXED_AXES: f32 = 100.0;

/// Splits `run` of `prims` in two where the halves cost least together; neither is empty. `run` has at least two lights.
pub(crate) fn split(prims: &mut [Prim], run: &Run) -> (Run, Run) {
    let lights = &mut prims[run.start..run.end];
    let grid = Grid::new(&run.bounds);
    let positions = Bins::<3>::new(lights, |p| grid.position(p));
    let mut plane = positions.best_plane();
    if positions.total().axis_variance() > MIXED_AXES {
        let narrowness = Bins::<1>::new(lights, |p| grid.narrowness(p)).best_plane();
        plane = cheaper(
            plane,
            narrowness.map(|plane| Plane {
                key: Key::Narrowness,
                ..plane
            }),
        );
    }
    let (mid, costs) = match &plane {
        Some(plane) => (
            match plane.key {
                Key::Position(axis) => partition(lights, |p| grid.position(p).0[axis] <= plane.bin),
                Key::Narrowness => partition(lights, |p| grid.narrowness(p).0[0] <= plane.bin),
            },
            plane.costs,
        ),
        // Nothing tells them apart: centres in one point, or too close to each other.
        None => (lights.len() / 2, [run.cost / 2.0; 2]),
    };
    let mid = match &plane {
        Some(Plane {
            key: Key::Position(axis),
            ..
        }) if SNAP.contains(&lights.len()) => snap(lights, *axis, mid),
        _ => mid,
    };
    let at = run.start + mid;
    let part = |start: usize, end: usize, cost| Run {
        start,
        end,
        bounds: centers(&prims[start..end]),
        cost,
    };
    (part(run.start, at, costs[0]), part(at, run.end, costs[1]))
}

/// Moves the border between the halves to the nearest multiple of eight lights, so that the lowest nodes come out full.
fn snap(lights: &mut [Prim], axis: usize, mid: usize) -> usize {
    let mid = (mid + WIDTH / 2) / WIDTH * WIDTH;
    let mid = mid.clamp(WIDTH, (lights.len() - 1) / WIDTH * WIDTH);
    lights.select_nth_unstable_by(mid, |a, b| along(a, b, axis));
    mid
}

/// The order of the centres along `axis`; of the ids where they agree.
fn along(a: &Prim, b: &Prim, axis: usize) -> Ordering {
    a.center[axis]
        .total_cmp(&b.center[axis])
        .then(a.light.cmp(&b.light))
}

/// Splits `run` in two halves of the same number of lights, along its longest side.
pub(crate) fn halve(prims: &mut [Prim], run: &Run) -> (Run, Run) {
    let lights = &mut prims[run.start..run.end];
    let axis = run.bounds.diagonal().max_position();
    let mid = lights.len() / 2;
    lights.select_nth_unstable_by(mid, |a, b| along(a, b, axis));
    let at = run.start + mid;
    let part = |start: usize, end: usize| Run {
        start,
        end,
        bounds: centers(&prims[start..end]),
        cost: run.cost / 2.0,
    };
    (part(run.start, at), part(at, run.end))
}

/// The box of the lights' centres.
pub(crate) fn centers(lights: &[Prim]) -> Aabb {
    lights.iter().fold(Aabb::EMPTY, |b, p| b.extend(p.center))
}

/// What decides on which side of a plane a light is.
#[derive(Clone, Copy)]
enum Key {
    Position(usize),
    Narrowness,
}

/// Lights in bins up to `bin` go left.
struct Plane {
    key: Key,
    bin: usize,
    costs: [f32; 2],
}

fn cheaper(a: Option<Plane>, b: Option<Plane>) -> Option<Plane> {
    let total = |plane: &Option<Plane>| {
        plane
            .as_ref()
            .map_or(f32::INFINITY, |p| p.costs[0] + p.costs[1])
    };
    if total(&b) < total(&a) { b } else { a }
}

/// The bins that lights fall into.
struct Grid {
    low: Vec3,
    scale: Vec3,
}

impl Grid {
    fn new(bounds: &Aabb) -> Self {
        const FLAT: f32 = 1e-30;
        let extent = bounds.diagonal();
        let scale = Vec3::splat(BINS as f32 * (1.0 - 1e-6)) / extent.max(Vec3::splat(FLAT));
        Self {
            low: bounds.min,
            scale: Vec3::select(extent.cmpgt(Vec3::splat(FLAT)), scale, Vec3::ZERO),
        }
    }

    #[inline]
    fn position(&self, prim: &Prim) -> ([usize; 3], Vec3) {
        let p = prim.center - self.low;
        ((p * self.scale).to_array().map(bin), p)
    }

    #[inline]
    fn narrowness(&self, prim: &Prim) -> ([usize; 1], Vec3) {
        let logarithm = float::ln(1.0 + prim.axis.length_squared());
        ([bin(2.0 * logarithm)], prim.center - self.low)
    }
}

#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "float to integer casts saturate, and the bin is clamped"
)]
fn bin(x: f32) -> usize {
    (x as usize).min(BINS - 1)
}

/// Sums of lights along `N` keys at once.
struct Bins<const N: usize> {
    sums: [[Sums; BINS]; N],
    filled: [[bool; BINS]; N],
}

impl<const N: usize> Bins<N> {
    fn new(lights: &[Prim], place: impl Fn(&Prim) -> ([usize; N], Vec3)) -> Self {
        let mut bins = Self {
            sums: [[Sums::default(); BINS]; N],
            filled: [[false; BINS]; N],
        };
        for prim in lights {
            let (at, position) = place(prim);
            let sums = Sums::of(prim, position);
            for (key, &bin) in at.iter().enumerate() {
                let all = &mut bins.sums[key][bin];
                *all = all.plus(&sums);
                bins.filled[key][bin] = true;
            }
        }
        bins
    }

    fn total(&self) -> Sums {
        self.sums[0]
            .iter()
            .fold(Sums::default(), |total, sums| total.plus(sums))
    }

    /// The cheapest plane with lights on both sides.
    fn best_plane(&self) -> Option<Plane> {
        (0..N).fold(None, |best, key| cheaper(best, self.best_of(key)))
    }

    fn best_of(&self, key: usize) -> Option<Plane> {
        let (sums, filled) = (&self.sums[key], &self.filled[key]);
        let first = filled.iter().position(|&f| f)?;
        let last = filled.iter().rposition(|&f| f)?;
        let mut right_costs = [0.0; BINS];
        let mut right = Sums::default();
        for bin in (first + 1..=last).rev() {
            right = right.plus(&sums[bin]);
            right_costs[bin] = right.cost();
        }
        let mut left = Sums::default();
        let mut best = None;
        for bin in first..last {
            left = left.plus(&sums[bin]);
            let plane = Plane {
                key: Key::Position(key),
                bin,
                costs: [left.cost(), right_costs[bin + 1]],
            };
            best = match best {
                None => Some(plane),
                best => cheaper(best, Some(plane)),
            };
        }
        best
    }
}

/// Moves what is `left` to the front, and returns how many those are.
fn partition(lights: &mut [Prim], left: impl Fn(&Prim) -> bool) -> usize {
    let mut mid = 0;
    let mut end = lights.len();
    while mid < end {
        if left(&lights[mid]) {
            mid += 1;
        } else {
            end -= 1;
            lights.swap(mid, end);
        }
    }
    mid
}
