use super::BilinearPatch;
use super::rounding::hit_slack;
use crate::glam::{Vec2, Vec3};
use light_math::float::{inverse_power_of_two, sqrt};

impl BilinearPatch {
    /// Parameters and distance of the ray's first meeting with the patch.
    ///
    /// The line at u, from one side to the other, meets the ray where the three vectors between
    /// them are in one plane: a quadratic equation for u.
    ///
    /// # Source
    /// `[Reshetov2019]`, section 8.2; a hair outside of the edges counts.
    pub(super) fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<(Vec2, f32)> {
        let lengths = [self.p00 - origin, self.du, self.dv, self.duv];
        let farthest = lengths
            .map(Vec3::abs)
            .into_iter()
            .fold(Vec3::ZERO, Vec3::max);
        let scale = inverse_power_of_two(farthest.max_element());
        let (uv, t) = self.scaled(scale).meet(origin * scale, direction)?;
        Some((uv, t / scale))
    }

    /// The same in a unit of length in which no product overflows or vanishes.
    fn meet(&self, origin: Vec3, direction: Vec3) -> Option<(Vec2, f32)> {
        let from = self.p00 - origin;
        let cross_dv = direction.cross(self.dv);
        let cross_duv = direction.cross(self.duv);
        let c = from.dot(cross_dv);
        let b = self.du.dot(cross_dv) + from.dot(cross_duv);
        let a = self.du.dot(cross_duv);
        let discriminant = b * b - 4.0 * a * c;
        if !(discriminant >= 0.0) {
            return None;
        }
        let q = -0.5 * (b + sqrt(discriminant).copysign(b));
        let near = |u: f32| {
            let v = closest(from + self.du * u, self.dv + self.duv * u, direction);
            let at = Vec2::new(u, v);
            if at == at.clamp(Vec2::ZERO, Vec2::ONE) {
                let t = self.along(from, at).dot(direction);
                (t > 0.0).then_some((at, t))
            } else {
                self.graze_edge(from, direction, at)
            }
        };
        match (near(q / a), near(c / q)) {
            (Some(first), Some(second)) if second.1 < first.1 => Some(second),
            (Some(first), _) => Some(first),
            (None, second) => second,
        }
    }

    /// From the origin of a ray, which sees the first corner at `from`, to the point at `uv`.
    pub(super) fn along(&self, from: Vec3, uv: Vec2) -> Vec3 {
        from + self.du * uv.x + (self.dv + self.duv * uv.x) * uv.y
    }

    /// Where a ray passes an edge, but for a few roundings of its direction: it meets the continued
    /// surface at `outside`, and where it comes in low, a rounding has moved that far.
    fn graze_edge(&self, from: Vec3, direction: Vec3, outside: Vec2) -> Option<(Vec2, f32)> {
        const FAR: f32 = 0.5;
        let mut uv = outside.clamp(Vec2::ZERO, Vec2::ONE);
        let beyond = (outside - uv).abs();
        if !(beyond.max_element() <= FAR) {
            return None;
        }
        if beyond.y > beyond.x {
            let (start, edge) = (from + self.dv * uv.y, self.du + self.duv * uv.y);
            uv.x = closest(start, edge, direction).clamp(0.0, 1.0);
        } else {
            let (start, edge) = (from + self.du * uv.x, self.dv + self.duv * uv.x);
            uv.y = closest(start, edge, direction).clamp(0.0, 1.0);
        }
        let p = self.along(from, uv);
        let t = p.dot(direction);
        let slack = hit_slack(t + from.length() + self.p00.length(), 0.0, 1.0);
        let is_near = p.cross(direction).length_squared() <= slack * slack;
        (t > 0.0 && is_near).then_some((uv, t))
    }
}

/// Where the line from `start` along `line` is closest to the ray from zero, as a part of `line`.
fn closest(start: Vec3, line: Vec3, direction: Vec3) -> f32 {
    let across = line.cross(direction);
    -start.cross(direction).dot(across) / across.length_squared()
}
