//! The light hierarchy that the reference built: links, and codes of bounds.

use lights::bounds::{LightBounds, LightExtent};
use lights::bvh::reference::{Link, ReferenceLightBvhRef, ReferenceNode, Side};
use std::collections::BTreeMap;

use super::compact_codes::{Codes, ROUNDED_CODE, compact_codes, judge};
use super::light_tree_splits;
use super::sampler_set::light_id;
use crate::oracle::cone::ExactCone;
use crate::oracle::cone_rounding::ConeRounding;
use crate::oracle::{Certainty, Jitter, codes};
use crate::{Case, Findings, Malformed, Rule, Tolerance};

const NARROW_CONE: Rule = Rule {
    name: "cone one code wider",
    reason: "rounding makes some cones of the reference narrower than what they hold; ours is a \
             code of the union in double precision, or the next wider one",
};

const EQUAL_COST: Rule = Rule {
    name: "splits of equal cost",
    reason: "the reference takes another of several splits that cost the least up to single \
             precision; ours is one of them in double precision",
};

/// What a node holds, in double precision where it is computed.
#[derive(Clone, Copy)]
struct ExactNode {
    bounds: LightBounds,
    cone: ExactCone,
    /// How far rounding may have moved our cone.
    moved: ConeRounding,
}

/// Compares all nodes and trails.
pub(super) fn compare(
    tree: &ReferenceLightBvhRef<'_>,
    lights: &[LightExtent],
    case: &Case<'_>,
    findings: &mut Findings,
) -> Result<(), Malformed> {
    let nodes: Vec<_> = case.get("nodes")?.items()?.collect();
    findings.equal("number of nodes", tree.nodes().len(), nodes.len());
    let mut exact = vec![None; tree.nodes().len()];
    for index in (0..tree.nodes().len()).rev() {
        exact[index] = exact_node(tree, lights, &exact, index);
    }
    let is_same_link =
        |(ours, theirs): (&ReferenceNode, &Case<'_>)| Ok(link(ours) == their_link(theirs)?);
    let same: Result<Vec<bool>, _> = tree.nodes().iter().zip(&nodes).map(is_same_link).collect();
    if same?.contains(&false) {
        return check_alone(tree, lights, &exact, &nodes, findings);
    }
    for (index, (ours, theirs)) in tree.nodes().iter().zip(&nodes).enumerate() {
        compare_link(ours, theirs, findings)?;
        let Some(exact) = exact[index] else {
            findings.fail(format!("node {index} holds nothing"));
            continue;
        };
        compare_bounds(tree, ours, Some(&compact_codes(theirs)?), &exact, findings);
    }
    for pair in case.get("bit_trails")?.items()? {
        let light = light_id(&pair.at(0)?)?;
        let ours = findings.ours("trail", i64::from(tree.trail(light).bits()));
        findings.equal(&format!("trail of {light:?}"), ours, pair.at(1)?.integer()?);
        findings.settled(Certainty::Determined);
    }
    Ok(())
}

/// Holds a tree that divides its lights another way than the reference's to the published cost, and
/// to its lights. Subtrees that the reference has too are compared with its own.
fn check_alone(
    tree: &ReferenceLightBvhRef<'_>,
    lights: &[LightExtent],
    exact: &[Option<ExactNode>],
    nodes: &[Case<'_>],
    findings: &mut Findings,
) -> Result<(), Malformed> {
    if let Err(message) = light_tree_splits::check(tree, lights) {
        findings.fail(message);
    }
    let links: Vec<_> = tree.nodes().iter().map(link).collect();
    let their_links: Result<Vec<_>, _> = nodes.iter().map(their_link).collect();
    let their_links = their_links?;
    let their_subtrees = (0..nodes.len()).map(|index| (subtree(&their_links, index), index));
    let their_subtrees: BTreeMap<_, _> = their_subtrees.collect();
    for (index, (ours, exact)) in tree.nodes().iter().zip(exact).enumerate() {
        let Some(exact) = exact else {
            findings.fail("a node holds nothing".to_owned());
            continue;
        };
        let theirs = their_subtrees.get(&subtree(&links, index));
        let theirs = theirs.map(|&index| &nodes[index]);
        let phi = findings.ours("node phi", ours.bounds().phi());
        findings.near("phi", phi, exact.bounds.phi, Tolerance::GENERAL);
        if let Some(theirs) = theirs {
            let their_phi = theirs.get("phi")?.float()?;
            findings.near("their phi", phi, their_phi, Tolerance::GENERAL);
        }
        findings.settled(Certainty::Determined);
        let codes = theirs.map(compact_codes).transpose()?;
        compare_bounds(tree, ours, codes.as_ref(), exact, findings);
        if let Link::Leaf(light) = ours.link() {
            let mut index = 0;
            for side in tree.trail(light).sides() {
                index = match (tree.nodes()[index].link(), side) {
                    (Link::Interior { .. }, Side::First) => index + 1,
                    (Link::Interior { second_child }, Side::Second) => second_child as usize,
                    (Link::Leaf(_), _) => break,
                };
            }
            findings.equal("end of the trail", tree.nodes()[index].link(), ours.link());
        }
    }
    findings.exempt(&EQUAL_COST);
    Ok(())
}

/// A node and all below it, in their order: a light each, or -1 for a node with two children.
fn subtree(links: &[[i64; 2]], index: usize) -> Vec<i64> {
    let mut missing = 1;
    let below = links[index..].iter().map_while(|&[is_leaf, light]| {
        (missing > 0).then(|| {
            missing += 1 - 2 * is_leaf;
            if is_leaf == 1 { light } else { -1 }
        })
    });
    below.collect()
}

/// The union of what is below a node; its children come after it.
fn exact_node(
    tree: &ReferenceLightBvhRef<'_>,
    lights: &[LightExtent],
    exact: &[Option<ExactNode>],
    index: usize,
) -> Option<ExactNode> {
    match tree.nodes()[index].link() {
        Link::Leaf(light) => {
            let bounds = *lights.get(light.index())?.bounded()?;
            let cone = ExactCone::new(bounds.w, bounds.cos_theta_o);
            let moved = ConeRounding::default();
            Some(ExactNode {
                bounds,
                cone,
                moved,
            })
        }
        Link::Interior { second_child } => {
            let (a, b) = (exact[index + 1]?, exact[second_child as usize]?);
            let mut bounds = a.bounds;
            bounds.bounds.min = bounds.bounds.min.min(b.bounds.bounds.min);
            bounds.bounds.max = bounds.bounds.max.max(b.bounds.bounds.max);
            bounds.phi += b.bounds.phi;
            bounds.cos_theta_e = bounds.cos_theta_e.min(b.bounds.cos_theta_e);
            bounds.two_sided |= b.bounds.two_sided;
            let cone = a.cone.union(b.cone, &mut Jitter::default());
            let moved = ConeRounding::of_union([a.cone, b.cone], [a.moved, b.moved]);
            Some(ExactNode {
                bounds,
                cone,
                moved,
            })
        }
    }
}

fn link(ours: &ReferenceNode) -> [i64; 2] {
    match ours.link() {
        Link::Leaf(light) => [1, i64::from(light.0)],
        Link::Interior { second_child } => [0, i64::from(second_child)],
    }
}

fn their_link(theirs: &Case<'_>) -> Result<[i64; 2], Malformed> {
    let is_leaf = i64::from(theirs.get("leaf")?.flag()?);
    Ok([is_leaf, theirs.get("child_or_light")?.integer()?])
}

fn compare_link(
    ours: &ReferenceNode,
    theirs: &Case<'_>,
    findings: &mut Findings,
) -> Result<(), Malformed> {
    let link = findings.ours("link", link(ours));
    findings.equal("link", link, their_link(theirs)?);
    findings.settled(Certainty::Determined);
    let phi = findings.ours("node phi", ours.bounds().phi());
    let their_phi = theirs.get("phi")?.float()?;
    findings.near("phi of a node", phi, their_phi, Tolerance::GENERAL);
    findings.settled(Certainty::Determined);
    Ok(())
}

fn compare_bounds(
    tree: &ReferenceLightBvhRef<'_>,
    ours: &ReferenceNode,
    theirs: Option<&Codes>,
    exact: &ExactNode,
    findings: &mut Findings,
) {
    let ours = Codes {
        w: ours.bounds().w(),
        packed: ours.bounds().packed(),
        bounds: ours.bounds().bounds(),
    };
    let rule = |rule| if theirs.is_some() { rule } else { &EQUAL_COST };

    let unpack =
        |packed: u32| [packed & 0x7fff, packed >> 15 & 0x7fff, packed >> 30].map(i64::from);

    let their_packed = theirs.map(|t| unpack(t.packed));
    let [cos_o, cos_e, two_sided] = unpack(ours.packed);

    // Codes of the axis. A cone with the code 0 is the whole sphere, whatever its axis; the code
    // itself is compared below.
    if cos_o > 0 || their_packed.is_some_and(|t| t[0] > 0) {
        let xy = |w: lights::math::OctahedralVector| [w.xy().0, w.xy().1].map(i64::from);
        let w = findings.ours("node axis", xy(ours.w));
        let is_exact = codes::is_octahedral(w, exact.cone.w, exact.moved.axis);
        let is_same = theirs.is_some_and(|t| w == xy(t.w));
        judge("axis", is_same, is_exact, rule(&ROUNDED_CODE), findings);
    }

    // Both cosines, and the flag.
    let cos_o = findings.ours("node cos_theta_o", cos_o);
    let number = codes::cosine(exact.cone.cos_theta);
    let is_exact = codes::is_below(cos_o, number) || codes::is_below(cos_o + 1, number);
    findings.check(is_exact, || "code of cos_theta_o is not exact".to_owned());
    // The code below or above is right as well, and may be the reference's.
    findings.settled(Certainty::Undetermined);
    if their_packed.is_none_or(|t| cos_o != t[0]) {
        findings.exempt(rule(&NARROW_CONE));
    }
    let cos_e = findings.ours("node cos_theta_e", cos_e);
    let is_exact = codes::is_below(cos_e, codes::cosine(f64::from(exact.bounds.cos_theta_e)));
    let is_same = their_packed.is_some_and(|t| cos_e == t[1]);
    judge(
        "cos_theta_e",
        is_same,
        is_exact,
        rule(&ROUNDED_CODE),
        findings,
    );
    let expected = their_packed.map_or(i64::from(exact.bounds.two_sided), |t| t[2]);
    findings.equal("two_sided", two_sided, expected);

    let all = tree.bounds();
    for axis in 0..3 {
        let number = |x: f32| codes::coordinate(x, all.min[axis], all.max[axis]);
        let low = findings.ours("node min", i64::from(ours.bounds.min[axis]));
        let is_exact = codes::is_below(low, number(exact.bounds.bounds.min[axis]));
        let is_same = theirs.is_some_and(|t| low == i64::from(t.bounds.min[axis]));
        judge("min", is_same, is_exact, rule(&ROUNDED_CODE), findings);
        let high = findings.ours("node max", i64::from(ours.bounds.max[axis]));
        let is_exact = codes::is_above(high, number(exact.bounds.bounds.max[axis]));
        let is_same = theirs.is_some_and(|t| high == i64::from(t.bounds.max[axis]));
        judge("max", is_same, is_exact, rule(&ROUNDED_CODE), findings);
    }
}

#[cfg(test)]
mod tests {
    use super::subtree;

    #[test]
    fn subtrees_are_alike_wherever_they_are() {
        // A light beside two, and the same two below another node.
        let ours = [[0, 2], [1, 7], [0, 4], [1, 3], [1, 5]];
        let theirs = [[0, 4], [0, 3], [1, 3], [1, 5], [1, 7]];
        assert_eq!(subtree(&ours, 2), [-1, 3, 5], "two lights");
        assert_eq!(subtree(&ours, 2), subtree(&theirs, 1), "the same two");
        assert_eq!(subtree(&ours, 1), subtree(&theirs, 4), "a leaf");
        assert_ne!(subtree(&ours, 0), subtree(&theirs, 0), "the roots");
    }
}
