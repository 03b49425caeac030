use crate::Tolerance;
use glam::{DVec2, DVec3};

/// How far single precision may move an input, relative to its magnitude.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// The number of perturbed inputs that are tried.
const TRIES: u32 = 192;

/// The largest range of the results for perturbed inputs, relative to their magnitude, that counts
/// as continuous.
const CONTINUOUS: f64 = 0.05;

/// The largest relative distance of a result from those for perturbed inputs below and above it, if
/// it is to count as the result for an input between them.
const BETWEEN: f64 = 0.01;

/// The largest quotient of two results for perturbed inputs that still distinguish a result from
/// its double and its half.
const DISTINCT: f64 = 1.5;

/// How far results may move with their inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Conditioning {
    /// Little, or by a step.
    #[default]
    Well,
    /// Far, without steps.
    Ill,
}

/// One way to perturb all inputs of a computation by a few roundings; the first leaves them as they
/// are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Jitter {
    way: u32,
    drawn: u32,
}

impl Jitter {
    pub(crate) const fn new(way: u32) -> Self {
        Self { way, drawn: 0 }
    }

    /// `x` moved relative to itself.
    pub(crate) fn relative(&mut self, x: f64) -> f64 {
        self.by(x, ROUNDING * x.abs())
    }

    /// `x`, a sum of numbers as large as `scale`, moved.
    pub(crate) fn at_scale(&mut self, x: f64, scale: f64) -> f64 {
        self.by(x, ROUNDING * scale)
    }

    /// `x` moved by at most `distance`.
    pub(crate) fn by(&mut self, x: f64, distance: f64) -> f64 {
        if self.way == 0 {
            return x;
        }
        self.drawn += 1;
        x + distance * self.draw()
    }

    /// A point or direction with each coordinate moved at the scale of `scale`.
    pub(crate) fn vector(&mut self, v: DVec3, scale: f64) -> DVec3 {
        v.map(|x| self.at_scale(x, scale))
    }

    /// Random numbers, perturbed within the unit square; zero stays.
    pub(crate) fn numbers(&mut self, u: DVec2) -> DVec2 {
        u.map(|x| self.relative(x).min(1.0 - 0.25 * f64::from(f32::EPSILON)))
    }

    /// One of two values that are both right; the first where nothing is perturbed.
    pub(crate) fn either<T>(&mut self, first: T, second: T) -> T {
        if self.by(0.0, 1.0) <= 0.0 {
            first
        } else {
            second
        }
    }

    /// A number in [-1, 1]; at the ends in every other way.
    fn draw(&self) -> f64 {
        let mut bits = self.way.wrapping_mul(0x9e37_79b9) ^ self.drawn.wrapping_mul(0x85eb_ca6b);
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
        bits = (bits ^ (bits >> 12)).wrapping_mul(0x297a_2d39);
        bits ^= bits >> 15;
        let x = f64::from(bits) / f64::from(u32::MAX) * 2.0 - 1.0;
        if self.way % 2 == 1 { x.signum() } else { x }
    }
}

/// A part of a result under test: a vector, or a number with zeros.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ours {
    pub(crate) answer: DVec3,
    pub(crate) tolerance: Tolerance,
    pub(crate) conditioning: Conditioning,
}

/// Confirms that `ours` is the true result for inputs within rounding error: all parts, each with
/// its tolerance, for one perturbation of the inputs. Otherwise each part is the result of some
/// perturbation, or within the range of all where that is narrow, or a number close between the
/// results of two perturbations.
pub(crate) fn confirm(
    ours: &[Ours],
    truth: impl Fn(&mut Jitter) -> Option<Vec<DVec3>>,
) -> Result<Certainty, String> {
    let mut seen: Vec<Vec<DVec3>> = Vec::new();
    for way in 0..TRIES {
        if let Some(truth) = truth(&mut Jitter::new(way)) {
            if ours
                .iter()
                .zip(&truth)
                .all(|(ours, truth)| ours.accepts(*truth))
            {
                return Ok(Certainty::Determined);
            }
            seen.push(truth);
        }
    }
    let Some(first) = seen.first() else {
        return Err("none".to_owned());
    };
    let range = |i: usize| {
        let all = || seen.iter().map(|truth| truth[i]);
        let low = all().fold(first[i], DVec3::min);
        (low, all().fold(first[i], DVec3::max))
    };
    let mut certainty = Certainty::Determined;
    for (i, part) in ours.iter().enumerate() {
        if seen.iter().any(|truth| part.accepts(truth[i])) {
            continue;
        }
        let (low, high) = range(i);
        if part.is_between(seen.iter().map(|truth| truth[i])) {
            continue;
        }
        match part.is_within(low, high) {
            Some(Certainty::Determined) => {}
            Some(Certainty::Undetermined) => certainty = Certainty::Undetermined,
            None => return Err(format!("{first:?}, part {i} within {low}..{high}")),
        }
    }
    Ok(certainty)
}

/// The least and the largest result over a number of perturbations.
pub(crate) fn range(ways: u32, answer: impl Fn(&mut Jitter) -> f64) -> [f64; 2] {
    let answers = (0..ways).map(|way| answer(&mut Jitter::new(way)));
    answers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
        [low.min(x), high.max(x)]
    })
}

/// Whether inputs determine a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Certainty {
    /// Up to the tolerances.
    Determined,
    /// Rounding of the inputs leaves a wide range.
    Undetermined,
}

impl Ours {
    fn slack(&self, magnitude: f64) -> f64 {
        f64::from(self.tolerance.absolute) + f64::from(self.tolerance.relative) * magnitude
    }

    fn accepts(&self, truth: DVec3) -> bool {
        let near = |ours: f64, truth: f64| {
            (ours - truth).abs() <= self.slack(truth.abs()) || ours == truth
        };
        (0..3).all(|i| near(self.answer[i], truth[i]))
    }

    /// Whether the result is a number close between two of `truths`, and all of them but those of a
    /// miss are alike.
    fn is_between(&self, truths: impl Iterator<Item = DVec3>) -> bool {
        if self.answer.y != 0.0 || self.answer.z != 0.0 {
            return false;
        }
        let ours = self.answer.x;
        let (mut below, mut above) = (0.0, f64::INFINITY);
        let (mut low, mut high) = (f64::INFINITY, 0.0);
        for truth in truths.map(|truth| truth.x).filter(|&truth| truth != 0.0) {
            (low, high) = (truth.min(low), truth.max(high));
            if truth <= ours {
                below = truth.max(below);
            } else {
                above = truth.min(above);
            }
        }
        0.0 < low
            && high <= DISTINCT * low
            && ours - below <= BETWEEN * ours
            && above - ours <= BETWEEN * ours
    }

    /// Whether the result is in the range of all results, and how certain that makes it.
    fn is_within(&self, low: DVec3, high: DVec3) -> Option<Certainty> {
        let magnitude = low.abs().max(high.abs()).length();
        let slack = DVec3::splat(self.slack(magnitude));
        let is_inside =
            (low - slack).cmple(self.answer).all() && self.answer.cmple(high + slack).all();
        let is_narrow = (high - low).length() <= CONTINUOUS * magnitude;
        match self.conditioning {
            _ if !is_inside => None,
            _ if is_narrow => Some(Certainty::Determined),
            Conditioning::Ill => Some(Certainty::Undetermined),
            Conditioning::Well => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_confirmed(ours: f64, truth: impl Fn(&mut Jitter) -> f64) -> bool {
        let ours = Ours {
            answer: DVec3::new(ours, 0.0, 0.0),
            tolerance: Tolerance::new(1e-6, 0.0),
            conditioning: Conditioning::Well,
        };
        let truth = |jitter: &mut Jitter| Some(vec![DVec3::new(truth(jitter), 0.0, 0.0)]);
        confirm(&[ours], truth) == Ok(Certainty::Determined)
    }

    #[test]
    fn steep_answers_are_confirmed_where_moved_inputs_surround_them() {
        // A cosine of 1e-5 that rounds by a twentieth; every other perturbation misses.
        let grazing = |jitter: &mut Jitter| 1.0 / jitter.at_scale(1e-5, 1.0);
        let edge = |jitter: &mut Jitter| match jitter.either(0.0, 1.0) {
            0.0 => 0.0,
            _ => 1.0 / jitter.at_scale(1e-5, 1.0),
        };
        for ours in [0.97e5, 1e5, 1.02e5] {
            assert!(is_confirmed(ours, grazing), "{ours}");
            assert!(is_confirmed(ours, edge), "{ours} on the edge");
        }
        for ours in [0.5e5, 0.9e5, 1.1e5, 2e5, -1e5] {
            assert!(!is_confirmed(ours, grazing), "{ours}");
            assert!(!is_confirmed(ours, edge), "{ours} on the edge");
        }
        // Nothing between the two sides of a step.
        let step = |jitter: &mut Jitter| jitter.either(1.0, 1.2);
        assert!(
            is_confirmed(1.2, step) && !is_confirmed(1.1, step),
            "a step"
        );
        // A range that is too wide confirms nothing.
        let wide = |jitter: &mut Jitter| 1.0 / jitter.at_scale(1e-6, 1.0);
        assert!(!is_confirmed(1.0001e6, wide), "wide");
    }
}
