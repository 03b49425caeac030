use light_math::Aabb;
use light_math::glam::Vec3;

use super::prim::{Prim, Run, Sums};

/// Bins on each axis.
const BINS: usize = 12;

/// Splits `run` of `prims` in two where the halves cost least together; neither is empty. `run` has at least two lights.
pub(crate) fn split(prims: &mut [Prim], run: &Run) -> (Run, Run) {
    let lights = &mut prims[run.start..run.end];
    let low = run.bounds.min;
    let extent = run.bounds.diagonal();
    let scale = Vec3::select(
        extent.cmpgt(Vec3::splat(1e-30)),
        Vec3::splat(BINS as f32 * (1.0 - 1e-6)) / extent.max(Vec3::splat(1e-30)),
        Vec3::ZERO,
    );
    let plane = best_plane(lights, low, scale);
    let (mid, costs) = match plane {
        Some(plane) => (
            partition(lights, |p| bin(p, low, scale)[plane.axis] <= plane.bin),
            plane.costs,
        ),
        // No plane separates them: centres in one point, or too close to tell apart.
        None => (lights.len() / 2, [run.cost / 2.0; 2]),
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

/// Splits `run` in two halves of the same number of lights, along its longest side.
pub(crate) fn halve(prims: &mut [Prim], run: &Run) -> (Run, Run) {
    let lights = &mut prims[run.start..run.end];
    let axis = run.bounds.diagonal().max_position();
    let mid = lights.len() / 2;
    lights.select_nth_unstable_by(mid, |a, b| {
        a.center[axis]
            .total_cmp(&b.center[axis])
            .then(a.light.cmp(&b.light))
    });
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

/// Lights in bins up to `bin` go left.
struct Plane {
    axis: usize,
    bin: usize,
    costs: [f32; 2],
}

fn best_plane(lights: &[Prim], low: Vec3, scale: Vec3) -> Option<Plane> {
    let mut bins = [[Sums::default(); BINS]; 3];
    let mut filled = [[false; BINS]; 3];
    for prim in lights {
        let at = bin(prim, low, scale);
        for axis in 0..3 {
            bins[axis][at[axis]].add(prim, low);
            filled[axis][at[axis]] = true;
        }
    }
    let mut best: Option<Plane> = None;
    for axis in 0..3 {
        let last = filled[axis].iter().rposition(|&f| f).unwrap_or(0);
        let mut right_costs = [0.0; BINS];
        let mut right = Sums::default();
        for k in (1..=last).rev() {
            right = right.plus(&bins[axis][k]);
            right_costs[k] = right.cost();
        }
        let mut left = Sums::default();
        for k in 0..last {
            left = left.plus(&bins[axis][k]);
            if !filled[axis][..=k].contains(&true) {
                continue;
            }
            let costs = [left.cost(), right_costs[k + 1]];
            let better = match &best {
                Some(best) => costs[0] + costs[1] < best.costs[0] + best.costs[1],
                None => true,
            };
            if better {
                best = Some(Plane {
                    axis,
                    bin: k,
                    costs,
                });
            }
        }
    }
    best
}

#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "float to integer casts saturate, and the bin is clamped"
)]
fn bin(prim: &Prim, low: Vec3, scale: Vec3) -> [usize; 3] {
    let at = (prim.center - low) * scale;
    [at.x, at.y, at.z].map(|x| (x as usize).min(BINS - 1))
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
