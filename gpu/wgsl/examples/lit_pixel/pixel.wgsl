// The first row is the pixel, of four bytes; the lights follow.
@group(0) @binding(0) var<storage, read_write> rows: array<vec4<u32>>;

fn light_row(i: u32) -> vec4<u32> {
    return rows[i];
}

// A white floor below the lights, by 256 choices of one of them.
@compute @workgroup_size(1)
fn light_pixel() {
    let scene = light_scene(1u);
    let here = light_surface(vec3<f32>(0.0), vec3<f32>(0.0, 0.0, 1.0));
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < 256u; i++) {
        let u = light_fraction_stratum(i, 256u, vec2<u32>(0x80000000u, 0u));
        let chosen = light_sampler_sample(scene.sampler, here, u);
        let arriving = light_set_sample_li(scene.lights, chosen.light, here, vec2<f32>(0.5));
        if chosen.pmf > 0.0 && arriving.pdf > 0.0 {
            let cosine = max(dot(here.n, arriving.wi), 0.0);
            sum += arriving.l * (cosine / (arriving.pdf * chosen.pmf));
        }
    }
    rows[0].x = pack4x8unorm(vec4<f32>(sum / (256.0 * 3.14159265358979), 1.0));
}
