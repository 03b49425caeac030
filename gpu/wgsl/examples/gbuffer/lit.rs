use core::error::Error;

use bytemuck::{cast_slice, pod_collect_to_vec};
use light_gpu::light_sources::{LightSet, Rgb};
use light_gpu::{LIGHTS_WGSL, light_scene_rows};
use pollster::block_on;
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::*;

type Picture = Result<Vec<f32>, Box<dyn Error>>;

pub fn lit(lights: &LightSet<Rgb>, pixels: &[[f32; 16]], frames: u32) -> Picture {
    let rows = light_scene_rows(lights)?;
    let adapter = block_on(Instance::default().request_adapter(&Default::default()))?;
    let (device, queue) = block_on(adapter.request_device(&Default::default()))?;
    let source = ShaderSource::Wgsl([LIGHTS_WGSL, include_str!("gbuffer.wgsl")].concat().into());
    let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source });
    let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("light_pixels"),
        compilation_options: Default::default(),
        cache: None,
    });
    let buffer = |usage, contents: &[u8]| {
        device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
    };
    let zeros = vec![0; 16 * pixels.len()];
    let read = buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST, &zeros);
    let picture = buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC, &zeros);
    let inputs = [cast_slice(&rows), cast_slice(pixels)].map(|b| buffer(BufferUsages::STORAGE, b));
    let entries = &[(0, &inputs[0]), (1, &inputs[1]), (2, &picture)]
        .map(|(binding, buffer)| BindGroupEntry { binding, resource: buffer.as_entire_binding() });
    let layout = &pipeline.get_bind_group_layout(0);
    let group = device.create_bind_group(&BindGroupDescriptor { label: None, layout, entries });
    let mut encoder = device.create_command_encoder(&Default::default());
    for _ in 0..frames {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups((pixels.len() as u32).div_ceil(64), 1, 1);
    }
    encoder.copy_buffer_to_buffer(&picture, 0, &read, 0, read.size());
    queue.submit([encoder.finish()]);
    read.slice(..).map_async(MapMode::Read, |_| ());
    device.poll(PollType::wait_indefinitely())?;
    Ok(pod_collect_to_vec(&read.slice(..).get_mapped_range()?))
}
