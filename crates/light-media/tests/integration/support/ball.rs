//! A scene of one ball.

use light_math::glam::{Vec2, Vec3};
use light_media::{FirstHit, Intersection, Visibility};
use light_sources::SurfacePoint;

/// The centre of the ball.
pub(crate) const CENTRE: Vec3 = Vec3::new(0.4, 0.0, 2.0);

/// Its radius.
pub(crate) const RADIUS: f32 = 1.2;

/// One emissive ball, the light 0, and nothing else.
pub(crate) struct Ball;

impl Ball {
    /// The distance at which a ray from outside meets it.
    pub(crate) fn distance(from: Vec3, wi: Vec3) -> Option<f32> {
        let to = CENTRE - from;
        let along = to.dot(wi);
        let root = along * along - to.length_squared() + RADIUS * RADIUS;
        (root > 0.0 && along > 0.0).then(|| along - root.sqrt())
    }
}

impl Visibility for Ball {
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool {
        let way = to - from;
        let hit = Self::distance(from, way.normalize());
        hit.is_none_or(|t| t > way.length() * 0.999)
    }
}

impl Intersection for Ball {
    fn first(&self, from: Vec3, wi: Vec3) -> FirstHit {
        let Some(t) = Self::distance(from, wi) else {
            return FirstHit::Nothing;
        };
        let p = from + wi * t;
        let at = SurfacePoint {
            p,
            n: (p - CENTRE).normalize(),
            uv: Vec2::ZERO,
        };
        FirstHit::Light(light_bounds::LightId(0), at)
    }
}
