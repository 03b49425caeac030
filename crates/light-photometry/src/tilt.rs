use alloc::vec::Vec;

/// How the output of a luminaire's lamps changes when it is tilted.
#[derive(Clone, Debug, PartialEq)]
pub struct LampTilt {
    angles: Vec<f32>,
    factors: Vec<f32>,
}

impl LampTilt {
    /// The factors at ascending angles in degrees from the measured position; `None` if the angles
    /// do not ascend or the counts differ.
    pub(super) fn new(angles: Vec<f32>, factors: Vec<f32>) -> Option<Self> {
        let ascend = angles.windows(2).all(|pair| pair[0] < pair[1]);
        let fit = ascend && !angles.is_empty() && angles.len() == factors.len();
        fit.then_some(Self { angles, factors })
    }

    /// The relative output at a tilt of `degrees`; beyond the measured angles that of the nearest.
    ///
    /// A [`PhotometricWeb`](super::PhotometricWeb) does not include this factor.
    #[must_use]
    pub fn factor(&self, degrees: f32) -> f32 {
        let above = self.angles.partition_point(|&angle| angle <= degrees);
        let (Some(below), true) = (above.checked_sub(1), above < self.angles.len()) else {
            let nearest = if above == 0 { 0 } else { above - 1 };
            return self.factors[nearest];
        };
        let t = (degrees - self.angles[below]) / (self.angles[above] - self.angles[below]);
        self.factors[below] + t * (self.factors[above] - self.factors[below])
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use super::*;

    #[test]
    fn interpolates_and_holds_the_ends() {
        let tilt = LampTilt::new(vec![0.0, 90.0, 180.0], vec![1.0, 0.8, 0.9]).expect("valid");
        for (degrees, factor) in [
            (-5.0, 1.0),
            (0.0, 1.0),
            (45.0, 0.9),
            (180.0, 0.9),
            (200.0, 0.9),
        ] {
            assert!((tilt.factor(degrees) - factor).abs() < 1e-6, "{degrees}");
        }
        assert_eq!(
            LampTilt::new(vec![0.0, 0.0], vec![1.0, 1.0]),
            None,
            "equal angles"
        );
        assert_eq!(LampTilt::new(vec![], vec![]), None, "nothing");
    }
}
