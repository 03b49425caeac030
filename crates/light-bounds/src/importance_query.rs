use crate::LightSampleContext;
use crate::glam::Vec3;

/// What [importance](crate::LightBounds::importance) reads of a context, prepared once for many
/// bounds.
///
/// A walk through a hierarchy asks for the importance of many bounds at one context: the direction
/// of its normal is found once here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImportanceQuery {
    pub(crate) p: Vec3,
    /// None in a medium.
    pub(crate) unit_ns: Option<Vec3>,
}

impl ImportanceQuery {
    /// The query of `ctx`: its point, and its [`unit_ns`](LightSampleContext::unit_ns).
    #[inline]
    #[must_use]
    pub fn new(ctx: &LightSampleContext) -> Self {
        Self {
            p: ctx.p,
            unit_ns: ctx.unit_ns(),
        }
    }
}
