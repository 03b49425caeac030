/// How much of a surface emits where its mask has a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MaskShare {
    /// As much as the value.
    Linear,
    /// As much as this factor, which is above 0, times the value, and at most all of it.
    AtMostOne(f64),
    /// All of it where the value is at least this, which is above 0; else nothing.
    Cutoff(f64),
}

impl MaskShare {
    pub(crate) fn of(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::AtMostOne(scale) => (value * scale).min(1.0),
            Self::Cutoff(least) => f64::from(u8::from(value >= least)),
        }
    }

    /// The value above `least`, up to `most`, at which the share bends or jumps.
    pub(crate) fn bend(self, least: f64, most: f64) -> Option<f64> {
        let bend = match self {
            Self::Linear => return None,
            Self::AtMostOne(scale) => 1.0 / scale,
            Self::Cutoff(bend) => bend,
        };
        (least < bend && bend <= most).then_some(bend)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_values() {
        let of = |share: MaskShare| [0.0, 0.25, 0.5, 2.0].map(|value| share.of(value));
        assert_eq!(of(MaskShare::Linear), [0.0, 0.25, 0.5, 2.0], "the value");
        assert_eq!(
            of(MaskShare::AtMostOne(1.5)),
            [0.0, 0.375, 0.75, 1.0],
            "scaled"
        );
        assert_eq!(
            of(MaskShare::Cutoff(0.5)),
            [0.0, 0.0, 1.0, 1.0],
            "all or nothing"
        );
    }

    /// Where all values are on one side of the bend, the share is a polynomial and needs no cut.
    #[test]
    fn only_values_on_both_sides_of_a_bend_are_cut() {
        let found = |share: MaskShare| {
            let spans = [(0.1, 0.4), (0.1, 0.5), (0.1, 0.9), (0.5, 0.9), (0.6, 0.9)];
            spans.map(|(least, most)| share.bend(least, most))
        };
        let expected = [None, Some(0.5), Some(0.5), None, None];
        assert_eq!(found(MaskShare::Cutoff(0.5)), expected, "a jump at 0.5");
        assert_eq!(found(MaskShare::AtMostOne(2.0)), expected, "full at 0.5");
        assert_eq!(found(MaskShare::Linear), [None; 5], "nowhere");
    }
}
