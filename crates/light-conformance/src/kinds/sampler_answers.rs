use lights::bounds::{LightExtent, LightId, LightSampleContext};
use lights::math::fraction;
use lights::math::glam::Vec3;
use lights::samplers::LightSampler;

use super::alias_table::{self, WHOLE_PARTS};
use super::pmf_range::{Importances, Range};
use super::sampler_set::Set;
use crate::oracle::Certainty;
use crate::oracle::parts::{PARTS, alias_parts, choose};
use crate::{Findings, Malformed, Rule, Tolerance};

const NO_POWER: Rule = Rule {
    name: "light without power",
    reason: "the reference answers for a light that is not in its tree as if it were at infinity; \
             ours answers 0",
};

const NOT_A_NUMBER: Rule = Rule {
    name: "reference is not a number",
    reason: "it divides 0 by 0 above two children that do not matter, or normalises a vector of \
             length zero at a box centre",
};

const IMPORTANCE: Rule = Rule {
    name: "importance in single precision",
    reason: "cosines of the reference are known to 5e-4, and it drops light at the edge of an \
             emission; ours is the probability in double precision",
};

const EDGE_OF_U: Rule = Rule {
    name: "edge of a choice",
    reason: "by the reference's importance u falls on the other side of a choice; ours is a choice \
             in double precision",
};

/// The most lights of one choice of the exhaustive sampler.
const MOST_IN_A_CHOICE: usize = 64;

/// Which sampler is asked, and by whom.
pub(super) struct Query<'a> {
    set: &'a Set,
    sampler: Sampler,
    /// Point, and the normal that the sampler reads.
    at: [Vec3; 2],
    importances: Importances<'a>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Sampler {
    Uniform,
    Power,
    Bvh,
    Exhaustive,
}

impl<'a> Query<'a> {
    pub(super) fn new(
        set: &'a Set,
        sampler: Option<&str>,
        p: Vec3,
        n: Vec3,
        ns: Vec3,
    ) -> Result<Self, Malformed> {
        // Ours all read the shading normal; the reference's exhaustive one reads the geometric
        // normal.
        let (sampler, normal) = match sampler {
            Some("uniform") => (Sampler::Uniform, ns),
            Some("power") => (Sampler::Power, ns),
            Some("bvh") => (Sampler::Bvh, ns),
            Some("exhaustive") => (Sampler::Exhaustive, n),
            other => return Err(Malformed(format!("no such sampler: {other:?}"))),
        };
        let at = [p, normal];
        Ok(Self {
            set,
            sampler,
            at,
            importances: Importances::new(at, &set.extents, set.bvh.tree().view()),
        })
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
        if self.sampler == Sampler::Power {
            let (powers, index) = (&self.set.powers, light.index());
            let exact = alias_parts(powers);
            return alias_table::compare_pmf(powers, &exact, index, ours, theirs, findings);
        }
        let ours = findings.ours("pmf", ours);
        let by_importance = matches!(self.sampler, Sampler::Bvh | Sampler::Exhaustive);
        let extent = self.set.extents.get(light.index());
        let bounded = extent.and_then(LightExtent::bounded);
        match bounded {
            Some(bounds) if by_importance && bounds.phi == 0.0 => {
                findings.equal("pmf of a light without power", ours, 0.0);
                findings.settled(Certainty::Determined);
                findings.exempt(&NO_POWER);
            }
            Some(_) if by_importance => {
                let range = self.range(light);
                findings.check(range.holds(ours), || {
                    format!("pmf of {light:?}: {ours:?}, reference {theirs:?}, not in {range:?}")
                });
                findings.settled(if range.is_wide() {
                    Certainty::Undetermined
                } else {
                    Certainty::Determined
                });
                if theirs.is_nan() {
                    findings.exempt(&NOT_A_NUMBER);
                } else if !self.proportion(light).holds(theirs) {
                    findings.exempt(&IMPORTANCE);
                } else if !Tolerance::GENERAL.accepts(ours, theirs) {
                    let is_exhaustive = self.sampler == Sampler::Exhaustive;
                    findings.exempt(if is_exhaustive {
                        &WHOLE_PARTS
                    } else {
                        &IMPORTANCE
                    });
                }
            }
            _ => {
                findings.near("pmf", ours, theirs, Tolerance::GENERAL);
                findings.settled(Certainty::Determined);
            }
        }
    }

    /// The probabilities of a bounded light; all infinite ones together count as one more.
    fn range(&self, light: LightId) -> Range {
        self.share().times(match self.sampler {
            Sampler::Bvh => self.importances.pmf_in_tree(light),
            _ => self.importances.pmf_among(light),
        })
    }

    /// The same without whole parts, as the reference computes it.
    fn proportion(&self, light: LightId) -> Range {
        self.share().times(match self.sampler {
            Sampler::Bvh => self.importances.pmf_in_tree(light),
            _ => self.importances.proportion_among(light),
        })
    }

    /// The probability of all bounded lights together.
    fn share(&self) -> Range {
        Range::exactly(1.0 / (self.infinite().count() + 1) as f64)
    }

    fn infinite(&self) -> impl Iterator<Item = usize> {
        let extents = self.set.extents.iter().enumerate();
        extents.filter_map(|(i, extent)| extent.infinite().map(|_| i))
    }

    /// Whether the light, or none (-1), that `u` chooses is right.
    pub(super) fn compare_choice(&self, u: f64, theirs: i64, findings: &mut Findings) {
        let ctx = self.context();
        let fraction = fraction::from_f64(u);
        let sample = self.sampler().sample(&ctx, fraction);
        if let Some(sample) = sample {
            let own = findings.ours("pmf of the sample", sample.pmf);
            let asked = self.sampler().pmf(&ctx, sample.light);
            findings.equal("pmf of the sample", own, asked);
            findings.settled(Certainty::Determined);
        }
        let is_one_choice = self.set.extents.len() <= MOST_IN_A_CHOICE;
        let choices = match self.sampler {
            Sampler::Exhaustive if is_one_choice => vec![self.choice_by_parts(fraction)],
            // The layout of an alias table is its builder's, and the reference's exhaustive choice
            // depends on a hash: any light is right that has a probability.
            Sampler::Power | Sampler::Exhaustive => {
                let ours = findings.ours_if_any("choice", sample);
                let is_right = match ours {
                    Some(sample) => sample.pmf > 0.0,
                    None => self.is_nothing_to_choose(),
                };
                findings.check(is_right, || {
                    format!("choice by {u}: {ours:?}, reference {theirs}")
                });
                return findings.settled(Certainty::Determined);
            }
            Sampler::Uniform | Sampler::Bvh => self.choices(u),
        };
        let ours = findings.ours("choice", sample.map_or(-1, |s| i64::from(s.light.0)));
        findings.check(choices.contains(&ours), || {
            format!("choice by {u}: {ours}, reference {theirs}, exact {choices:?}")
        });
        findings.settled(if choices.len() == 1 {
            Certainty::Determined
        } else {
            Certainty::Undetermined
        });
        // The reference's exhaustive choice depends on a hash.
        if ours != theirs && self.sampler != Sampler::Exhaustive {
            findings.exempt(&EDGE_OF_U);
        }
    }

    /// Whether no light may have a probability.
    fn is_nothing_to_choose(&self) -> bool {
        let mut lights = (0..).map(LightId).zip(&self.set.extents);
        lights.all(|(light, extent)| match self.sampler {
            Sampler::Power => self.set.powers[light.index()] == 0.0,
            _ => extent.bounded().is_some() && self.range(light).holds(0.0),
        })
    }

    /// The light, or none (-1), that `u` chooses of so few that one choice is enough: in integers,
    /// by the parts that our probabilities are.
    fn choice_by_parts(&self, u: u64) -> i64 {
        let infinite: Vec<_> = self.infinite().collect();
        let has_others = self.set.extents.len() > infinite.len();
        let slots = infinite.len() + usize::from(has_others);
        let scaled = u128::from(u) * slots as u128;
        if let Some(&light) = infinite.get((scaled >> 64) as usize) {
            return light as i64;
        }
        let parts = |(index, extent): (usize, &LightExtent)| {
            extent.bounded().map_or(0, |_| {
                let pmf = self
                    .set
                    .exhaustive
                    .pmf(&self.context(), LightId(index as u32));
                (f64::from(pmf) * (slots as i64 * PARTS) as f64).round() as i64
            })
        };
        let parts: Vec<_> = self.set.extents.iter().enumerate().map(parts).collect();
        choose(&parts, scaled as u64).map_or(-1, |(light, _)| light as i64)
    }

    /// All choices that rounding leaves open.
    fn choices(&self, u: f64) -> Vec<i64> {
        let count = self.set.extents.len();
        if self.sampler == Sampler::Uniform {
            return vec![((u * count as f64) as i64).min(count as i64 - 1)];
        }
        let infinite: Vec<_> = self.infinite().collect();
        let is_in_tree = |extent: &LightExtent| extent.bounded().is_some_and(|lb| lb.phi > 0.0);
        let has_tree = self.set.extents.iter().any(is_in_tree);
        let slots = infinite.len() + usize::from(has_tree);
        let scaled = u * slots as f64;
        let slot = scaled as usize;
        match infinite.get(slot) {
            Some(&light) => vec![light as i64],
            None if has_tree => self
                .importances
                .choices_in_tree(scaled - infinite.len() as f64),
            None => vec![-1],
        }
    }
}
