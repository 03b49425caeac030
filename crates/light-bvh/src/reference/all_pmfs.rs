use light_bounds::{LightId, LightSampleContext};

use super::descend::above_zero;
use super::{Link, ReferenceLightBvhRef, Side};

impl ReferenceLightBvhRef<'_> {
    /// Calls `each` with every light that [`sample`](Self::sample) at `ctx` may return and its
    /// [`pmf`](Self::pmf), to the bit, in the order of the nodes.
    ///
    /// One pass over the nodes, where a pmf of each light takes a logarithm more. Allocates eight
    /// bytes a node.
    pub fn for_each_pmf(&self, ctx: &LightSampleContext, mut each: impl FnMut(LightId, f32)) {
        let weight = |index: usize| self.nodes[index].bounds().importance(self.bounds, ctx);
        // The probability of reaching each node, `None` where no walk gets; it may be too small for
        // a float. Parents come before their children.
        let mut reached = alloc::vec![None; self.nodes.len()];
        if let Some(root) = reached.first_mut() {
            let is_dark_leaf = matches!(self.nodes[0].link(), Link::Leaf(_)) && !(weight(0) > 0.0);
            *root = (!is_dark_leaf).then_some(1.0);
        }
        for (index, node) in self.nodes.iter().enumerate() {
            let Some(pmf) = reached[index] else {
                continue;
            };
            match node.link() {
                Link::Leaf(light) => each(light, above_zero(pmf)),
                Link::Interior { second_child } => {
                    let second = second_child as usize;
                    let fork = self.fork(index, second, |b| b.importance(self.bounds, ctx));
                    for (side, child) in [(Side::First, index + 1), (Side::Second, second)] {
                        let probability = fork.probability(side);
                        reached[child] = (probability != 0.0).then_some(pmf * probability);
                    }
                }
            }
        }
    }
}
