use lights::bounds::{InfiniteBounds, LightExtent, LightId};
use lights::samplers::{
    ExhaustiveLightSampler, PowerLightSampler, ReferenceBvhLightSampler, UniformLightSampler,
};

use super::bounds::read_light_bounds;
use super::light_tree;
use super::sampler_answers::Question;
use crate::conformance::{Case, Checker, Findings, Malformed};

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
        light_tree::compare(&self.bvh.tree().view(), &self.extents, case, findings)
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

pub(super) fn light_id(case: &Case<'_>) -> Result<LightId, Malformed> {
    let index = u32::try_from(case.index()?).map_err(|e| Malformed(e.to_string()))?;
    Ok(LightId(index))
}
