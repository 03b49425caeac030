use crate::LightSampleContext;
use crate::glam::Vec3;

/// The data of a context that [importance](crate::LightBounds::importance) reads, prepared once for
/// many bounds.
///
/// A traversal of a hierarchy evaluates the importance of many bounds at one context; the normal is
/// normalised once here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImportanceQuery {
    pub(crate) p: Vec3,
    /// `None` in a medium.
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
