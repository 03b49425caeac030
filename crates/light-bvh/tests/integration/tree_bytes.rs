//! Trees as bytes: what comes back answers as before, and what is damaged is refused.

use light_bvh::light_bounds::light_math::{Aabb, fraction::stratum, glam::Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightGroups, LightId, LightSampleContext};
use light_bvh::{LightBvh, LightBvhOptions, StoredLightBvh, TreeBytesError};
use light_testkit::Rng;

/// Bytes of a tree before its nodes.
const HEADER: usize = 32;

/// Points in a cube, one in ten off.
fn lights(count: usize) -> Vec<LightExtent> {
    let mut rng = Rng::new(1);
    let light = |k: usize| {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(rng.vec3()),
            w: Vec3::Z,
            phi: if k % 10 == 3 { 0.0 } else { 1.0 + k as f32 },
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    };
    (0..count).map(light).collect()
}

fn tree(count: usize) -> LightBvh {
    LightBvh::build(&lights(count)).expect("valid lights")
}

/// The bytes where a tree can be used: at a multiple of 32, `shift` bytes further.
struct Aligned {
    memory: Vec<u8>,
    start: usize,
    len: usize,
}

impl Aligned {
    fn new(bytes: &[u8], shift: usize) -> Self {
        let mut memory = vec![0; bytes.len() + 64];
        let start = memory.as_ptr().align_offset(32) + shift;
        memory[start..start + bytes.len()].copy_from_slice(bytes);
        let len = bytes.len();
        Self { memory, start, len }
    }

    fn get(&self) -> &[u8] {
        &self.memory[self.start..][..self.len]
    }
}

#[test]
fn trees_come_back_from_bytes() {
    let floor = LightSampleContext::surface(Vec3::new(0.2, 0.3, -0.5), Vec3::Z, Vec3::Z);
    for count in [0, 1, 16, 17, 3000] {
        let tree = tree(count);
        let bytes = Aligned::new(&tree.to_bytes(), 0);
        let stored = StoredLightBvh::from_bytes(bytes.get()).expect("a tree");
        assert_eq!(stored.power(), tree.power(), "{count} lights");
        assert_eq!(
            stored.view().at(&floor).irradiance(),
            tree.view().at(&floor).irradiance(),
            "{count}"
        );
        for i in 0..100 {
            let u = stratum(i, 100, 0);
            let sample = tree.sample(&floor, u);
            assert_eq!(
                stored.view().sample(&floor, u),
                sample,
                "{count} lights, {u}"
            );
        }
        for id in (0..).map(LightId).take(count) {
            let pmf = tree.pmf(&floor, id);
            assert_eq!(stored.view().pmf(&floor, id), pmf, "{count} lights, {id:?}");
        }
        let shifted = Aligned::new(bytes.get(), 3);
        let copy = LightBvh::from_bytes(shifted.get()).expect("a tree at any place");
        assert_eq!(copy.to_bytes(), bytes.get(), "{count} lights");
    }
}

/// Groups lie in the bytes, and groups of a node that are not those of its lights are refused.
#[test]
fn groups_come_back_from_bytes() {
    let mut tree = tree(700);
    let plain = tree.to_bytes();
    let groups: Vec<_> = (0..700).map(|k| LightGroups::of(k % 3)).collect();
    tree.set_groups(&groups).expect("as many");
    let bytes = Aligned::new(&tree.to_bytes(), 0);
    let nodes = tree.view().nodes().len();
    assert_eq!(bytes.get().len(), plain.len() + 64 * nodes, "64 a node");
    let stored = StoredLightBvh::from_bytes(bytes.get()).expect("a tree");
    assert_eq!(stored.view().groups(), tree.groups(), "the same");
    let copy = LightBvh::from_bytes(bytes.get()).expect("a tree");
    assert_eq!(copy.to_bytes(), bytes.get(), "a copy");
    let floor = LightSampleContext::medium(Vec3::ZERO).with_groups(LightGroups::of(1));
    for id in (0..700).map(LightId) {
        let pmf = stored.view().pmf(&floor, id);
        assert_eq!(pmf, tree.pmf(&floor, id), "{id:?}");
        assert!(pmf == 0.0 || id.0 % 3 == 1, "{id:?}");
    }
    for at in [plain.len(), bytes.get().len() - 1] {
        let mut damaged = Aligned::new(bytes.get(), 0);
        let start = damaged.start;
        damaged.memory[start + at] ^= 0x41;
        let found = StoredLightBvh::from_bytes(damaged.get()).map(|_| ());
        assert_eq!(found, Err(TreeBytesError::Links), "byte {at}");
    }
    let mut fewer = bytes.get()[..bytes.get().len() - 64].to_vec();
    fewer[28..32].copy_from_slice(&(u32::try_from(nodes).expect("few") - 1).to_le_bytes());
    let found = LightBvh::from_bytes(&fewer).map(|_| ());
    assert_eq!(found, Err(TreeBytesError::Links), "one node without");
}

#[test]
fn a_copy_can_be_refitted() {
    let lights = lights(500);
    let options = LightBvhOptions::DYNAMIC;
    let mut tree = LightBvh::build_with(&lights, &options).expect("valid lights");
    let mut copy = LightBvh::from_bytes(&tree.to_bytes()).expect("a tree");
    let brighter: Vec<_> = lights
        .iter()
        .map(|light| match light {
            LightExtent::Bounded(bounds) => LightExtent::Bounded(LightBounds {
                phi: 3.0 + bounds.phi,
                ..*bounds
            }),
            other => *other,
        })
        .collect();
    tree.refit(&brighter).expect("the same lights");
    copy.refit(&brighter).expect("the same lights");
    assert_eq!(copy.to_bytes(), tree.to_bytes(), "refitted alike");
}

#[test]
fn what_is_no_tree_is_refused() {
    let whole = tree(40).to_bytes();
    let error = |bytes: &[u8]| StoredLightBvh::from_bytes(bytes).map(|_| ()).unwrap_err();
    for len in [0, 7, HEADER - 1] {
        assert_eq!(error(&whole[..len]), TreeBytesError::NoTree, "{len} bytes");
    }
    let expected = whole.len() as u64;
    for len in [HEADER, HEADER + 5, whole.len() - 1] {
        let cut = Aligned::new(&whole[..len], 0);
        let found = error(cut.get());
        assert_eq!(found, TreeBytesError::Length { expected }, "{len} bytes");
    }
    let mut other = whole.clone();
    other[3] ^= 1;
    assert_eq!(error(&other), TreeBytesError::NoTree, "another file");
    let mut newer = whole.clone();
    newer[8] = 9;
    assert_eq!(error(&newer), TreeBytesError::Version { found: 9 }, "newer");
    let shifted = Aligned::new(&whole, 4);
    assert_eq!(
        error(shifted.get()),
        TreeBytesError::Alignment,
        "4 bytes off"
    );
}

/// Every byte changed once: the tree is refused, or it answers without a panic; links are refused.
#[test]
fn damaged_links_are_refused() {
    let tree = tree(300);
    let whole = tree.to_bytes();
    let (nodes, slots) = (tree.view().nodes().len(), tree.view().slots().len());
    let floor = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z);
    for at in 0..whole.len() {
        let mut bytes = Aligned::new(&whole, 0);
        let start = bytes.start;
        bytes.memory[start + at] ^= 0x41;
        let in_node = at.checked_sub(HEADER).filter(|at| *at < nodes * 224);
        let is_link = match in_node {
            // `child_base` of a node without children, and `light_base` of one without lights, lead
            // nowhere.
            Some(at) => match tree.view().nodes()[at / 224] {
                node if (208..212).contains(&(at % 224)) => node.inner > 0,
                node if (212..216).contains(&(at % 224)) => {
                    usize::from(node.inner) < node.children()
                }
                _ => at % 224 >= 218,
            },
            None => at >= HEADER,
        };
        match StoredLightBvh::from_bytes(bytes.get()) {
            Ok(stored) => {
                assert!(!is_link, "byte {at} of {nodes} nodes, {slots} lights");
                for u in [0, 0x5eb8_51eb_851e_b852, u64::MAX] {
                    let _ = stored.view().sample(&floor, u);
                }
                let _ = stored.view().pmf(&floor, LightId(7));
            }
            Err(_) => assert!(is_link || at < HEADER, "byte {at} is no link"),
        }
    }
}

#[test]
fn chains_deeper_than_a_tree_are_refused() {
    let one = tree(1);
    let mut bytes = one.to_bytes();
    let node = one.view().nodes()[0];
    // 30 nodes, each the only child of the one before, and the light in the last.
    let mut chain = [node; 30];
    for (k, node) in (0u32..).zip(&mut chain) {
        (node.inner, node.count) = if k < 29 { (1, 1) } else { (0, 1) };
        node.parent = if k == 0 { u32::MAX } else { 16 * (k - 1) };
        node.child_base = k + 1;
    }
    bytes.truncate(HEADER);
    bytes[12..16].copy_from_slice(&30u32.to_le_bytes());
    for node in &chain {
        bytes.extend_from_slice(bytemuck::bytes_of(node));
    }
    bytes.extend_from_slice(&0u32.to_le_bytes());
    bytes.extend_from_slice(&(16 * 29u32).to_le_bytes());
    let found = LightBvh::from_bytes(&bytes).map(|_| ()).unwrap_err();
    assert_eq!(found, TreeBytesError::Links, "too deep");
}
