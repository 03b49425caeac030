//! Trees of more lights than memory holds at once, built from a file and mapped into memory.
//!
//! `out_of_core write COUNT LIGHTS` makes a file of so many triangles, 44 bytes each, of random
//! places in a cube; `out_of_core build LIGHTS TREE [LIGHTS AT ONCE]` builds their tree, with scratch
//! files beside it; `out_of_core query TREE` maps it in small pages and in huge ones, and times
//! samples, also after the system has been told to forget the file, which only its administrator
//! may; `out_of_core variance COUNT` compares V with that of a tree built in memory.

use core::num::NonZeroUsize;
use std::fs::{self, File};
use std::hint::black_box;
use std::io::{self, BufReader, BufWriter, Cursor, Read, Seek, Write};
use std::path::Path;
use std::time::Instant;

use benches::exact_variance::{flat_variance, summary};
use benches::peak_memory::peak_memory;
use light_render::bench::CpuTimer;
use light_testkit::Rng;
use light_testkit::light_sets::{SetLight, SetPoint};
use lights::bounds::{LightExtent, LightSampleContext};
use lights::bvh::out_of_core::{BuildStage, LightChunks, OutOfCoreBuild, SliceChunks};
use lights::bvh::{LightBvh, LightBvhRef, StoredLightBvh};
use lights::glam::Vec3;
use memmap2::{Advice, Mmap, UncheckedAdvice};
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSlice;

type Result<T> = core::result::Result<T, Box<dyn std::error::Error>>;

const USAGE: &str = "usage: out_of_core write COUNT LIGHTS | build LIGHTS TREE [LIGHTS AT ONCE] \
    | query TREE | variance COUNT";

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match *words {
        ["write", count, lights] => write(count.parse()?, Path::new(lights)),
        ["build", lights, tree] => build(Path::new(lights), Path::new(tree), 1 << 22),
        ["build", lights, tree, n] => build(Path::new(lights), Path::new(tree), n.parse()?),
        ["query", tree] => query(Path::new(tree)),
        ["variance", count] => variance(count.parse()?),
        _ => Err(USAGE.into()),
    }
}

/// Bytes of a light in a file: nine coordinates, radiance, and whether both sides emit.
const ROW: usize = 44;

/// A triangle of about 0.3 of the mean distance of neighbours, anywhere in the unit cube, whose
/// radiance is of three decades.
fn triangle(rng: &mut Rng, size: f32) -> SetLight {
    let p = rng.vec3();
    let [a, b] = [rng.direction(), rng.direction()].map(|e| e * size);
    SetLight::Triangle {
        vertices: [p, p + a, p + b],
        radiance: rng.log_range(1e-3, 1.0),
        two_sided: rng.below(10) == 0,
    }
}

fn size(count: usize) -> f32 {
    0.3 / (count as f32).cbrt()
}

fn write(count: usize, path: &Path) -> Result<()> {
    let mut rng = Rng::new(1);
    let mut file = BufWriter::with_capacity(1 << 20, File::create(path)?);
    for _ in 0..count {
        let SetLight::Triangle {
            vertices: [a, b, c],
            radiance,
            two_sided,
        } = triangle(&mut rng, size(count))
        else {
            unreachable!("a triangle");
        };
        for x in [a, b, c].iter().flat_map(Vec3::to_array) {
            file.write_all(&x.to_le_bytes())?;
        }
        file.write_all(&radiance.to_le_bytes())?;
        file.write_all(&u32::from(two_sided).to_le_bytes())?;
    }
    Ok(file.flush()?)
}

/// The lights of a file.
struct Rows {
    file: BufReader<File>,
    bytes: Vec<u8>,
}

impl Rows {
    fn open(path: &Path) -> io::Result<Self> {
        let file = BufReader::new(File::open(path)?);
        let bytes = vec![0; ROW << 16];
        Ok(Self { file, bytes })
    }
}

impl LightChunks for Rows {
    fn next_chunk(&mut self, chunk: &mut Vec<LightExtent>) -> io::Result<()> {
        let mut filled = 0;
        loop {
            match self.file.read(&mut self.bytes[filled..])? {
                0 => break,
                read => filled += read,
            }
        }
        let rows = self.bytes[..filled].par_chunks_exact(ROW);
        let rows = rows.with_min_len(4096);
        rows.map(|row| LightExtent::from(light(row).bounds()))
            .collect_into_vec(chunk);
        Ok(())
    }

    fn rewind(&mut self) -> io::Result<()> {
        self.file.rewind()
    }
}

fn light(row: &[u8]) -> SetLight {
    let (mut words, _) = row.as_chunks();
    let mut number = || {
        let (word, rest) = words.split_first().expect("eleven words");
        words = rest;
        f32::from_le_bytes(*word)
    };
    let mut vertex = || Vec3::new(number(), number(), number());
    let vertices = [vertex(), vertex(), vertex()];
    SetLight::Triangle {
        vertices,
        radiance: number(),
        two_sided: number().to_bits() != 0,
    }
}

fn build(lights: &Path, tree: &Path, lights_at_once: usize) -> Result<()> {
    let scratch = tree.with_extension("scratch");
    fs::create_dir_all(&scratch)?;
    let build = OutOfCoreBuild::new(&scratch).with_lights_at_once(lights_at_once);
    let mut out = BufWriter::with_capacity(1 << 20, File::create(tree)?);
    let start = Instant::now();
    let mut ends = [0.0; 3];
    let written = build.write(&mut Rows::open(lights)?, &mut out, |stage, _| {
        let stage = match stage {
            BuildStage::Count => 0,
            BuildStage::Divide => 1,
            _ => 2,
        };
        ends[stage] = start.elapsed().as_secs_f64();
    })?;
    out.into_inner()?.sync_all()?;
    let all = start.elapsed().as_secs_f64();
    fs::remove_dir(&scratch)?;
    println!("{written:?}");
    let [counted, divided, built] = ends;
    println!(
        "{all:.1} s: read {counted:.1}, divided {:.1}, built {:.1}, and until it was on the disk; \
         {} at most in memory",
        divided - counted,
        built - divided,
        peak_memory()
    );
    Ok(())
}

/// In pages of the least size, and in huge ones: the system uses these for what it reads into memory
/// after it was asked for them.
fn query(path: &Path) -> Result<()> {
    for (name, advice) in [
        ("small pages", Advice::NoHugePage),
        ("huge pages", Advice::HugePage),
    ] {
        println!("{name}:");
        query_in_pages(path, advice)?;
    }
    Ok(())
}

#[expect(unsafe_code, reason = "a mapped file changes when others write to it")]
fn query_in_pages(path: &Path, advice: Advice) -> Result<()> {
    let file = File::open(path)?;
    // SAFETY: nobody writes to a file that this example has made.
    let bytes = unsafe { Mmap::map(&file)? };
    if let Err(error) = bytes.advise(advice) {
        println!("not as it was asked for ({error})");
    }
    let tree = StoredLightBvh::from_bytes(&bytes)?;
    // SAFETY: the pages come back from the file with the same content.
    unsafe { bytes.unchecked_advise(UncheckedAdvice::DontNeed)? };
    match fs::write("/proc/sys/vm/drop_caches", "1") {
        Ok(()) => {
            for samples in [100, 1_000, 10_000, 100_000] {
                let start = Instant::now();
                ask(&tree.view(), samples);
                let time = start.elapsed().as_secs_f64() * 1e9 / f64::from(samples);
                println!("cold, the next {samples} samples: {time:.0} ns each");
            }
        }
        Err(error) => println!("cold: not measured, the file stays in memory ({error})"),
    }
    let start = Instant::now();
    let tree = StoredLightBvh::from_bytes(&bytes)?;
    println!(
        "the rest read and all checked in {:.1?}; {} of {} MB in huge pages",
        start.elapsed(),
        huge_file_pages_mb(),
        bytes.len() >> 20
    );
    hot(&tree.view())
}

/// How much of the files that this process maps is in huge pages, as Linux says it.
fn huge_file_pages_mb() -> u64 {
    let maps = fs::read_to_string("/proc/self/smaps_rollup").unwrap_or_default();
    let mut words = maps.split_whitespace();
    words.find(|&word| word == "FilePmdMapped:");
    let kb: Option<u64> = words.next().and_then(|kb| kb.parse().ok());
    kb.unwrap_or(0) >> 10
}

/// Samples of the mapped tree, and of one of a million such lights in memory, in turns.
fn hot(mapped: &LightBvhRef<'_>) -> Result<()> {
    const SAMPLES: u32 = 100_000;
    let mut rng = Rng::new(3);
    let million = (0..1_000_000).map(|_| triangle(&mut rng, size(1_000_000)).bounds().into());
    let million = LightBvh::build(&million.collect::<Vec<LightExtent>>())?;
    let time = |tree: &LightBvhRef<'_>| {
        let timer = CpuTimer::start();
        ask(tree, SAMPLES);
        timer.seconds() * 1e9 / f64::from(SAMPLES)
    };
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..9 {
        ours.push(time(mapped));
        theirs.push(time(&million.view()));
    }
    let [ours, theirs] = [ours, theirs].map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    println!(
        "hot: {ours:.0} ns of processor time a sample, {theirs:.0} of a million lights in memory \
         ({:.2} x)",
        ours / theirs
    );
    Ok(())
}

fn ask(tree: &LightBvhRef<'_>, samples: u32) {
    let mut rng = Rng::new(5);
    for _ in 0..samples {
        let n = rng.direction();
        black_box(tree.sample(&LightSampleContext::surface(rng.vec3(), n, n), rng.u64()));
    }
}

/// V at 64 points of trees of groups of a hundredth of the lights, and of all in memory.
fn variance(count: usize) -> Result<()> {
    let mut rng = Rng::new(2);
    let lights: Vec<SetLight> = (0..count)
        .map(|_| triangle(&mut rng, size(count)))
        .collect();
    let extents: Vec<LightExtent> = lights.iter().map(|light| light.bounds().into()).collect();
    let scratch = std::env::temp_dir().join("out_of_core_variance");
    fs::create_dir_all(&scratch)?;
    let mut bytes = Cursor::new(Vec::new());
    let build = OutOfCoreBuild::new(&scratch).with_lights_at_once(count / 100);
    let mut chunks = SliceChunks::new(&extents, NonZeroUsize::new(1 << 16).ok_or("none")?);
    build.write(&mut chunks, &mut bytes, |_, _| {})?;
    fs::remove_dir(&scratch)?;
    let [ours, all] = [
        LightBvh::from_bytes(bytes.get_ref())?,
        LightBvh::build(&extents)?,
    ];
    let points: Vec<SetPoint> = (0..64)
        .map(|_| SetPoint {
            p: rng.vec3(),
            n: rng.direction(),
        })
        .collect();
    for (name, tree) in [("out of core", ours), ("in memory", all)] {
        let values = points
            .iter()
            .filter_map(|p| flat_variance(&lights, &tree, p));
        println!(
            "{name}: V {}; {:.1} bytes a light, depth {}",
            summary(values.collect()),
            tree.bytes() as f64 / count as f64,
            tree.depth()
        );
    }
    Ok(())
}
