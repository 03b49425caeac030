// The check's own part of the shaders: their buffers, and one query an invocation.

@group(0) @binding(0) var<storage, read> rows: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read> queries: array<Query>;
@group(0) @binding(2) var<storage, read_write> answers: array<Answer>;
@group(0) @binding(3) var<storage, read_write> mapped: array<Mapped>;
@group(0) @binding(4) var<storage, read_write> arrived: array<Arrived>;
@group(0) @binding(5) var<storage, read_write> weighed: array<Weighed>;

struct Query {
    p: vec3<f32>,
    kind: u32,
    // Normal of a surface, extent of a segment.
    n: vec3<f32>,
    alpha: f32,
    wo: vec3<f32>,
    diffuse: f32,
    u: vec2<u32>,
    other: u32,
    unused: u32,
}

struct Answer {
    light: u32,
    pmf: f32,
    u: vec2<u32>,
    // What light_sampler_pmf says of that light, and of another one.
    again: f32,
    other: f32,
    unused: vec2<u32>,
}

struct Mapped {
    // Of the alias table.
    index: u32,
    pmf: f32,
    u: vec2<u32>,
    // The octahedral code of the query's normal, and the unit vector of that code.
    decoded: vec3<f32>,
    code: u32,
    // The unit vector of the place u on the square of equal areas, and its place.
    direction: vec3<f32>,
    unused: u32,
    place: vec2<f32>,
    unused_too: vec2<u32>,
}

struct Arrived {
    // Of the light `other` by the place u: a sample, and what light_set_pdf_li says of its direction.
    l: vec3<f32>,
    pdf: f32,
    wi: vec3<f32>,
    again: f32,
    p_light: vec3<f32>,
    // What it says of the direction wo.
    toward: f32,
    n_light: vec3<f32>,
    // The sum of the channels of what light_set_le says of it.
    le: f32,
}

struct Weighed {
    // The bounds of light `other`, and their importance.
    lower: vec3<f32>,
    importance: f32,
    upper: vec3<f32>,
    phi: f32,
    w: vec3<f32>,
    cos_theta_o: f32,
    cos_theta_e: f32,
    two_sided: u32,
    unused: vec2<u32>,
}

fn light_row(i: u32) -> vec4<u32> {
    return rows[i];
}

fn receiver(query: Query) -> LightReceiver {
    switch query.kind {
        case LIGHT_SURFACE: {
            return light_surface(query.p, query.n);
        }
        case LIGHT_TWO_SIDED: {
            return light_two_sided(query.p, query.n);
        }
        case LIGHT_GLOSSY: {
            return light_glossy(query.p, query.n, query.wo, query.alpha, query.diffuse);
        }
        case LIGHT_SEGMENT: {
            return light_segment(query.p, query.n);
        }
        default: {
            return light_medium(query.p);
        }
    }
}

@compute @workgroup_size(64)
fn choose(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let sampler = light_sampler(0u);
    let asked = receiver(query);
    let sampled = light_sampler_sample(sampler, asked, query.u);
    let again = light_sampler_pmf(sampler, asked, sampled.light);
    let other = light_sampler_pmf(sampler, asked, query.other);
    answers[id.x] = Answer(sampled.light, sampled.pmf, sampled.u, again, other, vec2<u32>(0u));
}

// One of four choices by a cut.
@compute @workgroup_size(64)
fn choose_by_cut(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    var here = light_sampler_cut(light_sampler(0u), receiver(query));
    let u = light_fraction_stratum(query.u.x & 3u, 4u, query.u);
    let sampled = light_sampler_cut_sample(&here, u);
    let again = light_sampler_cut_pmf(&here, sampled.light);
    let other = light_sampler_cut_pmf(&here, query.other);
    answers[id.x] = Answer(sampled.light, sampled.pmf, sampled.u, again, other, vec2<u32>(0u));
}

// The rows are those of compact bounds here.
@compute @workgroup_size(64)
fn weigh(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let bounds = light_compact_bounds_decode(light_compact_bounds(0u), query.other);
    let importance = light_bounds_importance(bounds, receiver(query));
    weighed[id.x] = Weighed(
        bounds.lower,
        importance,
        bounds.upper,
        bounds.phi,
        bounds.w,
        bounds.cos_theta_o,
        bounds.cos_theta_e,
        u32(bounds.two_sided),
        vec2<u32>(0u),
    );
}

// The rows are those of an alias table here.
@compute @workgroup_size(64)
fn map(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let sampled = light_alias_sample(0u, arrayLength(&rows), query.u);
    let code = light_octahedral_encode(query.n);
    let square = vec2<f32>(query.u >> vec2<u32>(8u)) / 16777216.0;
    let direction = light_square_to_sphere(square);
    mapped[id.x] = Mapped(
        sampled.index,
        sampled.pmf,
        sampled.u,
        light_octahedral_decode(code),
        code,
        direction,
        0u,
        light_sphere_to_square(direction),
        vec2<u32>(0u),
    );
}

// The rows are those of a set of lights here.
@compute @workgroup_size(64)
fn arrive(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let lights = light_set(0u);
    let asked = receiver(query);
    let u = vec2<f32>(query.u >> vec2<u32>(8u)) / 16777216.0;
    let sample = light_set_sample_li(lights, query.other, asked, u);
    arrived[id.x] = Arrived(
        sample.l,
        sample.pdf,
        sample.wi,
        light_set_pdf_li(lights, query.other, asked, sample.wi),
        sample.p_light,
        light_set_pdf_li(lights, query.other, asked, query.wo),
        sample.n_light,
        dot(light_set_le(lights, query.other, query.wo), vec3<f32>(1.0)),
    );
}
