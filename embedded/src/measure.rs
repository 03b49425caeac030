use core::hint::black_box;

use crate::digest::Digest;
use crate::machine;

/// How often each query is asked.
pub(crate) const SAMPLES: u32 = 1000;

/// Asks `query` for each of a thousand inputs, and prints a hash of the answers, and on a bare
/// machine the ticks and the bytes of stack that they took.
///
/// `words` are the bits of an answer. `inputs` and `words` do not count.
pub(crate) fn measure<I, O, const N: usize>(
    name: &str,
    inputs: impl Fn(u32) -> I,
    mut query: impl FnMut(I) -> O,
    words: impl Fn(O) -> [u32; N],
) {
    machine::paint_stack();
    let mut digest = Digest::EMPTY;
    let [mut least, mut all, mut most] = [u32::MAX, 0, 0];
    for i in 0..SAMPLES {
        let input = inputs(i);
        let start = machine::ticks();
        let answer = black_box(query(black_box(input)));
        let ticks = machine::ticks_since(start);
        least = least.min(ticks);
        most = most.max(ticks);
        all += ticks;
        for word in words(answer) {
            digest.add(word);
        }
    }
    machine::print_hash(name, digest.bits());
    machine::print_cost(name, [least, all, most], machine::stack_used());
}
