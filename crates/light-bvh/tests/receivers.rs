//! A receiver of one's own gets the choices of the context that it stands for, to the bit.
#![cfg(feature = "alloc")]

use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{LightExtent, LightId, LightSampleContext, ReceiverSides};
use light_bvh::reference::ReferenceLightBvh;
use light_bvh::{
    CutDetail, LightBvh, LightCut, MediumReceiver, Receiver, SegmentReceiver, SurfaceReceiver,
    TwoSidedReceiver,
};
use light_testkit::Rng;

mod support;
use support::lamp;

const COUNT: u32 = 200;

const P: Vec3 = Vec3::new(0.3, 0.6, 0.1);

fn lamps() -> Vec<LightExtent> {
    let mut rng = Rng::new(3);
    let lamps = (0..COUNT).map(|_| lamp(rng.vec3() + Vec3::Z, rng.log_range(0.1, 10.0)));
    lamps.collect()
}

fn us() -> impl Iterator<Item = f64> {
    (0..16u8).map(|i| (f64::from(i) + 0.5) / 16.0)
}

fn assert_alike<R: Receiver>(receiver: &R, ctx: &LightSampleContext) {
    let tree = LightBvh::build(&lamps()).expect("valid lights");
    let view = tree.view();
    let detail = CutDetail::default();
    let ours = LightCut::new(&view, receiver, detail);
    let theirs = LightCut::at(&view, ctx, detail);
    for u in us() {
        let sample = view.sample_for(receiver, u);
        assert_eq!(sample, view.sample(ctx, u), "{ctx:?} at {u}");
        let light = sample.expect("lit").light;
        let pmf = view.pmf_for(receiver, light);
        assert_eq!(pmf, view.pmf(ctx, light), "{ctx:?} at {u}");
        let sample = ours.sample(&view, receiver, 0.5, u);
        assert_eq!(
            sample,
            theirs.sample_at(&view, ctx, 0.5, u),
            "a cut, {ctx:?} at {u}"
        );
        let sample = sample.expect("lit");
        let pmf = ours.pmf(&view, receiver, 0.5, sample.light);
        assert_eq!(pmf, sample.pmf, "a cut, {ctx:?} at {u}");
    }
    let none = LightId(COUNT);
    assert_eq!(view.pmf_for(receiver, none), 0.0, "no such light");
    assert_eq!(ours.pmf(&view, receiver, 1.0, none), 0.0, "no such light");
}

#[test]
fn receivers_are_their_contexts() {
    let n = Vec3::Z;
    let surface = LightSampleContext::surface(P, n, n);
    assert_alike(&SurfaceReceiver::new(P, n), &surface);
    let both = LightSampleContext {
        sides: ReceiverSides::Both,
        ..surface
    };
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
