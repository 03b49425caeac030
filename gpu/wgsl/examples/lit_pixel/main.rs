use light_gpu::light_sources::{IntensityAmount, LightSetBuilder, PointLightDesc, SceneSphere};
use light_gpu::{LIGHTS_WGSL, light_scene_rows, light_sources::glam::Vec3};
use wgpu::util::{BufferInitDescriptor, DeviceExt, DownloadBuffer};
use wgpu::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut lights = LightSetBuilder::new(SceneSphere::new(Vec3::ZERO, 9.0)?);
    lights.add(PointLightDesc::new(Vec3::Z, Vec3::ONE, IntensityAmount::Radiometric(1.0)))?;
    lights.add(PointLightDesc::new(2.0 * Vec3::Z, Vec3::X, IntensityAmount::Radiometric(4.0)))?;
    let rows = [vec![[0; 4]], light_scene_rows(&lights.build())?].concat();
    let adapter = pollster::block_on(Instance::default().request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;
    let source = ShaderSource::Wgsl([LIGHTS_WGSL, include_str!("pixel.wgsl")].concat().into());
    let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source });
    let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    });
    let contents = bytemuck::cast_slice(&rows);
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
    let buffer = device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage });
    let layout = &pipeline.get_bind_group_layout(0);
    let entries = &[BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }];
    let group = device.create_bind_group(&BindGroupDescriptor { label: None, layout, entries });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(1, 1, 1);
    drop(pass);
    queue.submit([encoder.finish()]);
    let pixel = buffer.slice(..4);
    DownloadBuffer::read_buffer(&device, &queue, &pixel, |p| println!("{:?}", &p.unwrap()[..]));
    device.poll(PollType::wait_indefinitely())?;
    Ok(())
}
