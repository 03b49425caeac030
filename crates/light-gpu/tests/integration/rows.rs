//! Rows are what the shader's comments say of them.

use light_gpu::light_bvh::light_bounds::{CompactLightBounds, LightBounds, LightExtent};
use light_gpu::light_bvh::light_math::distribution::AliasTable;
use light_gpu::light_bvh::light_math::{Aabb, DirectionCone, glam::Vec3};
use light_gpu::light_bvh::{LightBvh, WideNode};
use light_gpu::light_samplers::BvhLightSampler;
use light_gpu::light_samplers::light_bounds::InfiniteBounds;
use light_gpu::{
    TooManyInfiniteLights, alias_table_rows, compact_bounds_rows, light_sampler_rows,
    light_tree_rows, node_rows,
};

fn lamps(count: u16) -> LightBvh {
    let lights: Vec<LightExtent> = (0..count)
        .map(|i| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(Vec3::new(f32::from(i), f32::from(i % 7), 2.0)),
                w: Vec3::NEG_Z,
                phi: 1.0 + f32::from(i),
                cos_theta_o: 1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        })
        .collect();
    LightBvh::build(&lights).expect("valid lights")
}

#[test]
fn a_tree_is_a_head_and_three_parts() {
    let tree = lamps(103);
    let tree = tree.view();
    let rows = light_tree_rows(&tree);
    let [nodes, order, lights, _] = rows[0].map(|n| n as usize);
    assert_eq!(nodes, tree.nodes().len(), "nodes");
    assert_eq!((order, lights), (26, 103), "rows of the order, and lights");
    let (in_nodes, rest) = rows[1..].split_at(14 * nodes);
    assert_eq!(in_nodes, node_rows(tree.nodes()), "the nodes");
    let (in_order, in_slots) = rest.split_at(order);
    assert_eq!(in_order.as_flattened()[..103], *tree.order(), "the order");
    assert_eq!(in_slots.as_flattened()[..103], *tree.slots(), "the slots");
}

/// The shader reads the fields of a node at these rows.
#[test]
fn a_node_is_fourteen_rows() {
    let node = WideNode {
        power: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15],
        origin: [1.0, 2.0, 3.0],
        inv_scale: 4.0,
        child_base: 5,
        light_base: 6,
        inner: 7,
        count: 8,
        parent: 9,
        ..WideNode::EMPTY
    };
    let rows = node_rows(core::slice::from_ref(&node));
    assert_eq!(rows.len(), 14, "rows of a node");
    assert_eq!(
        rows[11][1],
        u32::from_le_bytes([4, 5, 6, 7]),
        "bytes of children 4 to 7"
    );
    assert_eq!(
        rows[12].map(f32::from_bits),
        [1.0, 2.0, 3.0, 4.0],
        "origin and scale"
    );
    let [child_base, light_base, counts, parent] = rows[13];
    assert_eq!((child_base, light_base, parent), (5, 6, 9), "links");
    assert_eq!((counts >> 16) & 0xff, 7, "inner");
    assert_eq!(counts >> 24, 8, "count");
}

#[test]
fn no_light_is_a_head_alone() {
    let none = LightBvh::build(&[]).map(|tree| light_tree_rows(&tree.view()));
    assert_eq!(none.expect("an empty tree"), [[0; 4]], "only the head");
}

#[test]
fn a_bin_is_a_row() {
    let table = AliasTable::new(&[1.0, 3.0]).expect("valid weights");
    let rows = alias_table_rows(table.bins());
    for (row, bin) in rows.iter().zip(table.bins()) {
        assert_eq!(*row, [bin.own, bin.alias, bin.pmf.to_bits(), 0], "{bin:?}");
    }
}

fn bounds(cos_theta_o: f32) -> LightBounds {
    LightBounds {
        bounds: Aabb::from_point(Vec3::new(1.0, 2.0, 3.0)),
        w: Vec3::Z,
        phi: 5.0,
        cos_theta_o,
        cos_theta_e: 0.5,
        two_sided: true,
    }
}

#[test]
fn compact_bounds_are_six_words_after_their_box() {
    let all = Aabb::new(Vec3::new(-1.0, -2.0, -3.0), Vec3::new(4.0, 5.0, 6.0));
    let two = [0.25, 1.0].map(|cos| CompactLightBounds::encode(&bounds(cos), &all));
    let rows = compact_bounds_rows(&two, &all);
    assert_eq!(rows.len(), 2 + 3, "two of the box, twelve words");
    let [x, y, z, count] = rows[0];
    let lower = [x, y, z].map(f32::from_bits);
    assert_eq!(
        (lower, count),
        ([-1.0, -2.0, -3.0], 2),
        "the box and the count"
    );
    assert_eq!(f32::from_bits(rows[1][2]), 6.0, "its upper corner");
    let words = &rows[2..].as_flattened()[6..];
    assert_eq!(words[0], two[1].w().to_bits(), "the axis of the second");
    assert_eq!(f32::from_bits(words[1]), 5.0, "its power");
    assert_eq!(words[2], two[1].packed(), "its cosines");
    let [ax, ay, az] = two[1].bounds().min.map(u32::from);
    let [bx, by, bz] = two[1].bounds().max.map(u32::from);
    let corners = [ax | ay << 16, az | bx << 16, by | bz << 16];
    assert_eq!(words[3..], corners, "its box");
}

/// The shader has this number in place of what it would round.
#[test]
fn a_cone_of_one_normal_is_widened_to_the_number_below_1() {
    let all = Aabb::from_point(Vec3::new(1.0, 2.0, 3.0));
    let decoded = CompactLightBounds::encode(&bounds(1.0), &all).decode(&all);
    assert_eq!(decoded.cos_theta_o, 1.0f32.next_down(), "0x1.fffffep-1");
}

fn skies(count: usize) -> BvhLightSampler {
    let sky = LightExtent::Infinite(InfiniteBounds {
        fluence: 0.5,
        mean: 0.4 * Vec3::X,
        cone: DirectionCone::new(Vec3::X, 0.1),
    });
    BvhLightSampler::new(&vec![sky; count]).expect("valid skies")
}

#[test]
fn lights_at_infinity_are_three_rows_each_before_the_tree() {
    let sampler = skies(2);
    let rows = light_sampler_rows(&sampler.view()).expect("few skies");
    assert_eq!(rows[0], [0, 2, 0, 0], "a tree without power");
    let floats = |row: [u32; 4]| row.map(f32::from_bits);
    assert_eq!(floats(rows[4]), [0.4, 0.0, 0.0, 0.5], "mean and fluence");
    assert_eq!(floats(rows[5]), [1.0, 0.0, 0.0, 0.1], "the cone");
    assert_eq!(rows[6][0], 1, "the id");
    assert_eq!(
        rows[7..],
        light_tree_rows(&sampler.view().tree()),
        "the tree"
    );
}

#[test]
fn too_many_lights_at_infinity_are_refused() {
    assert!(light_sampler_rows(&skies(63).view()).is_ok(), "the most");
    let refused = light_sampler_rows(&skies(64).view());
    assert_eq!(refused, Err(TooManyInfiniteLights), "one more");
    let text = TooManyInfiniteLights.to_string();
    assert_eq!(text, "more than 63 lights at infinity", "says how many");
}
