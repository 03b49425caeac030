use lights::bounds::{LightExtent, LightId, LightSampleContext};
use lights::math::glam::Vec3;
use lights::samplers::LightSampler;

use super::light_samplers::{NARROW_CONE, Set};
use super::pmf_range::{Allowance, Query, Range};
use crate::conformance::{Findings, Malformed, Rule, Tolerance};

const NO_POWER: Rule = Rule {
    name: "light without power",
    reason: "the reference answers for a light that is not in its tree as if it were at infinity; ours answers 0",
};

const ONE_LIGHT: Rule = Rule {
    name: "tree of one light",
    reason: "the reference samples nothing where that light does not matter but answers a positive pmf; ours answers 0",
};

const NOT_A_NUMBER: Rule = Rule {
    name: "reference is not a number",
    reason: "it divides 0 by 0 above two children that do not matter, or normalises a vector of length zero at a box centre",
};

const STEP: Rule = Rule {
    name: "step of the importance",
    reason: "a node on the way is at the edge of its emission, or has no falloff, or the point is on its bounding sphere",
};

const EDGE_OF_U: Rule = Rule {
    name: "edge of a choice",
    reason: "u is so near to where one choice turns into another that the error of the cosines decides",
};

/// How near that is, at most and for lights of small probability.
const EDGE: [f64; 3] = [1e-3, 1e-5, 1e-7];

/// Which sampler is asked, and by whom.
pub(super) struct Question<'a> {
    set: &'a Set,
    sampler: Sampler,
    /// Point, and the normal that the sampler reads.
    at: [Vec3; 2],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Sampler {
    Uniform,
    Power,
    Bvh,
    Exhaustive,
}

impl<'a> Question<'a> {
    pub(super) fn new(
        set: &'a Set,
        sampler: Option<&str>,
        p: Vec3,
        n: Vec3,
        ns: Vec3,
    ) -> Result<Self, Malformed> {
        // Ours all read the shading normal; the reference's exhaustive one reads the geometric normal.
        let (sampler, normal) = match sampler {
            Some("uniform") => (Sampler::Uniform, ns),
            Some("power") => (Sampler::Power, ns),
            Some("bvh") => (Sampler::Bvh, ns),
            Some("exhaustive") => (Sampler::Exhaustive, n),
            other => return Err(Malformed(format!("no such sampler: {other:?}"))),
        };
        let at = [p, normal];
        Ok(Self { set, sampler, at })
    }

    fn sampler(&self) -> &dyn LightSampler {
        match self.sampler {
            Sampler::Uniform => &self.set.uniform,
            Sampler::Power => &self.set.power,
            Sampler::Bvh => &self.set.bvh,
            Sampler::Exhaustive => &self.set.exhaustive,
        }
    }

    fn context(&self) -> LightSampleContext {
        LightSampleContext::surface(self.at[0], self.at[1], self.at[1])
    }

    pub(super) fn compare_pmf(&self, light: LightId, theirs: f32, findings: &mut Findings) {
        let ours = self.sampler().pmf(&self.context(), light);
        let by_importance = matches!(self.sampler, Sampler::Bvh | Sampler::Exhaustive);
        let bounds = self
            .set
            .extents
            .get(light.index())
            .and_then(LightExtent::bounded);
        match bounds {
            Some(bounds) if by_importance => {
                self.compare_importance_pmf(light, bounds.phi, [ours, theirs], findings);
            }
            _ => findings.near(
                &format!("pmf of {light:?}"),
                ours,
                theirs,
                Tolerance::GENERAL,
            ),
        }
    }

    fn compare_importance_pmf(
        &self,
        light: LightId,
        phi: f32,
        [ours, theirs]: [f32; 2],
        findings: &mut Findings,
    ) {
        let tree = self.set.bvh.tree().view();
        if phi == 0.0 {
            findings.equal("pmf of a light without power", ours, 0.0);
            return findings.exempt(&NO_POWER);
        }
        let in_tree = self.sampler == Sampler::Bvh;
        if theirs.is_nan() && self.explains_nan(light) {
            findings.check((0.0..=1.0).contains(&ours), || format!("pmf {ours:?}"));
            return findings.exempt(&NOT_A_NUMBER);
        }
        if in_tree && tree.nodes().len() == 1 && ours == 0.0 {
            return findings.exempt(&ONE_LIGHT);
        }
        if self.range(Allowance::RoundOff, light).holds(theirs) {
            return findings.check(true, String::new);
        }
        if self.range(Allowance::WiderCones, light).holds(theirs) {
            return findings.exempt(&NARROW_CONE);
        }
        let range = self.range(Allowance::Steps, light);
        if range.holds(theirs) {
            return findings.exempt(&STEP);
        }
        findings.fail(format!(
            "pmf of {light:?}: {ours:?}, reference {theirs:?}, not in {range:?}"
        ));
    }

    fn query(&self, allowance: Allowance) -> Query {
        Query {
            at: self.at,
            allowance,
        }
    }

    fn range(&self, allowance: Allowance, light: LightId) -> Range {
        let extents = &self.set.extents;
        let infinite = extents.iter().filter(|e| e.infinite().is_some()).count();
        let share = Range::exactly(1.0 / (infinite + 1) as f64);
        share.times(match self.sampler {
            Sampler::Bvh => self
                .query(allowance)
                .pmf_in_tree(&self.set.bvh.tree().view(), light),
            _ => self.query(allowance).pmf_among(extents, light),
        })
    }

    /// Whether the same light, or none (-1), is chosen by `u`.
    pub(super) fn compare_choice(&self, u: f64, theirs: i64, findings: &mut Findings) {
        // An alias table's layout is its builder's, and the reference's exhaustive choice depends on a hash.
        if matches!(self.sampler, Sampler::Power | Sampler::Exhaustive) {
            return;
        }
        let ctx = self.context();
        let choose = |u: f64| {
            let choice = self.sampler().sample(&ctx, u);
            choice.map_or(-1, |sample| i64::from(sample.light.0))
        };
        let ours = choose(u);
        if ours != theirs {
            let lights = [ours, theirs].map(u32::try_from);
            let mut lights = lights.into_iter().flatten().map(LightId);
            if lights.clone().any(|light| self.explains_nan(light)) {
                return findings.exempt(&NOT_A_NUMBER);
            }
            if lights.any(|light| self.is_at_step(light)) {
                return findings.exempt(&STEP);
            }
        }
        let is_near = |distance: f64| {
            let near = [u - distance, u + distance].map(|u| choose(u.clamp(0.0, 1.0)));
            near.contains(&theirs)
        };
        if ours != theirs && EDGE.into_iter().any(is_near) {
            return findings.exempt(&EDGE_OF_U);
        }
        findings.equal(&format!("choice by {u}"), ours, theirs);
    }

    /// Whether a step of the importance can change the probability of `light`.
    fn is_at_step(&self, light: LightId) -> bool {
        self.range(Allowance::Steps, light) != self.range(Allowance::WiderCones, light)
    }

    /// Whether the reference may answer with NaN for `light`.
    fn explains_nan(&self, light: LightId) -> bool {
        let query = self.query(Allowance::Steps);
        match self.sampler {
            Sampler::Bvh => query.explains_nan(&self.set.bvh.tree().view(), light),
            Sampler::Exhaustive => query.explains_nan_among(&self.set.extents),
            Sampler::Uniform | Sampler::Power => false,
        }
    }
}
