// One light a pixel and frame, by each technique. They share light_row, the buffers, `random` and
// `Pixel` of the example gbuffer, whose text stands before this one.

// Rows of the head, before those of the sampler.
const HEAD: u32 = 2u;

// What one light gives to a pixel, by a place of the unit square; 0 where it gives nothing.
fn contribution(pixel: Pixel, light: u32, place: vec2<f32>) -> vec3<f32> {
    let here = light_surface(pixel.p, pixel.n);
    let arriving = light_set_sample_li(light_set(rows[0].x), light, here, place);
    if !(arriving.pdf > 0.0) {
        return vec3<f32>(0.0);
    }
    let cosine = max(dot(here.n, arriving.wi), 0.0);
    return pixel.albedo * arriving.l * (cosine / (3.14159265358979 * arriving.pdf));
}

fn place_of(u: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(u >> vec2<u32>(8u)) / 16777216.0;
}

fn luminance(color: vec3<f32>) -> f32 {
    return dot(color, vec3<f32>(0.2126, 0.7152, 0.0722));
}

fn add(i: u32, color: vec3<f32>) {
    picture[i] += vec4<f32>(color + pixels[i].emitted, 1.0);
}

fn is_surface(i: u32) -> bool {
    return i < arrayLength(&pixels) && any(pixels[i].n != vec3<f32>(0.0));
}

// A light by the tree.
@compute @workgroup_size(64)
fn by_tree(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_surface(id.x) {
        return;
    }
    let pixel = pixels[id.x];
    let u = random(vec4<u32>(id.x, u32(picture[id.x].w), 0u, 0u));
    let chosen = light_sampler_sample(light_sampler(HEAD), light_surface(pixel.p, pixel.n), u.xy);
    var color = vec3<f32>(0.0);
    if chosen.pmf > 0.0 {
        color = contribution(pixel, chosen.light, place_of(u.zw)) / chosen.pmf;
    }
    add(id.x, color);
}

// Four lights by a cut of the tree.
@compute @workgroup_size(64)
fn by_cut(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_surface(id.x) {
        return;
    }
    let pixel = pixels[id.x];
    let frame = u32(picture[id.x].w);
    let u = random(vec4<u32>(id.x, frame, 0u, 0u));
    var here = light_sampler_cut(light_sampler(HEAD), light_surface(pixel.p, pixel.n));
    var color = vec3<f32>(0.0);
    for (var i = 0u; i < 4u; i++) {
        let chosen = light_sampler_cut_sample(&here, light_fraction_stratum(i, 4u, u.xy));
        if chosen.pmf > 0.0 {
            let place = random(vec4<u32>(id.x, frame, 1u + i, 0u)).zw;
            color += contribution(pixel, chosen.light, place_of(place)) / (4.0 * chosen.pmf);
        }
    }
    add(id.x, color);
}

// A light of all with equal probability.
@compute @workgroup_size(64)
fn by_chance(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_surface(id.x) {
        return;
    }
    let u = random(vec4<u32>(id.x, u32(picture[id.x].w), 0u, 0u));
    let count = rows[1].z;
    let light = light_fraction_choose(count, u.xy).index;
    add(id.x, f32(count) * contribution(pixels[id.x], light, place_of(u.zw)));
}

// One of `candidates` lights of equal probability, resampled in proportion to what it gives.
fn resampled(i: u32, candidates: u32) {
    let pixel = pixels[i];
    let frame = u32(picture[i].w);
    let count = rows[1].z;
    var sum = 0.0;
    var kept = vec3<f32>(0.0);
    for (var k = 0u; k < candidates; k++) {
        let u = random(vec4<u32>(i, frame, k, 1u));
        let light = light_fraction_choose(count, u.xy).index;
        let color = contribution(pixel, light, place_of(u.zw));
        let weight = luminance(color);
        sum += weight;
        let fresh = f32(random(vec4<u32>(i, frame, k, 2u)).x >> 8u) / 16777216.0;
        kept = select(kept, color, fresh * sum < weight);
    }
    var color = vec3<f32>(0.0);
    if sum > 0.0 {
        color = kept * (f32(count) * sum / (f32(candidates) * luminance(kept)));
    }
    add(i, color);
}

@compute @workgroup_size(64)
fn by_8_candidates(@builtin(global_invocation_id) id: vec3<u32>) {
    if is_surface(id.x) {
        resampled(id.x, 8u);
    }
}

@compute @workgroup_size(64)
fn by_32_candidates(@builtin(global_invocation_id) id: vec3<u32>) {
    if is_surface(id.x) {
        resampled(id.x, 32u);
    }
}

// A light of the list of the pixel's tile, with equal probability.
@compute @workgroup_size(64)
fn by_tile(@builtin(global_invocation_id) id: vec3<u32>) {
    if !is_surface(id.x) {
        return;
    }
    let width = rows[1].x;
    let tile = (id.x % width) / 16u + rows[1].y * (id.x / width / 16u);
    let list = rows[rows[0].y + tile];
    let u = random(vec4<u32>(id.x, u32(picture[id.x].w), 0u, 0u));
    var color = vec3<f32>(0.0);
    if list.y > 0u {
        let entry = list.x + light_fraction_choose(list.y, u.xy).index;
        let light = rows[rows[0].z + (entry >> 2u)][entry & 3u];
        color = f32(list.y) * contribution(pixels[id.x], light, place_of(u.zw));
    }
    add(id.x, color);
}
