use bytemuck::{Pod, Zeroable};
use light_bounds::SampledLight;
use light_bvh::{CutDetail, LightBvhRef, LightCut};
use light_math::OctahedralVector;
use light_math::fraction::stratum;

use crate::light_record::LightRecord;
use crate::query::Query;

/// A chosen light; its probability is 0 where none was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Chosen {
    /// Its id.
    pub light: u32,
    /// Its probability.
    pub pmf: f32,
    /// What is left of the random number, the upper word first.
    pub u: [u32; 2],
}

/// Four choices by a cut.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Choices {
    /// One in each quarter of the random numbers.
    pub chosen: [Chosen; 4],
    /// The probability of the query's other light.
    pub other: f32,
    /// Nothing.
    pub unused: [u32; 3],
}

/// What arrives from a light; the density is 0 where nothing does.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Arrived {
    /// Radiance, or what stands for it.
    pub l: [f32; 3],
    /// Density of the direction.
    pub pdf: f32,
    /// The direction toward the light.
    pub wi: [f32; 3],
    /// Nothing.
    pub unused: u32,
}

/// A light of the tree.
#[inline]
pub fn sample(tree: &LightBvhRef<'_>, query: &Query, answer: &mut Chosen) {
    *answer = tree.sample(&query.context(), query.u()).into();
}

/// The probability of the query's other light.
#[inline]
pub fn pmf(tree: &LightBvhRef<'_>, query: &Query, answer: &mut f32) {
    *answer = tree.pmf(&query.context(), query.other());
}

/// Four lights of the tree, by one cut.
///
/// Cut and answer are made in place: a GPU moves what is larger than some registers byte by byte.
#[inline]
pub fn sample_by_cut(tree: &LightBvhRef<'_>, query: &Query, answer: &mut Choices) {
    let mut cut = LightCut::default();
    cut.set(tree, &query.context(), CutDetail::default());
    for (i, chosen) in (0..).zip(&mut answer.chosen) {
        *chosen = cut.sample(stratum(i, 4, query.u())).into();
    }
    answer.other = cut.pmf(query.other());
    answer.unused = [0; 3];
}

/// What arrives from a light.
#[inline]
#[must_use]
pub fn arrive(light: &LightRecord, query: &Query) -> Arrived {
    let sample = light.sample_li(&query.context(), query.place());
    sample.map_or(Arrived::zeroed(), |sample| Arrived {
        l: sample.l.to_array(),
        pdf: sample.pdf,
        wi: sample.wi.to_array(),
        unused: 0,
    })
}

/// The unit vector of an octahedral code.
#[inline]
#[must_use]
pub fn decode(code: u32) -> [f32; 3] {
    OctahedralVector::from_bits(code).decode().to_array()
}

impl From<Option<SampledLight>> for Chosen {
    fn from(sampled: Option<SampledLight>) -> Self {
        sampled.map_or(Self::zeroed(), |sampled| Self {
            light: sampled.light.0,
            pmf: sampled.pmf,
            u: [(sampled.u >> 32) as u32, sampled.u as u32],
        })
    }
}
