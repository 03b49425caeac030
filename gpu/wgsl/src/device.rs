//! The shader on whatever driver there is.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::time::Instant;

use wgpu::util::{BufferInitDescriptor, DeviceExt};

use crate::query::Query;

/// Invocations of a work group, as the shader says.
const GROUP: u32 = 64;

/// A device with the check's shader.
pub struct Device {
    name: String,
    device: wgpu::Device,
    queue: wgpu::Queue,
    module: wgpu::ShaderModule,
    /// By entry point: a software driver takes longer to compile one than to run it.
    pipelines: RefCell<BTreeMap<String, wgpu::ComputePipeline>>,
}

impl Device {
    /// The device that the driver offers first.
    ///
    /// # Errors
    /// One line that says what there is not.
    pub fn new(shader: &str) -> Result<Self, String> {
        let instance = wgpu::Instance::default();
        let adapter =
            pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
                .map_err(|e| e.to_string())?;
        let name = adapter.get_info().name;
        // No more than every device has, but for the size of buffers.
        let limits = wgpu::Limits {
            max_storage_buffers_per_shader_stage: 4,
            max_buffer_size: 1 << 28,
            max_storage_buffer_binding_size: 1 << 27,
            ..wgpu::Limits::downlevel_defaults()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_limits: limits,
            ..Default::default()
        }))
        .map_err(|e| e.to_string())?;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(shader.into()),
        });
        Ok(Self {
            name,
            device,
            queue,
            module,
            pipelines: RefCell::default(),
        })
    }

    /// What the driver calls it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The compiled entry point.
    fn pipeline(&self, entry: &str) -> wgpu::ComputePipeline {
        let mut pipelines = self.pipelines.borrow_mut();
        let compile = || {
            let options = wgpu::PipelineCompilationOptions::default();
            let descriptor = wgpu::ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &self.module,
                entry_point: Some(entry),
                compilation_options: options,
                cache: None,
            };
            self.device.create_compute_pipeline(&descriptor)
        };
        let known = pipelines.entry(entry.to_owned());
        known.or_insert_with(compile).clone()
    }

    /// What the entry point `entry` writes to its buffer of `binding` for the queries, and the
    /// seconds from their submission to their end.
    ///
    /// # Errors
    /// One line by the driver.
    pub fn run<A: bytemuck::Pod>(
        &self,
        (entry, binding): (&str, u32),
        rows: &[[u32; 4]],
        queries: &[Query],
    ) -> Result<(Vec<A>, f64), String> {
        let pipeline = self.pipeline(entry);
        let filled = |contents: &[u8]| {
            self.device.create_buffer_init(&BufferInitDescriptor {
                label: None,
                contents,
                usage: wgpu::BufferUsages::STORAGE,
            })
        };
        let size = size_of::<A>() as u64 * queries.len() as u64;
        let empty = |usage| {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let answers = empty(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let read = empty(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let buffers = [
            (0, &filled(bytemuck::cast_slice(rows))),
            (1, &filled(bytemuck::cast_slice(queries))),
            (binding, &answers),
        ];
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &buffers.map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            }),
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups((queries.len() as u32).div_ceil(GROUP), 1, 1);
        }
        encoder.copy_buffer_to_buffer(&answers, 0, &read, 0, size);
        let start = Instant::now();
        self.queue.submit([encoder.finish()]);
        read.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|e| e.to_string())?;
        let seconds = start.elapsed().as_secs_f64();
        let bytes = read
            .slice(..)
            .get_mapped_range()
            .map_err(|e| e.to_string())?;
        Ok((bytemuck::pod_collect_to_vec(&bytes), seconds))
    }
}
