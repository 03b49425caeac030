use crate::medium::{MajorantSegment, Majorants};
use light_math::float;
use light_sources::Radiance;

/// The tentative collisions along a ray: a Poisson process with the majorant as its rate. Trackers
/// decide at each of them whether the collision is real.
#[derive(Clone, Debug)]
pub(crate) struct TentativeCollisions<'a> {
    segments: Majorants<'a>,
    here: Option<MajorantSegment>,
}

/// A tentative collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Collision {
    /// Distance along the ray.
    pub(crate) t: f32,
    /// The bound of the extinction there, above zero.
    pub(crate) sigma_maj: f32,
}

impl<'a> TentativeCollisions<'a> {
    pub(crate) fn new(mut segments: Majorants<'a>) -> Self {
        let here = segments.next();
        Self { segments, here }
    }

    /// The next collision; `None` when the ray leaves the last segment first.
    ///
    /// One random number is enough for any number of segments: it gives the optical thickness at
    /// which the collision happens.
    pub(crate) fn next(&mut self, next_u: &mut impl FnMut() -> f32) -> Option<Collision> {
        self.here?;
        let mut thickness = -float::ln(1.0 - next_u());
        while let Some(MajorantSegment { span, sigma_maj }) = &mut self.here {
            let crossed = *sigma_maj * span.length();
            // Weights are divided by the bound; the reciprocal of a subnormal one overflows:
            // nothing happens there.
            if thickness < crossed && *sigma_maj >= f32::MIN_POSITIVE {
                // The quotient is at most the length, also when rounded.
                let t = span.t0 + thickness / *sigma_maj;
                span.t0 = t;
                return Some(Collision {
                    t,
                    sigma_maj: *sigma_maj,
                });
            }
            thickness -= crossed;
            self.here = self.segments.next();
        }
        None
    }
}

/// One minus extinction over majorant: the probability of a null collision.
#[inline]
pub(crate) fn null_share<R: Radiance>(sigma_t: R, sigma_maj: f32) -> R {
    (sigma_t * (-1.0 / sigma_maj)).map(|x| (1.0 + x).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::Span;

    #[test]
    fn collisions_use_up_their_thickness_across_segments() {
        let span = Span { t0: 1.0, t1: 5.0 };
        let mut collisions = TentativeCollisions::new(Majorants::constant(span, 0.5));
        let half = |n: i32| 1.0 - float::exp(-0.5 * n as f32);
        let first = collisions.next(&mut || half(3)).expect("within");
        assert!((first.t - 4.0).abs() < 1e-5, "three units on: {first:?}");
        assert_eq!(collisions.next(&mut || half(2)), None, "beyond the end");
        assert_eq!(collisions.next(&mut || 0.0), None, "and it stays there");
    }

    #[test]
    fn vacuum_without_end_is_crossed() {
        let span = Span {
            t0: 0.0,
            t1: f32::INFINITY,
        };
        let mut collisions = TentativeCollisions::new(Majorants::constant(span, 0.0));
        assert_eq!(collisions.next(&mut || 0.999_999_9), None, "nothing there");
    }

    /// Numbers that reach the end of a segment up to rounding.
    #[test]
    fn collisions_stay_in_their_segment() {
        let mut rng = light_testkit::Rng::new(71);
        for _ in 0..20_000 {
            let (t0, length) = (rng.log_range(1e-2, 1e2), rng.log_range(1e-2, 1e2));
            let sigma = rng.log_range(0.1, 1.0) / length;
            let span = Span {
                t0,
                t1: t0 + length,
            };
            let crossed = sigma * span.length();
            let thickness = float::next_down(crossed);
            // The number whose logarithm comes nearest from below.
            let mut u = 1.0 - float::exp(-thickness);
            while -float::ln(1.0 - u) >= crossed {
                u = float::next_down(u);
            }
            let mut collisions = TentativeCollisions::new(Majorants::constant(span, sigma));
            let found = collisions.next(&mut || u).expect("within");
            assert!(found.t <= span.t1, "{found:?} beyond {span:?}");
        }
    }

    #[test]
    fn an_extinction_above_its_bound_by_rounding_leaves_nothing() {
        use light_math::glam::Vec3;
        let above = Vec3::new(float::next_up(0.7), 0.35, 0.0);
        let share = null_share(above, 0.7);
        assert_eq!((share.x, share.z), (0.0, 1.0), "{share}");
        assert!((share.y - 0.5).abs() < 1e-6, "{share}");
    }
}
