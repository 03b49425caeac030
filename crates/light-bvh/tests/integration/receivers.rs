//! A receiver of one's own gets the choices of the context that it stands for, to the bit.

use light_bvh::light_bounds::light_math::fraction::stratum;
use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{LightExtent, LightId, LightSampleContext, SampledLight};
use light_bvh::reference::ReferenceLightBvh;
use light_bvh::{
    CutDetail, LightBvh, MediumReceiver, Receiver, SegmentReceiver, SurfaceReceiver,
    TwoSidedReceiver,
};
use light_testkit::Rng;

use crate::support::lamp;

const COUNT: u32 = 200;

const P: Vec3 = Vec3::new(0.3, 0.6, 0.1);

fn lamps() -> Vec<LightExtent> {
    let mut rng = Rng::new(3);
    let lamps = (0..COUNT).map(|_| lamp(rng.vec3() + Vec3::Z, rng.log_range(0.1, 10.0)));
    lamps.collect()
}

fn us() -> impl Iterator<Item = u64> {
    (0..16).map(|i| stratum(i, 16, 1 << 63))
}

fn assert_alike<R: Receiver>(receiver: &R, ctx: &LightSampleContext) {
    let tree = LightBvh::build(&lamps()).expect("valid lights");
    let view = tree.view();
    let detail = CutDetail::default();
    let (ours, theirs) = (view.cut(receiver, detail), view.cut(ctx, detail));
    let (here, there) = (view.at(receiver), view.at(ctx));
    assert_eq!(here.irradiance(), there.irradiance(), "{ctx:?}");
    for u in us() {
        let sample = view.sample(receiver, u);
        assert_eq!(sample, view.sample(ctx, u), "{ctx:?} at {u}");
        assert_eq!(sample, here.sample(u), "kept, {ctx:?} at {u}");
        assert_eq!(sample, there.sample(u), "kept, {ctx:?} at {u}");
        let SampledLight { light, pmf, .. } = sample.expect("lit");
        let pmfs = [
            view.pmf(receiver, light),
            view.pmf(ctx, light),
            here.pmf(light),
            there.pmf(light),
        ];
        assert_eq!(pmfs, [pmf; 4], "{ctx:?} at {u}");
        let sample = ours.sample(u);
        assert_eq!(sample, theirs.sample(u), "a cut, {ctx:?} at {u}");
        let sample = sample.expect("lit");
        assert_eq!(ours.pmf(sample.light), sample.pmf, "a cut, {ctx:?} at {u}");
    }
    let none = LightId(COUNT);
    assert_eq!(view.pmf(receiver, none), 0.0, "no such light");
    assert_eq!(here.pmf(none), 0.0, "no such light");
    assert_eq!(ours.pmf(none), 0.0, "no such light");
}

#[test]
fn receivers_are_their_contexts() {
    let n = Vec3::Z;
    let surface = LightSampleContext::surface(P, n, n);
    assert_alike(&SurfaceReceiver::new(P, n), &surface);
    let both = LightSampleContext::two_sided(P, n, n);
    assert_alike(&TwoSidedReceiver::new(P, n), &both);
    let medium = LightSampleContext::medium(P);
    assert_alike(&MediumReceiver::new(P), &medium);
    let segment = LightSampleContext::segment(P, Vec3::ONE);
    assert_alike(&SegmentReceiver::new(P, Vec3::ONE), &segment);
}

/// An owned reference tree answers as a view of it.
#[test]
fn a_reference_tree_is_its_view() {
    let tree = ReferenceLightBvh::build(&lamps()).expect("valid lights");
    let view = tree.view();
    let ctx = LightSampleContext::medium(P);
    for u in us() {
        let sample = tree.sample(&ctx, u).expect("lit");
        assert_eq!(Some(sample), view.sample(&ctx, u), "at {u}");
        assert_eq!(tree.pmf(&ctx, sample.light), sample.pmf, "at {u}");
        let sample = tree.sample_emitter(u).expect("lit");
        assert_eq!(Some(sample), view.sample_emitter(u), "at {u}");
        assert_eq!(tree.pmf_emitter(sample.light), sample.pmf, "at {u}");
    }
}
