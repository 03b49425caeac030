//! Pins what cells are and what they answer, bit for bit and on every platform: a change here
//! breaks reproducibility and belongs in the changelog as value-breaking.

use light_bvh::LightBvh;
use light_bvh::light_bounds::light_math::{Aabb, fraction::from_f64, glam::Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::visibility::{CellKey, CellTable, CoarseCell, FillOptions};

/// Flat lights on a spiral, made of operations that every platform rounds alike.
fn lights() -> Vec<LightExtent> {
    let light = |i: u16| {
        let t = f32::from(i);
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(Vec3::new(t * 0.25, t * 7.0 % 5.0, 4.0 + t * 3.0 % 11.0)),
            w: [Vec3::X, Vec3::NEG_Z, Vec3::new(0.6, 0.0, -0.8)][usize::from(i % 3)],
            phi: 1.0 + t,
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: i % 5 == 0,
        })
    };
    (0..400).map(light).collect()
}

#[test]
fn cells_are_pinned() {
    let tree = LightBvh::build(&lights()).expect("valid lights");
    let place = |i: u16| {
        let p = Vec3::new(
            50.0 + f32::from(i % 8) / 8.0,
            2.0 + f32::from(i / 8) / 8.0,
            0.0,
        );
        LightSampleContext::surface(p, Vec3::Z, Vec3::Z)
    };
    let places: Vec<_> = (0..64).map(place).collect();
    let key = CellKey::fine(&places[20], 1.0);
    let (view, options) = (tree.view(), FillOptions::default());
    // Half of the lights are seen, others from half of the places.
    let see = |at: &LightSampleContext, light: LightId, _| {
        Some(light.0 % 2 == 0 || (light.0 > 200 && at.p.x > 50.4))
    };
    let coarse = CoarseCell::fill(view, key.coarse(), &places, &options, see);
    let fine = coarse.fill_fine(view, key, &places[20..24], &options, see);
    let table = CellTable::new(&[coarse], &[fine]).expect("cells");
    let sum = |bytes: &mut dyn Iterator<Item = u8>| {
        bytes.fold(0u32, |sum, byte| {
            sum.wrapping_mul(31).wrapping_add(u32::from(byte))
        })
    };
    let parts = table.view().parts();
    let shapes = sum(&mut parts
        .shapes
        .iter()
        .flat_map(|node| node.opened.to_le_bytes()));
    let factors = sum(&mut parts.factors.iter().flatten().copied());
    let within = view.in_cell(table.view().factors(key));
    let chosen = [0.125, 0.5, 0.875].map(|u| {
        let sample = within.sample(&places[20], from_f64(u)).expect("lit");
        (sample.light.0, sample.pmf.to_bits())
    });
    let pinned = (
        107_351_589,
        1_986_311_891,
        [(176, 0x3c9d_9d58), (203, 0x3cf1_c1b2), (232, 0x3c45_f7fb)],
    );
    assert_eq!((shapes, factors, chosen), pinned, "nodes, factors, samples");
}
