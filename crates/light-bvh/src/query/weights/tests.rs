//! Weights in codes, where they are trusted, are those in a unit near the distance.

use light_bounds::Gloss;
use light_math::glam::Vec3;
use light_testkit::Rng;

use super::*;
use crate::importance::glossy::GlossyReceiver;
use crate::importance::medium::MediumReceiver;
use crate::importance::segment::SegmentReceiver;
use crate::importance::surface::SurfaceReceiver;
use crate::importance::two_sided::TwoSidedReceiver;

/// Whether the weights in codes of this node are trusted; they differ from those in the other unit,
/// a power of two, by its square alone.
fn check<R: Receiver>(node: &WideNode, receiver: &R) -> bool {
    let frame = NodeFrame::in_codes(node, receiver.position());
    let in_codes = Weights::in_frame(node, receiver, &frame, false, note_nothing);
    if !is_trusted(in_codes.total, &frame, receiver) {
        return false;
    }
    let afar = Weights::from_afar(node, receiver, false);
    let zoom = f64::from(in_codes.inv_unit) / f64::from(afar.inv_unit);
    for (ours, theirs) in in_codes.lanes.iter().zip(afar.lanes) {
        let expected = f64::from(theirs) / (zoom * zoom);
        assert_eq!(f64::from(*ours), expected, "{node:?}");
    }
    true
}

#[test]
fn no_weight_vanishes_near_a_node() {
    let mut rng = Rng::new(7);
    let (mut trusted, mut asked) = ([0; 5], 0);
    for i in 0..4000 {
        let mut bytes = |below: usize| [0; WIDTH].map(|_: u8| rng.below(below).to_le_bytes()[0]);
        let signed = |codes: [u8; WIDTH]| codes.map(|code| i8::from_ne_bytes([code]));
        let node = WideNode {
            mean: [bytes(256), bytes(256), bytes(256)],
            extent: [bytes(8), bytes(8), bytes(8)],
            axis: [bytes(256), bytes(256), bytes(256)].map(signed),
            offset: signed(bytes(256)),
            spread: bytes(128),
            // The dimmest lights, alone and beside the brightest.
            power: bytes([3, 249][i % 2]),
            inv_scale: 64.0,
            ..WideNode::EMPTY
        };
        let far = rng.log_range(1.0, 1e7);
        let (toward, n) = (rng.direction(), rng.direction());
        // Half of the receivers see the node at their horizon.
        let level = (n - toward * n.dot(toward)).normalize_or(Vec3::Z);
        let n = if rng.f32() < 0.5 { level } else { n };
        let p = toward * -far;
        let gloss = Gloss {
            wo: rng.direction(),
            alpha: rng.f32(),
            diffuse: 0.0,
        };
        let along = rng.direction() * rng.log_range(1e-3, 1e7);
        asked += 1;
        for (trusted, is_trusted) in trusted.iter_mut().zip([
            check(&node, &SurfaceReceiver::new(p, n)),
            check(&node, &GlossyReceiver::new(p, n, &gloss)),
            check(&node, &TwoSidedReceiver::new(p, n)),
            check(&node, &MediumReceiver::new(p)),
            check(&node, &SegmentReceiver::new(p, along)),
        ]) {
            *trusted += u32::from(is_trusted);
        }
    }
    for trusted in trusted {
        let is_half = asked / 2 < trusted && trusted < asked;
        assert!(is_half, "{trusted} of {asked} are trusted");
    }
}
