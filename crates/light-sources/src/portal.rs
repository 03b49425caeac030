use crate::glam::{DVec2, DVec3, Vec2, Vec3};
use light_math::Frame;
use light_math::distribution::Window;
use light_math::float::{atan2, tan};

use core::f32::consts::{FRAC_1_PI, FRAC_PI_2, PI};
use core::f64;

/// A rectangle through which the sky is visible, with a map of directions under which it is an
/// axis-aligned rectangle of the unit square, seen from any point.
///
/// In the portal's own frame, where light comes from +z, a direction has the angles `atan(x / z)`
/// and `atan(y / z)`; the square holds them scaled from `[-pi/2, pi/2]`.
///
/// # Source
/// `[Bitterli2015]`, section 3.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portal {
    corner: Vec3,
    /// From the first corner to the last and to the second, along x and y of the frame.
    size: Vec2,
    frame: Frame,
}

/// Tolerance of the cosines of the angles between the sides: files write few digits.
const TOLERANCE: f32 = 1e-3;

/// How far the last corner may be from where the others put it, over the longest side: coordinates
/// of three decimals move it so far.
const CLOSURE: f32 = 4e-3;

/// The largest angle below a right angle.
const UPRIGHT: f32 = f32::from_bits(FRAC_PI_2.to_bits() - 1);

impl Portal {
    /// The portal with these corners, one after the other around it; `None` unless they are a
    /// planar rectangle with an area. Light comes from where the corners run clockwise.
    pub(crate) fn new([p0, p1, p2, p3]: [Vec3; 4]) -> Option<Self> {
        let x = (p3 - p0).try_normalize()?;
        let y = (p1 - p0).try_normalize()?;
        let (opposite_x, opposite_y) = ((p2 - p1).try_normalize()?, (p2 - p3).try_normalize()?);
        let is_parallel = |a: Vec3, b: Vec3| (a.dot(b) - 1.0).abs() <= TOLERANCE;
        let gap = ((p2 - p1) - (p3 - p0)).length();
        let closes = gap <= CLOSURE * p0.distance(p3).max(p0.distance(p1));
        if !(is_parallel(x, opposite_x)
            && is_parallel(y, opposite_y)
            && x.dot(y).abs() <= TOLERANCE
            && closes)
        {
            return None;
        }
        let z = x.cross(y).normalize();
        let frame = Frame::from_xz((x - z * x.dot(z)).normalize(), z);
        let portal = Self {
            corner: p0,
            size: Vec2::new(p0.distance(p3), p0.distance(p1)),
            frame,
        };
        let area = portal.area();
        (area.is_finite() && (1.0 / area).is_finite()).then_some(portal)
    }

    pub(crate) const fn frame(&self) -> &Frame {
        &self.frame
    }

    pub(crate) fn area(&self) -> f32 {
        self.size.x * self.size.y
    }

    /// The direction of a point of the square, and the solid angle per area there.
    ///
    /// # Source
    /// `[PBRT4]`, section 12.5.3: `pi^2 (1 - x^2) (1 - y^2) / z`.
    pub(crate) fn direction(&self, uv: Vec2) -> (Vec3, f32) {
        // A right angle rounds to beyond a right angle, whose tangent has the other sign.
        let angles = ((uv - 0.5) * PI).clamp(Vec2::splat(-UPRIGHT), Vec2::splat(UPRIGHT));
        let w = Vec3::new(tan(angles.x), tan(angles.y), 1.0).normalize();
        (self.frame.from_local(w), solid_angle_per_area(w))
    }

    /// The integrals over a texel of a square map with `n` of them along each side, in sr: of the
    /// direction in the portal's frame, of which z is the cosine at the portal, and of 1, the solid
    /// angle.
    ///
    /// From the axis to the angles `a` and `b` that of the cosine is
    /// `(sin a atan(tan b cos a) + sin b atan(tan a cos b)) / 2`, the form factor of a rectangle,
    /// and the solid angle is `asin(sin a sin b)`. The one of x is `-cos a atan(tan b cos a) / 2`
    /// but for what does not depend on `a`, and cancels.
    pub(crate) fn texel_integrals([x, y]: [u32; 2], n: u32) -> (DVec3, f64) {
        let angle =
            |i: u32| DVec2::from_angle((f64::from(i) / f64::from(n) - 0.5) * f64::consts::PI);
        let corner = |x: u32, y: u32| {
            let (a, b) = (angle(x), angle(y));
            let across = |a: DVec2, b: DVec2| DVec2::new(b.x, b.y * a.x).to_angle();
            let (to_b, to_a) = (across(a, b), across(b, a));
            // The angle with the sine `sin a sin b`, of which this is the cosine.
            let sine = a.y * b.y;
            let cosine = DVec2::new(a.x, a.y * b.x).length();
            let integral = 0.5 * DVec3::new(-a.x * to_b, -b.x * to_a, a.y * to_b + b.y * to_a);
            integral.extend(DVec2::new(cosine, sine).to_angle())
        };
        let sum = corner(x + 1, y + 1) - corner(x, y + 1) - corner(x + 1, y) + corner(x, y);
        (sum.truncate(), sum.w)
    }

    /// The point of the square of a direction, and the solid angle per area there; `None` for
    /// directions from which no light comes.
    pub(crate) fn uv(&self, w: Vec3) -> Option<(Vec2, f32)> {
        let w = self.frame.to_local(w);
        (w.z > 0.0).then(|| (square(w), solid_angle_per_area(w)))
    }

    /// The rectangle of the square that the portal fills, seen from `p`; `None` from behind.
    pub(crate) fn window(&self, p: Vec3) -> Option<Window> {
        let first = self.frame.to_local(self.corner - p);
        (first.z > 0.0).then(|| Window::new(square(first), square(first + self.size.extend(0.0))))
    }

    /// The point of the portal at `u` of its sides.
    pub(crate) fn point(&self, u: Vec2) -> Vec3 {
        self.corner + self.frame.from_local((u * self.size).extend(0.0))
    }

    /// Whether the line through `p` along `w` passes the portal.
    pub(crate) fn is_on_line(&self, p: Vec3, w: Vec3) -> bool {
        let to_corner = self.frame.to_local(self.corner - p);
        let w = self.frame.to_local(w);
        let t = to_corner.z / w.z;
        let at = w.truncate() * t - to_corner.truncate();
        // The portal is enlarged by the rounding error of the point, which grows at grazing angles.
        let magnitude = t.abs() + to_corner.length() + p.length();
        let slack = 8.0 * f32::EPSILON * magnitude / w.z.abs();
        at.cmpge(Vec2::splat(-slack)).all() && at.cmple(self.size + slack).all()
    }
}

/// Both angles of a direction in front, scaled to the unit square.
fn square(w: Vec3) -> Vec2 {
    (Vec2::new(atan2(w.x, w.z), atan2(w.y, w.z)) + FRAC_PI_2) * FRAC_1_PI
}

/// Uses `y^2 + z^2` instead of `1 - x^2`, which loses digits near the edge of the half space.
fn solid_angle_per_area(w: Vec3) -> f32 {
    let sq = w * w;
    PI * PI * (sq.y + sq.z) * (sq.x + sq.z) / w.z
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [Vec3; 4] = [
        Vec3::ZERO,
        Vec3::new(0.0, 2.0, 0.0),
        Vec3::new(3.0, 2.0, 0.0),
        Vec3::new(3.0, 0.0, 0.0),
    ];

    #[test]
    fn refuses_what_is_no_rectangle() {
        assert!(Portal::new(SQUARE).is_some(), "a rectangle");
        let [p0, p1, p2, p3] = SQUARE;
        assert!(
            Portal::new([p0, p1, p2 + Vec3::X, p3]).is_none(),
            "a trapezium"
        );
        assert!(
            Portal::new([p0, p1 + Vec3::X, p2 + Vec3::X, p3]).is_none(),
            "slanted"
        );
        assert!(
            Portal::new([p0, p1, p2 + Vec3::Z, p3]).is_none(),
            "not planar"
        );
        // By 1 part in 40 of the side, an angle of less than two degrees.
        for off in [Vec3::X, Vec3::Y, Vec3::Z] {
            let p2 = p2 + off * (0.025 * p0.distance(p3));
            assert!(Portal::new([p0, p1, p2, p3]).is_none(), "off by {off}");
        }
        let rounded = SQUARE.map(|p| (p * 1e3).round() * 1e-3 + Vec3::X * 4e-4);
        assert!(Portal::new(rounded).is_some(), "three decimals");
        assert!(Portal::new([p0; 4]).is_none(), "a point");
        assert!(Portal::new([p0, p1, Vec3::NAN, p3]).is_none(), "NaN");
        assert!(Portal::new([p0, p2, p1, p3]).is_none(), "crossed");
    }

    #[test]
    fn the_window_is_where_the_portal_is_seen() {
        let Some(portal) = Portal::new(SQUARE) else {
            unreachable!("a rectangle")
        };
        let p = Vec3::new(1.0, -1.0, -2.0);
        assert!(portal.window(Vec3::Z).is_none(), "from behind");
        let Some(window) = portal.window(p) else {
            unreachable!("in front")
        };
        for i in 0..64u8 {
            let u = Vec2::new(f32::from(i % 8), f32::from(i / 8)) / 7.0;
            let w = (portal.point(u) - p).normalize();
            let Some((uv, _)) = portal.uv(w) else {
                unreachable!("in front")
            };
            let inside = uv.clamp(window.min, window.max);
            assert!(
                uv.distance(inside) < 1e-6,
                "{u} is seen at {uv}, not in {window:?}"
            );
            assert!(portal.direction(uv).0.distance(w) < 1e-6, "round trip");
            assert!(
                portal.is_on_line(p, w) && !portal.is_on_line(p + Vec3::X * 4.0, w),
                "on line"
            );
        }
    }

    /// However large the texels are: one of a map of one has all of the half space.
    #[test]
    fn integrals_of_texels_are_exact() {
        let Some(portal) = Portal::new(SQUARE) else {
            unreachable!("a rectangle")
        };
        const PARTS: u32 = 256;
        for n in [1, 2, 3] {
            for texel in (0..n * n).map(|i| [i % n, i / n]) {
                let (mut direction, mut solid_angle) = (DVec3::ZERO, 0.0);
                for part in (0..PARTS * PARTS).map(|i| [i % PARTS, i / PARTS]) {
                    let at = [0, 1].map(|i| texel[i] as f32 + (part[i] as f32 + 0.5) / 256.0);
                    let (w, density) = portal.direction(Vec2::from(at) / n as f32);
                    let area = f64::from(density) / f64::from(n * n * PARTS * PARTS);
                    direction += portal.frame().to_local(w).as_dvec3() * area;
                    solid_angle += area;
                }
                let (exact, whole) = Portal::texel_integrals(texel, n);
                assert!(
                    exact.distance(direction) < 1e-2 && (whole - solid_angle).abs() < 1e-2,
                    "{texel:?} of {n}: {exact}, {whole}, not {direction}, {solid_angle}"
                );
            }
        }
        let (direction, solid_angle) = Portal::texel_integrals([0, 0], 1);
        let pi = f64::consts::PI;
        assert!(direction.distance(DVec3::Z * pi) < 1e-12, "{direction}");
        assert!((solid_angle - 2.0 * pi).abs() < 1e-12, "{solid_angle}");
    }

    #[test]
    fn lines_that_come_in_low_pass_the_edges() {
        let corners = SQUARE.map(|p| p + Vec3::new(-1.0, 0.3, 2.0));
        let Some(portal) = Portal::new(corners) else {
            unreachable!("a rectangle")
        };
        for i in 0..4096u16 {
            let part = f32::from(i % 64) / 63.0;
            let edge = Vec2::new(f32::from(i / 64 % 2), part);
            let turn = Vec2::from_angle(f32::from(i / 64) * 0.1);
            let w = (turn.extend(0.0) + portal.frame().z * 0.001).normalize();
            for u in [edge, Vec2::new(edge.y, edge.x)] {
                let p = portal.point(u) + w * 8.0;
                assert!(portal.is_on_line(p, -w), "{u} along {w}");
                let aside = w.cross(portal.frame().z).normalize();
                let beyond = (u - 0.5).dot(Vec2::new(aside.x, aside.y)).signum() * 4.0 * aside;
                assert!(!portal.is_on_line(p + beyond, -w), "beside {u} along {w}");
            }
        }
    }
}
