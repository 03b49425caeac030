//! All vector widths give the same bits.

use light_math::glam::Vec3;

use crate::importance::glossy::GlossyReceiver;
use crate::importance::medium::MediumReceiver;
use crate::importance::receiver::Receiver;
use crate::importance::segment::SegmentReceiver;
use crate::importance::surface::SurfaceReceiver;
use crate::importance::two_sided::TwoSidedReceiver;
use crate::node::wide_node::{WIDTH, WideNode};
use crate::query::into_receiver::{Query, QueryFor};
use crate::query::weights::Weights;
use crate::simd::{dispatch, run_with_each_width};

/// The weights of a node's children and the squares of their angular sizes, as bits.
#[derive(Clone, Copy)]
struct Bits<'a>(&'a WideNode);

impl Query for Bits<'_> {
    type Output = [[u32; WIDTH]; 2];

    #[inline(always)]
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
        let (weights, angular_size_sq) = Weights::with_angular_size(self.0, receiver);
        [weights.lanes, angular_size_sq].map(|lanes| lanes.map(f32::to_bits))
    }
}

/// Trivially true where the machine has no wider vectors than the build's target.
#[test]
fn wide_vectors_give_the_bits_of_narrow_ones() {
    fn check<R: Receiver>(node: &WideNode, receiver: &R) {
        let work = QueryFor(receiver, Bits(node));
        let results = run_with_each_width(work);
        for result in &results {
            assert_eq!(*result, results[0], "weights of {node:?}");
        }
        assert_eq!(dispatch(work), results[0], "the widest");
    }
    let mut state = 1u32;
    let mut next = || {
        state = state.wrapping_mul(0x915f_77f5).wrapping_add(1);
        (state >> 16).to_le_bytes()[0]
    };
    for _ in 0..500 {
        let mut bytes = || core::array::from_fn::<u8, WIDTH, _>(|_| next());
        let node = WideNode {
            mean: [bytes(), bytes(), bytes()],
            extent: [bytes(), bytes(), bytes()],
            axis: [bytes(), bytes(), bytes()]
                .map(|axis| axis.map(|code| i8::from_ne_bytes([code]))),
            offset: bytes().map(|code| i8::from_ne_bytes([code])),
            spread: bytes().map(|x| x / 2),
            power: bytes(),
            inv_scale: 100.0,
            ..WideNode::EMPTY
        };
        let [x, y, z, ..] = bytes().map(|x| f32::from(x) * 0.01);
        let (p, n) = (Vec3::new(x, y, z), Vec3::new(y, z, 0.1 - x).normalize());
        let gloss = light_bounds::Gloss {
            wo: n,
            alpha: 0.2,
            diffuse: 0.5,
        };
        check(&node, &SurfaceReceiver::new(p, n));
        check(&node, &GlossyReceiver::new(p, n, &gloss));
        check(&node, &TwoSidedReceiver::new(p, n));
        check(&node, &MediumReceiver::new(p));
        check(&node, &SegmentReceiver::new(p, n));
    }
}
