//! Frames on a device.

use std::fs;
use std::time::Instant;

use bytemuck::{cast_slice, pod_collect_to_vec};
use light_gpu::LIGHTS_WGSL;
use light_math::glam::{Vec3, Vec4};
use pollster::block_on;
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::*;

type Result<T> = core::result::Result<T, Box<dyn core::error::Error>>;

/// A device with the pixels and the lights.
pub struct Compute {
    name: String,
    device: Device,
    queue: Queue,
    module: ShaderModule,
    inputs: [Buffer; 2],
    pixels: u32,
    /// Whether the processors of this machine do the work.
    is_software: bool,
}

/// A picture of some frames; pixels without a surface have no colour.
pub struct Lit {
    pub picture: Vec<Option<Vec3>>,
    pub frames: u32,
}

impl Compute {
    pub fn new(rows: &[[u32; 4]], pixels: &[[f32; 16]]) -> Result<Self> {
        let adapter = block_on(Instance::default().request_adapter(&Default::default()))?;
        let AdapterInfo { name, device_type, .. } = adapter.get_info();
        let (device, queue) = block_on(adapter.request_device(&Default::default()))?;
        let text =
            [LIGHTS_WGSL, include_str!("../gbuffer/gbuffer.wgsl"), include_str!("techniques.wgsl")];
        let source = ShaderSource::Wgsl(text.concat().into());
        let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source });
        let inputs = [cast_slice(rows), cast_slice(pixels)].map(|contents: &[u8]| {
            let usage = BufferUsages::STORAGE;
            device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
        });
        let pixels = pixels.len() as u32;
        let is_software = device_type == DeviceType::Cpu;
        Ok(Self { name, device, queue, module, inputs, pixels, is_software })
    }

    /// What the driver calls it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Adds frames until the time is over.
    pub fn light(&self, entry: &str, seconds: f64) -> Result<Lit> {
        let device = &self.device;
        let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &self.module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            cache: None,
        });
        let size = 16 * u64::from(self.pixels);
        let buffer = |usage| {
            let mapped_at_creation = false;
            device.create_buffer(&BufferDescriptor { label: None, size, usage, mapped_at_creation })
        };
        let picture = buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let read = buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let [rows, pixels] = &self.inputs;
        let entries = &[(0, rows), (1, pixels), (2, &picture)].map(|(binding, buffer)| {
            BindGroupEntry { binding, resource: buffer.as_entire_binding() }
        });
        let layout = &pipeline.get_bind_group_layout(0);
        let group = device.create_bind_group(&BindGroupDescriptor { label: None, layout, entries });
        let add = |frames| -> Result<u32> {
            let mut encoder = device.create_command_encoder(&Default::default());
            for _ in 0..frames {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(&pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.dispatch_workgroups(self.pixels.div_ceil(64), 1, 1);
            }
            self.queue.submit([encoder.finish()]);
            device.poll(PollType::wait_indefinitely())?;
            Ok(frames)
        };
        // A graphics card waits for each submission longer than for a frame.
        let at_once = if self.is_software { 1 } else { 16 };
        // The driver compiles at the first frame.
        let mut frames = add(1)?;
        let start = Clock::new(self.is_software);
        while start.seconds() < seconds {
            frames += add(at_once)?;
        }
        let mut encoder = device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&picture, 0, &read, 0, size);
        self.queue.submit([encoder.finish()]);
        read.slice(..).map_async(MapMode::Read, |_| ());
        device.poll(PollType::wait_indefinitely())?;
        let sums: Vec<Vec4> =
            pod_collect_to_vec::<_, [f32; 4]>(&read.slice(..).get_mapped_range()?)
                .into_iter()
                .map(Vec4::from)
                .collect();
        let color = |sum: &Vec4| (sum.w > 0.0).then(|| sum.truncate() / sum.w);
        Ok(Lit { picture: sums.iter().map(color).collect(), frames })
    }
}

/// Seconds of the processors by this process, where they are the device; or of the clock.
struct Clock(Instant, Option<f64>);

impl Clock {
    fn new(is_software: bool) -> Self {
        Self(Instant::now(), is_software.then(processor_seconds).flatten())
    }

    fn seconds(&self) -> f64 {
        match (self.1, processor_seconds()) {
            (Some(start), Some(now)) => now - start,
            _ => self.0.elapsed().as_secs_f64(),
        }
    }
}

/// Linux counts them in hundredths of a second.
fn processor_seconds() -> Option<f64> {
    let counters = fs::read_to_string("/proc/self/stat").ok()?;
    let (_, counters) = counters.rsplit_once(')')?;
    let times = counters.split_whitespace().skip(11).take(2);
    let ticks: Option<Vec<f64>> = times.map(|ticks| ticks.parse().ok()).collect();
    Some(ticks?.iter().sum::<f64>() / 100.0)
}
