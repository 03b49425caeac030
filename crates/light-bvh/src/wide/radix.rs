//! Sorting by key from the top digit down: every digit makes parts that are sorted apart from each other.

use alloc::vec;
use alloc::vec::Vec;

use super::morton::Entry;
use crate::join::map;

/// Bits of a digit.
const DIGIT: u32 = 11;

/// So few entries are sorted by comparing them.
const FEW: usize = 1024;

/// All entries in the order of their keys, those of one key in the order of the lights, as they come.
pub(super) fn sorted(chunks: &[Vec<Entry>]) -> Vec<Entry> {
    let entries = || chunks.iter().flatten();
    let mut out = vec![Entry::default(); entries().count()];
    let Some(shift) = top_digit(entries()) else {
        entries().zip(&mut out).for_each(|(e, to)| *to = *e);
        return out;
    };
    let parts = scatter(entries(), shift, &mut out);
    map(parts, sort);
    out
}

/// Sorts `entries`, whose lights are in ascending order.
pub(super) fn sort(entries: &mut [Entry]) {
    if entries.len() <= FEW {
        entries.sort_unstable_by_key(|e| (e.key, e.light));
        return;
    }
    if let Some(shift) = top_digit(entries.iter()) {
        let from = entries.to_vec();
        map(scatter(from.iter(), shift, entries), sort);
    }
}

/// How far right a key is shifted to leave the highest digit in which entries differ; `None` if all keys agree.
fn top_digit<'e>(mut entries: impl Iterator<Item = &'e Entry>) -> Option<u32> {
    let first = entries.next()?.key;
    let differing = entries.fold(0, |bits, e| bits | (e.key ^ first));
    Some((differing.checked_ilog2()? + 1).saturating_sub(DIGIT))
}

#[expect(clippy::cast_possible_truncation, reason = "masked to a digit")]
const fn digit(key: u64, shift: u32) -> usize {
    (key >> shift) as usize & ((1 << DIGIT) - 1)
}

/// Copies the entries to `out` in the order of a digit, and returns the parts that agree in it and are not single.
fn scatter<'e, 'o>(
    entries: impl Iterator<Item = &'e Entry> + Clone,
    shift: u32,
    out: &'o mut [Entry],
) -> Vec<&'o mut [Entry]> {
    let mut ends = [0; 1 << DIGIT];
    for entry in entries.clone() {
        ends[digit(entry.key, shift)] += 1;
    }
    let mut end = 0;
    for next in &mut ends {
        // The start of each part, which moves on to its end as the part fills.
        (*next, end) = (end, end + *next);
    }
    for entry in entries {
        let next = &mut ends[digit(entry.key, shift)];
        out[*next] = *entry;
        *next += 1;
    }
    let (mut rest, mut start) = (out, 0);
    let mut parts = Vec::new();
    for end in ends {
        let (part, behind) = rest.split_at_mut(end - start);
        (rest, start) = (behind, end);
        if part.len() > 1 {
            parts.push(part);
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(n: u32, key: impl Fn(u64) -> u64) -> Vec<Entry> {
        let entry = |light| Entry {
            key: key(u64::from(light)),
            light,
            power: 1.0,
        };
        (0..n).map(entry).collect()
    }

    fn check(entries: &[Entry]) {
        let mut expected = entries.to_vec();
        expected.sort_by_key(|e| e.key);
        let chunks: Vec<Vec<Entry>> = entries.chunks(777).map(<[Entry]>::to_vec).collect();
        assert_eq!(sorted(&chunks), expected, "{} entries", entries.len());
    }

    #[test]
    fn any_keys_are_sorted_and_equal_ones_keep_their_order() {
        let scramble = |i: u64| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 1;
        for n in [0, 1, 2, 1000, 20_000] {
            check(&entries(n, scramble));
            check(&entries(n, |i| scramble(i) >> 50));
            check(&entries(n, |i| scramble(i) & 7 | 1 << 62));
            check(&entries(n, |_| 5));
            check(&entries(n, |i| {
                if i == 3 {
                    0
                } else {
                    1 << 60 | scramble(i) >> 30
                }
            }));
        }
    }
}
