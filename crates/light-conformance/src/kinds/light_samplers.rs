use super::light_tree;
use super::sampler_answers::Query;
use super::sampler_set::{Set, light_id};
use crate::{Case, Checker, Findings, Malformed};

/// Lights, then the tree of them, then the results of samplers.
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
            Some("bvh_nodes") => compare_tree(set, case, findings),
            Some("case") => compare_sampler(set, case, findings),
            other => Err(Malformed(format!("no such kind: {other:?}"))),
        }
    }
}

fn compare_tree(set: &Set, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    light_tree::compare(&set.bvh.tree().view(), &set.extents, case, findings)
}

fn compare_sampler(set: &Set, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
    let p = case.get("p")?.vec3()?;
    let [n, ns] = [case.get("n")?.vec3()?, case.get("ns")?.vec3()?];
    let query = Query::new(set, case.get("sampler")?.text(), p, n, ns)?;
    for pair in case.get("pmf")?.items()? {
        query.compare_pmf(light_id(&pair.at(0)?)?, pair.at(1)?.float()?, findings);
    }
    for triple in case.get("samples")?.items()? {
        let choice = triple.at(1)?.integer()?;
        if choice >= 0 {
            query.compare_pmf(light_id(&triple.at(1)?)?, triple.at(2)?.float()?, findings);
        }
        let u = f64::from(triple.at(0)?.float()?);
        query.compare_choice(u, choice, findings);
    }
    Ok(())
}
