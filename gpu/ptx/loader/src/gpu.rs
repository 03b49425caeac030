//! The kernels on a GPU, through the CUDA driver.

use std::sync::Arc;
use std::time::Instant;

use bytemuck::{NoUninit, cast_slice};
use cudarc::driver::{
    CudaContext, CudaModule, CudaSlice, CudaStream, DriverError, LaunchConfig, PushKernelArg, sys,
};
use cudarc::nvrtc::Ptx;
use light_bvh::LightBvhRef;
use light_ptx_queries::{Arrived, LightRecord, Query, arrive, decode};

use crate::host;
use crate::work::{Kernel, Work};

/// The kernels, as `cargo xtask ptx` made them.
const PTX: &str = include_str!("../../kernels.ptx");

/// Threads of a block: kernels hold many registers.
const BLOCK: u32 = 64;

/// Launches that are timed together.
const LAUNCHES: u32 = 16;

/// What comes back, or one line by the driver.
type Answered<T> = Result<T, DriverError>;

/// A GPU with the kernels.
pub struct Gpu {
    name: String,
    stream: Arc<CudaStream>,
    module: Arc<CudaModule>,
}

/// Arrays of a tree on the GPU, and how many elements each has.
struct Tree {
    arrays: [CudaSlice<u32>; 3],
    counts: [u64; 3],
}

impl Gpu {
    /// The first GPU of this machine.
    ///
    /// # Errors
    /// One line that says what there is not.
    pub fn new() -> Result<Self, String> {
        // SAFETY: looks for a library and calls nothing of it.
        if !unsafe { sys::is_culib_present() } {
            return Err("no CUDA driver".into());
        }
        let context = CudaContext::new(0).map_err(|e| format!("no CUDA device ({e})"))?;
        let name = context.name().map_err(|e| e.to_string())?;
        let ptx = Ptx::from_src(PTX);
        let module = context
            .load_module(ptx)
            .map_err(|e| format!("the driver takes no kernel ({e})"))?;
        Ok(Self {
            name,
            stream: context.default_stream(),
            module,
        })
    }

    /// What the driver calls it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How many codes are decoded to other bits than on the host.
    pub fn unlike_codes(&self, codes: &[u32]) -> Answered<usize> {
        let ours: Vec<[f32; 3]> = codes.iter().map(|&code| decode(code)).collect();
        let codes = self.upload(codes)?;
        let theirs = self.answers("light_octahedral_decode", &[&codes], 3, ours.len())?;
        Ok(unlike(&theirs, cast_slice(&ours), 3))
    }

    /// How many samples of lights have other bits than on the host.
    pub fn unlike_arrivals(&self, lights: &[LightRecord], queries: &[Query]) -> Answered<usize> {
        let answer = |query: &Query| arrive(&lights[query.other as usize], query);
        let ours: Vec<Arrived> = queries.iter().map(answer).collect();
        let (lights, queries) = (self.upload(lights)?, self.upload(queries)?);
        let words = size_of::<Arrived>() / 4;
        let theirs = self.answers("light_sample_li", &[&lights, &queries], words, ours.len())?;
        Ok(unlike(&theirs, cast_slice(&ours), words))
    }

    /// How many answers of a tree have other bits than on the host.
    pub fn unlike_choices(
        &self,
        kernel: Kernel,
        tree: &LightBvhRef<'_>,
        work: &Work,
    ) -> Answered<usize> {
        let ours = host::answers(kernel, tree, work);
        let (tree, queries) = (self.tree(tree)?, self.upload(&work.queries)?);
        let mut answers = self.stream.alloc_zeros::<u32>(ours.len())?;
        self.choose(kernel, &tree, &queries, &mut answers, work.queries.len())?;
        Ok(unlike(
            &self.stream.memcpy_dtov(&answers)?,
            &ours,
            kernel.words,
        ))
    }

    /// Millions of queries a second.
    pub fn rate(&self, kernel: Kernel, tree: &LightBvhRef<'_>, work: &Work) -> Answered<f64> {
        let count = work.queries.len();
        let (tree, queries) = (self.tree(tree)?, self.upload(&work.queries)?);
        let mut answers = self.stream.alloc_zeros::<u32>(kernel.words * count)?;
        self.choose(kernel, &tree, &queries, &mut answers, count)?;
        self.stream.synchronize()?;
        let start = Instant::now();
        for _ in 0..LAUNCHES {
            self.choose(kernel, &tree, &queries, &mut answers, count)?;
        }
        self.stream.synchronize()?;
        Ok(f64::from(LAUNCHES) * count as f64 / start.elapsed().as_secs_f64() / 1e6)
    }

    /// Launches a kernel that asks a tree.
    fn choose(
        &self,
        kernel: Kernel,
        tree: &Tree,
        queries: &CudaSlice<u32>,
        answers: &mut CudaSlice<u32>,
        count: usize,
    ) -> Answered<()> {
        let function = self.module.load_function(kernel.name)?;
        let mut launch = self.stream.launch_builder(&function);
        for (array, length) in tree.arrays.iter().zip(&tree.counts) {
            launch.arg(array).arg(length);
        }
        let all = count as u64;
        launch.arg(queries).arg(answers).arg(&all);
        // SAFETY: the arguments are those that the kernel declares, and the arrays as long as said.
        unsafe { launch.launch(blocks(count)) }?;
        Ok(())
    }

    /// The answers of a kernel that takes arrays, answers and their number.
    fn answers(
        &self,
        kernel: &str,
        arrays: &[&CudaSlice<u32>],
        words: usize,
        count: usize,
    ) -> Answered<Vec<u32>> {
        let mut answers = self.stream.alloc_zeros::<u32>(words * count)?;
        let function = self.module.load_function(kernel)?;
        let mut launch = self.stream.launch_builder(&function);
        for &array in arrays {
            launch.arg(array);
        }
        let all = count as u64;
        launch.arg(&mut answers).arg(&all);
        // SAFETY: the arguments are those that the kernel declares, and the arrays as long as said.
        unsafe { launch.launch(blocks(count)) }?;
        self.stream.memcpy_dtov(&answers)
    }

    fn tree(&self, tree: &LightBvhRef<'_>) -> Answered<Tree> {
        let counts = [tree.nodes().len(), tree.order().len(), tree.slots().len()];
        Ok(Tree {
            arrays: [
                self.upload(tree.nodes())?,
                self.upload(tree.order())?,
                self.upload(tree.slots())?,
            ],
            counts: counts.map(|n| n as u64),
        })
    }

    /// An array in words. The driver aligns it to 256 bytes.
    fn upload<T: NoUninit>(&self, array: &[T]) -> Answered<CudaSlice<u32>> {
        self.stream.memcpy_stod(cast_slice::<T, u32>(array))
    }
}

fn blocks(count: usize) -> LaunchConfig {
    LaunchConfig {
        grid_dim: ((count as u32).div_ceil(BLOCK), 1, 1),
        block_dim: (BLOCK, 1, 1),
        shared_mem_bytes: 0,
    }
}

/// How many answers of so many words differ.
fn unlike(theirs: &[u32], ours: &[u32], words: usize) -> usize {
    let pairs = theirs.chunks(words).zip(ours.chunks(words));
    pairs.filter(|(theirs, ours)| theirs != ours).count()
}
