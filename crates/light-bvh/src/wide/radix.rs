//! Sorting by key from the top digit down: every digit makes parts that are sorted apart from each other.

use alloc::vec;
use alloc::vec::Vec;

use super::morton::Entry;
use crate::join::{map, table};

/// Bits of a digit.
const DIGIT: u32 = 11;

/// So few entries are sorted by comparing them.
const FEW: usize = 1024;

/// Entries that are put in the order of a digit in one go.
pub(super) const CHUNK: usize = 1 << 15;

/// Sorts `entries`, whose lights are in ascending order.
pub(super) fn sort(entries: &mut [Entry]) {
    if entries.len() <= FEW {
        sort_few(entries);
    } else {
        let chunks = entries.chunks(CHUNK).map(<[Entry]>::to_vec);
        entries.copy_from_slice(&sorted(chunks.collect()));
    }
}

/// The same for at most [`FEW`]: by a short digit first, which leaves little to be compared.
fn sort_few(entries: &mut [Entry]) {
    /// Fewer are compared at once.
    const VERY_FEW: usize = 32;
    const SHORT: u32 = 8;
    if entries.len() <= VERY_FEW {
        return sort_by_comparing(entries);
    }
    let first = entries[0].key;
    let differing = entries.iter().fold(0, |bits, e| bits | (e.key ^ first));
    let Some(top) = u64::checked_ilog2(differing) else {
        return;
    };
    let mut piles = [Entry::default(); FEW];
    let piles = &mut piles[..entries.len()];
    let mut ends = [0; 1 << SHORT];
    pile(entries, (top + 1).saturating_sub(SHORT), piles, &mut ends);
    entries.copy_from_slice(piles);
    let mut start = 0;
    for end in ends {
        sort_by_comparing(&mut entries[start..end]);
        start = end;
    }
}

/// The same for a few, mostly a handful.
#[inline]
fn sort_by_comparing(entries: &mut [Entry]) {
    /// Fewer are put in order one by one.
    const HANDFUL: usize = 12;
    if entries.len() > HANDFUL {
        return entries.sort_unstable_by_key(|e| (e.key, e.light));
    }
    for end in 1..entries.len() {
        let entry = entries[end];
        let mut place = end;
        while place > 0 && entries[place - 1].key > entry.key {
            entries[place] = entries[place - 1];
            place -= 1;
        }
        entries[place] = entry;
    }
}

/// All entries in the order of their keys, those of one key in the order of the lights, as they come.
pub(super) fn sorted(chunks: Vec<Vec<Entry>>) -> Vec<Entry> {
    let Some(shift) = top_digit(&chunks) else {
        return chunks.concat();
    };
    let piles = map(chunks, |chunk| Piles::new(&chunk, shift));
    let mut out = table(piles.iter().map(|p| p.entries.len()).sum(), |_| {
        Entry::default()
    });
    let mut rest = &mut *out;
    let mut parts = Vec::new();
    for digit in 0..1 << DIGIT {
        let count = piles.iter().map(|p| p.get(digit).len()).sum();
        let (part, behind) = core::mem::take(&mut rest).split_at_mut(count);
        rest = behind;
        if count > 0 {
            parts.push((digit, part));
        }
    }
    map(parts, |(digit, part): (usize, &mut [Entry])| {
        let entries = piles.iter().flat_map(|p| p.get(digit));
        part.iter_mut().zip(entries).for_each(|(to, e)| *to = *e);
        sort(part);
    });
    out
}

/// How far right a key is shifted to leave the highest digit in which entries differ; `None` if all keys agree.
fn top_digit(chunks: &[Vec<Entry>]) -> Option<u32> {
    let first = chunks.iter().flatten().next()?.key;
    let differing = map(chunks.iter().collect(), |chunk: &Vec<Entry>| {
        chunk.iter().fold(0, |bits, e| bits | (e.key ^ first))
    });
    let differing = differing.into_iter().fold(0, |all, bits| all | bits);
    Some((u64::checked_ilog2(differing)? + 1).saturating_sub(DIGIT))
}

/// Entries by a digit of their keys.
struct Piles {
    /// In the order of the digit, otherwise as they came.
    entries: Vec<Entry>,
    /// Where the entries of each digit end.
    ends: Vec<usize>,
}

impl Piles {
    fn new(chunk: &[Entry], shift: u32) -> Self {
        let mut ends = vec![0; 1 << DIGIT];
        let mut entries = vec![Entry::default(); chunk.len()];
        pile(chunk, shift, &mut entries, &mut ends);
        Self { entries, ends }
    }

    fn get(&self, digit: usize) -> &[Entry] {
        let start = digit.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.entries[start..self.ends[digit]]
    }
}

/// Puts `entries` into the order of the digit that `shift` leaves at the right, and tells where those of each digit end; of `ends`,
/// all 0, there are as many as digits, a power of two.
#[inline]
fn pile(entries: &[Entry], shift: u32, piles: &mut [Entry], ends: &mut [usize]) {
    let mask = ends.len() - 1;
    #[expect(clippy::cast_possible_truncation, reason = "masked to a digit")]
    let digit = |entry: &Entry| (entry.key >> shift) as usize & mask;
    for entry in entries {
        ends[digit(entry)] += 1;
    }
    let mut end = 0;
    for next in &mut *ends {
        // The start of each pile, which moves on to its end as the pile grows.
        (*next, end) = (end, end + *next);
    }
    for entry in entries {
        let next = &mut ends[digit(entry)];
        piles[*next] = *entry;
        *next += 1;
    }
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
        assert_eq!(sorted(chunks), expected, "{} entries", entries.len());
    }

    #[test]
    fn any_keys_are_sorted_and_equal_ones_keep_their_order() {
        let scramble = |i: u64| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 1;
        for n in [0, 1, 2, 20, 100, 1000, 20_000] {
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
