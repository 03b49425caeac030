// The numbers of light-bvh (QUERY_CONSTANTS) and light-samplers. Generated.

const LIGHT_BENT: f32 = 0.1894306;
const LIGHT_BOX_EMISSION: f32 = 297.0;
const LIGHT_DISTANCE: f32 = 0.09;
const LIGHT_FAR: f32 = 1e36;
const LIGHT_GLOSSY_DISTANCE: f32 = 0.03;
const LIGHT_GROUP_BY_POSITION: f32 = 400.0;
const LIGHT_HEIGHT: f32 = 0.43;
const LIGHT_LEAST_SHARE: f32 = 0.0009765625;
const LIGHT_LEAST_SPREAD: f32 = 0.51961523;
const LIGHT_LEAST_TOTAL: f32 = 1e-10;
const LIGHT_MIN_ALPHA: f32 = 0.01;
const LIGHT_MIN_COS: f32 = 0.001;
const LIGHT_MIN_DIFFUSE: f32 = 0.02;
const LIGHT_MIN_HALF_SQ: f32 = 1e-5;
const LIGHT_NEAREST: f32 = 1e-8;
const LIGHT_NEARNESS: f32 = 0.2;
const LIGHT_PLACES: f32 = 4.0;
const LIGHT_RAMP_BY_POSITION: f32 = 11.0;
const LIGHT_ROUND_OFF: f32 = 1e-5;
const LIGHT_STEP_EDGE: f32 = 4.87;
const LIGHT_UNIT: f32 = 127.25;
const LIGHT_WIDENING: f32 = 0.375;
const LIGHT_HORIZON_SLACK: f32 = 1e-5;

// Fractions of 2^64, random numbers that choices use up: x is the upper, y the lower word.

// A whole number and what is left of a fraction.
struct LightIndex {
    index: u32,
    u: vec2<u32>,
}

// (r + u) / g, rounded down: the inverse of a choice of probability g / 2^16; r < g <= 65536.
fn light_fraction_divide(r: u32, u: vec2<u32>, g: u32) -> vec2<u32> {
    let n3 = (r << 16u) | (u.x >> 16u);
    let n2 = ((n3 % g) << 16u) | (u.x & 0xffffu);
    let n1 = ((n2 % g) << 16u) | (u.y >> 16u);
    let n0 = ((n1 % g) << 16u) | (u.y & 0xffffu);
    return vec2<u32>(((n3 / g) << 16u) | (n2 / g), ((n1 / g) << 16u) | (n0 / g));
}

// u * 2^16, without its whole part.
fn light_fraction_after_16_bits(u: vec2<u32>) -> vec2<u32> {
    return vec2<u32>((u.x << 16u) | (u.y >> 16u), u.y << 16u);
}

// One of the numbers 0..count with equal probability; count is at least 1.
fn light_fraction_choose(count: u32, u: vec2<u32>) -> LightIndex {
    let low = light_product(u.y, count);
    let high = light_product(u.x, count);
    let middle = high.y + low.x;
    let carry = select(0u, 1u, middle < high.y);
    return LightIndex(high.x + carry, vec2<u32>(middle, low.y));
}

// The product in two words.
fn light_product(a: u32, b: u32) -> vec2<u32> {
    let low = (a & 0xffffu) * (b & 0xffffu);
    let middle = (a >> 16u) * (b & 0xffffu) + (low >> 16u);
    let cross = (a & 0xffffu) * (b >> 16u) + (middle & 0xffffu);
    let high = (a >> 16u) * (b >> 16u) + (middle >> 16u) + (cross >> 16u);
    return vec2<u32>(high, (cross << 16u) | (low & 0xffffu));
}

// The upper 24 bits as a number in [0, 1).
fn light_fraction_to_f32(u: vec2<u32>) -> f32 {
    return f32(u.x >> 8u) * (1.0 / 16777216.0);
}

// Indices in proportion to weights, in constant time: AliasTable of light-math.

// An index, its probability, and what is left of the random number.
struct LightAliasSample {
    index: u32,
    pmf: f32,
    u: vec2<u32>,
}

// An index of the table of `count` bins that begins in row `first`, a bin a row.
fn light_alias_sample(first: u32, count: u32, u: vec2<u32>) -> LightAliasSample {
    let chosen = light_fraction_choose(count, u);
    let bin = light_row(first + chosen.index);
    let place = chosen.u.x >> 16u;
    let is_own = place < bin.x;
    let index = select(bin.y, chosen.index, is_own);
    let rest = light_fraction_divide(
        select(place - bin.x, place, is_own),
        light_fraction_after_16_bits(chosen.u),
        select(65536u - bin.x, bin.x, is_own),
    );
    return LightAliasSample(index, light_alias_pmf(first, count, index), rest);
}

// The probability of an index, with the bits that a sample of it has; 0 for one out of range.
fn light_alias_pmf(first: u32, count: u32, index: u32) -> f32 {
    if index >= count {
        return 0.0;
    }
    return bitcast<f32>(light_row(first + index).z);
}

// Maps between the sphere and the square: octahedral codes and the equal-area map of light-math.

// a with the sign of b, whose zero counts as it is signed.
fn light_with_sign(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    let sign = bitcast<vec2<u32>>(b) & vec2<u32>(0x80000000u);
    return bitcast<vec2<f32>>(bitcast<vec2<u32>>(abs(a)) | sign);
}

// The unit vector of a 32-bit octahedral code, x in its lower half.
fn light_octahedral_decode(code: u32) -> vec3<f32> {
    let xy = vec2<f32>(vec2<u32>(code, code >> 16u) & vec2<u32>(0xffffu)) * (2.0 / 65535.0) - 1.0;
    let z = 1.0 - (abs(xy.x) + abs(xy.y));
    let folded = light_with_sign(1.0 - abs(xy.yx), xy);
    return normalize(vec3<f32>(select(folded, xy, z >= 0.0), z));
}

// The octahedral code of the direction of v, which need not have unit length.
fn light_octahedral_encode(v: vec3<f32>) -> u32 {
    let w = v / (abs(v.x) + abs(v.y) + abs(v.z));
    let folded = light_with_sign(1.0 - abs(w.yx), w.xy);
    let xy = clamp(select(folded, w.xy, w.z >= 0.0), vec2<f32>(-1.0), vec2<f32>(1.0));
    let code = vec2<u32>((xy * 0.5 + 0.5) * 65535.0 + 0.5);
    return code.x | (code.y << 16u);
}

// The unit vector of a point of the unit square, on which equal areas are equal solid angles.
fn light_square_to_sphere(p: vec2<f32>) -> vec3<f32> {
    let uv = 2.0 * p - 1.0;
    let a = abs(uv);
    let signed_distance = 1.0 - (a.x + a.y);
    let r = 1.0 - abs(signed_distance);
    let turn = select((a.y - a.x) / r + 1.0, 1.0, r == 0.0);
    let phi = turn * 0.78539816339;
    let xy = light_with_sign(vec2<f32>(cos(phi), sin(phi)), uv) * (r * sqrt(2.0 - r * r));
    return vec3<f32>(xy, light_with_sign(vec2<f32>(1.0 - r * r), vec2<f32>(signed_distance)).x);
}

// The point of the unit square of a unit vector.
fn light_sphere_to_square(d: vec3<f32>) -> vec2<f32> {
    let a = abs(d);
    let r = min(sqrt((a.x * a.x + a.y * a.y) / (1.0 + a.z)), 1.0);
    let major = max(a.x, a.y);
    let tangent = select(min(a.x, a.y) / major, 0.0, major == 0.0);
    let octant = atan(tangent) * 0.63661977237;
    let turn = select(octant, 1.0 - octant, a.x < a.y);
    let upper = vec2<f32>(r - turn * r, turn * r);
    let uv = select(upper, 1.0 - upper.yx, d.z < 0.0);
    return 0.5 * light_with_sign(uv, d.xy) + 0.5;
}

// Who asks for light: what LightSampleContext is on the CPU.

const LIGHT_SURFACE: u32 = 0u;
const LIGHT_TWO_SIDED: u32 = 1u;
const LIGHT_GLOSSY: u32 = 2u;
const LIGHT_MEDIUM: u32 = 3u;
const LIGHT_SEGMENT: u32 = 4u;

const LIGHT_MAX: f32 = 0x1.fffffep+127;
// The least normal number.
const LIGHT_MIN: f32 = 0x1p-126;

struct LightReceiver {
    p: vec3<f32>,
    // One of the constants above.
    kind: u32,
    // The unit normal of a surface, the unit direction of a segment.
    n: vec3<f32>,
    // Of a segment.
    length: f32,
    // The unit vector from a glossy surface to the viewer.
    wo: vec3<f32>,
    cos_o: f32,
    alpha: f32,
    diffuse: f32,
}

// A point of a surface that light reaches from the side of its normal n, of any length. Without a
// direction, or where coordinates were clamped, it is a point in a medium.
fn light_surface(p: vec3<f32>, n: vec3<f32>) -> LightReceiver {
    var receiver = light_medium(p);
    receiver.n = light_unit_or(n, vec3<f32>(0.0));
    let is_surface = all(receiver.p == p) && any(receiver.n != vec3<f32>(0.0));
    receiver.kind = select(LIGHT_MEDIUM, LIGHT_SURFACE, is_surface);
    return receiver;
}

// A point of a surface that light reaches from both sides.
fn light_two_sided(p: vec3<f32>, n: vec3<f32>) -> LightReceiver {
    var receiver = light_surface(p, n);
    receiver.kind = select(LIGHT_MEDIUM, LIGHT_TWO_SIDED, receiver.kind == LIGHT_SURFACE);
    return receiver;
}

// A point of a surface that reflects the share `diffuse` of light in all directions alike, the rest
// about the mirror direction, as microfacets of the roughness `alpha` do. `wo` leads to the viewer.
fn light_glossy(
    p: vec3<f32>,
    n: vec3<f32>,
    wo: vec3<f32>,
    alpha: f32,
    diffuse: f32,
) -> LightReceiver {
    var receiver = light_surface(p, n);
    receiver.kind = select(LIGHT_MEDIUM, LIGHT_GLOSSY, receiver.kind == LIGHT_SURFACE);
    let viewer = light_unit_or(wo, vec3<f32>(0.0));
    let is_matt = all(viewer == vec3<f32>(0.0));
    receiver.wo = select(viewer, receiver.n, is_matt);
    receiver.cos_o = clamp(dot(receiver.n, receiver.wo), LIGHT_MIN_COS, 1.0);
    receiver.alpha = clamp(alpha, LIGHT_MIN_ALPHA, 1.0);
    receiver.diffuse = clamp(select(diffuse, 1.0, is_matt), LIGHT_MIN_DIFFUSE, 1.0);
    return receiver;
}

// A point in a medium.
fn light_medium(p: vec3<f32>) -> LightReceiver {
    var receiver: LightReceiver;
    receiver.p = clamp(p, vec3<f32>(-LIGHT_FAR), vec3<f32>(LIGHT_FAR));
    receiver.kind = LIGHT_MEDIUM;
    return receiver;
}

// The ray segment from p to p + extent in a medium; one of no extent is a point.
fn light_segment(p: vec3<f32>, extent: vec3<f32>) -> LightReceiver {
    var receiver = light_medium(p);
    receiver.kind = select(LIGHT_MEDIUM, LIGHT_SEGMENT, any(extent != vec3<f32>(0.0)));
    let along = light_medium(receiver.p + extent).p - receiver.p;
    let largest = max(max(abs(along.x), abs(along.y)), max(abs(along.z), LIGHT_MIN));
    receiver.length = length(along / largest) * largest;
    receiver.n = light_unit_or(along, vec3<f32>(0.0, 0.0, 1.0));
    return receiver;
}

// How far the receiver reaches from p.
fn light_reach(receiver: LightReceiver) -> f32 {
    let extent = abs(receiver.n) * receiver.length;
    return extent.x + extent.y + extent.z;
}

// The unit vector along v, however long that is; `otherwise` if v is 0.
fn light_unit_or(v: vec3<f32>, otherwise: vec3<f32>) -> vec3<f32> {
    if abs(dot(v, v) - 1.0) <= 1e-5 {
        return v;
    }
    let largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if !(largest > 0.0 && largest <= LIGHT_MAX) {
        return otherwise;
    }
    return normalize(v / largest);
}

// Four children of a node of the light tree, side by side, as a receiver sees them.

// A node in 14 rows: WideNode of light-bvh documents them.
struct LightNode {
    rows: array<vec4<u32>, 12>,
    origin: vec3<f32>,
    inv_scale: f32,
    child_base: u32,
    light_base: u32,
    // Of the children, how many are nodes, and how many there are.
    inner: u32,
    count: u32,
    parent: u32,
    // The largest power of a child, as a share of the tree's.
    gain: f32,
}

// Where a receiver sees the children of a node, and in which unit of length.
struct LightFrame {
    origin: vec3<f32>,
    // The length of a code.
    code: f32,
    // One over the unit.
    inv_unit: f32,
}

// ChildView of light-bvh documents the fields.
struct LightChildren {
    mean_x: vec4<f32>,
    mean_y: vec4<f32>,
    mean_z: vec4<f32>,
    extent_x: vec4<f32>,
    extent_y: vec4<f32>,
    extent_z: vec4<f32>,
    axis_x: vec4<f32>,
    axis_y: vec4<f32>,
    axis_z: vec4<f32>,
    dist: vec4<f32>,
    dist_sq: vec4<f32>,
    slack: vec4<f32>,
    offset: vec4<f32>,
    spread: vec4<f32>,
    power: vec4<f32>,
    soft: vec4<bool>,
    step: vec4<bool>,
    both_sides: vec4<bool>,
}

// The node that begins in row `first`.
fn light_node(first: u32) -> LightNode {
    var node: LightNode;
    for (var row = 0u; row < 12u; row++) {
        node.rows[row] = light_row(first + row);
    }
    let place = bitcast<vec4<f32>>(light_row(first + 12u));
    node.origin = place.xyz;
    node.inv_scale = place.w;
    let links = light_row(first + 13u);
    node.child_base = links.x;
    node.light_base = links.y;
    node.inner = (links.z >> 16u) & 0xffu;
    node.count = links.z >> 24u;
    node.parent = links.w;
    node.gain = bitcast<f32>(links.z << 16u);
    return node;
}

// A code of the node is the unit: the quickest.
fn light_frame_in_codes(node: LightNode, p: vec3<f32>) -> LightFrame {
    return LightFrame((node.origin - p) * node.inv_scale, 1.0, node.inv_scale);
}

// The unit is near the distance to the node or its extent, whichever is larger.
fn light_frame_from_afar(node: LightNode, p: vec3<f32>, reach: f32) -> LightFrame {
    let origin = node.origin - p;
    let away = abs(origin.x) + abs(origin.y) + abs(origin.z) + reach;
    let unit = bitcast<u32>(max(away, 256.0 / node.inv_scale)) & 0x7f800000u;
    let inv_unit = bitcast<f32>((254u << 23u) - unit);
    return LightFrame(origin * inv_unit, inv_unit / node.inv_scale, inv_unit);
}

// The four children 4 word, 4 word + 1, ...
fn light_children(node: ptr<function, LightNode>, frame: LightFrame, word: u32) -> LightChildren {
    var c: LightChildren;
    c.mean_x = frame.origin.x + frame.code * light_bytes((*node).rows[0][word]);
    c.mean_y = frame.origin.y + frame.code * light_bytes((*node).rows[1][word]);
    c.mean_z = frame.origin.z + frame.code * light_bytes((*node).rows[2][word]);
    c.extent_x = frame.code * light_bytes((*node).rows[3][word]);
    c.extent_y = frame.code * light_bytes((*node).rows[4][word]);
    c.extent_z = frame.code * light_bytes((*node).rows[5][word]);
    c.axis_x = light_signed_bytes((*node).rows[6][word]);
    c.axis_y = light_signed_bytes((*node).rows[7][word]);
    c.axis_z = light_signed_bytes((*node).rows[8][word]);
    let offset = light_signed_bytes((*node).rows[9][word]);
    c.both_sides = offset == vec4<f32>(-128.0);
    c.offset = select(offset, vec4<f32>(0.0), c.both_sides);
    let spread = light_bytes_as_u32((*node).rows[10][word]);
    c.step = (spread & vec4<u32>(128u)) != vec4<u32>(0u);
    c.soft = (spread & vec4<u32>(64u)) != vec4<u32>(0u);
    let least = bitcast<u32>(f32(LIGHT_LEAST_SPREAD));
    c.spread = bitcast<vec4<f32>>(((spread & vec4<u32>(63u)) << vec4<u32>(20u)) + least);
    let power = light_bytes_as_u32((*node).rows[11][word]);
    let zero = 96u << 23u;
    c.power = bitcast<vec4<f32>>((power << vec4<u32>(20u)) + zero) - bitcast<f32>(zero);
    c.dist_sq = light_dist_sq(c, LIGHT_DISTANCE);
    c.dist = sqrt(c.dist_sq);
    c.slack = LIGHT_ROUND_OFF * c.dist;
    return c;
}

// The same children as seen from `offset` further on, and no nearer than the root of `least_sq`.
fn light_children_from(children: LightChildren, offset: mat3x4<f32>, least_sq: f32) -> LightChildren {
    var c = children;
    c.mean_x -= offset[0];
    c.mean_y -= offset[1];
    c.mean_z -= offset[2];
    c.dist_sq = max(vec4<f32>(least_sq), light_dist_sq(c, LIGHT_DISTANCE));
    c.dist = sqrt(c.dist_sq);
    return c;
}

// The mean squared distance, where `variance` is the share of the squared width that counts.
fn light_dist_sq(c: LightChildren, variance: f32) -> vec4<f32> {
    let width = light_width(c);
    let away = c.mean_x * c.mean_x + c.mean_y * c.mean_y;
    return away + (c.mean_z * c.mean_z + variance * (width * width));
}

fn light_width(c: LightChildren) -> vec4<f32> {
    return c.extent_x + c.extent_y + c.extent_z;
}

fn light_bytes_as_u32(word: u32) -> vec4<u32> {
    return (vec4<u32>(word) >> vec4<u32>(0u, 8u, 16u, 24u)) & vec4<u32>(255u);
}

fn light_bytes(word: u32) -> vec4<f32> {
    return vec4<f32>(light_bytes_as_u32(word));
}

fn light_signed_bytes(word: u32) -> vec4<f32> {
    let high = bitcast<vec4<i32>>(vec4<u32>(word) << vec4<u32>(24u, 16u, 8u, 0u));
    return vec4<f32>(high >> vec4<u32>(24u));
}

// The importance of four children of a node to a receiver: `importance` of light-bvh.

const LIGHT_HALF_PI: f32 = 1.57079632679;

// 0 only where no light of the child can contribute.
fn light_importance(receiver: LightReceiver, c: LightChildren, inv_unit: f32) -> vec4<f32> {
    switch receiver.kind {
        case LIGHT_SEGMENT: {
            return light_segment_importance(receiver, c, inv_unit);
        }
        case LIGHT_MEDIUM: {
            return light_emitted(c, c.dist, vec4<f32>(0.0));
        }
        default: {
            return light_surface_importance(receiver, c);
        }
    }
}

// One or two sides, matt or glossy.
fn light_surface_importance(receiver: LightReceiver, c: LightChildren) -> vec4<f32> {
    // Half of the mean height over the horizon, and of what the box adds to it.
    let n = 0.5 * receiver.n;
    let mean = n.x * c.mean_x + n.y * c.mean_y + n.z * c.mean_z;
    let support_x = abs(n.x) * c.extent_x;
    let support_y = abs(n.y) * c.extent_y;
    let support_z = abs(n.z) * c.extent_z;
    let support = support_x + support_y + support_z;
    let squares = support_x * support_x + support_y * support_y + support_z * support_z;
    let root = sqrt(mean * mean + LIGHT_HEIGHT * squares);
    let reaches = light_may_reach(c);
    if receiver.kind == LIGHT_TWO_SIDED {
        let height = 2.0 * max(c.slack, root);
        return select(vec4<f32>(0.0), light_emitted(c, height, vec4<f32>(0.0)), reaches);
    }
    let height = max(c.slack, mean + root);
    // Of a group that straddles the horizon, what is above it lies higher than the mean.
    let along = c.axis_x * receiver.n.x + c.axis_y * receiver.n.y + c.axis_z * receiver.n.z;
    let raised = max(vec4<f32>(0.0), support - mean) * along;
    let lift = select(vec4<f32>(0.0), raised, c.soft & !c.step);
    var weight = light_emitted(c, height, lift);
    if receiver.kind == LIGHT_GLOSSY {
        weight *= light_reflected(receiver, c, height);
    }
    return select(vec4<f32>(0.0), weight, (mean + support > -c.slack) & reaches);
}

// Whether any light of the child may emit toward the receiver.
fn light_may_reach(c: LightChildren) -> vec4<bool> {
    let along = c.axis_x * c.mean_x + c.axis_y * c.mean_y + c.axis_z * c.mean_z;
    let beyond = along + c.offset * c.dist;
    let edge = (LIGHT_STEP_EDGE * c.spread) * c.dist;
    let is_within = beyond < LIGHT_BOX_EMISSION * light_width(c) + edge;
    return is_within | c.soft | c.both_sides;
}

// What the children emit to a point over whose horizon they are at `height`.
fn light_emitted(c: LightChildren, height: vec4<f32>, lift: vec4<f32>) -> vec4<f32> {
    let along = c.axis_x * c.mean_x + c.axis_y * c.mean_y + c.axis_z * c.mean_z;
    let beyond = along + c.offset * c.dist + lift;
    let width = light_width(c);
    let width_sq = width * width;
    let cap = (0.25 * LIGHT_UNIT) * (LIGHT_UNIT - c.offset);
    let ramp = select(
        vec4<f32>(LIGHT_RAMP_BY_POSITION),
        vec4<f32>(LIGHT_GROUP_BY_POSITION),
        c.soft,
    );
    let variance = select(ramp, cap, c.step) * width_sq + (c.spread * c.spread) * c.dist_sq;
    let root = sqrt(beyond * beyond + variance);
    // root - beyond, which a driver's rounding must not make 0.
    let one_side = select(root - beyond, variance / (root + abs(beyond)), beyond > vec4<f32>(0.0));
    let emitted = select(one_side, root, c.both_sides);
    let scale = select(vec4<f32>(1.0), LIGHT_UNIT * c.dist / root, c.step);
    let inv_dist_sq = 1.0 / c.dist_sq;
    let near = 1.0 + LIGHT_NEARNESS * (width_sq * inv_dist_sq);
    return (((c.power * inv_dist_sq) * (height * inv_dist_sq)) * near) * (emitted * scale);
}

// How much more or less a glossy surface reflects toward its viewer than a matt one.
fn light_reflected(receiver: LightReceiver, c: LightChildren, height: vec4<f32>) -> vec4<f32> {
    let wo = receiver.wo;
    let dist_sq = light_dist_sq(c, LIGHT_GLOSSY_DISTANCE);
    let inv_dist = 1.0 / sqrt(dist_sq);
    let cos_i = min(vec4<f32>(1.0), height * inv_dist);
    let toward = c.mean_x * wo.x + c.mean_y * wo.y + c.mean_z * wo.z;
    let half_sq = max(vec4<f32>(LIGHT_MIN_HALF_SQ), 2.0 + 2.0 * toward * inv_dist);
    let cos_sum = cos_i + receiver.cos_o;
    let upright = min(half_sq, cos_sum * cos_sum);
    let extent_sq = c.extent_x * c.extent_x + c.extent_y * c.extent_y + c.extent_z * c.extent_z;
    let widening = LIGHT_WIDENING * extent_sq / (dist_sq + extent_sq);
    let alpha = receiver.alpha;
    let alpha_sq = min(vec4<f32>(1.0), alpha * alpha + widening);
    let spread = half_sq - (1.0 - alpha_sq) * upright;
    let facets = alpha_sq * half_sq * half_sq / (spread * spread);
    let shadowing = 0.5 / ((1.0 - alpha) * 2.0 * cos_i * receiver.cos_o + alpha * cos_sum);
    return receiver.diffuse + (1.0 - receiver.diffuse) * facets * shadowing;
}

// The mean fluence along a segment, from places equally spaced in the angle that a child sees.
fn light_segment_importance(
    receiver: LightReceiver,
    c: LightChildren,
    inv_unit: f32,
) -> vec4<f32> {
    let w = receiver.n;
    let length = max(1e-3 * c.dist, vec4<f32>(receiver.length * inv_unit));
    let nearest = c.mean_x * w.x + c.mean_y * w.y + c.mean_z * w.z;
    let aside_x = c.mean_x - w.x * nearest;
    let aside_y = c.mean_y - w.y * nearest;
    let aside_z = c.mean_z - w.z * nearest;
    let aside_sq = aside_x * aside_x + aside_y * aside_y + aside_z * aside_z;
    let extent_sq = c.extent_x * c.extent_x + c.extent_y * c.extent_y + c.extent_z * c.extent_z;
    let least = LIGHT_NEAREST * length;
    let blurred = aside_sq + 2.0 * LIGHT_DISTANCE * extent_sq + c.slack * c.slack;
    let height_sq = max(least * least, blurred);
    let height = sqrt(height_sq);
    let begin = light_angle(-nearest / height);
    let span = max(vec4<f32>(1e-6), light_angle((length - nearest) / height) - begin);
    var sum = vec4<f32>(0.0);
    for (var place = 0; place < i32(LIGHT_PLACES); place++) {
        let theta = begin + span * ((f32(place) + 0.5) / LIGHT_PLACES);
        let t = clamp(nearest + height * light_tangent(theta), vec4<f32>(0.0), length);
        let offset = mat3x4<f32>(w.x * t, w.y * t, w.z * t);
        let here = light_children_from(c, offset, least.x * least.x);
        let from_nearest = t - nearest;
        let fluence = light_emitted(here, here.dist, vec4<f32>(0.0));
        sum += fluence * (height_sq + from_nearest * from_nearest);
    }
    return sum * (span / (LIGHT_PLACES * height * length));
}

// The arc tangent within 0.006, and below a right angle.
fn light_angle(x: vec4<f32>) -> vec4<f32> {
    let magnitude = abs(x);
    let square = x * x;
    let low = magnitude / (1.0 + 0.28 * square);
    let high = LIGHT_HALF_PI - magnitude / (square + 0.28);
    let angle = select(high, low, magnitude <= vec4<f32>(1.0));
    return min(vec4<f32>(LIGHT_HALF_PI - 1e-4), angle) * sign(x);
}

// The tangent within a fiftieth.
fn light_tangent(x: vec4<f32>) -> vec4<f32> {
    let t = x / LIGHT_HALF_PI;
    let square = t * t;
    return x * (1.0 - LIGHT_BENT * square) / (1.0 - square);
}

// Lights chosen by a tree, with exact probabilities: LightBvhRef of light-bvh.

const LIGHT_MAX_DEPTH: u32 = 24u;
const LIGHT_NOWHERE: u32 = 0xffffffffu;

// Where the parts of a tree begin, in rows.
struct LightTree {
    nodes: u32,
    order: u32,
    slots: u32,
    node_count: u32,
    light_count: u32,
}

// A light, its probability, and what is left of the random number. Nothing was chosen where the
// probability is 0: no light of the tree can contribute.
struct SampledLight {
    light: u32,
    pmf: f32,
    u: vec2<u32>,
}

// The parts of 2^16 of each child of a node, or its weights.
struct LightParts {
    lanes: array<vec4<u32>, 4>,
}

struct LightWeights {
    lanes: array<vec4<f32>, 4>,
    total: f32,
    // One over the unit of length that they are in.
    inv_unit: f32,
}

// The tree whose rows begin in row `first`: light_tree_rows of the crate makes them.
fn light_tree(first: u32) -> LightTree {
    let head = light_row(first);
    let nodes = first + 1u;
    let order = nodes + 14u * head.x;
    return LightTree(nodes, order, order + head.y, head.x, head.z);
}

// A light, chosen by the fraction u about in proportion to the unoccluded light of each.
fn light_tree_sample(tree: LightTree, receiver: LightReceiver, u: vec2<u32>) -> SampledLight {
    let none = SampledLight(0u, 0.0, u);
    var index = 0u;
    var pmf = 1.0;
    var rest = u;
    for (var level = 0u; level < LIGHT_MAX_DEPTH && index < tree.node_count; level++) {
        var node = light_node(tree.nodes + 14u * index);
        let parts = light_parts(&node, receiver);
        var place = rest.x >> 16u;
        var child = 16u;
        var chosen = 0u;
        for (var k = 0u; k < 16u; k++) {
            let own = parts.lanes[k >> 2u][k & 3u];
            if child == 16u && place < own {
                child = k;
                chosen = own;
            }
            place -= select(0u, own, child == 16u);
        }
        if child == 16u {
            return none;
        }
        pmf = light_positive_product(pmf, f32(chosen) * (1.0 / 65536.0));
        rest = light_fraction_divide(place, light_fraction_after_16_bits(rest), chosen);
        if child >= node.inner {
            let entry = node.light_base + child - node.inner;
            return SampledLight(light_entry(tree.order, entry), pmf, rest);
        }
        index = node.child_base + child;
    }
    return none;
}

// The probability with which light_tree_sample returns `light`, with the same bits.
fn light_tree_pmf(tree: LightTree, receiver: LightReceiver, light: u32) -> f32 {
    if light >= tree.light_count {
        return 0.0;
    }
    var shares: array<f32, 24>;
    var levels = 0u;
    var slot = light_entry(tree.slots, light);
    if slot == LIGHT_NOWHERE {
        return 0.0;
    }
    while slot != LIGHT_NOWHERE && levels < LIGHT_MAX_DEPTH {
        let child = slot & 15u;
        var node = light_node(tree.nodes + 14u * (slot >> 4u));
        let parts = light_parts(&node, receiver);
        shares[levels] = f32(parts.lanes[child >> 2u][child & 3u]) * (1.0 / 65536.0);
        levels++;
        slot = node.parent;
    }
    // Multiplied from the root down, as a sample does it.
    var pmf = 1.0;
    while levels > 0u {
        levels--;
        pmf = light_positive_product(pmf, shares[levels]);
    }
    return pmf;
}

// About the irradiance by the lights of the tree, if all of them have power 1 together.
fn light_tree_irradiance(tree: LightTree, receiver: LightReceiver) -> f32 {
    if tree.node_count == 0u {
        return 0.0;
    }
    var node = light_node(tree.nodes);
    let weights = light_trusted_weights(&node, receiver);
    if !(weights.total > 0.0) {
        return 0.0;
    }
    // Intensities are counted twice.
    let irradiance = (0.5 * weights.total * weights.inv_unit) * (node.gain * weights.inv_unit);
    return clamp(irradiance, LIGHT_MIN, LIGHT_MAX);
}

// The parts of 2^16 of each child: at least one where it can contribute, none elsewhere. They sum
// to 2^16, because the first one takes what is left over, or to 0.
fn light_parts(node: ptr<function, LightNode>, receiver: LightReceiver) -> LightParts {
    let weights = light_trusted_weights(node, receiver);
    var parts: LightParts;
    if !(weights.total > 0.0) {
        return parts;
    }
    let scale = min((65536.0 - 16.0) / weights.total, LIGHT_MAX);
    var sum = vec4<u32>(0u);
    for (var word = 0u; word < 4u; word++) {
        let lanes = weights.lanes[word];
        let some = vec4<u32>(1u) + vec4<u32>(lanes * scale);
        parts.lanes[word] = select(vec4<u32>(0u), some, lanes > vec4<f32>(0.0));
        sum += parts.lanes[word];
    }
    var left_over = 65536u - (sum.x + sum.y + sum.z + sum.w);
    for (var k = 0u; k < 16u; k++) {
        let own = parts.lanes[k >> 2u][k & 3u];
        let is_first = own > 0u && left_over > 0u;
        parts.lanes[k >> 2u][k & 3u] = own + select(0u, left_over, is_first);
        left_over = select(left_over, 0u, is_first);
    }
    return parts;
}

// In codes of the node, or in a unit in which none of them vanishes.
fn light_trusted_weights(node: ptr<function, LightNode>, receiver: LightReceiver) -> LightWeights {
    let weights = light_weights(node, receiver, light_frame_in_codes(*node, receiver.p));
    if weights.total >= LIGHT_LEAST_TOTAL && weights.total <= LIGHT_MAX {
        return weights;
    }
    let frame = light_frame_from_afar(*node, receiver.p, light_reach(receiver));
    return light_weights(node, receiver, frame);
}

fn light_weights(
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
    frame: LightFrame,
) -> LightWeights {
    var weights: LightWeights;
    for (var word = 0u; word < 4u; word++) {
        let children = light_children(node, frame, word);
        weights.lanes[word] = light_importance(receiver, children, frame.inv_unit);
    }
    let least = vec4<f32>(light_total(weights.lanes) * LIGHT_LEAST_SHARE);
    for (var word = 0u; word < 4u; word++) {
        let lanes = weights.lanes[word];
        weights.lanes[word] = select(vec4<f32>(0.0), max(lanes, least), lanes > vec4<f32>(0.0));
    }
    weights.total = light_total(weights.lanes);
    weights.inv_unit = frame.inv_unit;
    return weights;
}

fn light_total(lanes: array<vec4<f32>, 4>) -> f32 {
    let four = (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]);
    return (four.x + four.z) + (four.y + four.w);
}

// An entry of an array of words that begins in row `first`.
fn light_entry(first: u32, entry: u32) -> u32 {
    return light_row(first + (entry >> 2u))[entry & 3u];
}

// The product of two probabilities: 0 only if one of them is.
fn light_positive_product(a: f32, b: f32) -> f32 {
    return select(0.0, max(a * b, LIGHT_MIN), a > 0.0 && b > 0.0);
}

// Lights at infinity beside those of a tree: BvhLightSamplerRef of light-samplers.

struct LightSampler {
    tree: LightTree,
    // Of the tree.
    power: f32,
    // The row of the first light at infinity, of three each, and how many there are.
    infinite: u32,
    infinite_count: u32,
}

// A part of the first choice: 0 is the tree, the lights at infinity follow.
struct LightShare {
    index: u32,
    // Its parts of 2^16, and how far into them a random number falls.
    parts: u32,
    place: u32,
}

// The sampler whose rows begin in row `first`: light_sampler_rows of the crate makes them.
fn light_sampler(first: u32) -> LightSampler {
    let head = light_row(first);
    let infinite = first + 1u;
    let tree = light_tree(infinite + 3u * head.y);
    return LightSampler(tree, bitcast<f32>(head.x), infinite, head.y);
}

// A light, chosen by u about in proportion to the unoccluded light of each.
fn light_sampler_sample(
    sampler: LightSampler,
    receiver: LightReceiver,
    u: vec2<u32>,
) -> SampledLight {
    if sampler.infinite_count == 0u {
        return light_tree_sample(sampler.tree, receiver, u);
    }
    let share = light_share(sampler, receiver, u.x >> 16u, LIGHT_NOWHERE);
    if share.parts == 0u {
        return SampledLight(0u, 0.0, u);
    }
    let pmf = f32(share.parts) * (1.0 / 65536.0);
    let rest = light_fraction_divide(share.place, light_fraction_after_16_bits(u), share.parts);
    if share.index > 0u {
        return SampledLight(light_infinite_id(sampler, share.index - 1u), pmf, rest);
    }
    var sampled = light_tree_sample(sampler.tree, receiver, rest);
    sampled.pmf = light_positive_product(pmf, sampled.pmf);
    return sampled;
}

// The probability with which light_sampler_sample returns `light`, with the same bits.
fn light_sampler_pmf(sampler: LightSampler, receiver: LightReceiver, light: u32) -> f32 {
    if sampler.infinite_count == 0u {
        return light_tree_pmf(sampler.tree, receiver, light);
    }
    var index = 0u;
    for (var i = 0u; i < sampler.infinite_count; i++) {
        index = select(index, i + 1u, light_infinite_id(sampler, i) == light);
    }
    let share = light_share(sampler, receiver, 0u, index);
    let pmf = f32(share.parts) * (1.0 / 65536.0);
    if index > 0u {
        return pmf;
    }
    return light_positive_product(pmf, light_tree_pmf(sampler.tree, receiver, light));
}

// The share `wanted`, or that on which `at` falls, a place below 2^16, if `wanted` is
// LIGHT_NOWHERE. It has no parts where nothing has weight.
fn light_share(
    sampler: LightSampler,
    receiver: LightReceiver,
    at: u32,
    wanted: u32,
) -> LightShare {
    let of_unit_power = light_tree_irradiance(sampler.tree, receiver);
    let in_tree = min(light_positive_product(of_unit_power, sampler.power), LIGHT_MAX);
    let count = 1u + sampler.infinite_count;
    var total = 0.0;
    for (var i = 0u; i < count; i++) {
        total += light_first_weight(sampler, receiver, in_tree, i);
    }
    var unit = select(1.0, 1.0 / 128.0, total > LIGHT_MAX);
    unit = select(unit, 0x1p+100, total < 0x1p-100);
    var scaled = 0.0;
    for (var i = 0u; i < count; i++) {
        scaled += light_in_unit(light_first_weight(sampler, receiver, in_tree, i), unit);
    }
    var share = LightShare(LIGHT_NOWHERE, 0u, at);
    if !(scaled > 0.0) {
        return share;
    }
    let scale = min((65536.0 - f32(count)) / scaled, LIGHT_MAX);
    var left_over = 65536u;
    for (var i = 0u; i < count; i++) {
        let weight = light_in_unit(light_first_weight(sampler, receiver, in_tree, i), unit);
        left_over -= select(0u, 1u + u32(weight * scale), weight > 0.0);
    }
    for (var i = 0u; i < count; i++) {
        let weight = light_in_unit(light_first_weight(sampler, receiver, in_tree, i), unit);
        let own = select(0u, 1u + u32(weight * scale) + left_over, weight > 0.0);
        left_over = select(left_over, 0u, weight > 0.0);
        let is_chosen = wanted == LIGHT_NOWHERE && share.place < own;
        if share.index == LIGHT_NOWHERE && (is_chosen || wanted == i) {
            share.index = i;
            share.parts = own;
        }
        share.place -= select(0u, own, share.index == LIGHT_NOWHERE);
    }
    return share;
}

// About the irradiance by the lights of the tree, or by a light at infinity.
fn light_first_weight(
    sampler: LightSampler,
    receiver: LightReceiver,
    in_tree: f32,
    index: u32,
) -> f32 {
    if index == 0u {
        return in_tree;
    }
    let first = sampler.infinite + 3u * (index - 1u);
    let mean = bitcast<vec4<f32>>(light_row(first));
    let cone = bitcast<vec4<f32>>(light_row(first + 1u));
    return light_positive_product(mean.w, light_mean_cosine(receiver, mean.xyz, cone));
}

// Of light whose directions have this mean and lie within the cone about `cone.xyz` of the cosine
// `cone.w`; 0 only if all of them are below the horizon.
fn light_mean_cosine(receiver: LightReceiver, mean: vec3<f32>, cone: vec4<f32>) -> f32 {
    if receiver.kind == LIGHT_MEDIUM || receiver.kind == LIGHT_SEGMENT {
        return 1.0;
    }
    let height = dot(receiver.n, mean);
    let variance = max(0.0, 1.0 - dot(mean, mean));
    if receiver.kind == LIGHT_TWO_SIDED {
        return max(max(abs(height), 0.5 * sqrt(variance)), LIGHT_HORIZON_SLACK);
    }
    let sin = sqrt(max(0.0, (1.0 - cone.w) * (1.0 + cone.w)));
    if cone.w >= 0.0 && dot(receiver.n, cone.xyz) + sin < -LIGHT_HORIZON_SLACK {
        return 0.0;
    }
    let expected = 0.5 * (height + sqrt(height * height + 0.25 * variance));
    return max(expected, LIGHT_HORIZON_SLACK);
}

fn light_in_unit(weight: f32, unit: f32) -> f32 {
    return select(0.0, max(weight * unit, LIGHT_MIN), weight > 0.0);
}

fn light_infinite_id(sampler: LightSampler, index: u32) -> u32 {
    return light_row(sampler.infinite + 3u * index + 2u).x;
}
