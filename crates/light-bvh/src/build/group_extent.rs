use light_bounds::{LightBounds, LightExtent};
use light_math::Aabb;
use light_math::glam::Vec3;

/// What the builder reads of a group to place it among others, as if it were one light: the mean
/// position and axis of its lights, and their power, above 0; `None` if they are off.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
pub(crate) fn group_extent(mean: Vec3, axis: Vec3, power: Option<f64>) -> LightExtent {
    /// The least length of an axis that the builder groups by.
    const SHORT: f32 = 1e-6;
    let length = axis.length();
    LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(mean),
        // The square of a short axis vanishes, and its direction says little.
        w: if length > SHORT {
            axis * (1.0 / length)
        } else {
            Vec3::Z
        },
        phi: power.map_or(0.0, |power| {
            (power as f32).clamp(f32::MIN_POSITIVE, f32::MAX)
        }),
        // The cone of a diffuse light whose mean axis is as long.
        cos_theta_o: (2.0 * length - 1.0).clamp(-1.0, 1.0),
        cos_theta_e: 0.0,
        two_sided: false,
    })
}
