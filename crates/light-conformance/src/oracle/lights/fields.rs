//! Fields of a line, in double precision.

use crate::{Case, Malformed};
use glam::{DMat3, DVec3};

/// Linear part and origin of a transform.
pub(super) fn transform(matrix: &Case<'_>) -> Result<(DMat3, DVec3), Malformed> {
    let m = matrix.float_array::<16>()?.map(f64::from);
    let column = |i: usize| DVec3::new(m[i], m[4 + i], m[8 + i]);
    Ok((DMat3::from_cols(column(0), column(1), column(2)), column(3)))
}

pub(super) fn point(case: &Case<'_>) -> Result<DVec3, Malformed> {
    Ok(case.vec3()?.as_dvec3())
}

pub(super) fn number(case: &Case<'_>, name: &str) -> Result<f64, Malformed> {
    Ok(f64::from(case.get(name)?.float()?))
}
