use lights::glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::morton::morton_encode_u64_unorm;

/// A run of this many neighbours without a mutually nearest pair counts as a chain.
const CHAIN: usize = 256;

/// Whether nearest-neighbour agglomeration would only merge the ends of long chains: coincident
/// boxes, evenly spaced rows, or rows in which each box is larger than the one before. It would
/// then take one pass over all boxes per merge.
pub(super) fn is_chained(boxes: &[Aabb]) -> bool {
    if boxes.len() <= CHAIN {
        return false;
    }
    let mut row: Vec<Aabb> = sorted(boxes).map(|i| boxes[i as usize]).collect();
    while row.len() > CHAIN {
        let pairs = mutual(&row);
        if longest_gap(&pairs, row.len()) > CHAIN {
            return true;
        }
        let count = row.len();
        merge(&pairs, count, |to, from| {
            row[to] = match from {
                Merged::One(i) => row[i],
                Merged::Pair(i) => row[i].union(&row[i + 1]),
            };
        });
        row.truncate(count - pairs.len());
    }
    false
}

/// A hierarchy of nearest neighbours along a Morton curve. Chains without a mutually nearest pair
/// are merged in pairs, so that any input takes `O(n log n)` time and `O(log n)` depth.
pub(super) fn agglomerate(boxes: &[Aabb]) -> Bvh2 {
    let mut bvh = Bvh2::zeroed(boxes.len());
    let count = u32::try_from(boxes.len()).expect("fewer than 2^32 boxes");
    bvh.primitive_indices = (0..count).collect();
    let mut row: Vec<Bvh2Node> = sorted(boxes)
        .map(|i| Bvh2Node::new(boxes[i as usize], 1, i))
        .collect();
    // Children lie side by side, from the end on.
    let mut free = bvh.nodes.len();
    while row.len() > 1 {
        let bounds: Vec<Aabb> = row.iter().map(|node| *node.aabb()).collect();
        let pairs = without_gaps(&mutual(&bounds), row.len());
        let count = row.len();
        merge(&pairs, count, |to, from| {
            row[to] = match from {
                Merged::One(i) => row[i],
                Merged::Pair(i) => {
                    free -= 2;
                    bvh.nodes[free..free + 2].copy_from_slice(&row[i..i + 2]);
                    let first = u32::try_from(free).expect("fewer than 2^31 boxes");
                    Bvh2Node::new(bounds[i].union(&bounds[i + 1]), 0, first)
                }
            };
        });
        row.truncate(count - pairs.len());
    }
    if let ([root], [node]) = (&mut bvh.nodes[..1], &row[..]) {
        *root = *node;
    }
    bvh.children_are_ordered_after_parents = true;
    bvh
}

/// The one or two nodes of which an entry of the next row is made.
enum Merged {
    One(usize),
    Pair(usize),
}

/// The order of the boxes along a Morton curve through their centers.
fn sorted(boxes: &[Aabb]) -> impl Iterator<Item = u32> {
    let middle = |b: &Aabb| 0.5 * b.min + 0.5 * b.max;
    let mut around = Aabb::empty();
    for b in boxes {
        around.extend(middle(b));
    }
    let size = (around.max - around.min).max(Vec3A::splat(f32::MIN_POSITIVE));
    let code = |b: &Aabb| {
        // Positions beyond the largest code are clamped to it.
        let place = (middle(b).as_dvec3() - around.min.as_dvec3()) / size.as_dvec3();
        morton_encode_u64_unorm(place.min(DVec3::splat(1.0 - 1e-9)))
    };
    let mut order: Vec<(u64, u32)> = boxes.iter().map(code).zip(0..).collect();
    order.sort_unstable();
    order.into_iter().map(|(_, i)| i)
}

/// The first of each mutually nearest pair of neighbours.
fn mutual(row: &[Aabb]) -> Vec<usize> {
    let cost = |i: usize| row[i].union(&row[i + 1]).half_area();
    let mut costs: Vec<f32> = (0..row.len().saturating_sub(1)).map(cost).collect();
    costs.push(f32::INFINITY);
    let mut pairs = Vec::new();
    let mut before = f32::INFINITY;
    for i in 0..row.len() - 1 {
        // On a tie the later one, as in the agglomeration that this predicts.
        if before >= costs[i] && costs[i] < costs[i + 1] {
            pairs.push(i);
        }
        before = costs[i];
    }
    pairs
}

/// The length of the longest run of neighbours that are in none of the pairs.
fn longest_gap(pairs: &[usize], count: usize) -> usize {
    let ends = pairs.iter().map(|&i| i + 2);
    let starts = pairs.iter().copied().chain([count]);
    let gaps = core::iter::once(0).chain(ends).zip(starts);
    gaps.map(|(end, start)| start - end).max().unwrap_or(0)
}

/// The pairs, and as many further pairs as fit between them.
fn without_gaps(pairs: &[usize], count: usize) -> Vec<usize> {
    let mut all = Vec::new();
    let mut next = 0;
    for &pair in pairs.iter().chain([&count]) {
        // A single one, or two, may find a nearer neighbour later.
        if pair - next > 2 {
            all.extend((next..pair - 1).step_by(2));
        }
        if pair < count {
            all.push(pair);
        }
        next = pair + 2;
    }
    if all.is_empty() {
        all.push(0);
    }
    all
}

/// For each entry of the next row, its nodes.
fn merge(pairs: &[usize], count: usize, mut each: impl FnMut(usize, Merged)) {
    let (mut to, mut from) = (0, 0);
    let mut pairs = pairs.iter().copied().peekable();
    while from < count {
        if pairs.next_if_eq(&from).is_some() {
            each(to, Merged::Pair(from));
            from += 2;
        } else {
            each(to, Merged::One(from));
            from += 1;
        }
        to += 1;
    }
}
