//! Radix sort by key, most significant digit first: the buckets of a digit are sorted
//! independently.

use alloc::vec;
use alloc::vec::Vec;

use crate::build::morton_entry::MortonEntry;
use crate::parallel::{map, table};

/// Bits of a digit.
const DIGIT: u32 = 11;

/// Entries that one job distributes by a digit.
pub(crate) const CHUNK: usize = 1 << 15;

/// Sorts `entries`, whose lights are in ascending order.
pub(crate) fn sort(entries: &mut [MortonEntry]) {
    if entries.len() <= COMPARISON_SORT_MAX {
        sort_by_comparing(entries);
    } else if entries.len() <= CHUNK {
        sort_into(&mut entries.to_vec(), entries);
    } else {
        let chunks = entries.chunks(CHUNK).map(<[MortonEntry]>::to_vec);
        entries.copy_from_slice(&sorted(chunks.collect()));
    }
}

/// At most so many are sorted by comparison.
const COMPARISON_SORT_MAX: usize = 32;

/// Makes `to` what `from` is when sorted; `from` is scratch memory afterwards.
fn sort_into(from: &mut [MortonEntry], to: &mut [MortonEntry]) {
    /// More entries use a full digit, fewer a short one, whose buckets are small.
    const MANY: usize = 1024;
    const SHORT: u32 = 8;
    let first = from.first().map_or(0, |e| e.key);
    let differing = from.iter().fold(0, |bits, e| bits | (e.key ^ first));
    let top = match u64::checked_ilog2(differing) {
        Some(top) if from.len() > COMPARISON_SORT_MAX => top + 1,
        _ => {
            to.copy_from_slice(from);
            return sort_by_comparing(to);
        }
    };
    if from.len() > MANY {
        let ends = bucket(from, top.saturating_sub(DIGIT), to, [0; 1 << DIGIT]);
        sort_buckets(&ends, from, to);
    } else {
        let ends = bucket(from, top.saturating_sub(SHORT), to, [0; 1 << SHORT]);
        sort_buckets(&ends, from, to);
    }
}

/// Sorts the parts of `entries` that end at `ends`; there is as much `room`.
fn sort_buckets(ends: &[usize], room: &mut [MortonEntry], entries: &mut [MortonEntry]) {
    let mut start = 0;
    for &end in ends {
        let bucket = &mut entries[start..end];
        if bucket.len() <= COMPARISON_SORT_MAX {
            sort_by_comparing(bucket);
        } else {
            let room = &mut room[..bucket.len()];
            room.copy_from_slice(bucket);
            sort_into(room, bucket);
        }
        start = end;
    }
}

/// The same for few entries.
#[inline]
fn sort_by_comparing(entries: &mut [MortonEntry]) {
    /// At most so many are sorted by insertion.
    const INSERTION_SORT_MAX: usize = 12;
    if entries.len() > INSERTION_SORT_MAX {
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

/// All entries in the order of their keys, those of one key in the order of the lights, as they
/// come.
pub(crate) fn sorted(chunks: Vec<Vec<MortonEntry>>) -> Vec<MortonEntry> {
    /// Entries of a job.
    const JOB: usize = 1 << 13;
    let Some(shift) = top_digit(&chunks) else {
        return chunks.concat();
    };
    let buckets = map(chunks, |chunk| Buckets::new(&chunk, shift));
    let mut out = table(buckets.iter().map(|p| p.entries.len()).sum(), |_| {
        MortonEntry::default()
    });
    let mut rest = &mut *out;
    let (mut jobs, mut job, mut entries) = (Vec::new(), Vec::new(), 0);
    for digit in 0..1 << DIGIT {
        let count: usize = buckets.iter().map(|p| p.get(digit).len()).sum();
        let (part, behind) = core::mem::take(&mut rest).split_at_mut(count);
        rest = behind;
        if count > 0 {
            job.push((digit, part));
            entries += count;
        }
        if entries >= JOB {
            jobs.push(core::mem::take(&mut job));
            entries = 0;
        }
    }
    jobs.push(job);
    map(jobs, |job: Vec<(usize, &mut [MortonEntry])>| {
        let mut room = Vec::new();
        for (digit, part) in job {
            room.clear();
            for buckets in &buckets {
                room.extend_from_slice(buckets.get(digit));
            }
            if part.len() > CHUNK {
                part.copy_from_slice(&room);
                sort(part);
            } else {
                sort_into(&mut room, part);
            }
        }
    });
    out
}

/// How far right a key is shifted to leave the highest digit in which entries differ; `None` if all
/// keys agree.
fn top_digit(chunks: &[Vec<MortonEntry>]) -> Option<u32> {
    let first = chunks.iter().flatten().next()?.key;
    let differing = map(chunks.iter().collect(), |chunk: &Vec<MortonEntry>| {
        chunk.iter().fold(0, |bits, e| bits | (e.key ^ first))
    });
    let differing = differing.into_iter().fold(0, |all, bits| all | bits);
    Some((u64::checked_ilog2(differing)? + 1).saturating_sub(DIGIT))
}

/// Entries by a digit of their keys.
struct Buckets {
    /// In the order of the digit, otherwise as they came.
    entries: Vec<MortonEntry>,
    /// Where the entries of each digit end.
    ends: [usize; 1 << DIGIT],
}

impl Buckets {
    fn new(chunk: &[MortonEntry], shift: u32) -> Self {
        let mut entries = vec![MortonEntry::default(); chunk.len()];
        let ends = bucket(chunk, shift, &mut entries, [0; 1 << DIGIT]);
        Self { entries, ends }
    }

    fn get(&self, digit: usize) -> &[MortonEntry] {
        let start = digit.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.entries[start..self.ends[digit]]
    }
}

/// Puts `entries` into the order of the digit that `shift` leaves at the right, and returns where
/// those of each digit end; of `ends`, all 0, there are as many as digits, a power of two.
#[inline]
fn bucket<const DIGITS: usize>(
    entries: &[MortonEntry],
    shift: u32,
    buckets: &mut [MortonEntry],
    mut ends: [usize; DIGITS],
) -> [usize; DIGITS] {
    #[expect(clippy::cast_possible_truncation, reason = "masked to a digit")]
    let digit = |entry: &MortonEntry| (entry.key >> shift) as usize & (DIGITS - 1);
    for entry in entries {
        ends[digit(entry)] += 1;
    }
    let mut end = 0;
    for next in &mut ends {
        // The start of each bucket, which moves on to its end as the bucket grows.
        (*next, end) = (end, end + *next);
    }
    for entry in entries {
        let next = &mut ends[digit(entry)];
        buckets[*next] = *entry;
        *next += 1;
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(n: u32, key: impl Fn(u64) -> u64) -> Vec<MortonEntry> {
        let entry = |light| MortonEntry {
            key: key(u64::from(light)),
            light,
            power: 1.0,
        };
        (0..n).map(entry).collect()
    }

    fn check(entries: &[MortonEntry]) {
        let mut expected = entries.to_vec();
        expected.sort_by_key(|e| e.key);
        let chunks: Vec<Vec<MortonEntry>> =
            entries.chunks(777).map(<[MortonEntry]>::to_vec).collect();
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
