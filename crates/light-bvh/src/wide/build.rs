use alloc::vec;
use alloc::vec::Vec;

use light_bounds::LightBounds;

use super::moments::Moments;
use super::node::{WIDTH, WideNode};
use super::prim::{Prim, Run};
use super::split::{centers, halve, split};
use super::tree::MAX_DEPTH;

/// Lights below which a subtree is built by one thread.
#[cfg(feature = "rayon")]
const FORK: usize = 4096;

/// A subtree in the making: its root apart from the nodes below it, which refer to each other by their place in `below`.
pub(crate) struct Subtree {
    pub(crate) root: WideNode,
    pub(crate) below: Vec<WideNode>,
    pub(crate) moments: Moments,
}

/// What all steps of a build share.
pub(crate) struct Build<'a, F: Fn(u32) -> &'a LightBounds + Sync> {
    /// The bounds of a light by its id.
    pub(crate) bounds: F,
    /// One over the power of all lights.
    pub(crate) inv_total: f64,
}

impl<'a, F: Fn(u32) -> &'a LightBounds + Sync> Build<'a, F> {
    /// The subtree over `prims`, at least one. Writes the lights' ids into `order`, as long as `prims`, of which `first` is the place in the
    /// whole tree's.
    pub(crate) fn subtree(
        &self,
        prims: &mut [Prim],
        order: &mut [u32],
        first: usize,
        depth: usize,
    ) -> Subtree {
        let children = Children::new(prims, MAX_DEPTH - depth);
        let mut moments = [None; WIDTH];
        let (own, rest) = order.split_at_mut(children.lights);
        let singles = children.runs().filter(|run| run.len() == 1);
        let slots = children.count - children.lights..;
        for ((slot, run), entry) in slots.zip(singles).zip(own) {
            *entry = prims[run.start].light;
            moments[slot] = Some(Moments::of_light((self.bounds)(*entry), self.inv_total));
        }
        let jobs = jobs(&children, prims, rest, first + children.lights);
        let subtrees = self.run(jobs, depth + 1);
        for (slot, subtree) in subtrees.iter().enumerate() {
            moments[slot] = Some(subtree.moments);
        }
        let moments: Vec<Moments> = moments.into_iter().flatten().collect();
        let mut root = WideNode::encode(&moments);
        root.inner = low_byte(subtrees.len());
        root.light_base = low_word(first);
        Subtree {
            below: assemble(subtrees),
            root,
            moments: Moments::join(&moments),
        }
    }

    #[cfg(feature = "rayon")]
    fn run(&self, jobs: Vec<Job<'_>>, depth: usize) -> Vec<Subtree> {
        use rayon::prelude::*;
        if jobs.iter().map(|job| job.prims.len()).sum::<usize>() < FORK {
            return self.run_here(jobs, depth);
        }
        jobs.into_par_iter()
            .map(|job| self.subtree(job.prims, job.order, job.first, depth))
            .collect()
    }

    #[cfg(not(feature = "rayon"))]
    fn run(&self, jobs: Vec<Job<'_>>, depth: usize) -> Vec<Subtree> {
        self.run_here(jobs, depth)
    }

    fn run_here(&self, jobs: Vec<Job<'_>>, depth: usize) -> Vec<Subtree> {
        jobs.into_iter()
            .map(|job| self.subtree(job.prims, job.order, job.first, depth))
            .collect()
    }
}

/// The part of a build that one child stands for.
struct Job<'p> {
    prims: &'p mut [Prim],
    order: &'p mut [u32],
    first: usize,
}

fn jobs<'p>(
    children: &Children,
    prims: &'p mut [Prim],
    order: &'p mut [u32],
    first: usize,
) -> Vec<Job<'p>> {
    let (mut prims, mut order, mut first, mut done) = (prims, order, first, 0);
    let mut jobs = Vec::with_capacity(WIDTH);
    for run in children.runs() {
        let (mine, rest) = prims.split_at_mut(run.end - done);
        prims = rest;
        if run.len() > 1 {
            let (my_order, rest) = order.split_at_mut(run.len());
            order = rest;
            jobs.push(Job {
                prims: &mut mine[run.start - done..],
                order: my_order,
                first,
            });
            first += run.len();
        }
        done = run.end;
    }
    jobs
}

/// The roots of the subtrees side by side, then what is below each of them.
fn assemble(subtrees: Vec<Subtree>) -> Vec<WideNode> {
    let total = subtrees.iter().map(|s| s.below.len() + 1).sum();
    let mut nodes = Vec::with_capacity(total);
    nodes.extend(subtrees.iter().map(|s| s.root));
    for (index, subtree) in subtrees.into_iter().enumerate() {
        let offset = nodes.len();
        nodes[index].child_base = low_word(offset);
        for child in 0..usize::from(subtree.root.inner) {
            let mut node = subtree.below[child];
            node.parent = low_word(index * WIDTH + child);
            node.child_base += low_word(offset);
            nodes.push(node);
        }
        for node in subtree.below.iter().skip(usize::from(subtree.root.inner)) {
            nodes.push(WideNode {
                parent: node.parent + low_word(offset * WIDTH),
                child_base: node.child_base + low_word(offset),
                ..*node
            });
        }
    }
    nodes
}

/// The runs of lights that become the children of a node, in the order of the lights.
struct Children {
    runs: [Option<Run>; WIDTH],
    count: usize,
    /// How many of them are single lights.
    lights: usize,
}

impl Children {
    /// Divides `prims` among at most eight children, so that each fits below `levels - 1` more levels.
    fn new(prims: &mut [Prim], levels: usize) -> Self {
        let whole = Run {
            start: 0,
            end: prims.len(),
            bounds: centers(prims),
            cost: f32::INFINITY,
        };
        let mut children = Self {
            runs: [None; WIDTH],
            count: 1,
            lights: 0,
        };
        children.runs[0] = Some(whole);
        // With so many lights for so few levels, only halves of the same size are sure to fit.
        let tight = levels <= 11 && prims.len() > 1 << (3 * (levels - 1));
        while let Some(index) = children.next(tight) {
            let Some(run) = children.runs[index] else {
                break;
            };
            let (left, right) = if tight {
                halve(prims, &run)
            } else {
                split(prims, &run)
            };
            children.runs[index + 1..=children.count].rotate_right(1);
            children.runs[index] = Some(left);
            children.runs[index + 1] = Some(right);
            children.count += 1;
        }
        children.lights = children.runs().filter(|run| run.len() == 1).count();
        children
    }

    fn runs(&self) -> impl Iterator<Item = &Run> {
        self.runs.iter().flatten()
    }

    /// Which run to split next: the costliest of those that need a node of their own anyway, then small ones that fit as single lights.
    fn next(&self, tight: bool) -> Option<usize> {
        if self.count == WIDTH {
            return None;
        }
        let free = WIDTH - self.count;
        let price = |run: &Run| {
            if tight { run.len() as f32 } else { run.cost }
        };
        let best = |fits: &dyn Fn(&Run) -> bool| {
            self.runs()
                .enumerate()
                .filter(|(_, run)| run.len() > 1 && fits(run))
                .max_by(|(_, a), (_, b)| price(a).total_cmp(&price(b)))
                .map(|(index, _)| index)
        };
        best(&|run| run.len() > WIDTH).or_else(|| best(&|run| run.len() <= free + 1))
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a tree holds fewer than 2^32 lights, and fewer nodes than lights"
)]
const fn low_word(x: usize) -> u32 {
    x as u32
}

#[expect(clippy::cast_possible_truncation, reason = "at most eight children")]
const fn low_byte(x: usize) -> u8 {
    x as u8
}

/// The nodes of the whole tree, the root first, and the lights in the order that the nodes refer to.
pub(crate) fn build<'a>(
    prims: &mut [Prim],
    bounds: impl Fn(u32) -> &'a LightBounds + Sync,
    inv_total: f64,
) -> (Vec<WideNode>, Vec<u32>) {
    let mut order = vec![0; prims.len()];
    if prims.is_empty() {
        return (Vec::new(), order);
    }
    let whole = Build { bounds, inv_total }.subtree(prims, &mut order, 0, 0);
    let mut nodes = assemble(vec![whole]);
    // `assemble` sees the root as a child of a node that is not there.
    nodes[0].parent = super::node::NOWHERE;
    (nodes, order)
}
