//! Choices by whole parts: in double precision how many parts a weight owns, and in integers which
//! index a random number leads to.

/// The parts of one choice.
pub(crate) const PARTS: i64 = 1 << 16;

/// The most weights of one choice.
const GROUP: usize = 64;

/// What single precision moves a sum by with each addition.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

/// The fewest and the most parts of each of at most 64 weights.
///
/// Each weight is known from its first number to its second, and is the sum of at most `terms`
/// floats. One part goes to each positive weight, those that are left after the others have been
/// shared in proportion go to the first one.
pub(crate) fn parts(weights: &[[f64; 2]], terms: usize) -> Vec<[i64; 2]> {
    let count = weights.len() as i64;
    let all = (PARTS - count) as f64;
    let sum = |end: usize, without: usize| {
        let others = weights
            .iter()
            .enumerate()
            .filter(|other| other.0 != without);
        others.map(|other| other.1[end]).sum::<f64>()
    };
    let sums = [0, 1].map(|end| sum(end, weights.len()));
    // Of the additions, of the quotient by the sum, and of the product.
    let error = (weights.len() + terms) as f64 * ROUNDING;
    let own = |(index, weight): (usize, &[f64; 2])| {
        [0, 1].map(|end| {
            if weight[end] <= 0.0 {
                return 0;
            }
            let others = if sums[1].is_finite() {
                sums[1 - end] - weight[1 - end]
            } else {
                sum(1 - end, index)
            };
            let share = match (weight[end].is_infinite(), others.is_infinite()) {
                // A light at the point itself outweighs all others.
                (true, true) => [0.0, 1.0][end],
                (true, false) => 1.0,
                (false, _) => (weight[end] / (weight[end] + others)).min(1.0),
            };
            let moved = 1.0 + [-error, error][end];
            1 + (share * all * moved).floor() as i64
        })
    };
    let own: Vec<_> = weights.iter().enumerate().map(own).collect();
    let mut parts = own.clone();
    for (i, part) in parts.iter_mut().enumerate() {
        let before = &own[..i];
        let may_be_first = part[1] > 0 && before.iter().all(|other| other[0] == 0);
        let is_first = part[0] > 0 && before.iter().all(|other| other[1] == 0);
        if !may_be_first {
            continue;
        }
        let others = |end: usize| {
            let all: i64 = own.iter().map(|other| other[end]).sum();
            all - own[i][end]
        };
        // No more is left over than one part for each weight.
        let most = (PARTS - others(0)).min(part[1] + count);
        let fewest = (PARTS - others(1)).max(part[0]);
        *part = if is_first {
            [fewest, most]
        } else {
            [part[0].min(fewest), part[1].max(most)]
        };
    }
    parts
}

/// The least and the largest probability of weight `index` among any number of weights, which are
/// chosen by groups of groups of equal length, at most 64 at a time.
pub(crate) fn probability(weights: &[[f64; 2]], index: usize) -> [f64; 2] {
    let len = weights.len().div_ceil(GROUP).max(1);
    let sum = |group: &[[f64; 2]]| [0, 1].map(|end| group.iter().map(|w| w[end]).sum());
    let groups: Vec<_> = weights.chunks(len).map(sum).collect();
    let parts = parts(&groups, len)[index / len];
    let among = parts.map(|parts| parts as f64 / PARTS as f64);
    if len == 1 {
        return among;
    }
    let group = weights.chunks(len).nth(index / len).unwrap_or(&[]);
    let within = probability(group, index % len);
    [among[0] * within[0], among[1] * within[1]]
}

/// The fewest and the most parts of 2^-16 of a bin that each weight owns in an alias table of as
/// many bins: one of a positive weight, and its share of the others by rounded running sums.
pub(crate) fn alias_parts(weights: &[f32]) -> Vec<[i64; 2]> {
    let total: f64 = weights.iter().map(|&w| f64::from(w)).sum();
    let positive = weights.iter().filter(|&&w| w > 0.0).count();
    let shared = (weights.len() as i64 * PARTS - positive as i64) as f64;
    // Of the two sums, the quotient and the product in double precision.
    let error = (weights.len() + 3) as f64 * f64::EPSILON;
    let (mut sum, mut given) = (0.0, [0, 0]);
    let parts = weights.iter().map(|&weight| {
        if weight <= 0.0 {
            return [0, 0];
        }
        sum += f64::from(weight);
        let up_to = sum / total * shared;
        let now = [1.0 - error, 1.0 + error].map(|e| (up_to * e + 0.5).floor() as i64);
        let parts = [1 + now[0] - given[1], 1 + now[1] - given[0]];
        given = now;
        parts
    });
    parts.collect()
}

/// The index in whose parts `u`, a fraction of 2^64, falls, and how far it falls into them; none if
/// the parts end before.
pub(crate) fn choose(parts: &[i64], u: u64) -> Option<(usize, u64)> {
    let mut place = u128::from(u) * PARTS as u128;
    for (index, &parts) in parts.iter().enumerate() {
        let width = u128::try_from(parts).ok()? << 64;
        if place < width {
            return Some((index, (place / parts as u128) as u64));
        }
        place -= width;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_by_hand() {
        let exactly =
            |weights: &[f64]| parts(&weights.iter().map(|&w| [w, w]).collect::<Vec<_>>(), 1);
        // 65533 shared as 1 to 3: 16383.25 and 49149.75; two parts are left.
        assert_eq!(
            exactly(&[1.0, 0.0, 3.0]),
            [[16386; 2], [0; 2], [49150; 2]],
            "1 to 3"
        );
        assert_eq!(exactly(&[0.0, 2.0]), [[0; 2], [65536; 2]], "one alone");
        // 65534 in halves is a whole number, which rounding may miss.
        assert_eq!(
            exactly(&[1.0, 1.0]),
            [[32768, 32769], [32767, 32768]],
            "alike"
        );
        let open = parts(&[[0.0, 1.0], [1.0, 1.0]], 1);
        assert_eq!(open[0], [0, 32769], "perhaps none");
    }

    #[test]
    fn alias_parts_by_hand() {
        // 196606 shared as 1 to 3: up to 49151.5 and 196606.
        assert_eq!(
            alias_parts(&[1.0, 0.0, 3.0]),
            [[49152, 49153], [0, 0], [147455, 147456]],
            "a half is rounded either way"
        );
        assert_eq!(alias_parts(&[2.0]), [[65536; 2]], "one alone");
    }

    #[test]
    fn a_choice_by_hand() {
        let parts = [1 << 15, 0, 1 << 14, 1 << 14];
        assert_eq!(choose(&parts, 3 << 62), Some((3, 0)), "three quarters");
        assert_eq!(
            choose(&parts, 1 << 62),
            Some((0, 1 << 63)),
            "half of the half"
        );
        assert_eq!(choose(&parts, u64::MAX).map(|c| c.0), Some(3), "the last");
        assert_eq!(choose(&[1], 1 << 63), None, "beyond");
    }
}
