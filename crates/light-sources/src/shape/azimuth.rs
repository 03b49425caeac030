use core::f32::consts::TAU;

use crate::glam::Vec3;
use light_math::float::{ONE_MINUS_EPSILON, atan2};

/// The angle around the axis z of the point at `p`, as a part of a full turn, in `[0, 1)`.
pub(super) fn azimuth(p: Vec3) -> f32 {
    let turn = atan2(p.y, p.x) / TAU;
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    turn.min(ONE_MINUS_EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuths_stay_below_a_full_turn() {
        let turns = [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y].map(azimuth);
        assert_eq!(turns, [0.0, 0.25, 0.5, 0.75], "quarters");
        // An angle so little below the axis x that its part of a turn rounds to 1.
        for y in [1e-9, 1e-20, f32::MIN_POSITIVE] {
            assert_eq!(azimuth(Vec3::new(1.0, -y, 0.0)), ONE_MINUS_EPSILON, "{y}");
        }
    }
}
