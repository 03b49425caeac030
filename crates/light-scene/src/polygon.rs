//! Faces of many corners as triangles.

use core::fmt;

use crate::glam::{DVec2, DVec3, Vec3};

/// Convex faces of at most so many corners become fans.
const SMALL: usize = 16;

/// What the corners of a face times those that point inward may be: what clipping takes is in
/// proportion to it.
pub(crate) const MOST_WORK: usize = 1 << 24;

/// How much more area than the face the triangles may have together, for rounding.
const SLACK: f64 = 1e-4;

/// A face that takes too long: how many corners it has, and how many of them point inward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TooInvolved {
    pub(crate) corners: usize,
    pub(crate) inward: usize,
}

impl fmt::Display for TooInvolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { corners, inward } = self;
        write!(
            f,
            "expected a face whose corners times those that point inward are at most {MOST_WORK}, \
             found {corners} times {inward}"
        )
    }
}

/// The triangles of a face, as indices into the list of its corners, all with its front.
///
/// A convex face of few corners is a fan around the first. One of many is halved over and over: a
/// fan would put all its triangles side by side around one corner, where no hierarchy can separate
/// them. Any other is cut ear by ear, in its own plane.
///
/// # Errors
/// When the work would exceed [`MOST_WORK`].
///
/// # Source
/// `[Meisters1975]`, polygons have ears.
pub(crate) fn triangles(corners: &[Vec3]) -> Result<Vec<[u32; 3]>, TooInvolved> {
    let count = u32::try_from(corners.len()).unwrap_or(u32::MAX);
    if count < 4 {
        return Ok((2..count).map(|last| [0, last - 1, last]).collect());
    }
    let flat = flattened(corners);
    let simple = if corners.len() <= SMALL {
        (2..count).map(|last| [0, last - 1, last]).collect()
    } else {
        halves(count)
    };
    if covers(&flat, &simple) {
        return Ok(simple);
    }
    clipped(&flat)
}

/// The corners in the plane that the face lies in most, where it runs counter-clockwise.
fn flattened(corners: &[Vec3]) -> Vec<DVec2> {
    let first = corners[0].as_dvec3();
    let from_first = |corner: &Vec3| corner.as_dvec3() - first;
    let edges = corners[1..].windows(2);
    let normal: DVec3 = edges
        .map(|edge| from_first(&edge[0]).cross(from_first(&edge[1])))
        .sum();
    let size = normal.abs();
    // The axes of the plane, in the order that keeps its front for an axis that points up.
    let (u, v, up) = if size.x >= size.max_element() {
        (DVec3::Y, DVec3::Z, normal.x)
    } else if size.y >= size.max_element() {
        (DVec3::Z, DVec3::X, normal.y)
    } else {
        (DVec3::X, DVec3::Y, normal.z)
    };
    let place = |corner: &Vec3| {
        let p = from_first(corner);
        DVec2::new(u.dot(p), v.dot(p) * 1f64.copysign(up))
    };
    corners.iter().map(place).collect()
}

/// Splits the corners into halves, recursively.
fn halves(count: u32) -> Vec<[u32; 3]> {
    let mut all = Vec::new();
    let mut waiting = vec![(0u32, count - 1)];
    while let Some((first, last)) = waiting.pop() {
        let middle = first.midpoint(last);
        if middle > first {
            all.push([first, middle, last]);
            waiting.extend([(middle, last), (first, middle)]);
        }
    }
    all
}

/// Whether the triangles do not overlap: all of them run the same way around.
fn covers(flat: &[DVec2], triangles: &[[u32; 3]]) -> bool {
    let areas = triangles.iter().map(|t| {
        let [a, b, c] = t.map(|i| flat[i as usize]);
        turn(a, b, c)
    });
    let (sum, backward) = areas.fold((0.0, 0.0), |(sum, backward): (f64, f64), area| {
        (sum + area, backward - area.min(0.0))
    });
    backward <= SLACK * sum
}

/// Twice the area of a triangle, above 0 if it runs counter-clockwise.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The corners that are left, each with those beside it.
struct Ring<'a> {
    flat: &'a [DVec2],
    before: Vec<u32>,
    after: Vec<u32>,
    /// Those that pointed inward at first; no other does later.
    inward: Vec<u32>,
}

/// Ears cut off one by one.
fn clipped(flat: &[DVec2]) -> Result<Vec<[u32; 3]>, TooInvolved> {
    let count = u32::try_from(flat.len()).unwrap_or(u32::MAX);
    let mut ring = Ring {
        flat,
        before: (0..count).map(|i| (i + count - 1) % count).collect(),
        after: (0..count).map(|i| (i + 1) % count).collect(),
        inward: Vec::new(),
    };
    ring.inward = (0..count).filter(|&i| ring.turn_at(i) < 0.0).collect();
    let inward = ring.inward.len();
    if flat.len().saturating_mul(inward) > MOST_WORK {
        let corners = flat.len();
        return Err(TooInvolved { corners, inward });
    }
    let mut all = Vec::with_capacity(flat.len() - 2);
    let (mut at, mut left, mut in_vain) = (0u32, count, 0u32);
    let mut is_lost = false;
    while left > 3 {
        // A face that crosses itself may have no ear: what is left is cut as it comes.
        is_lost |= in_vain > left;
        if is_lost || ring.is_ear(at) {
            all.push(ring.triangle(at));
            // Ears of one corner after the other would make a fan.
            let next = ring.cut(at);
            at = ring.after[next as usize];
            left -= 1;
            in_vain = 0;
        } else {
            in_vain += 1;
            at = ring.after[at as usize];
        }
    }
    all.push(ring.triangle(at));
    Ok(all)
}

impl Ring<'_> {
    fn triangle(&self, at: u32) -> [u32; 3] {
        [self.before[at as usize], at, self.after[at as usize]]
    }

    fn turn_at(&self, at: u32) -> f64 {
        let [a, b, c] = self.triangle(at).map(|i| self.flat[i as usize]);
        turn(a, b, c)
    }

    /// Whether the corner and the two beside it hold none of the others.
    fn is_ear(&self, at: u32) -> bool {
        let area = self.turn_at(at);
        if area <= 0.0 {
            // On a straight edge nothing is lost.
            return area == 0.0;
        }
        let [a, b, c] = self.triangle(at).map(|i| self.flat[i as usize]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let is_inside = |&i: &u32| {
            let p = self.flat[i as usize];
            let is_near = p.cmpge(low).all() && p.cmple(high).all();
            // A corner that two parts of a face share does not block an ear.
            is_near
                && p != a
                && p != b
                && p != c
                && turn(a, b, p) >= 0.0
                && turn(b, c, p) >= 0.0
                && turn(c, a, p) >= 0.0
        };
        !self.inward.iter().any(is_inside)
    }

    /// Takes a corner out; the next one.
    fn cut(&mut self, at: u32) -> u32 {
        let [before, _, after] = self.triangle(at);
        self.after[before as usize] = after;
        self.before[after as usize] = before;
        after
    }
}

#[cfg(test)]
mod tests;
