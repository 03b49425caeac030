use light_bounds::{Gloss, LightId, LightSampleContext, SampledLight};
use light_bvh::{LightBvhRef, SurfaceReceiver};
use light_math::discrete::SampledIndex;
use light_math::distribution::AliasTable;
use light_math::glam::Vec3;
use light_math::{OctahedralVector, fraction};
use light_photometry::PhotometricWebRef;
use light_samplers::{BvhLightSamplerRef, LightChoices, LightSampler};
use light_sources::LightLiSample;

use crate::apart::{apart1, apart2, apart3};
use crate::flash;
use crate::machine;
use crate::measure::measure;
use crate::random::{random, random_point};
use crate::scene_records::PointRecord;
use crate::sky::SkySample;

/// The parts of `light-math` that read tables: the powers of the lights, and their axes.
#[inline(never)]
pub fn tables() {
    machine::begin();
    nothing();
    let powers = flash::powers();
    measure(
        "alias-sample",
        random,
        |&u| apart2(AliasTable::sample)(&powers, u),
        |s: SampledIndex| [s.index as u32, s.pmf.to_bits(), high(s.u), low(s.u)],
    );
    let axes = flash::axes();
    measure(
        "octahedral-decode",
        |i| axes[i as usize % axes.len()],
        |&axis| apart1(OctahedralVector::decode)(axis),
        |w| w.to_array().map(f32::to_bits),
    );
    machine::end();
}

/// The tree, for points on surfaces alone: the code of one kind of receiver.
#[inline(never)]
pub fn tree() {
    machine::begin();
    nothing();
    let stored = flash::tree();
    let tree = stored.view();
    let lights = tree.slots().len() as u32;
    let surface = |i| {
        let (p, n) = point(i);
        SurfaceReceiver::new(p, n)
    };
    measure(
        "tree-sample",
        |i| (surface(i), random(i)),
        |(receiver, u)| apart3(LightBvhRef::sample)(&tree, receiver, *u),
        choice,
    );
    measure(
        "tree-pmf",
        |i| (surface(i), light(i, lights)),
        |(receiver, light)| apart3(LightBvhRef::pmf)(&tree, receiver, *light),
        |pmf| [pmf.to_bits()],
    );
    machine::end();
}

/// The sampler of the tree and the sky, for every kind of receiver.
#[inline(never)]
pub fn sampler() {
    machine::begin();
    nothing();
    let stored = flash::tree();
    let lights = stored.view().slots().len() as u32;
    let infinite = [flash::sky().infinite_light()];
    let Ok(sampler) = BvhLightSamplerRef::new(stored.view(), stored.power(), &infinite) else {
        panic!("no sampler");
    };
    measure(
        "sampler-sample",
        |i| (receiver(i), random(i)),
        |(ctx, u)| apart3(BvhLightSamplerRef::sample)(&sampler, ctx, *u),
        choice,
    );
    measure(
        "sampler-pmf",
        |i| (receiver(i), light(i, lights + 1)),
        |(ctx, light)| apart3(BvhLightSamplerRef::pmf)(&sampler, ctx, *light),
        |pmf| [pmf.to_bits()],
    );
    machine::end();
}

/// Four choices at one point, from a cut of the tree.
#[inline(never)]
pub fn choices() {
    machine::begin();
    nothing();
    let stored = flash::tree();
    let Ok(sampler) = BvhLightSamplerRef::new(stored.view(), stored.power(), &[]) else {
        panic!("no sampler");
    };
    // Of two kilobytes: all queries share them.
    let mut here = LightChoices::default();
    measure(
        "four-choices",
        |i| (receiver(i), random(i)),
        |(ctx, u)| {
            sampler.set_at(ctx, 4, &mut here);
            let mut lights = [u32::MAX; 16];
            for (place, light) in lights.chunks_exact_mut(4).zip(here.samples(*u)) {
                place.copy_from_slice(&choice(Some(light)));
            }
            lights
        },
        |lights| lights,
    );
    machine::end();
}

/// The lights themselves.
#[inline(never)]
pub fn lights() {
    machine::begin();
    nothing();
    let lights = flash::lights();
    measure(
        "sample-li",
        |i| {
            let light = &lights[i as usize % lights.len()];
            (light, receiver(i), random_point(i))
        },
        |(light, ctx, u)| light.light().and_then(|light| light.sample_li(ctx, *u)),
        arrival,
    );
    let sky = flash::sky();
    measure(
        "sky-sample",
        random_point,
        |&u| sky.sample(u),
        sky_direction,
    );
    let axes = flash::axes();
    let axis = |i: u32| axes[i as usize % axes.len()].decode();
    measure("sky-pdf", axis, |&wi| sky.pdf(wi), |pdf| [pdf.to_bits()]);
    let web = flash::web();
    measure(
        "web",
        axis,
        |&w| apart2(PhotometricWebRef::toward)(&web, w),
        |candelas| [candelas.to_bits()],
    );
    machine::end();
}

/// What a measurement costs itself.
fn nothing() {
    measure("nothing", |i| i, |&i| i, |i| [i]);
}

/// Position and normal of the `i`th point on a surface.
fn point(i: u32) -> (Vec3, Vec3) {
    let points = flash::points();
    let PointRecord { p, n } = points[i as usize % points.len()];
    (Vec3::from_array(p), Vec3::from_array(n))
}

/// The `i`th receiver, of each of the five kinds in turn.
#[inline(never)]
fn receiver(i: u32) -> LightSampleContext {
    let ((p, n), (q, wo)) = (point(i), point(i + 1));
    let surface = LightSampleContext::surface(p, n, n);
    match i % 5 {
        0 => surface,
        1 => LightSampleContext::two_sided(p, n, n),
        2 => surface.with_gloss(Gloss {
            wo,
            alpha: 0.2,
            diffuse: 0.5,
        }),
        3 => LightSampleContext::medium(p),
        _ => LightSampleContext::segment(p, q - p),
    }
}

/// One of the first `count` lights.
fn light(i: u32, count: u32) -> LightId {
    LightId(fraction::choose(count, random(i)).0)
}

fn choice(choice: Option<SampledLight>) -> [u32; 4] {
    choice.map_or([u32::MAX; 4], |s| {
        [s.light.0, s.pmf.to_bits(), high(s.u), low(s.u)]
    })
}

fn arrival(sample: Option<LightLiSample<Vec3>>) -> [u32; 10] {
    sample.map_or([u32::MAX; 10], |s| {
        let ([l, m, n], [x, y, z]) = (s.l.to_array(), s.wi.to_array());
        let [px, py, pz] = s.p_light.to_array();
        [l, m, n, x, y, z, s.pdf, px, py, pz].map(f32::to_bits)
    })
}

fn sky_direction(s: SkySample) -> [u32; 7] {
    let ([l, m, n], [x, y, z]) = (s.l.to_array(), s.wi.to_array());
    [l, m, n, x, y, z, s.pdf].map(f32::to_bits)
}

const fn high(u: u64) -> u32 {
    (u >> 32) as u32
}

const fn low(u: u64) -> u32 {
    u as u32
}
