//! Pins what the tree answers, bit for bit and on every platform: a change here breaks
//! reproducibility and belongs in the changelog as value-breaking.

use light_bvh::light_bounds::light_math::{Aabb, fraction::from_f64, glam::Vec3};
use light_bvh::light_bounds::{Gloss, LightBounds, LightExtent, LightSampleContext};
use light_bvh::reference::ReferenceLightBvh;
use light_bvh::{CutDetail, LightBvh};

/// Spots and boxes on a spiral, made of operations that every platform rounds alike.
fn lights() -> Vec<LightExtent> {
    let light = |i: u16| {
        let t = f32::from(i);
        let p = Vec3::new(t * 0.25, t * 7.0 % 5.0, t * 3.0 % 11.0);
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::new(p, p + Vec3::splat(t % 3.0 * 0.125)),
            w: [Vec3::X, Vec3::NEG_Z, Vec3::new(0.6, 0.0, -0.8)][usize::from(i % 3)],
            phi: 1.0 + t,
            cos_theta_o: 1.0 - t / 64.0,
            cos_theta_e: f32::from(i % 2),
            two_sided: i % 5 == 0,
        })
    };
    (0..64).map(light).collect()
}

#[test]
fn reference_tree() {
    let tree = ReferenceLightBvh::build(&lights()).expect("valid lights");
    let ctx = LightSampleContext::surface(Vec3::new(3.0, 2.0, -1.0), Vec3::Z, Vec3::Z);
    let chosen = [0.0, 0.125, 0.5, 0.75, 0.96875].map(|u| {
        let sample = tree.sample(&ctx, from_f64(u)).expect("lit");
        (sample.light.0, sample.pmf.to_bits())
    });
    let pinned = [
        (0, 0x39e2_7f7d),
        (11, 0x3e13_eca8),
        (34, 0x3c8f_754e),
        (44, 0x3d28_ffd2),
        (61, 0x3cfc_2629),
    ];
    assert_eq!(chosen, pinned, "samples");
    let emitted = [0.25, 0.875].map(|u| {
        let sample = tree.sample_emitter(from_f64(u)).expect("lit");
        (sample.light.0, sample.pmf.to_bits())
    });
    let pinned = [(35, 0x3c8d_c8dd), (61, 0x3cf4_2f43)];
    assert_eq!(emitted, pinned, "without a context");
}

#[test]
fn default_tree() {
    let tree = LightBvh::build(&lights()).expect("valid lights");
    let p = Vec3::new(3.0, 2.0, -1.0);
    let surface = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
    let glossy = surface.with_gloss(Gloss {
        wo: Vec3::new(0.6, 0.0, 0.8),
        alpha: 0.25,
        diffuse: 0.5,
    });
    let receivers = [
        surface,
        glossy,
        LightSampleContext::two_sided(p, Vec3::Z, Vec3::Z),
        LightSampleContext::medium(p),
        LightSampleContext::segment(p, Vec3::new(8.0, -1.0, 4.0)),
    ];
    let chosen = receivers.map(|ctx| {
        [0.125, 0.75].map(|u| {
            let sample = tree.sample(&ctx, from_f64(u)).expect("lit");
            (sample.light.0, sample.pmf.to_bits())
        })
    });
    let pinned = [
        [(8, 0x3dbe_775a), (28, 0x3d15_fd6c)],
        [(8, 0x3e11_60be), (10, 0x3c96_0501)],
        [(8, 0x3dbc_19d6), (28, 0x3d15_900f)],
        [(8, 0x3d90_1237), (32, 0x3c5f_dbb8)],
        [(30, 0x3de0_0f8e), (42, 0x3c11_5f7e)],
    ];
    assert_eq!(
        chosen, pinned,
        "surface, glossy, two-sided, medium, segment"
    );

    let view = tree.view();
    let cut = view.cut(&surface, CutDetail::default());
    let chosen = [0.125, 0.75].map(|u| {
        let sample = cut.sample(from_f64(u)).expect("lit");
        (sample.light.0, sample.pmf.to_bits())
    });
    let pinned = [(49, 0x3c17_dbab), (19, 0x3d24_2fa1)];
    assert_eq!(chosen, pinned, "from a cut");
}
