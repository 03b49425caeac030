//! Trees of more lights than are in memory at once: whole, as good to refit, and refused like
//! others.

use core::num::NonZeroUsize;
use std::fs;
use std::io::{self, Cursor, ErrorKind, Seek, SeekFrom, Write};
use std::path::PathBuf;

use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{
    EmissionLobe, InfiniteBounds, LightBounds, LightExtent, LightId, LightSampleContext,
};
use light_bvh::out_of_core::{
    BuildStage, LightChunks, OutOfCoreBuild, OutOfCoreError, SliceChunks,
};
use light_bvh::{LightBvh, LightBvhError, LightBvhOptions, MAX_DEPTH};
use light_testkit::Rng;

use crate::support::lamp;

/// A folder for scratch files, empty before and after.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        Self(folder)
    }

    fn build(&self, lights_at_once: usize) -> OutOfCoreBuild {
        OutOfCoreBuild::new(&self.0).with_lights_at_once(lights_at_once)
    }

    fn files(&self) -> usize {
        fs::read_dir(&self.0).expect("a folder").count()
    }
}

/// Lights of a slice, so many at a time.
fn slice(lights: &[LightExtent], chunk: usize) -> SliceChunks<'_> {
    SliceChunks::new(lights, NonZeroUsize::new(chunk).expect("some"))
}

/// Spots, points, panels, measured lights, skies and dark lights at the places of `place`.
fn lights(count: usize, seed: u64, place: impl Fn(&mut Rng, usize) -> Vec3) -> Vec<LightExtent> {
    let mut rng = Rng::new(seed);
    let light = |k: usize| {
        let bounds = LightBounds {
            bounds: Aabb::from_point(place(&mut rng, k)),
            w: rng.direction(),
            phi: if k % 10 == 3 {
                0.0
            } else {
                rng.log_range(0.1, 10.0)
            },
            cos_theta_o: if k % 3 == 0 { -1.0 } else { 1.0 },
            cos_theta_e: if k % 3 == 1 { 0.9 } else { 0.0 },
            two_sided: k % 7 == 0,
        };
        let lobe = EmissionLobe {
            power: bounds.phi,
            mean: bounds.w * 0.5,
            spread: 0.2,
        };
        match k % 50 {
            0 => LightExtent::Infinite(InfiniteBounds::uniform(1.0)),
            1..10 => LightExtent::Lobe(bounds, lobe),
            _ => LightExtent::Bounded(bounds),
        }
    };
    (0..count).map(light).collect()
}

fn in_a_cube(rng: &mut Rng, _: usize) -> Vec3 {
    rng.vec3()
}

/// The bytes, and the tree in them.
fn written(build: &OutOfCoreBuild, lights: &[LightExtent], chunk: usize) -> (Vec<u8>, LightBvh) {
    let mut out = Cursor::new(Vec::new());
    let tree = build
        .write(&mut slice(lights, chunk), &mut out, |_, _| {})
        .expect("valid lights");
    let bytes = out.into_inner();
    let bounded = lights.iter().filter_map(LightExtent::bounded);
    let held = bounded.filter(|bounds| bounds.phi > 0.0).count();
    assert_eq!((tree.lights, tree.held), (lights.len(), held), "lights");
    assert_eq!(tree.bytes, bytes.len() as u64, "bytes");
    let read = LightBvh::from_bytes(&bytes).expect("a tree");
    assert_eq!(read.view().nodes().len(), tree.nodes, "nodes");
    assert_eq!(read.power(), tree.power, "power");
    (bytes, read)
}

#[test]
fn a_tree_of_lights_that_fit_has_the_bytes_of_any_other() {
    let scratch = Scratch::new("fit");
    for count in [0, 1, 2, 5000] {
        let lights = lights(count, 1, in_a_cube);
        for options in [LightBvhOptions::QUALITY, LightBvhOptions::FAST] {
            let build = scratch.build(5000).with_options(options);
            let (bytes, _) = written(&build, &lights, 8192);
            let tree = LightBvh::build_with(&lights, &options).expect("valid lights");
            assert!(bytes == tree.to_bytes(), "{count} lights, {options:?}");
        }
    }
}

/// What the nodes say of their lights is what a refit would make of them, and its order of nodes is
/// that of every tree: else a refit would not find them.
fn check_whole(name: &str, lights: &[LightExtent], lights_at_once: usize) {
    let scratch = Scratch::new(name);
    let (bytes, tree) = written(&scratch.build(lights_at_once), lights, 777);
    assert_eq!(scratch.files(), 0, "{name}: scratch files stay");
    let mut refitted = tree.clone();
    refitted.refit(lights).expect("the same lights");
    assert!(refitted.to_bytes() == bytes, "{name}: refitted");
    assert!(tree.depth() <= MAX_DEPTH, "{name}: {} levels", tree.depth());
    let medium = LightSampleContext::medium(Vec3::new(0.5, 0.25, -1.0));
    let pmf = |id: usize| tree.pmf(&medium, LightId(u32::try_from(id).expect("few")));
    let sum: f64 = (0..lights.len()).map(|id| f64::from(pmf(id))).sum();
    assert!((sum - 1.0).abs() < 1e-4, "{name}: {sum}");
}

#[test]
fn a_tree_of_lights_that_do_not_fit_is_whole() {
    const SCALES: [f32; 7] = [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-24, 1e-36];
    let nested = |_: &mut Rng, k: usize| Vec3::new(0.5, 0.25, 1.0) * SCALES[k % SCALES.len()];
    for lights_at_once in [1, 16, 300, 2999] {
        let name = |kind| format!("{kind}-{lights_at_once}");
        check_whole(&name("cube"), &lights(3000, 2, in_a_cube), lights_at_once);
        let one_place = lights(3000, 3, |_, _| Vec3::ONE);
        check_whole(&name("one-place"), &one_place, lights_at_once);
        let line = lights(3000, 4, |_, k| Vec3::X * k as f32);
        check_whole(&name("line"), &line, lights_at_once);
        check_whole(&name("nested"), &lights(3000, 5, nested), lights_at_once);
    }
}

/// Lights whose tree would have more levels than a tree may have.
#[test]
fn levels_of_the_upper_tree_count() {
    let mut rng = Rng::new(6);
    let lights: Vec<LightExtent> = (0..30_000)
        .map(|k| {
            let scale = 0.125f32.powi(k % 24);
            lamp((rng.vec3() - 0.5) * scale, scale)
        })
        .collect();
    let all = LightBvh::build(&lights).expect("valid lights");
    assert_eq!(all.depth(), MAX_DEPTH, "levels of one tree");
    for lights_at_once in [100, 29_000] {
        check_whole(&format!("deep-{lights_at_once}"), &lights, lights_at_once);
    }
}

#[test]
fn dark_lights_have_a_place_where_they_are_kept() {
    let scratch = Scratch::new("dark");
    let build = scratch.build(100).with_options(LightBvhOptions::DYNAMIC);
    let mut lights = lights(2000, 6, in_a_cube);
    let dark: Vec<LightExtent> = lights
        .iter()
        .map(|light| match *light {
            LightExtent::Bounded(bounds) => LightBounds { phi: 0.0, ..bounds }.into(),
            other => other,
        })
        .collect();
    lights.clone_from(&dark);
    let mut out = Cursor::new(Vec::new());
    let tree = build
        .write(&mut slice(&lights, 64), &mut out, |_, _| {})
        .expect("valid lights");
    assert_eq!(tree.held, 1960, "all but skies");
    let mut tree = LightBvh::from_bytes(out.get_ref()).expect("a tree");
    let LightExtent::Bounded(bounds) = &mut lights[11] else {
        panic!("a light with bounds");
    };
    (bounds.phi, bounds.cos_theta_o) = (1.0, -1.0);
    tree.refit(&lights).expect("a place for each");
    let medium = LightSampleContext::medium(Vec3::splat(2.0));
    assert!(tree.pmf(&medium, LightId(11)) > 0.0, "switched on");
}

#[test]
fn progress_covers_every_stage() {
    let scratch = Scratch::new("progress");
    let lights = lights(1000, 7, in_a_cube);
    let mut calls = Vec::new();
    let tree = scratch
        .build(100)
        .write(
            &mut slice(&lights, 400),
            &mut Cursor::new(vec![]),
            |stage, done| {
                calls.push((stage, done));
            },
        )
        .expect("valid lights");
    let chunks = [400, 800, 1000];
    let of = |stage| chunks.map(|n| (stage, n));
    assert_eq!(calls[..3], of(BuildStage::Count), "counted");
    assert_eq!(calls[3..6], of(BuildStage::Divide), "divided");
    let built = &calls[6..];
    assert!(built.len() >= 10, "a group at a time: {built:?}");
    assert!(built.is_sorted_by_key(|(_, done)| *done), "{built:?}");
    assert_eq!(built.last(), Some(&(BuildStage::Build, tree.held)), "all");
}

/// A tree may follow other things in a file.
#[test]
fn a_tree_is_written_where_the_file_stands() {
    let scratch = Scratch::new("offset");
    let lights = lights(500, 8, in_a_cube);
    let build = scratch.build(100);
    let (bytes, _) = written(&build, &lights, 100);
    let mut out = Cursor::new(vec![7; 64]);
    out.seek(SeekFrom::End(0)).expect("memory");
    build
        .write(&mut slice(&lights, 100), &mut out, |_, _| {})
        .expect("valid lights");
    out.write_all(&[9]).expect("memory");
    let out = out.into_inner();
    assert!(
        out[..64] == [7; 64] && out[64..out.len() - 1] == bytes,
        "in place"
    );
    assert_eq!(out.last(), Some(&9), "the file stands behind the tree");
}

/// Other lights when they are read again.
struct Changing<'a> {
    lights: &'a [LightExtent],
    chunks: SliceChunks<'a>,
}

impl LightChunks for Changing<'_> {
    fn next_chunk(&mut self, chunk: &mut Vec<LightExtent>) -> io::Result<()> {
        self.chunks.next_chunk(chunk)
    }

    fn rewind(&mut self) -> io::Result<()> {
        self.lights = &self.lights[1..];
        self.chunks = slice(self.lights, 30);
        Ok(())
    }
}

#[test]
fn what_cannot_be_a_tree_is_refused_and_leaves_no_scratch_files() {
    let scratch = Scratch::new("refused");
    let build = scratch.build(50);
    let mut lights = lights(200, 9, in_a_cube);
    let write = |lights: &mut dyn FnMut(&OutOfCoreBuild) -> Result<(), OutOfCoreError>| {
        let result = lights(&build).expect_err("refused");
        assert_eq!(scratch.files(), 0, "scratch files stay: {result}");
        result
    };
    let out = || Cursor::new(Vec::new());
    let changed = write(&mut |build| {
        let mut changing = Changing {
            lights: &lights,
            chunks: slice(&lights, 30),
        };
        build
            .write(&mut changing, &mut out(), |_, _| {})
            .map(|_| ())
    });
    assert!(matches!(changed, OutOfCoreError::Changed), "{changed}");
    lights[123] = LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(Vec3::X * 1e37),
        w: Vec3::Z,
        phi: 1.0,
        cos_theta_o: -1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    });
    let far = write(&mut |build| {
        let mut lights = slice(&lights, 30);
        build.write(&mut lights, &mut out(), |_, _| {}).map(|_| ())
    });
    let expected = LightBvhError::TooFar {
        light: LightId(123),
    };
    assert!(
        matches!(far, OutOfCoreError::Lights(error) if error == expected),
        "{far}"
    );
    lights.truncate(100);
    let nowhere = OutOfCoreBuild::new(scratch.0.join("missing")).with_lights_at_once(50);
    let missing = nowhere
        .write(&mut slice(&lights, 30), &mut out(), |_, _| {})
        .expect_err("no folder");
    assert!(
        matches!(&missing, OutOfCoreError::Io(error) if error.kind() == ErrorKind::NotFound),
        "{missing}"
    );
}
