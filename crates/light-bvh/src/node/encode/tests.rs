use super::*;
use crate::node::light_emission::Shape;
use light_math::Aabb;
use light_math::glam::Vec3;

/// Numbers of `[-1, 1)`.
fn numbers() -> impl FnMut() -> f32 {
    let mut state = 1u32;
    move || {
        state = state.wrapping_mul(0x915f_77f5).wrapping_add(1);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    }
}

fn vector(next: &mut impl FnMut() -> f32) -> Vec3 {
    Vec3::new(next(), next(), next())
}

/// Children about `at`, with boxes and axes of any size.
fn children(next: &mut impl FnMut() -> f32, at: Vec3, size: f32) -> [Moments; WIDTH] {
    core::array::from_fn(|_| {
        let (a, b) = (at + vector(next) * size, at + vector(next) * size);
        let bounds = Aabb::new(a.min(b), a.max(b));
        Moments {
            power: 1.0,
            bounds,
            mean: (a + (b - a) * next().abs()).clamp(bounds.min, bounds.max),
            axis: vector(next) * 4.0 * next(),
            offset: next(),
            ..Moments::NOTHING
        }
    })
}

#[test]
fn boxes_hold_what_they_must() {
    let mut next = numbers();
    for (at, size) in [
        (0.0, 1.0),
        (1e4, 0.01),
        (-1e3, 1e3),
        (0.0, 1e-20),
        (1e30, 1e36),
    ] {
        for _ in 0..2000 {
            let children = children(&mut next, Vec3::splat(at), size);
            let node = WideNode::encode(&children);
            for (k, child) in children.iter().enumerate() {
                for axis in 0..3 {
                    let code = |code: u8| f64::from(code) / f64::from(node.inv_scale);
                    let mean = f64::from(node.origin[axis]) + code(node.mean[axis][k]);
                    let half = code(node.extent[axis][k]);
                    let (min, max) = (child.bounds.min[axis], child.bounds.max[axis]);
                    assert!(mean - half <= f64::from(min), "{k}: {child:?} in {node:?}");
                    assert!(mean + half >= f64::from(max), "{k}: {child:?} in {node:?}");
                }
            }
        }
    }
}

/// In all directions in which the exact line emits, and from its codes: a margin is left for the
/// rounding of receivers.
#[test]
fn offsets_leave_what_receivers_round_off() {
    /// In codes; nine tenths of the margin, the rest is the encoder's own round-off.
    const LEFT: f64 = 0.009;
    let mut next = numbers();
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (mut sharp, mut least_left) = (0, f64::INFINITY);
    for _ in 0..20_000 {
        let children = children(&mut next, Vec3::ZERO, 1.0);
        let node = WideNode::encode(&children);
        for (k, child) in children.iter().enumerate() {
            let decoded = node.axis.map(|axis| f64::from(axis[k]));
            let axis = child.axis.to_array().map(f64::from);
            let length = dot(axis, axis).sqrt();
            let cos = f64::from(child.offset) / length;
            if node.spread[k] > 0 || !(cos.abs() < 1.0) {
                continue;
            }
            let along = dot(decoded, axis) / length;
            let aside = (dot(decoded, decoded) - along * along).max(0.0).sqrt();
            let sin = (1.0 - cos * cos).sqrt();
            // Seen from the exact axis, the direction opposite to the decoded one is at the
            // angle of cosine `-along / |decoded|`.
            let opposite_is_lit = -along / dot(decoded, decoded).sqrt() >= cos;
            let least = if opposite_is_lit {
                -dot(decoded, decoded).sqrt()
            } else {
                along * cos - aside * sin
            };
            sharp += 1;
            least_left = least_left.min(least - f64::from(node.offset[k]));
        }
    }
    assert!(sharp > 20_000, "{sharp} sharp");
    assert!(least_left >= LEFT, "{least_left} codes are left");
}

#[test]
fn nothing_sharp_emits_beyond_its_axis_and_offset() {
    let mut next = numbers();
    let (mut sharp, mut lit) = (0, 0);
    for _ in 0..1000 {
        let children = children(&mut next, Vec3::ZERO, 1.0);
        let node = WideNode::encode(&children);
        let w = vector(&mut next).normalize_or(Vec3::X);
        for (k, child) in children.iter().enumerate() {
            let axis = Vec3::from(node.axis.map(|axis| f32::from(axis[k])));
            sharp += u32::from(node.spread[k] == 0);
            if node.spread[k] == 0 && child.axis.dot(w) > child.offset {
                lit += 1;
                let decoded = axis.dot(w) - f32::from(node.offset[k]);
                assert!(decoded > 0.0, "{k}: {child:?} in {node:?}");
            }
        }
    }
    assert!(sharp > 1000 && lit > 1000, "{sharp} sharp, {lit} lit");
}

#[test]
fn wide_vectors_encode_as_narrow_ones_do() {
    let mut next = numbers();
    for _ in 0..300 {
        let mut children = children(&mut next, Vec3::splat(3.0), 2.0);
        for child in &mut children {
            child.power = next().max(0.0);
            child.spread_sq = next().max(0.0);
        }
        let mut narrow = WideNode::EMPTY;
        narrow.set(&children);
        assert_eq!(WideNode::encode(&children), narrow, "{children:?}");
    }
}

#[test]
fn what_is_off_leaves_its_slot_empty() {
    let mut children = children(&mut numbers(), Vec3::ZERO, 1.0);
    children[3] = Moments::NOTHING;
    let node = WideNode::encode(&children[..7]);
    assert_eq!(node.count, 7, "with the empty slot");
    for k in [3, 7] {
        assert_eq!(node.power[k], 0, "slot {k}");
        assert_eq!(node.extent.map(|extent| extent[k]), [1; 3], "slot {k}");
    }
    assert!(node.power[..3].iter().all(|&power| power > 0), "others");
}

/// Spots along and against `w` in one place, all others along `w`.
fn spots(w: Vec3, against: usize) -> Moments {
    let spot = |k: usize| Moments {
        power: 1.0,
        bounds: Aabb::from_point(Vec3::splat(k as f32)),
        mean: Vec3::splat(k as f32),
        axis: if k < against { -w } else { w },
        line: if k < against { -w } else { w },
        offset: 0.9,
        shape: Shape::Steps,
        ..Moments::NOTHING
    };
    Moments::join(&[0, 1, 2, 3].map(spot))
}

#[test]
fn offsets_of_opposed_beams_are_odd_and_those_of_other_spots_even() {
    let mut next = numbers();
    for _ in 0..100 {
        let w = vector(&mut next).normalize();
        let groups = [spots(w, 2), spots(w, 0), spots(w, 4), spots(w, 2)];
        let node = WideNode::encode(&groups);
        assert!(node.has_rare(), "{w}");
        let odd = [0, 1, 2, 3].map(|k| node.offset[k] & 1 == 1);
        assert_eq!(odd, [true, false, false, true], "{w}: {:?}", node.offset);
        for (k, group) in groups.iter().enumerate() {
            assert!((node.offset[k] - 114).abs() <= 1, "{w}: {:?}", node.offset);
            let axis = Vec3::from_array([0, 1, 2].map(|i| f32::from(node.axis[i][k])));
            assert!(axis.dot(group.line) > 125.0, "{w}: {axis}");
        }
        let plain = WideNode::encode(&[spots(w, 0), spots(w, 4)]);
        assert!(!plain.has_rare(), "{w}: all beams of a group the same way");
    }
}
