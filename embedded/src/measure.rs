use core::hint::black_box;

use crate::digest::Digest;
use crate::machine;

/// How often each query is asked.
pub(crate) const SAMPLES: u32 = 1000;

/// Asks `query` for each of a thousand inputs, and prints the words of a hash of the answers, the
/// ticks of the shortest query, of all and of the longest, and the bytes of stack that they took.
/// The host counts neither ticks nor stack.
///
/// `words` are the bits of an answer. `inputs` and `words` do not count.
pub(crate) fn measure<I, O, const N: usize>(
    name: &str,
    inputs: impl Fn(u32) -> I,
    mut query: impl FnMut(&I) -> O,
    words: impl Fn(O) -> [u32; N],
) {
    let mut measured = Measured::new();
    for i in 0..SAMPLES {
        // In their places: a copy would count.
        let mut input = inputs(i);
        black_box(&mut input);
        let start = machine::ticks();
        let mut answer = query(&input);
        black_box(&mut answer);
        let ticks = machine::ticks_since(start);
        measured.add(ticks, &words(answer));
    }
    measured.print(name);
}

/// What is known of the queries so far. Its functions are not inlined: all queries share them.
struct Measured {
    digest: Digest,
    least: u32,
    all: u32,
    most: u32,
}

impl Measured {
    #[inline(never)]
    fn new() -> Self {
        machine::paint_stack();
        Self {
            digest: Digest::EMPTY,
            least: u32::MAX,
            all: 0,
            most: 0,
        }
    }

    #[inline(never)]
    fn add(&mut self, ticks: u32, answer: &[u32]) {
        self.least = self.least.min(ticks);
        self.most = self.most.max(ticks);
        self.all += ticks;
        for &word in answer {
            self.digest.add(word);
        }
    }

    #[inline(never)]
    fn print(&self, name: &str) {
        let [high, low] = self.digest.words();
        let stack = machine::stack_used();
        machine::print(name, &[high, low, self.least, self.all, self.most, stack]);
    }
}
