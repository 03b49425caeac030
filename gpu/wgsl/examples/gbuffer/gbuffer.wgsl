@group(0) @binding(0) var<storage, read> rows: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> pixels: array<Pixel>;
// The sum over frames, and their number.
@group(0) @binding(2) var<storage, read_write> picture: array<vec4<f32>>;

struct Pixel {
    p: vec3<f32>,
    // 0 where there is no surface.
    n: vec3<f32>,
    albedo: vec3<f32>,
    emitted: vec3<f32>,
}

fn light_row(i: u32) -> vec4<u32> {
    return rows[i];
}

// Four random words: pcg4d of Jarzynski and Olano, 2020.
fn random(seed: vec4<u32>) -> vec4<u32> {
    var v = seed * 1664525u + 1013904223u;
    for (var i = 0u; i < 2u; i++) {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
        v ^= select(vec4<u32>(0u), v >> vec4<u32>(16u), i == 0u);
    }
    return v;
}

// One choice of a light for each pixel; its shadow is for the renderer to trace.
@compute @workgroup_size(64)
fn light_pixels(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&pixels) {
        return;
    }
    let pixel = pixels[id.x];
    var sum = picture[id.x];
    let u = random(vec4<u32>(id.x, u32(sum.w), 0u, 0u));
    if any(pixel.n != vec3<f32>(0.0)) {
        let scene = light_scene(0u);
        let here = light_surface(pixel.p, pixel.n);
        let chosen = light_sampler_sample(scene.sampler, here, u.xy);
        let place = vec2<f32>(u.zw >> vec2<u32>(8u)) / 16777216.0;
        let arriving = light_set_sample_li(scene.lights, chosen.light, here, place);
        if chosen.pmf > 0.0 && arriving.pdf > 0.0 {
            let cosine = max(dot(here.n, arriving.wi), 0.0);
            let weight = cosine / (3.14159265358979 * arriving.pdf * chosen.pmf);
            sum += vec4<f32>(pixel.albedo * arriving.l * weight, 0.0);
        }
    }
    picture[id.x] = sum + vec4<f32>(pixel.emitted, 1.0);
}
