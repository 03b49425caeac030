use lights::bounds::{InfiniteBounds, LightExtent, LightId};
use lights::bvh::reference::{Link, ReferenceNode};
use lights::samplers::{
    ExhaustiveLightSampler, PowerLightSampler, ReferenceBvhLightSampler, UniformLightSampler,
};

use super::bounds::read_light_bounds;
use super::compact::compact_codes;
use super::sampler_answers::Question;
use crate::conformance::{Case, Checker, Findings, Malformed, Rule, Tolerance};

pub(super) const NARROW_CONE: Rule = Rule {
    name: "cone one code wider",
    reason: "rounding makes some cones of the reference narrower than what they hold, by the last bit; ours take the next code",
};

/// Lights, then the tree of them, then what samplers answer.
#[derive(Default)]
pub(super) struct LightSamplers {
    sets: Vec<Set>,
}

impl Checker for LightSamplers {
    fn check(&mut self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        if case.get("kind")?.text() == Some("set") {
            self.sets.push(Set::read(case)?);
            findings.equal("set", case.get("set")?.index()?, self.sets.len() - 1);
            return Ok(());
        }
        let index = case.get("set")?.index()?;
        let set = self.sets.get(index);
        let set = set.ok_or_else(|| Malformed(format!("no set {index} so far")))?;
        match case.get("kind")?.text() {
            Some("bvh_nodes") => set.compare_tree(case, findings),
            Some("case") => set.compare_sampler(case, findings),
            other => Err(Malformed(format!("no such kind: {other:?}"))),
        }
    }
}

/// The samplers of a set of lights.
pub(super) struct Set {
    pub(super) extents: Vec<LightExtent>,
    pub(super) uniform: UniformLightSampler,
    pub(super) power: PowerLightSampler,
    pub(super) bvh: ReferenceBvhLightSampler,
    pub(super) exhaustive: ExhaustiveLightSampler,
}

impl Set {
    fn read(case: &Case<'_>) -> Result<Self, Malformed> {
        let mut extents = Vec::new();
        let mut powers = Vec::new();
        for light in case.get("lights")?.items()? {
            powers.push(light.get("power_weight")?.float()?);
            extents.push(match light.find("bounds") {
                Some(bounds) => LightExtent::Bounded(read_light_bounds(&bounds)?),
                None => LightExtent::Infinite(InfiniteBounds::uniform(1.0)),
            });
        }
        Ok(Self {
            uniform: UniformLightSampler::new(extents.len() as u32),
            power: PowerLightSampler::new(&powers).map_err(|e| Malformed(e.to_string()))?,
            bvh: ReferenceBvhLightSampler::new(&extents).map_err(|e| Malformed(e.to_string()))?,
            exhaustive: ExhaustiveLightSampler::new(&extents)
                .map_err(|e| Malformed(e.to_string()))?,
            extents,
        })
    }

    fn compare_tree(&self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let tree = self.bvh.tree().view();
        let nodes: Vec<_> = case.get("nodes")?.items()?.collect();
        findings.equal("number of nodes", tree.nodes().len(), nodes.len());
        for (index, (ours, theirs)) in tree.nodes().iter().zip(&nodes).enumerate() {
            compare_node(index, ours, theirs, findings)?;
        }
        for pair in case.get("bit_trails")?.items()? {
            let light = light_id(&pair.at(0)?)?;
            let ours = tree.trail(light).bits() as usize;
            findings.equal(&format!("trail of {light:?}"), ours, pair.at(1)?.index()?);
        }
        Ok(())
    }

    fn compare_sampler(&self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        let p = case.get("p")?.vec3()?;
        let [n, ns] = [case.get("n")?.vec3()?, case.get("ns")?.vec3()?];
        let question = Question::new(self, case.get("sampler")?.text(), p, n, ns)?;
        for pair in case.get("pmf")?.items()? {
            question.compare_pmf(light_id(&pair.at(0)?)?, pair.at(1)?.float()?, findings);
        }
        for triple in case.get("samples")?.items()? {
            let choice = triple.at(1)?.integer()?;
            if choice >= 0 {
                question.compare_pmf(light_id(&triple.at(1)?)?, triple.at(2)?.float()?, findings);
            }
            let u = f64::from(triple.at(0)?.float()?);
            question.compare_choice(u, choice, findings);
        }
        Ok(())
    }
}

fn compare_node(
    index: usize,
    ours: &ReferenceNode,
    theirs: &Case<'_>,
    findings: &mut Findings,
) -> Result<(), Malformed> {
    let link = theirs.get("child_or_light")?;
    let link = if theirs.get("leaf")?.flag()? {
        Link::Leaf(light_id(&link)?)
    } else {
        Link::Interior {
            second_child: light_id(&link)?.0,
        }
    };
    findings.equal(&format!("link of node {index}"), ours.link(), link);
    let phi = theirs.get("phi")?.float()?;
    findings.near(
        &format!("phi of node {index}"),
        ours.bounds().phi(),
        phi,
        Tolerance::GENERAL,
    );

    let codes = compact_codes(theirs)?;
    let is_one_less = ours.bounds().packed() + 1 == codes.packed;
    if is_one_less {
        findings.exempt(&NARROW_CONE);
    } else {
        findings.equal(
            &format!("packed bits of node {index}"),
            ours.bounds().packed(),
            codes.packed,
        );
    }
    findings.equal(&format!("axis of node {index}"), ours.bounds().w(), codes.w);
    findings.equal(
        &format!("box of node {index}"),
        ours.bounds().bounds(),
        codes.bounds,
    );
    Ok(())
}

fn light_id(case: &Case<'_>) -> Result<LightId, Malformed> {
    let index = u32::try_from(case.index()?).map_err(|e| Malformed(e.to_string()))?;
    Ok(LightId(index))
}
