// The numbers of the Rust crates: light-bvh, light-samplers, light-bounds,
// light-math (warp), light-sources (shape, environment maps), and the kinds of rows.
// Generated.

const LIGHT_BENT: f32 = 0.1894306;
const LIGHT_BESIDE: f32 = 4.0;
const LIGHT_BOX_EMISSION: f32 = 297.0;
const LIGHT_CUT_THRESHOLD: f32 = 0.08;
const LIGHT_DISTANCE: f32 = 0.09;
const LIGHT_DOUBT: f32 = 0.2;
const LIGHT_FAINT_POWER: f32 = 168.0;
const LIGHT_FAR: f32 = 1e36;
const LIGHT_GLOSSY_DISTANCE: f32 = 0.03;
const LIGHT_GROUP_BY_POSITION: f32 = 400.0;
const LIGHT_HEIGHT: f32 = 0.43;
const LIGHT_LEAST_SHARE: f32 = 0.0009765625;
const LIGHT_LEAST_SPREAD: f32 = 0.51961523;
const LIGHT_LEAST_TOTAL: f32 = 1e-10;
const LIGHT_MAX_REVISION: f32 = 16.0;
const LIGHT_MAX_STEP_REVISION: f32 = 2.0;
const LIGHT_MAX_STEP_RISE: f32 = 4.0;
const LIGHT_MAX_ZOOM: f32 = 1073741800.0;
const LIGHT_MIN_ALPHA: f32 = 0.01;
const LIGHT_MIN_COS: f32 = 0.001;
const LIGHT_MIN_DIFFUSE: f32 = 0.02;
const LIGHT_MIN_HALF_SQ: f32 = 1e-5;
const LIGHT_MORE_ODDS: f32 = 4.0;
const LIGHT_MOST: f32 = 0.9375;
const LIGHT_NEAREST: f32 = 1e-8;
const LIGHT_NEARNESS: f32 = 0.2;
const LIGHT_NEAR_SHARE: f32 = 0.125;
const LIGHT_NEAR_SMALL: f32 = 16.0;
const LIGHT_ODDS: f32 = 8.0;
const LIGHT_PLACES: f32 = 4.0;
const LIGHT_RAMP_BY_POSITION: f32 = 11.0;
const LIGHT_ROUND_OFF: f32 = 1e-5;
const LIGHT_SHEET_CORRELATION: f32 = 0.325;
const LIGHT_SHEET_NEARER: f32 = 0.3;
const LIGHT_SHEET_THICKNESS: f32 = 0.05;
const LIGHT_SMALL_EXTENT: f32 = 15.0;
const LIGHT_STEP_EDGE: f32 = 4.87;
const LIGHT_UNIT: f32 = 127.25;
const LIGHT_WIDENING: f32 = 0.375;
const LIGHT_HORIZON_SLACK: f32 = 1e-5;
const LIGHT_COS_SLACK: f32 = 2e-6;
const LIGHT_EDGE_SLACK: f32 = 1.7e-5;
const LIGHT_SIN_GROWTH: f32 = 1.0000004;
const LIGHT_CODE_ERROR: f32 = 6.9e-5;
const LIGHT_NEGLIGIBLE: f32 = 1e-20;
const LIGHT_NEWTON_PRECISION: f32 = 1e-6;
const LIGHT_NEWTON_REACH: f32 = 0.25;
const LIGHT_CLOSE: f32 = 0.001;
const LIGHT_DIRECTION_ERROR: f32 = 4.7683716e-7;
const LIGHT_EDGE_ERROR: f32 = 9.536743e-7;
const LIGHT_GRAZING: f32 = 0.001;
const LIGHT_HIT_ERROR: f32 = 4.7683716e-7;
const LIGHT_LEAST_COSINE: f32 = 0.01;
const LIGHT_LEAST_DENSITY: f32 = 0.15915494;
const LIGHT_OWN_ERROR: f32 = 9.536743e-7;
const LIGHT_PARALLEL: f32 = 0.001;
const LIGHT_SMALL_BOUND: f32 = 0.00059400004;
const LIGHT_SMALL_SOLID_ANGLE: f32 = 0.0003;
const LIGHT_SPHERE_ERROR: f32 = 4.7683716e-7;
const LIGHT_WIDEST_SLACK: f32 = 0.5;
const LIGHT_FIRST_INSET: f32 = 0.999;
const LIGHT_FIRST_NUDGE: f32 = 2e-7;
const LIGHT_SECOND_INSET: f32 = 0.97;
const LIGHT_SECOND_NUDGE: f32 = 6e-7;
const LIGHT_THIRD_INSET: f32 = 0.5;
const LIGHT_THIRD_NUDGE: f32 = 2e-6;
const LIGHT_KIND_POINT: u32 = 1u;
const LIGHT_KIND_SPOT: u32 = 2u;
const LIGHT_KIND_DISTANT: u32 = 3u;
const LIGHT_KIND_UNIFORM: u32 = 4u;
const LIGHT_KIND_TRIANGLE: u32 = 5u;
const LIGHT_KIND_RECTANGLE: u32 = 6u;
const LIGHT_KIND_SPHERE: u32 = 7u;
const LIGHT_KIND_LAT_LONG: u32 = 8u;
const LIGHT_KIND_EQUAL_AREA: u32 = 9u;
const LIGHT_SIDES_FRONT: u32 = 1u;
const LIGHT_SIDES_BACK: u32 = 2u;
const LIGHT_CUT_NODES: u32 = 24u;

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

// The fraction at the relative position u in the part `i` of `count` equal ones; count is at most
// 65536.
fn light_fraction_stratum(i: u32, count: u32, u: vec2<u32>) -> vec2<u32> {
    return light_fraction_divide(i, u, count);
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

// Whether it is a point of a surface.
fn light_has_normal(receiver: LightReceiver) -> bool {
    return receiver.kind <= LIGHT_GLOSSY;
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
    // Whether a child may be a thin sheet, or a group of opposed beams.
    has_rare: bool,
    // Whether codes of the node describe a subtree coarsely.
    has_rough: bool,
    // Whether the lights lie along a line.
    is_line: bool,
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
    // Whether the lights lie in a thin sheet, and how positions along the axes are correlated:
    // x and y, y and z, z and x. Set only where the node has rare children.
    sheet: vec4<bool>,
    correlation_xy: vec4<f32>,
    correlation_yz: vec4<f32>,
    correlation_zx: vec4<f32>,
    // Whether the beams of a group go both ways along the axis. Set only there, too.
    opposed: vec4<bool>,
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
    node.count = (links.z >> 24u) & 0x7fu;
    node.is_line = (links.z >> 31u) == 1u;
    node.parent = links.w;
    // The two top bits of the gain are flags.
    node.gain = bitcast<f32>((links.z & 0x3fffu) << 16u);
    node.has_rare = (links.z & 0x8000u) != 0u;
    node.has_rough = (links.z & 0x4000u) != 0u;
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
    if (*node).has_rare {
        let code = light_bytes_as_u32((*node).rows[9][word]);
        c.opposed = c.soft & c.step & ((code & vec4<u32>(1u)) != vec4<u32>(0u));
        c.sheet = c.soft & !c.step & (c.offset > vec4<f32>(0.0));
        let steps = code - vec4<u32>(1u);
        c.correlation_xy = LIGHT_SHEET_CORRELATION * (vec4<f32>(steps / 25u) - 2.0);
        c.correlation_yz = LIGHT_SHEET_CORRELATION * (vec4<f32>(steps / 5u % 5u) - 2.0);
        c.correlation_zx = LIGHT_SHEET_CORRELATION * (vec4<f32>(steps % 5u) - 2.0);
        c.offset = select(c.offset, vec4<f32>(0.0), c.sheet);
    }
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
    let half = light_half_height(receiver, c);
    let reaches = light_may_reach(c);
    if receiver.kind == LIGHT_TWO_SIDED {
        let height = 2.0 * max(c.slack, half.root);
        return select(vec4<f32>(0.0), light_emitted(c, height, vec4<f32>(0.0)), reaches);
    }
    let height = max(c.slack, half.mean + half.root);
    // Of a group that straddles the horizon, what is above it lies higher than the mean.
    let along = c.axis_x * receiver.n.x + c.axis_y * receiver.n.y + c.axis_z * receiver.n.z;
    let raised = max(vec4<f32>(0.0), half.support - half.mean) * along;
    let lift = select(vec4<f32>(0.0), raised, c.soft & !c.step);
    var weight = light_emitted(c, height, lift);
    if any(c.sheet) {
        weight = select(weight, light_sheet_emitted(c, receiver.n, height), c.sheet);
    }
    if receiver.kind == LIGHT_GLOSSY {
        weight *= light_reflected(receiver, c, height);
    }
    let is_above = half.mean + half.support > -c.slack;
    return select(vec4<f32>(0.0), weight, is_above & reaches);
}

// What children that are thin sheets emit: of their lights those above the horizon count.
fn light_sheet_emitted(c: LightChildren, n: vec3<f32>, height: vec4<f32>) -> vec4<f32> {
    let tx = n.x * c.extent_x;
    let ty = n.y * c.extent_y;
    let tz = n.z * c.extent_z;
    // Three times the covariance of height and position, and the variance of height.
    let ux = c.extent_x * (tx + c.correlation_xy * ty + c.correlation_zx * tz);
    let uy = c.extent_y * (ty + c.correlation_xy * tx + c.correlation_yz * tz);
    let uz = c.extent_z * (tz + c.correlation_zx * tx + c.correlation_yz * ty);
    let of_box = tx * tx + ty * ty + tz * tz;
    let least = max(vec4<f32>(1e-37), LIGHT_SHEET_THICKNESS * of_box);
    let variance = max(least, n.x * ux + n.y * uy + n.z * uz);
    let mean = n.x * c.mean_x + n.y * c.mean_y + n.z * c.mean_z;
    let raised = max(vec4<f32>(0.0), 0.5 * (sqrt(variance) - mean)) / variance;
    let lift = raised * (c.axis_x * ux + c.axis_y * uy + c.axis_z * uz);
    let sx = LIGHT_SHEET_NEARER * raised * ux;
    let sy = LIGHT_SHEET_NEARER * raised * uy;
    let sz = LIGHT_SHEET_NEARER * raised * uz;
    let farther = sx * (2.0 * c.mean_x + sx) + sy * (2.0 * c.mean_y + sy)
        + sz * (2.0 * c.mean_z + sz);
    var seen = c;
    seen.dist_sq = max(c.dist_sq + farther, LIGHT_SHEET_THICKNESS * c.dist_sq);
    seen.dist = sqrt(seen.dist_sq);
    return light_emitted(seen, height, lift);
}

// Whether any light of the child may emit toward the receiver.
fn light_may_reach(c: LightChildren) -> vec4<bool> {
    let edge = (LIGHT_STEP_EDGE * c.spread) * c.dist;
    let is_within = light_emission_beyond(c) < LIGHT_BOX_EMISSION * light_width(c) + edge;
    return is_within | c.soft | c.both_sides;
}

// What the children emit to a point over whose horizon they are at `height`.
fn light_emitted(c: LightChildren, height: vec4<f32>, lift: vec4<f32>) -> vec4<f32> {
    let beyond = light_emission_beyond(c) + lift;
    let width = light_width(c);
    let width_sq = width * width;
    let variance = light_emission_variance(c, width_sq);
    let root = sqrt(beyond * beyond + variance);
    // root - beyond, which a driver's rounding must not make 0.
    let one_side = select(root - beyond, variance / (root + abs(beyond)), beyond > vec4<f32>(0.0));
    let emitted = select(one_side, root, c.both_sides);
    let scale = select(vec4<f32>(1.0), LIGHT_UNIT * c.dist / root, c.step);
    let inv_dist_sq = 1.0 / c.dist_sq;
    let near = 1.0 + LIGHT_NEARNESS * (width_sq * inv_dist_sq);
    return (((c.power * inv_dist_sq) * (height * inv_dist_sq)) * near) * (emitted * scale);
}

// Whether the weight of a child may be off by more than LIGHT_DOUBT of the weights of the node, of
// which it has `share`: of a step by one standard deviation, of a ramp by its squared angular size.
fn light_is_doubtful(c: LightChildren, share: vec4<f32>) -> vec4<bool> {
    let beyond = light_emission_beyond(c);
    let width = light_width(c);
    let width_sq = width * width;
    let root = sqrt(beyond * beyond + light_emission_variance(c, width_sq));
    let doubt = select(width_sq, share * (root + beyond), c.step);
    let unit = select(c.dist_sq, LIGHT_DOUBT * (root - beyond), c.step);
    return share * doubt > LIGHT_DOUBT * unit;
}

// Whether the receiver is nearer to the boxes of the children than half of their width.
fn light_is_beside(c: LightChildren) -> vec4<bool> {
    let x = max(vec4<f32>(0.0), abs(c.mean_x) - c.extent_x);
    let y = max(vec4<f32>(0.0), abs(c.mean_y) - c.extent_y);
    let z = max(vec4<f32>(0.0), abs(c.mean_z) - c.extent_z);
    let width = light_width(c);
    return width * width > LIGHT_BESIDE * (x * x + y * y + z * z);
}

// How likely it is that light of the children reaches the receiver at all: that its lights emit
// toward it, and are above its horizon.
fn light_likelihood(receiver: LightReceiver, c: LightChildren) -> vec4<f32> {
    let beyond = light_emission_beyond(c);
    let width = light_width(c);
    let root = sqrt(beyond * beyond + light_emission_variance(c, width * width));
    let emitted = select(0.5 - 0.5 * beyond / root, vec4<f32>(1.0), c.both_sides);
    switch receiver.kind {
        case LIGHT_SEGMENT: {
            return vec4<f32>(1.0);
        }
        case LIGHT_MEDIUM, LIGHT_TWO_SIDED: {
            return emitted;
        }
        default: {
            let height = light_half_height(receiver, c);
            return emitted * (0.5 + 0.5 * height.mean / height.root);
        }
    }
}

// By how much the mean emission misses the receiver, times the distance.
fn light_emission_beyond(c: LightChildren) -> vec4<f32> {
    let along = c.axis_x * c.mean_x + c.axis_y * c.mean_y + c.axis_z * c.mean_z;
    // Opposed beams emit both ways.
    return select(along, -abs(along), c.opposed) + c.offset * c.dist;
}

// The variance of that.
fn light_emission_variance(c: LightChildren, width_sq: vec4<f32>) -> vec4<f32> {
    let cap = (0.25 * LIGHT_UNIT) * (LIGHT_UNIT - c.offset);
    let ramp = select(
        vec4<f32>(LIGHT_RAMP_BY_POSITION),
        vec4<f32>(LIGHT_GROUP_BY_POSITION),
        c.soft,
    );
    return select(ramp, cap, c.step) * width_sq + (c.spread * c.spread) * c.dist_sq;
}

// Half of the mean height over the horizon, half of what the box adds to it, and the root of the
// mean square of half of the height.
struct LightHeight {
    mean: vec4<f32>,
    support: vec4<f32>,
    root: vec4<f32>,
}

fn light_half_height(receiver: LightReceiver, c: LightChildren) -> LightHeight {
    let n = 0.5 * receiver.n;
    let mean = n.x * c.mean_x + n.y * c.mean_y + n.z * c.mean_z;
    let support_x = abs(n.x) * c.extent_x;
    let support_y = abs(n.y) * c.extent_y;
    let support_z = abs(n.z) * c.extent_z;
    let support = support_x + support_y + support_z;
    let squares = support_x * support_x + support_y * support_y + support_z * support_z;
    return LightHeight(mean, support, sqrt(mean * mean + LIGHT_HEIGHT * squares));
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
    // Squared width over squared distance of each child; 0 where it is seen from afar.
    angular_size_sq: array<vec4<f32>, 4>,
    total: f32,
    // One over the unit of length that they are in.
    inv_unit: f32,
}

// A child of a node, how many parts of 2^16 it has, and what is left of the random number. It has
// no parts where no child can contribute.
struct LightChild {
    child: u32,
    parts: u32,
    u: vec2<u32>,
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
    return light_tree_descend(tree, receiver, 0u, 1.0, u);
}

// From a node, which was reached with the probability `pmf`, down to a light.
fn light_tree_descend(
    tree: LightTree,
    receiver: LightReceiver,
    from_node: u32,
    from_pmf: f32,
    u: vec2<u32>,
) -> SampledLight {
    let none = SampledLight(0u, 0.0, u);
    var index = from_node;
    var pmf = from_pmf;
    var rest = u;
    for (var level = 0u; level < LIGHT_MAX_DEPTH && index < tree.node_count; level++) {
        var node = light_node(tree.nodes + 14u * index);
        let chosen = light_choose(light_parts(light_resolved_weights(tree, &node, receiver)), rest);
        if chosen.parts == 0u {
            return none;
        }
        pmf = light_positive_product(pmf, f32(chosen.parts) * (1.0 / 65536.0));
        rest = chosen.u;
        if chosen.child >= node.inner {
            let entry = node.light_base + chosen.child - node.inner;
            return SampledLight(light_entry(tree.order, entry), pmf, rest);
        }
        index = node.child_base + chosen.child;
    }
    return none;
}

// The child that the random number falls on.
fn light_choose(parts: LightParts, u: vec2<u32>) -> LightChild {
    var all = parts;
    var place = u.x >> 16u;
    var child = 16u;
    var chosen = 0u;
    for (var k = 0u; k < 16u; k++) {
        let own = all.lanes[k >> 2u][k & 3u];
        if child == 16u && place < own {
            child = k;
            chosen = own;
        }
        place -= select(0u, own, child == 16u);
    }
    if child == 16u {
        return LightChild(0u, 0u, u);
    }
    let rest = light_fraction_divide(place, light_fraction_after_16_bits(u), chosen);
    return LightChild(child, chosen, rest);
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
        var parts = light_parts(light_resolved_weights(tree, &node, receiver));
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
    let weights = light_resolved_weights(tree, &node, receiver);
    return light_irradiance(weights.total, weights.inv_unit, node.gain);
}

// The irradiance that a sum of weights means, in whose unit of length `inv_unit` is one, times
// `gain`.
fn light_irradiance(total: f32, inv_unit: f32, gain: f32) -> f32 {
    if !(total > 0.0) {
        return 0.0;
    }
    // Intensities are counted twice.
    let irradiance = (0.5 * total * inv_unit) * (gain * inv_unit);
    return clamp(irradiance, LIGHT_MIN, LIGHT_MAX);
}

// The parts of 2^16 of each child: at least one where it can contribute, none elsewhere. They sum
// to 2^16, because the first one takes what is left over, or to 0.
fn light_parts(weights: LightWeights) -> LightParts {
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

// The weights of the children of a node.
fn light_resolved_weights(
    tree: LightTree,
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
) -> LightWeights {
    return light_capped(tree, node, receiver, light_weights_ahead(tree, node, receiver));
}

// The same where a child that has most of them leaves some of the choices to the others, if it is
// uncertain whether its light reaches the receiver.
fn light_capped(
    tree: LightTree,
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
    weights: LightWeights,
) -> LightWeights {
    let k = light_child_above(weights, LIGHT_MOST * weights.total);
    if k == 16u {
        return weights;
    }
    let weight = weights.lanes[k >> 2u][k & 3u];
    var capped = weights;
    capped.lanes[k >> 2u][k & 3u] = 0.0;
    let rest = light_total(capped.lanes);
    capped.lanes[k >> 2u][k & 3u] = light_cap(tree, node, receiver, k, weight, rest);
    capped.total = light_total(capped.lanes);
    return capped;
}

// The first child whose weight is above `limit`, or 16.
fn light_child_above(weights: LightWeights, limit: f32) -> u32 {
    var k = 0u;
    while k < 16u && !(weights.lanes[k >> 2u][k & 3u] > limit) {
        k++;
    }
    return k;
}

// What child k counts for if the weights of all others are `rest` together: at most its largest
// odds allow.
fn light_cap(
    tree: LightTree,
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
    k: u32,
    weight: f32,
    rest: f32,
) -> f32 {
    if k < (*node).inner && !light_has_lights(tree, (*node).child_base + k) {
        return weight;
    }
    let lane = k & 3u;
    let children = light_children(node, light_frame_in_codes(*node, receiver.p), k >> 2u);
    let likelihood = light_likelihood(receiver, children)[lane];
    if !(likelihood < 1.0) {
        return weight;
    }
    let of_group = select(1.0, LIGHT_MORE_ODDS, children.soft[lane]);
    let of_step = select(1.0, LIGHT_MORE_ODDS, children.step[lane]);
    let odds = LIGHT_ODDS * of_group * of_step;
    let cap = rest * (odds * sqrt(likelihood / (1.0 - likelihood)));
    return select(weight, cap, cap > 0.0 && cap < weight);
}

// Whether a node holds single lights.
fn light_has_lights(tree: LightTree, index: u32) -> bool {
    return index < tree.node_count && light_node(tree.nodes + 14u * index).inner < 16u;
}

// The weights of the children of a node. A subtree that is small in codes of the node, and near,
// counts by the weights of its own children; if it has several, it has at least its near share. A
// subtree of lights that emit in steps, at the edge of which the receiver is, a large one that is
// near, and lights along a line that the receiver is beside count by their own children too.
fn light_weights_ahead(
    tree: LightTree,
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
) -> LightWeights {
    var weights = light_trusted_weights(node, receiver);
    if !(*node).has_rough {
        return weights;
    }
    let doubtful = light_doubtful_children(node, receiver, weights);
    let reach = LIGHT_NEAR_SMALL / (*node).inv_scale + light_reach(receiver);
    var groups = 0u;
    for (var k = 0u; k < (*node).inner; k++) {
        let word = k >> 2u;
        let lane = k & 3u;
        let index = (*node).child_base + k;
        let is_small = light_is_small(node, word, lane);
        let is_doubtful = ((doubtful >> k) & 1u) == 1u;
        let is_beside = ((doubtful >> (16u + k)) & 1u) == 1u;
        let has_weight = weights.lanes[word][lane] > 0.0 && index < tree.node_count;
        if (is_small || is_doubtful || is_beside) && has_weight {
            var child = light_node(tree.nodes + 14u * index);
            let away = child.origin - receiver.p;
            let near = reach + 255.0 / child.inv_scale;
            let is_near = is_small && dot(away, away) < near * near;
            let is_step_or_large = light_is_step(node, word, lane) || child.inner == 16u;
            let is_rough = is_doubtful && is_step_or_large;
            if is_near || is_rough || (is_beside && child.is_line) {
                let own = light_weights_of_lines(tree, &child, receiver);
                let scale = light_weight_scale(own, weights.inv_unit, child.gain / (*node).gain);
                let weight = light_positive_product(own.total, scale);
                weights.lanes[word][lane] = min(weight, LIGHT_MAX / 16.0);
                let is_group = is_near && child.count > 1u && weight > 0.0;
                groups |= select(0u, 1u << k, is_group);
            }
        }
    }
    let least = min(light_total(weights.lanes) * LIGHT_NEAR_SHARE, LIGHT_MAX / 16.0);
    for (var word = 0u; word < 4u; word++) {
        let is_group = (vec4<u32>(groups >> (4u * word)) & vec4<u32>(1u, 2u, 4u, 8u)) != vec4<u32>(0u);
        let lanes = weights.lanes[word];
        weights.lanes[word] = select(lanes, max(lanes, vec4<f32>(least)), is_group);
    }
    return light_with_least_share(weights);
}

// The weights of the children of a node. If its lights lie along a line, so do those of a child that
// the receiver is beside, and it counts by the weights of its own children.
fn light_weights_of_lines(
    tree: LightTree,
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
) -> LightWeights {
    var weights = light_trusted_weights(node, receiver);
    if !(*node).is_line || !(*node).has_rough {
        return weights;
    }
    let doubtful = light_doubtful_children(node, receiver, weights);
    for (var k = 0u; k < (*node).inner; k++) {
        let word = k >> 2u;
        let lane = k & 3u;
        let index = (*node).child_base + k;
        let is_beside = ((doubtful >> (16u + k)) & 1u) == 1u;
        if is_beside && weights.lanes[word][lane] > 0.0 && index < tree.node_count {
            var child = light_node(tree.nodes + 14u * index);
            if child.is_line {
                let own = light_trusted_weights(&child, receiver);
                let scale = light_weight_scale(own, weights.inv_unit, child.gain / (*node).gain);
                let weight = light_positive_product(own.total, scale);
                weights.lanes[word][lane] = min(weight, LIGHT_MAX / 16.0);
            }
        }
    }
    return light_with_least_share(weights);
}

// The children whose weights are doubtful, a bit each, and above these those that the receiver is
// beside.
fn light_doubtful_children(
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
    weights: LightWeights,
) -> u32 {
    let frame = light_frame_in_codes(*node, receiver.p);
    let inv_total = 1.0 / max(weights.total, LIGHT_MIN);
    var doubtful = 0u;
    for (var word = 0u; 4u * word < (*node).inner; word++) {
        let children = light_children(node, frame, word);
        let is_doubtful = light_is_doubtful(children, weights.lanes[word] * inv_total);
        let is_beside = light_is_beside(children);
        let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), is_doubtful)
            | select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u) << vec4<u32>(16u), is_beside);
        doubtful |= (bits.x | bits.y | bits.z | bits.w) << (4u * word);
    }
    return doubtful;
}

// Whether a light of a child emits in a step.
fn light_is_step(node: ptr<function, LightNode>, word: u32, lane: u32) -> bool {
    return (((*node).rows[10][word] >> (8u * lane)) & 0x80u) != 0u;
}

// Whether a light of any child emits in a step.
fn light_has_steps(node: ptr<function, LightNode>) -> bool {
    return any(((*node).rows[10] & vec4<u32>(0x80808080u)) != vec4<u32>(0u));
}

// Whether a child that is a node is small in codes of this one.
fn light_is_small(node: ptr<function, LightNode>, word: u32, lane: u32) -> bool {
    let extents = (*node).rows[3][word] | (*node).rows[4][word] | (*node).rows[5][word];
    let extent = (extents >> (8u * lane)) & 0xffu;
    let power = ((*node).rows[11][word] >> (8u * lane)) & 0xffu;
    // No extent is 0.
    return extent == 1u
        || (extent <= u32(LIGHT_SMALL_EXTENT) && power <= u32(LIGHT_FAINT_POWER));
}

// The factor that makes weights, of a node whose largest power is `gain`, those of one where it is 1
// and one over the unit of length is `inv_unit`. Where distances differ by more than LIGHT_MAX_ZOOM,
// weights lose their proportion and keep their sign.
fn light_weight_scale(weights: LightWeights, inv_unit: f32, gain: f32) -> f32 {
    let zoom = min(weights.inv_unit / inv_unit, LIGHT_MAX_ZOOM);
    return max(gain * zoom * zoom, LIGHT_MIN);
}

// In codes of the node, or in a unit in which none of them vanishes.
fn light_trusted_weights(node: ptr<function, LightNode>, receiver: LightReceiver) -> LightWeights {
    let weights = light_weights(node, receiver, light_frame_in_codes(*node, receiver.p));
    if weights.total >= LIGHT_LEAST_TOTAL && weights.total <= LIGHT_MAX {
        return weights;
    }
    let frame = light_frame_from_afar(*node, receiver.p, light_reach(receiver));
    var from_afar = light_weights(node, receiver, frame);
    from_afar.angular_size_sq = array<vec4<f32>, 4>();
    return from_afar;
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
        let width = light_width(children);
        weights.angular_size_sq[word] = width * width * (1.0 / children.dist_sq);
    }
    weights.inv_unit = frame.inv_unit;
    return light_with_least_share(weights);
}

// The same where each child that can contribute has its least share of the sum of all.
fn light_with_least_share(weights: LightWeights) -> LightWeights {
    var raised = weights;
    let least = vec4<f32>(light_total(weights.lanes) * LIGHT_LEAST_SHARE);
    for (var word = 0u; word < 4u; word++) {
        let lanes = weights.lanes[word];
        raised.lanes[word] = select(vec4<f32>(0.0), max(lanes, least), lanes > vec4<f32>(0.0));
    }
    raised.total = light_total(raised.lanes);
    return raised;
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

// Several choices at one receiver, from a cut through the tree: LightCut of light-bvh.

// The nodes of a cut, breadth first. Weights are not kept: a choice computes those of its node
// again, for memory of a thread is scarcer than time.
struct LightCut {
    tree: LightTree,
    receiver: LightReceiver,
    nodes: array<u32, LIGHT_CUT_NODES>,
    // A bit for each child that is a node of the cut itself.
    opened: array<u32, LIGHT_CUT_NODES>,
    // Where the parts of 2^16 of each node end.
    ends: array<u32, LIGHT_CUT_NODES>,
    count: u32,
    // Of all weights.
    sum: f32,
    // A child that has most of them, and by what its weight is multiplied: 16 times the place of its
    // node, and which of its children.
    capped: u32,
    cap: f32,
    // One over the root's unit of length.
    inv_unit: f32,
}

// The cut for several choices at a receiver: groups whose estimate is rough are opened.
fn light_tree_cut(tree: LightTree, receiver: LightReceiver) -> LightCut {
    var cut: LightCut;
    cut.tree = tree;
    cut.receiver = receiver;
    cut.inv_unit = 1.0;
    cut.capped = LIGHT_NOWHERE;
    var totals: array<f32, LIGHT_CUT_NODES>;
    var count = select(0u, 1u, tree.node_count > 0u);
    var root_total = 0.0;
    // Breadth first: the cap, if it is reached, cuts all branches at the same depth.
    for (var index = 0u; index < count; index++) {
        var node = light_node(tree.nodes + 14u * cut.nodes[index]);
        var weights = light_cut_own_weights(tree, &node, receiver);
        if index == 0u {
            cut.inv_unit = weights.inv_unit;
        }
        weights = light_cut_scaled(weights, node.gain, cut.inv_unit);
        if index == 0u {
            root_total = light_total(weights.lanes);
        } else {
            weights = light_cut_revised(weights, totals[index], root_total, light_has_steps(&node));
        }
        var opened = 0u;
        for (var k = 0u; k < node.inner; k++) {
            let rough = weights.lanes[k >> 2u][k & 3u] * weights.angular_size_sq[k >> 2u][k & 3u];
            opened |= select(0u, 1u << k, rough > LIGHT_CUT_THRESHOLD * root_total);
        }
        // A node whose children do not all fit opens none.
        if count + countOneBits(opened) > LIGHT_CUT_NODES {
            opened = 0u;
        }
        for (var left = opened; left != 0u; left &= left - 1u) {
            let k = firstTrailingBit(left);
            cut.nodes[count] = node.child_base + k;
            // What each is estimated at, until its own weights are known.
            totals[count] = weights.lanes[k >> 2u][k & 3u];
            count++;
        }
        cut.opened[index] = opened;
        totals[index] = light_total(light_cut_unopened(weights, opened).lanes);
        cut.sum += totals[index];
    }
    cut.count = count;
    light_cut_cap(&cut, &totals);
    let scale = min((65536.0 - f32(LIGHT_CUT_NODES)) / cut.sum, LIGHT_MAX);
    var left_over = 65536u;
    for (var index = 0u; index < count; index++) {
        cut.ends[index] = select(0u, 1u + u32(totals[index] * scale), totals[index] > 0.0);
        left_over -= cut.ends[index];
    }
    // What is left over goes to the first with any weight.
    var end = 0u;
    for (var index = 0u; index < count; index++) {
        let has_weight = cut.ends[index] > 0u;
        end += cut.ends[index] + select(0u, left_over, has_weight);
        left_over = select(left_over, 0u, has_weight);
        cut.ends[index] = end;
    }
    return cut;
}

// Leaves some of the choices to the others where one child has most of the weights of the cut, and it
// is uncertain whether its light reaches the receiver.
fn light_cut_cap(
    cut: ptr<function, LightCut>,
    totals: ptr<function, array<f32, LIGHT_CUT_NODES>>,
) {
    let most = LIGHT_MOST * (*cut).sum;
    var index = 0u;
    while index < (*cut).count && !((*totals)[index] > most) {
        index++;
    }
    if index == (*cut).count {
        return;
    }
    let tree = (*cut).tree;
    var node = light_node(tree.nodes + 14u * (*cut).nodes[index]);
    var weights = light_cut_weights(cut, &node, index);
    // What its weights count for in the cut.
    let revision = (*totals)[index] / weights.total;
    let k = light_child_above(weights, most / revision);
    if k == 16u {
        return;
    }
    let weight = weights.lanes[k >> 2u][k & 3u] * revision;
    weights.lanes[k >> 2u][k & 3u] = 0.0;
    let in_node = light_total(weights.lanes) * revision;
    var rest = in_node;
    for (var other = 0u; other < (*cut).count; other++) {
        rest += select((*totals)[other], 0.0, other == index);
    }
    let capped = light_cap(tree, &node, (*cut).receiver, k, weight, rest);
    if capped < weight {
        (*cut).capped = 16u * index + k;
        (*cut).cap = capped / weight;
        (*totals)[index] = in_node + capped;
        (*cut).sum = rest + capped;
    }
}

// A light. For several choices it takes light_fraction_stratum of each.
fn light_cut_sample(cut: ptr<function, LightCut>, u: vec2<u32>) -> SampledLight {
    let none = SampledLight(0u, 0.0, u);
    if !((*cut).sum > 0.0) {
        return none;
    }
    let place = u.x >> 16u;
    var index = 0u;
    while index < (*cut).count && (*cut).ends[index] <= place {
        index++;
    }
    if index == (*cut).count {
        return none;
    }
    let start = light_cut_start(cut, index);
    let parts = (*cut).ends[index] - start;
    let rest = light_fraction_divide(place - start, light_fraction_after_16_bits(u), parts);
    let tree = (*cut).tree;
    var node = light_node(tree.nodes + 14u * (*cut).nodes[index]);
    let chosen = light_choose(light_parts(light_cut_weights(cut, &node, index)), rest);
    if chosen.parts == 0u {
        return none;
    }
    let of_node = f32(parts) * (1.0 / 65536.0);
    let pmf = light_positive_product(of_node, f32(chosen.parts) * (1.0 / 65536.0));
    if chosen.child >= node.inner {
        let entry = node.light_base + chosen.child - node.inner;
        return SampledLight(light_entry(tree.order, entry), pmf, chosen.u);
    }
    let child = node.child_base + chosen.child;
    return light_tree_descend(tree, (*cut).receiver, child, pmf, chosen.u);
}

// The probability with which light_cut_sample returns `light`, with the same bits.
fn light_cut_pmf(cut: ptr<function, LightCut>, light: u32) -> f32 {
    let tree = (*cut).tree;
    if light >= tree.light_count {
        return 0.0;
    }
    var shares: array<f32, 24>;
    var levels = 0u;
    var pmf = 0.0;
    var slot = light_entry(tree.slots, light);
    while slot != LIGHT_NOWHERE && levels < LIGHT_MAX_DEPTH {
        let child = slot & 15u;
        var node = light_node(tree.nodes + 14u * (slot >> 4u));
        var index = 0u;
        while index < (*cut).count && (*cut).nodes[index] != slot >> 4u {
            index++;
        }
        if index < (*cut).count {
            var parts = light_parts(light_cut_weights(cut, &node, index));
            let of_node = (*cut).ends[index] - light_cut_start(cut, index);
            let within = f32(parts.lanes[child >> 2u][child & 3u]) * (1.0 / 65536.0);
            pmf = light_positive_product(f32(of_node) * (1.0 / 65536.0), within);
            break;
        }
        var parts = light_parts(light_resolved_weights(tree, &node, (*cut).receiver));
        shares[levels] = f32(parts.lanes[child >> 2u][child & 3u]) * (1.0 / 65536.0);
        levels++;
        slot = node.parent;
    }
    // Multiplied from the cut down, as a sample does it.
    while levels > 0u {
        levels--;
        pmf = light_positive_product(pmf, shares[levels]);
    }
    return pmf;
}

// About the irradiance by the lights of the tree, if all of them have power 1 together.
fn light_cut_irradiance(cut: ptr<function, LightCut>) -> f32 {
    return light_irradiance((*cut).sum, (*cut).inv_unit, 1.0);
}

// Where the parts of one of the nodes begin.
fn light_cut_start(cut: ptr<function, LightCut>, index: u32) -> u32 {
    return select(0u, (*cut).ends[max(index, 1u) - 1u], index > 0u);
}

// The weights of one of the nodes, without the children that are nodes of the cut themselves.
fn light_cut_weights(
    cut: ptr<function, LightCut>,
    node: ptr<function, LightNode>,
    index: u32,
) -> LightWeights {
    let weights = light_cut_own_weights((*cut).tree, node, (*cut).receiver);
    let scaled = light_cut_scaled(weights, (*node).gain, (*cut).inv_unit);
    var unopened = light_cut_unopened(scaled, (*cut).opened[index]);
    if (*cut).capped >> 4u == index {
        let k = (*cut).capped & 15u;
        let weight = unopened.lanes[k >> 2u][k & 3u];
        unopened.lanes[k >> 2u][k & 3u] = light_positive_product(weight, (*cut).cap);
        unopened.total = light_total(unopened.lanes);
    }
    return unopened;
}

// Weights of a node, in which children are capped where lights emit in steps.
fn light_cut_own_weights(
    tree: LightTree,
    node: ptr<function, LightNode>,
    receiver: LightReceiver,
) -> LightWeights {
    let weights = light_weights_ahead(tree, node, receiver);
    if !light_has_steps(node) {
        return weights;
    }
    return light_capped(tree, node, receiver, weights);
}

// Weights of a node in the root's unit.
fn light_cut_scaled(weights: LightWeights, gain: f32, inv_unit: f32) -> LightWeights {
    return light_cut_times(weights, light_weight_scale(weights, inv_unit, gain));
}

// Weights times a factor above 0: what is above 0 stays so.
fn light_cut_times(weights: LightWeights, factor: f32) -> LightWeights {
    var scaled = weights;
    for (var word = 0u; word < 4u; word++) {
        let lanes = weights.lanes[word];
        let some = max(lanes * factor, vec4<f32>(LIGHT_MIN));
        scaled.lanes[word] = select(vec4<f32>(0.0), some, lanes > vec4<f32>(0.0));
    }
    return scaled;
}

// Weights of an opened node, together within some times what the group was estimated at. Choices
// within the node do not need it: there only ratios count.
fn light_cut_revised(
    weights: LightWeights,
    expected: f32,
    root_total: f32,
    has_steps: bool,
) -> LightWeights {
    let ratio = min(expected / max(light_total(weights.lanes), LIGHT_MIN), LIGHT_MAX);
    let rise = 1.0 + LIGHT_MAX_STEP_RISE * (root_total / max(expected, LIGHT_MIN));
    let most = select(LIGHT_MAX_REVISION, min(rise, LIGHT_MAX_REVISION), has_steps);
    let less = select(LIGHT_MAX_REVISION, LIGHT_MAX_STEP_REVISION, has_steps);
    let revision = min(ratio * most, max(ratio / less, 1.0));
    return light_cut_times(weights, revision);
}

fn light_cut_unopened(weights: LightWeights, opened: u32) -> LightWeights {
    var some = weights;
    for (var word = 0u; word < 4u; word++) {
        let bits = (vec4<u32>(opened) >> (vec4<u32>(0u, 1u, 2u, 3u) + 4u * word)) & vec4<u32>(1u);
        some.lanes[word] = select(weights.lanes[word], vec4<f32>(0.0), bits == vec4<u32>(1u));
    }
    some.total = light_total(some.lanes);
    return some;
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
    let of_unit_power = light_tree_irradiance(sampler.tree, receiver);
    let first = light_first_sample(sampler, receiver, of_unit_power, u);
    if first.light != LIGHT_NOWHERE {
        return first;
    }
    var sampled = light_tree_sample(sampler.tree, receiver, first.u);
    sampled.pmf = light_positive_product(first.pmf, sampled.pmf);
    return sampled;
}

// The probability with which light_sampler_sample returns `light`, with the same bits.
fn light_sampler_pmf(sampler: LightSampler, receiver: LightReceiver, light: u32) -> f32 {
    if sampler.infinite_count == 0u {
        return light_tree_pmf(sampler.tree, receiver, light);
    }
    let index = light_first_index(sampler, light);
    let of_unit_power = light_tree_irradiance(sampler.tree, receiver);
    let pmf = light_first_pmf(sampler, receiver, of_unit_power, index);
    if index > 0u {
        return pmf;
    }
    return light_positive_product(pmf, light_tree_pmf(sampler.tree, receiver, light));
}

// What a sampler knows at a receiver for several choices there.
struct LightSamplerCut {
    sampler: LightSampler,
    cut: LightCut,
}

// A sampler at a receiver, for several choices: closer to the lights' contributions than single
// ones, with probabilities of its own.
fn light_sampler_cut(sampler: LightSampler, receiver: LightReceiver) -> LightSamplerCut {
    return LightSamplerCut(sampler, light_tree_cut(sampler.tree, receiver));
}

// A light. For several choices it takes light_fraction_stratum of each.
fn light_sampler_cut_sample(here: ptr<function, LightSamplerCut>, u: vec2<u32>) -> SampledLight {
    var cut = (*here).cut;
    if (*here).sampler.infinite_count == 0u {
        return light_cut_sample(&cut, u);
    }
    let of_unit_power = light_cut_irradiance(&cut);
    let first = light_first_sample((*here).sampler, cut.receiver, of_unit_power, u);
    if first.light != LIGHT_NOWHERE {
        return first;
    }
    var sampled = light_cut_sample(&cut, first.u);
    sampled.pmf = light_positive_product(first.pmf, sampled.pmf);
    return sampled;
}

// The probability with which light_sampler_cut_sample returns `light`, with the same bits.
fn light_sampler_cut_pmf(here: ptr<function, LightSamplerCut>, light: u32) -> f32 {
    var cut = (*here).cut;
    if (*here).sampler.infinite_count == 0u {
        return light_cut_pmf(&cut, light);
    }
    let index = light_first_index((*here).sampler, light);
    let of_unit_power = light_cut_irradiance(&cut);
    let pmf = light_first_pmf((*here).sampler, cut.receiver, of_unit_power, index);
    if index > 0u {
        return pmf;
    }
    return light_positive_product(pmf, light_cut_pmf(&cut, light));
}

// A light at infinity; or LIGHT_NOWHERE, which stands for the tree, with what is left of u; or the
// probability 0 where nothing has weight.
fn light_first_sample(
    sampler: LightSampler,
    receiver: LightReceiver,
    of_unit_power: f32,
    u: vec2<u32>,
) -> SampledLight {
    let share = light_share(sampler, receiver, of_unit_power, u.x >> 16u, LIGHT_NOWHERE);
    if share.parts == 0u {
        return SampledLight(0u, 0.0, u);
    }
    let pmf = f32(share.parts) * (1.0 / 65536.0);
    let rest = light_fraction_divide(share.place, light_fraction_after_16_bits(u), share.parts);
    if share.index > 0u {
        return SampledLight(light_infinite_id(sampler, share.index - 1u), pmf, rest);
    }
    return SampledLight(LIGHT_NOWHERE, pmf, rest);
}

// The probability of the first choice `index`.
fn light_first_pmf(
    sampler: LightSampler,
    receiver: LightReceiver,
    of_unit_power: f32,
    index: u32,
) -> f32 {
    let share = light_share(sampler, receiver, of_unit_power, 0u, index);
    return f32(share.parts) * (1.0 / 65536.0);
}

// 0 for a light of the tree, one more than its number for a light at infinity.
fn light_first_index(sampler: LightSampler, light: u32) -> u32 {
    var index = 0u;
    for (var i = 0u; i < sampler.infinite_count; i++) {
        index = select(index, i + 1u, light_infinite_id(sampler, i) == light);
    }
    return index;
}

// The share `wanted`, or that on which `at` falls, a place below 2^16, if `wanted` is
// LIGHT_NOWHERE. It has no parts where nothing has weight.
fn light_share(
    sampler: LightSampler,
    receiver: LightReceiver,
    of_unit_power: f32,
    at: u32,
    wanted: u32,
) -> LightShare {
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

// Points of shapes by random numbers in [0, 1)^2: the warps of light-math.

// 2^-k for x in [2^k, 2^(k+1)): a scale without any rounding.
fn light_inverse_power_of_two(x: f32) -> f32 {
    let exponent = bitcast<u32>(x) & 0x7f800000u;
    return max(bitcast<f32>(0x7f000000u - min(exponent, 0x7f000000u)), LIGHT_MIN);
}

// Cosine and sine of a part of a full turn.
fn light_azimuth(turn: f32) -> vec2<f32> {
    let angle = 6.2831853071795864 * turn;
    return vec2<f32>(cos(angle), sin(angle));
}

fn light_safe_sqrt(x: f32) -> f32 {
    return sqrt(max(x, 0.0));
}

// The angle whose sine and cosine are in proportion to these, from 0 on: to the last digit where
// it is small.
fn light_angle_of(sin: f32, cos: f32) -> f32 {
    if sin < 0.1 * cos {
        let x = sin / cos;
        let sq = x * x;
        return x * (1.0 - sq * (1.0 / 3.0 - sq * (1.0 / 5.0 - sq * (1.0 / 7.0))));
    }
    return atan2(sin, cos);
}

// A unit vector.
fn light_uniform_sphere(u: vec2<f32>) -> vec3<f32> {
    let z = 1.0 - 2.0 * u.x;
    return vec3<f32>(light_azimuth(u.y) * light_safe_sqrt(1.0 - z * z), z);
}

// Barycentric coordinates.
fn light_uniform_triangle(u: vec2<f32>) -> vec3<f32> {
    let half = 0.5 * u;
    let b = select(vec2<f32>(u.x - half.y, half.y), vec2<f32>(half.x, u.y - half.x), u.x < u.y);
    return vec3<f32>(b, 1.0 - b.x - b.y);
}

// x in [0, 1) in proportion to the line from a at 0 to b at 1.
fn light_linear_sample(u: f32, start: f32, end: f32) -> f32 {
    let largest = max(start, end);
    if !(largest > 0.0 && largest <= LIGHT_MAX) {
        return u;
    }
    let scale = light_inverse_power_of_two(largest);
    let a = start * scale;
    let b = end * scale;
    let x = u * (a + b) / (a + sqrt((1.0 - u) * (a * a) + u * (b * b)));
    return clamp(x, select(0x1p-24, 0.0, a > LIGHT_NEGLIGIBLE), 0x1.fffffep-1);
}

// The place of the unit square in proportion to what weights at its corners (0, 0), (1, 0),
// (0, 1), (1, 1) interpolate; all of them are between 0.01 and 1.
fn light_bilinear_sample(u: vec2<f32>, w: vec4<f32>) -> vec2<f32> {
    let y = light_linear_sample(u.y, w.x + w.y, w.z + w.w);
    let row = (1.0 - y) * w.xy + y * w.zw;
    return vec2<f32>(light_linear_sample(u.x, row.x, row.y), y);
}

// The density of that place.
fn light_bilinear_pdf(p: vec2<f32>, w: vec4<f32>) -> f32 {
    if any(p < vec2<f32>(0.0)) || any(p > vec2<f32>(1.0)) {
        return 0.0;
    }
    let row = (1.0 - p.y) * w.xy + p.y * w.zw;
    return 4.0 * ((1.0 - p.x) * row.x + p.x * row.y) / (w.x + w.y + w.z + w.w);
}

// Axes of which the third is the unit vector z.
fn light_frame(z: vec3<f32>) -> mat3x3<f32> {
    let sign = select(-1.0, 1.0, z.z >= 0.0);
    let a = -1.0 / (sign + z.z);
    let b = z.x * z.y * a;
    let x = vec3<f32>(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x);
    return mat3x3<f32>(x, vec3<f32>(b, sign + z.y * z.y * a, -z.y), z);
}

// Directions toward a picture of the sky: ImageInfiniteLight of light-sources.

// Where the parts of a picture begin, in rows.
struct LightEnvironment {
    // From light space to the scene.
    turn: mat3x3<f32>,
    // Columns and rows of the picture; none where it is black.
    size: vec2<u32>,
    is_lat_long: bool,
    // One row a texel: its radiance, and the density of its directions.
    texels: u32,
    // Words: where texels begin in their row, where rows begin, and edges of rows.
    columns: u32,
    rows: u32,
    caps: u32,
}

// A direction, its density per solid angle, and the radiance from there. There is none where pdf
// is 0.
struct LightEnvironmentSample {
    l: vec3<f32>,
    pdf: f32,
    wi: vec3<f32>,
}

// One of the parts of [0, 1], and the place in it.
struct LightBin {
    index: u32,
    place: f32,
}

// The picture whose rows begin in row `first`.
fn light_environment(
    first: u32,
    size: vec2<u32>,
    is_lat_long: bool,
    turn: mat3x3<f32>,
) -> LightEnvironment {
    let columns = first + size.x * size.y;
    let rows = columns + ((size.x * size.y + 3u) >> 2u);
    let caps = rows + ((size.y + 3u) >> 2u);
    return LightEnvironment(turn, size, is_lat_long, first, columns, rows, caps);
}

// A direction by u in [0, 1)^2, in proportion to the texels: u.y picks the row.
fn light_environment_sample(sky: LightEnvironment, u: vec2<f32>) -> LightEnvironmentSample {
    var sample: LightEnvironmentSample;
    if sky.size.x == 0u {
        return sample;
    }
    let row = light_bin(sky.rows, 0u, sky.size.y, u.y);
    let column = light_bin(sky.columns, row.index * sky.size.x, sky.size.x, u.x);
    let texel = vec2<u32>(column.index, row.index);
    let from_middle = vec2<f32>(column.place, row.place) - 0.5;
    // Rounding may move a direction beyond the edge of its texel. On the square of equal areas it
    // is moved by the least that suffices, then as in a lat-long map.
    var nudges = array<f32, 7>(
        0.0, LIGHT_FIRST_NUDGE, LIGHT_SECOND_NUDGE, LIGHT_THIRD_NUDGE, 0.0, 0.0, 0.0,
    );
    var insets = array<f32, 7>(
        1.0, 1.0, 1.0, 1.0, LIGHT_FIRST_INSET, LIGHT_SECOND_INSET, LIGHT_THIRD_INSET,
    );
    for (var i = 0u; i < 7u; i++) {
        if sky.is_lat_long && nudges[i] > 0.0 {
            continue;
        }
        let most = max(0.5 - nudges[i] * vec2<f32>(sky.size), vec2<f32>(0.0));
        let place = clamp(from_middle, -most, most) * insets[i];
        sample.wi = sky.turn * light_environment_direction(sky, texel, 0.5 + place);
        if all(light_environment_texel(sky, sample.wi) == texel) {
            break;
        }
    }
    let found = light_environment_row(sky, texel);
    sample.l = found.xyz;
    sample.pdf = found.w;
    return sample;
}

// The radiance from the direction wi, and its density.
fn light_environment_toward(sky: LightEnvironment, wi: vec3<f32>) -> LightEnvironmentSample {
    if sky.size.x == 0u {
        return LightEnvironmentSample(vec3<f32>(0.0), 0.0, wi);
    }
    let found = light_environment_row(sky, light_environment_texel(sky, wi));
    return LightEnvironmentSample(found.xyz, found.w, wi);
}

fn light_environment_row(sky: LightEnvironment, texel: vec2<u32>) -> vec4<f32> {
    return bitcast<vec4<f32>>(light_row(sky.texels + texel.y * sky.size.x + texel.x));
}

// Column and row of the texel that holds a direction of the scene.
fn light_environment_texel(sky: LightEnvironment, wi: vec3<f32>) -> vec2<u32> {
    // Of a rotation or a reflection the transposed matrix is the inverse.
    let w = wi * sky.turn;
    var p: vec2<f32>;
    if sky.is_lat_long {
        p = light_lat_long_point(w);
    } else {
        p = light_sphere_to_square(w);
    }
    let last = sky.size - 1u;
    return min(vec2<u32>(max(p * vec2<f32>(sky.size), vec2<f32>(0.0))), last);
}

// The direction, in light space, of a place in [0, 1]^2 of a texel.
fn light_environment_direction(
    sky: LightEnvironment,
    texel: vec2<u32>,
    place: vec2<f32>,
) -> vec3<f32> {
    if !sky.is_lat_long {
        return light_square_to_sphere((vec2<f32>(texel) + place) / vec2<f32>(sky.size));
    }
    // From the nearer pole, where the share of the sphere keeps its digits.
    let is_upper = texel.y < sky.size.y - texel.y;
    let row = select(sky.size.y - 1u - texel.y, texel.y, is_upper);
    let part = select(1.0 - place.y, place.y, is_upper);
    let near = light_number(sky.caps, row);
    let far = light_number(sky.caps, row + 1u);
    let share = near + part * (far - near);
    let sin_t = 2.0 * sqrt(share * (1.0 - share));
    let y = select(-1.0, 1.0, is_upper) * (1.0 - 2.0 * share);
    // From the middle of the map, where the angle is small.
    let azimuth = light_azimuth((f32(texel.x) + place.x) / f32(sky.size.x) - 0.5);
    return vec3<f32>(-sin_t * azimuth.y, y, sin_t * azimuth.x);
}

// The point in [0, 1]^2 of a direction: rows of latitude from +y down, whose middle looks to +z.
fn light_lat_long_point(d: vec3<f32>) -> vec2<f32> {
    let sin_t = length(d.xz);
    if sin_t == 0.0 {
        return vec2<f32>(0.0, select(0.0, 1.0, d.y < 0.0));
    }
    let u = 0.15915494309 * atan2(d.x, -d.z);
    return vec2<f32>(select(u, u + 1.0, u < 0.0), 0.31830988618 * atan2(sin_t, d.y));
}

// The last of `count` bins that begins at or below u, and where u lies between its ends. Their
// beginnings are entries, from `start` on, of the array in row `first`; the last one ends at 1.
fn light_bin(first: u32, start: u32, count: u32, u: f32) -> LightBin {
    let within = clamp(u, 0.0, 0x1.fffffep-1);
    var low = 0u;
    var high = count;
    while low < high {
        let middle = (low + high) >> 1u;
        if light_number(first, start + middle) <= within {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    let index = max(low, 1u) - 1u;
    let begin = light_number(first, start + index);
    var end = 1.0;
    if index + 1u < count {
        end = light_number(first, start + index + 1u);
    }
    return LightBin(index, (within - begin) / (end - begin));
}

// A number of an array that begins in row `first`.
fn light_number(first: u32, entry: u32) -> f32 {
    return bitcast<f32>(light_entry(first, entry));
}

// Bounds of lights in 24 bytes, and their importance: CompactLightBounds of light-bounds.

// Bounds of many lights, and the box that their codes are relative to.
struct LightCompactBounds {
    // The row of the first word, of six for each light.
    words: u32,
    count: u32,
    lower: vec3<f32>,
    upper: vec3<f32>,
}

// Where some lights are and where they emit to: LightBounds of light-bounds.
struct LightBounds {
    lower: vec3<f32>,
    upper: vec3<f32>,
    w: vec3<f32>,
    phi: f32,
    cos_theta_o: f32,
    cos_theta_e: f32,
    two_sided: bool,
}

// An angle by its sine (x) and cosine (y).
alias LightAngle = vec2<f32>;

// The bounds whose rows begin in row `first`: compact_bounds_rows of the crate makes them.
fn light_compact_bounds(first: u32) -> LightCompactBounds {
    let lower = light_row(first);
    let upper = light_row(first + 1u);
    return LightCompactBounds(
        first + 2u,
        lower.w,
        bitcast<vec3<f32>>(lower.xyz),
        bitcast<vec3<f32>>(upper.xyz),
    );
}

// The bounds of one of them; i is below their number.
fn light_compact_bounds_decode(all: LightCompactBounds, i: u32) -> LightBounds {
    var words: array<u32, 6>;
    for (var k = 0u; k < 6u; k++) {
        words[k] = light_entry(all.words, 6u * i + k);
    }
    let low = vec3<u32>(words[3], words[3] >> 16u, words[4]) & vec3<u32>(0xffffu);
    let high = vec3<u32>(words[4] >> 16u, words[5], words[5] >> 16u) & vec3<u32>(0xffffu);
    return LightBounds(
        light_compact_corner(all, low),
        light_compact_corner(all, high),
        light_octahedral_decode(words[0]),
        bitcast<f32>(words[1]),
        light_widened(words[2] & 0x7fffu),
        light_compact_cosine(words[2] >> 15u),
        (words[2] >> 30u) == 1u,
    );
}

fn light_compact_corner(all: LightCompactBounds, code: vec3<u32>) -> vec3<f32> {
    let t = vec3<f32>(code) / 65535.0;
    return all.lower * (1.0 - t) + all.upper * t;
}

// Of the lowest 15 bits.
fn light_compact_cosine(code: u32) -> f32 {
    return 2.0 * (f32(code & 0x7fffu) / 32767.0) - 1.0;
}

// The cosine of an angle that is larger than that of a code by the error of an axis.
fn light_widened(code: u32) -> f32 {
    // Next to 1 the sine takes the last digit of a cosine, which a driver may round otherwise.
    if code == 0x7fffu {
        return 0x1.fffffep-1;
    }
    let cos_theta = light_compact_cosine(code);
    let sin_theta = sqrt(max(0.0, (1.0 - cos_theta) * (1.0 + cos_theta)));
    let lost = LIGHT_CODE_ERROR * (sin_theta + 0.5 * LIGHT_CODE_ERROR * cos_theta);
    return max(cos_theta - lost - 0x1p-24, -1.0);
}

// How much the lights may contribute at a receiver, relative to others; 0 only where none of them
// can. A surface counts light from both sides, a segment its beginning.
fn light_bounds_importance(bounds: LightBounds, receiver: LightReceiver) -> f32 {
    if bounds.phi == 0.0 {
        return 0.0;
    }
    let center = bounds.lower * 0.5 + bounds.upper * 0.5;
    let away = receiver.p - center;
    let box = max(bounds.upper - center, center - bounds.lower);
    let size = max(abs(away), box);
    let scale = light_inverse_power_of_two(max(size.x, max(size.y, size.z)));
    let to_p = away * scale;
    let half = box * scale;
    let dist_sq = dot(to_p, to_p);
    let radius_sq = dot(half, half);
    if !(dist_sq + radius_sq <= LIGHT_MAX) {
        return LIGHT_MIN;
    }
    let dist = sqrt(dist_sq);
    let sin_b = sqrt(radius_sq) * LIGHT_SIN_GROWTH;
    var cosines = 1.0;
    if sin_b < dist {
        let from_light = to_p / dist;
        let sin_subtended = sin_b / dist;
        let cos_subtended = sqrt(max(0.0, (1.0 - sin_subtended) * (1.0 + sin_subtended)));
        let subtended = LightAngle(sin_subtended, cos_subtended);
        let cos_w = dot(bounds.w, from_light);
        let along = select(cos_w, abs(cos_w), bounds.two_sided);
        let to_axis = LightAngle(length(cross(bounds.w, from_light)), along);
        let beyond_normals = light_angle_difference(to_axis, light_angle_by(bounds.cos_theta_o));
        let cos_emission = light_angle_difference(beyond_normals, subtended).y;
        if cos_emission < bounds.cos_theta_e - LIGHT_EDGE_SLACK {
            return 0.0;
        }
        var cos_incidence = 1.0;
        if receiver.kind != LIGHT_MEDIUM && receiver.kind != LIGHT_SEGMENT {
            let to_normal = light_angle_by(min(abs(dot(receiver.n, from_light)), 1.0));
            cos_incidence = light_angle_difference(to_normal, subtended).y;
        }
        cosines = max(cos_emission, LIGHT_COS_SLACK) * max(cos_incidence, LIGHT_COS_SLACK);
    }
    let half_diagonal = 0.5 * length((bounds.upper - bounds.lower) * scale);
    let clamped_dist_sq = max(dist_sq, half_diagonal * scale);
    let importance = bounds.phi * scale / clamped_dist_sq * scale * cosines;
    return clamp(importance, LIGHT_MIN, 0.25 * LIGHT_MAX);
}

fn light_angle_by(cos_theta: f32) -> LightAngle {
    return LightAngle(sqrt(max(0.0, (1.0 - cos_theta) * (1.0 + cos_theta))), cos_theta);
}

// The difference, at least 0.
fn light_angle_difference(a: LightAngle, b: LightAngle) -> LightAngle {
    let sin_theta = max(a.x * b.y - a.y * b.x, 0.0);
    let difference = LightAngle(sin_theta, a.y * b.y + a.x * b.x);
    return select(difference, LightAngle(0.0, 1.0), a.y > b.y);
}

// A triangle as it is seen from a point, and its solid angle: solid_angle of light-math.

// In a unit in which no product of three lengths overflows.
struct LightSeenTriangle {
    // The corners relative to the second one, and to the point.
    v: array<vec3<f32>, 3>,
    r: array<vec3<f32>, 3>,
    // Unit vectors toward the corners, and their distances.
    directions: array<vec3<f32>, 3>,
    dist: vec3<f32>,
    // Of the angles at which the edges opposite to each corner are seen.
    cosines: vec3<f32>,
}

fn light_seen_triangle(p: array<vec3<f32>, 3>, viewer: vec3<f32>) -> LightSeenTriangle {
    let a = p[0] - viewer;
    let b = p[1] - viewer;
    let c = p[2] - viewer;
    let farthest = max(max(abs(a), abs(b)), abs(c));
    let scale = light_inverse_power_of_two(max(max(farthest.x, farthest.y), farthest.z));
    let r = array<vec3<f32>, 3>(a * scale, b * scale, c * scale);
    let dist = vec3<f32>(length(r[0]), length(r[1]), length(r[2]));
    let d = array<vec3<f32>, 3>(r[0] / dist.x, r[1] / dist.y, r[2] / dist.z);
    let v = array<vec3<f32>, 3>((p[0] - p[1]) * scale, vec3<f32>(0.0), (p[2] - p[1]) * scale);
    let cosines = vec3<f32>(dot(d[1], d[2]), dot(d[2], d[0]), dot(d[0], d[1]));
    return LightSeenTriangle(v, r, d, dist, cosines);
}

// Cosine and sine, in proportion, of half the signed solid angle.
fn light_half_angle(seen: LightSeenTriangle) -> vec2<f32> {
    let l = seen.dist;
    // The nearest corner, whose rounding matters least.
    var nearest = seen.r[2];
    if l.x <= l.y && l.x <= l.z {
        nearest = seen.r[0];
    } else if l.y <= l.z {
        nearest = seen.r[1];
    }
    let sin = dot(nearest, light_scaled_normal(seen.v)) / (l.x * l.y * l.z);
    let c = seen.cosines;
    if all(c > vec3<f32>(0.0)) {
        return vec2<f32>(1.0 + ((c.x + c.y) + c.z), sin);
    }
    let s0 = light_direction_sum(seen, 1u, 2u);
    let s1 = light_direction_sum(seen, 2u, 0u);
    let s2 = light_direction_sum(seen, 0u, 1u);
    let sq = vec3<f32>(dot(s0, s0), dot(s1, s1), dot(s2, s2));
    var cos = dot(s0, s1);
    if sq.x >= sq.y && sq.x >= sq.z {
        cos = dot(s1, s2);
    } else if sq.y >= sq.z {
        cos = dot(s2, s0);
    }
    return vec2<f32>(select(cos, abs(cos), sin == 0.0), sin);
}

// The solid angle of a half angle, without its sign.
fn light_solid_angle(half: vec2<f32>) -> f32 {
    return 2.0 * light_angle_of(abs(half.y), half.x);
}

// 1 + cos of the angle at which the edge between the first two corners is seen.
fn light_one_plus_first_cosine(seen: LightSeenTriangle) -> f32 {
    if seen.cosines.z > 0.0 {
        return 1.0 + seen.cosines.z;
    }
    let sum = light_direction_sum(seen, 0u, 1u);
    return 0.5 * dot(sum, sum);
}

// The sum of the unit vectors toward two corners. Where it is small, what counts is how far the
// edge passes from the point.
fn light_direction_sum(seen: LightSeenTriangle, i: u32, j: u32) -> vec3<f32> {
    var triangle = seen;
    let r0 = triangle.r[i];
    let r1 = triangle.r[j];
    let l0 = triangle.dist[i];
    let l1 = triangle.dist[j];
    if dot(r0, r1) > 0.0 {
        return r0 / l0 + r1 / l1;
    }
    let along = normalize(triangle.v[j] - triangle.v[i]);
    let near = select(r1, r0, l0 < l1);
    let once = near - along * dot(near, along);
    let foot = once - along * dot(once, along);
    let s0 = -dot(r0, along);
    let s1 = dot(r1, along);
    let excess = 1.0 / (l0 * (l0 + s0)) - 1.0 / (l1 * (l1 + s1));
    return foot * (1.0 / l0 + 1.0 / l1) + along * (dot(foot, foot) * excess);
}

// The normal, as long as twice the area, by the two shorter edges.
fn light_scaled_normal(v: array<vec3<f32>, 3>) -> vec3<f32> {
    let e0 = v[1] - v[0];
    let e1 = v[2] - v[1];
    let e2 = v[0] - v[2];
    let l = vec3<f32>(dot(e0, e0), dot(e1, e1), dot(e2, e2));
    if l.x >= l.y && l.x >= l.z {
        return cross(e1, e2);
    } else if l.y >= l.z {
        return cross(e2, e0);
    }
    return cross(e0, e1);
}

// Directions toward a triangle, uniform in solid angle: SphericalTriangle of light-math.

// An edge seen from a point: places on it are fractions.
struct LightSide {
    edge: vec3<f32>,
    start_dist: f32,
    // What the edge adds along the direction of its start, and at right angles.
    along: f32,
    across: f32,
}

struct LightSphericalTriangle {
    opposite: LightSide,
    second_to_first: vec3<f32>,
    second_dist: f32,
    directions: array<vec3<f32>, 3>,
    volume: f32,
    along_tangent: f32,
    one_plus_cos: f32,
    // 0 where it covers none.
    solid_angle: f32,
}

fn light_spherical_triangle(p: array<vec3<f32>, 3>, at: vec3<f32>) -> LightSphericalTriangle {
    let seen = light_seen_triangle(p, at);
    let half = light_half_angle(seen);
    let first_to_second = seen.v[1] - seen.v[0];
    let side = seen.v[2] - seen.v[0];
    let first = seen.directions[0];
    let rejected = light_rejection(side, first);
    let opposite = LightSide(side, seen.dist.x, dot(side, first), length(rejected));
    let volume = abs(half.y) * seen.dist.z / opposite.across;
    let solid_angle = light_solid_angle(half);
    let is_usable = solid_angle > 0.0 && volume > 0.0 && volume <= LIGHT_MAX;
    return LightSphericalTriangle(
        opposite,
        -first_to_second,
        seen.dist.y,
        seen.directions,
        volume,
        dot(first_to_second, rejected) / (seen.dist.y * opposite.across),
        light_one_plus_first_cosine(seen),
        select(0.0, solid_angle, is_usable),
    );
}

// Barycentric coordinates for u.
fn light_spherical_triangle_sample(t: LightSphericalTriangle, u: vec2<f32>) -> vec3<f32> {
    let half = light_sin_cos_of_small(0.5 * u.x * t.solid_angle);
    let cut = light_place_of_half_angle(
        t.opposite,
        half.x * t.one_plus_cos,
        half.y * t.volume - half.x * t.along_tangent,
    );
    let arc = light_arc_to(t, cut);
    let sq = light_half_angle_squares(arc, 1.0);
    let sin_sq = u.y * sq.x;
    let cos_sq = (1.0 - u.y) + u.y * sq.y;
    let walked = light_place_of_angle(arc, 2.0 * sqrt(sin_sq * cos_sq), cos_sq - sin_sq);
    return vec3<f32>((1.0 - cut) * walked, 1.0 - walked, cut * walked);
}

// The u of barycentric coordinates.
fn light_spherical_triangle_invert(t: LightSphericalTriangle, b: vec3<f32>) -> vec2<f32> {
    let walked = b.x + b.z;
    if !(walked > 0.0) {
        return vec2<f32>(0.0);
    }
    let cut = b.z / walked;
    let half = light_side_half_angle(t.opposite, cut);
    let angle = atan2(half.x * t.volume, half.y * t.one_plus_cos + half.x * t.along_tangent);
    let arc = light_arc_to(t, cut);
    let share = light_half_angle_squares(arc, walked).x / light_half_angle_squares(arc, 1.0).x;
    return clamp(vec2<f32>(2.0 * angle / t.solid_angle, share), vec2<f32>(0.0), vec2<f32>(1.0));
}

// The side from the second corner to a place on the opposite one.
fn light_arc_to(t: LightSphericalTriangle, cut: f32) -> LightSide {
    let edge = t.second_to_first + t.opposite.edge * cut;
    let second = t.directions[1];
    let across = length(light_rejection(edge, second));
    return LightSide(edge, t.second_dist, dot(edge, second), across);
}

// Sine and cosine, in proportion, of half the angle between the start and a place.
fn light_side_half_angle(side: LightSide, place: f32) -> vec2<f32> {
    let x = side.start_dist + place * side.along;
    let y = place * side.across;
    let dist = sqrt(x * x + y * y);
    return select(vec2<f32>(dist - x, y), vec2<f32>(y, dist + x), x > 0.0);
}

// Their squares.
fn light_half_angle_squares(side: LightSide, place: f32) -> vec2<f32> {
    let half = light_side_half_angle(side, place);
    let sq = half * half;
    return sq * (1.0 / (sq.x + sq.y));
}

fn light_place_of_half_angle(side: LightSide, sin_half: f32, cos_half: f32) -> f32 {
    let scale = light_inverse_power_of_two(max(sin_half, cos_half));
    let s = sin_half * scale;
    let c = max(cos_half, 0.0) * scale;
    return light_place_of_angle(side, 2.0 * s * c, (c - s) * (c + s));
}

// The place seen at an angle from the start, given its sine and cosine up to a factor.
fn light_place_of_angle(side: LightSide, sin: f32, cos: f32) -> f32 {
    let place = side.start_dist * sin / (side.across * cos - side.along * sin);
    if place >= 0.0 {
        return min(place, 1.0);
    }
    return select(0.0, 1.0, sin > 0.0);
}

fn light_sin_cos_of_small(x: f32) -> vec2<f32> {
    if !(x < 0.1) {
        return vec2<f32>(sin(x), cos(x));
    }
    let sq = x * x;
    let sine = x * (1.0 - sq * (1.0 / 6.0 - sq * (1.0 / 120.0)));
    return vec2<f32>(sine, 1.0 - sq * (0.5 - sq * (1.0 / 24.0)));
}

// What is left of v at right angles to a unit vector; twice, for the digits.
fn light_rejection(v: vec3<f32>, axis: vec3<f32>) -> vec3<f32> {
    let once = v - axis * dot(axis, v);
    return once - axis * dot(axis, once);
}

// Directions toward a rectangle, uniform in solid angle: SphericalRectangle of light-math.

struct LightSphericalRectangle {
    // The lower corner in the frame of the rectangle, with the point as origin, and its edges.
    low: vec2<f32>,
    size: vec2<f32>,
    // Of the point over the plane.
    height: f32,
    // 0 where it covers none.
    solid_angle: f32,
}

// A line segment seen from a point: from low to low + size along it.
struct LightLine {
    low: f32,
    size: f32,
    dist_sq: f32,
}

fn light_spherical_rectangle(
    corner: vec3<f32>,
    ex: vec3<f32>,
    ey: vec3<f32>,
    p: vec3<f32>,
) -> LightSphericalRectangle {
    // In a unit near the largest length: no product of four overflows or vanishes.
    let farthest = max(abs(corner - p), max(abs(ex), abs(ey)));
    let scale = light_inverse_power_of_two(max(max(farthest.x, farthest.y), farthest.z));
    let d = (corner - p) * scale;
    let size = vec2<f32>(length(ex * scale), length(ey * scale));
    let x = (ex * scale) / size.x;
    let y = (ey * scale) / size.y;
    let height = abs(dot(d, cross(x, y)));
    var seen = LightSphericalRectangle(vec2<f32>(dot(d, x), dot(d, y)), size, height, 0.0);
    if height > 0.0 {
        seen.solid_angle = light_area_between(seen, 0.0, 1.0);
    }
    return seen;
}

// The place in [0, 1]^2 for u: the line across by the paper's formula, then by Newton's method on
// areas that have their digits.
fn light_spherical_rectangle_sample(s: LightSphericalRectangle, u: vec2<f32>) -> vec2<f32> {
    let area = u.x * s.solid_angle;
    var x = light_cut(s, area);
    for (var i = 0u; i < 2u; i++) {
        let line = light_line(s, x);
        let slope = s.size.x * s.height * light_line_share(line, 0.0, 1.0) / line.dist_sq;
        var excess = (1.0 - u.x) * s.solid_angle;
        if u.x <= 0.5 {
            excess = light_area_between(s, 0.0, x) - area;
        } else {
            excess -= light_area_between(s, x, 1.0);
        }
        let step = excess / slope;
        let reach = sqrt(line.dist_sq) / s.size.x;
        if !(abs(step) < LIGHT_NEWTON_REACH * reach) {
            break;
        }
        x = light_unit(x - step);
        if step * step < LIGHT_NEWTON_PRECISION * reach {
            break;
        }
    }

    let line = light_line(s, x);
    let share = light_line_share(line, 0.0, 1.0);
    var y = light_line_place(line, u.y);
    for (var i = 0u; i < 2u; i++) {
        let dist = light_line_dist(line, s.low.y + y * s.size.y);
        let slope = s.size.y * line.dist_sq / (dist * dist * dist);
        var excess = (1.0 - u.y) * share;
        if u.y <= 0.5 {
            excess = light_line_share(line, 0.0, y) - u.y * share;
        } else {
            excess -= light_line_share(line, y, 1.0);
        }
        let step = excess / slope;
        let reach = dist / s.size.y;
        if !(abs(step) < LIGHT_NEWTON_REACH * reach) {
            break;
        }
        y = light_unit(y - step);
        if step * step < LIGHT_NEWTON_PRECISION * reach {
            break;
        }
    }
    return vec2<f32>(x, y);
}

// The u of a place.
fn light_spherical_rectangle_invert(s: LightSphericalRectangle, at: vec2<f32>) -> vec2<f32> {
    let line = light_line(s, at.x);
    let u = vec2<f32>(
        light_area_between(s, 0.0, at.x) / s.solid_angle,
        light_line_share(line, 0.0, at.y) / light_line_share(line, 0.0, 1.0),
    );
    return clamp(u, vec2<f32>(0.0), vec2<f32>(1.0));
}

// The solid angle of the part between two places of x.
fn light_area_between(s: LightSphericalRectangle, start: f32, end: f32) -> f32 {
    let columns = light_halves(s.low.x + start * s.size.x, (end - start) * s.size.x);
    let rows = light_halves(s.low.y, s.size.y);
    return light_quadrant(columns.xy, rows.xy, s.height)
        + light_quadrant(columns.xy, rows.zw, s.height)
        + light_quadrant(columns.zw, rows.xy, s.height)
        + light_quadrant(columns.zw, rows.zw, s.height);
}

// The place of the cut with the given area below it.
fn light_cut(s: LightSphericalRectangle, area: f32) -> f32 {
    let h = s.height;
    let x = s.low.x;
    let y0 = s.low.y;
    let y1 = y0 + s.size.y;
    let difference = atan2(h * s.size.y, h * h + y0 * y1);
    let sum = atan2(h * abs(y0 + y1), y0 * y1 - h * h);
    let line = light_line(s, 0.0);
    let r = light_line_dist(line, y0) * light_line_dist(line, y1);
    let share = light_line_share(line, 0.0, 1.0);
    let angle = atan2(x * h * share * r, h * h * r + x * x * y0 * y1) + area;
    let excess = sin(0.5 * (difference + angle)) * sin(0.5 * (difference - angle));
    let other = sin(0.5 * (sum + angle)) * sin(0.5 * (sum - angle));
    let place = h * sin(angle) / sqrt(max(4.0 * excess * other, LIGHT_MIN));
    return light_unit((place - x) / s.size.x);
}

// The line across the rectangle at the place x.
fn light_line(s: LightSphericalRectangle, place: f32) -> LightLine {
    let x = s.low.x + place * s.size.x;
    return LightLine(s.low.y, s.size.y, x * x + s.height * s.height);
}

// The difference of the sines of the elevation between two places.
fn light_line_share(line: LightLine, start: f32, end: f32) -> f32 {
    let low = line.low + start * line.size;
    let width = (end - start) * line.size;
    let high = low + width;
    let r0 = light_line_dist(line, low);
    let r1 = light_line_dist(line, high);
    if low * high > 0.0 {
        return width * (low + high) * line.dist_sq / (r0 * r1 * (high * r0 + low * r1));
    }
    return high / r1 - low / r0;
}

// The place with the share u of the whole below it.
fn light_line_place(line: LightLine, u: f32) -> f32 {
    let share = light_line_share(line, 0.0, 1.0);
    let sine = line.low / light_line_dist(line, line.low) + u * share;
    let below = light_one_minus_sine(line, -line.low) + u * share;
    let above = light_one_minus_sine(line, line.low + line.size) + (1.0 - u) * share;
    let y = sine * sqrt(line.dist_sq / max(below * above, LIGHT_MIN));
    return light_unit((y - line.low) / line.size);
}

fn light_one_minus_sine(line: LightLine, y: f32) -> f32 {
    let r = light_line_dist(line, y);
    return select(1.0 - y / r, line.dist_sq / (r * (r + y)), y > 0.0);
}

fn light_line_dist(line: LightLine, y: f32) -> f32 {
    return sqrt(line.dist_sq + y * y);
}

// The parts of an interval on both sides of 0, each as its distance from 0 and its width.
fn light_halves(low: f32, width: f32) -> vec4<f32> {
    let high = low + width;
    if low >= 0.0 {
        return vec4<f32>(low, width, 0.0, 0.0);
    } else if high <= 0.0 {
        return vec4<f32>(-high, width, 0.0, 0.0);
    }
    return vec4<f32>(0.0, high, 0.0, -low);
}

// The solid angle of a rectangle within one quadrant around the foot of the point.
fn light_quadrant(x: vec2<f32>, y: vec2<f32>, height: f32) -> f32 {
    let sin = height * x.y * y.y;
    if !(sin > 0.0) {
        return 0.0;
    }
    let r0 = vec3<f32>(x.x, y.x, height);
    let r1 = vec3<f32>(x.x + x.y, y.x, height);
    let r2 = vec3<f32>(x.x + x.y, y.x + y.y, height);
    let r3 = vec3<f32>(x.x, y.x + y.y, height);
    let l0 = length(r0);
    let l2 = length(r2);
    let diagonal = l0 * l2 + dot(r0, r2);
    let cos1 = diagonal * length(r1) + dot(r1, r0) * l2 + dot(r1, r2) * l0;
    let cos3 = diagonal * length(r3) + dot(r3, r0) * l2 + dot(r3, r2) * l0;
    return 2.0 * (light_angle_of(sin, cos1) + light_angle_of(sin, cos3));
}

fn light_unit(x: f32) -> f32 {
    return clamp(x, 0.0, 1.0);
}

// Points of triangles and rectangles as seen from a receiver: the shapes of light-sources.

// A point of a surface, its unit normal, the unit direction toward it and the density of that;
// 0 where there is none.
struct LightShapeSample {
    p: vec3<f32>,
    pdf: f32,
    n: vec3<f32>,
    wi: vec3<f32>,
}

struct LightTriangle {
    p: array<vec3<f32>, 3>,
    n: vec3<f32>,
    // 0 without area: it is never sampled then.
    inv_area: f32,
}

struct LightRectangle {
    corner: vec3<f32>,
    x: vec3<f32>,
    y: vec3<f32>,
    n: vec3<f32>,
}

fn light_triangle(p: array<vec3<f32>, 3>) -> LightTriangle {
    let normal = cross(p[1] - p[0], p[2] - p[0]);
    let largest = max(max(abs(normal.x), abs(normal.y)), abs(normal.z));
    if !(largest > 0.0) {
        return LightTriangle(p, vec3<f32>(0.0), 0.0);
    }
    // Divided by the largest component first, so that no square vanishes.
    let twice_area = largest * length(normal / largest);
    let n = light_unit_or(normal, vec3<f32>(0.0));
    return LightTriangle(p, n, select(0.0, 2.0 / twice_area, twice_area >= LIGHT_MIN));
}

fn light_rectangle(corner: vec3<f32>, x: vec3<f32>, y: vec3<f32>) -> LightRectangle {
    return LightRectangle(corner, x, y, normalize(cross(normalize(x), normalize(y))));
}

// Whether the receiver may be a point of the plane through `on` with the unit normal `n`, wherever
// rounding has put it. Nothing in a plane lights it.
fn light_is_in_plane(receiver: LightReceiver, on: vec3<f32>, n: vec3<f32>) -> bool {
    let size = max(abs(on), abs(receiver.p));
    let error = LIGHT_OWN_ERROR * max(max(size.x, size.y), size.z);
    let across = cross(receiver.n, n);
    let is_parallel = dot(across, across) <= LIGHT_PARALLEL * LIGHT_PARALLEL;
    return light_has_normal(receiver) && is_parallel && abs(dot(receiver.p - on, n)) <= error;
}

fn light_triangle_sample(
    t: LightTriangle,
    receiver: LightReceiver,
    u: vec2<f32>,
) -> LightShapeSample {
    var found: LightShapeSample;
    if t.inv_area == 0.0 || light_is_in_plane(receiver, t.p[0], t.n) {
        return found;
    }
    let seen = light_triangle_seen(t, receiver.p);
    var b = light_uniform_triangle(u);
    var density = 1.0;
    if seen.solid_angle > 0.0 {
        let weights = light_triangle_cosines(receiver, seen);
        let place = light_bilinear_sample(u, weights);
        density = light_bilinear_pdf(place, weights) / seen.solid_angle;
        b = light_spherical_triangle_sample(seen, place);
    }
    found.p = t.p[0] + light_triangle_offset(t, b);
    found.n = t.n;
    let to_light = light_triangle_toward(t, receiver.p, b);
    let by_area = light_area_to_solid_angle(t.inv_area, to_light, t.n);
    let by_angle = vec4<f32>(light_unit_or(to_light, vec3<f32>(0.0)), density);
    let direction = select(by_area, by_angle, seen.solid_angle > 0.0);
    found.wi = direction.xyz;
    found.pdf = direction.w;
    if light_is_within_rounding(found, to_light) {
        found.pdf = light_triangle_pdf(t, receiver, found.wi);
    }
    return found;
}

fn light_triangle_pdf(t: LightTriangle, receiver: LightReceiver, wi: vec3<f32>) -> f32 {
    let b = light_triangle_hit(t, receiver.p, wi);
    if t.inv_area == 0.0 || all(b == vec3<f32>(0.0))
        || light_is_in_plane(receiver, t.p[0], t.n) {
        return 0.0;
    }
    let seen = light_triangle_seen(t, receiver.p);
    if seen.solid_angle > 0.0 {
        let place = light_spherical_triangle_invert(seen, b);
        return light_bilinear_pdf(place, light_triangle_cosines(receiver, seen)) / seen.solid_angle;
    }
    let to_light = light_triangle_toward(t, receiver.p, b);
    return light_area_to_solid_angle(t.inv_area, to_light, t.n).w;
}

// From the first vertex to the point at b.
fn light_triangle_offset(t: LightTriangle, b: vec3<f32>) -> vec3<f32> {
    return (t.p[1] - t.p[0]) * b.y + (t.p[2] - t.p[0]) * b.z;
}

// From p to the point at b: not by way of the point itself, whose rounding grows with the
// coordinates of the scene.
fn light_triangle_toward(t: LightTriangle, p: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return (t.p[0] - p) + light_triangle_offset(t, b);
}

// The triangle on the sphere of directions around p; without solid angle where it is so small that
// it is sampled by area.
fn light_triangle_seen(t: LightTriangle, p: vec3<f32>) -> LightSphericalTriangle {
    var seen: LightSphericalTriangle;
    let e1 = t.p[1] - t.p[0];
    let e2 = t.p[2] - t.p[0];
    let to_p = p - t.p[0];
    let r = length(to_p) - sqrt(max(dot(e1, e1), dot(e2, e2)));
    if r > 0.0 && abs(dot(cross(e1, e2), to_p)) < LIGHT_SMALL_BOUND * (r * r * r) {
        return seen;
    }
    seen = light_spherical_triangle(t.p, p);
    if !(seen.solid_angle > LIGHT_SMALL_SOLID_ANGLE) {
        seen.solid_angle = 0.0;
    }
    return seen;
}

// The square of a spherical triangle has the second corner all along its lower side.
fn light_triangle_cosines(receiver: LightReceiver, seen: LightSphericalTriangle) -> vec4<f32> {
    let d = seen.directions;
    return light_receiver_cosines(receiver, d[1], d[1], d[0], d[2]);
}

// Barycentric coordinates of the point that the ray meets, 0 where there is none. Edges are wider
// by the rounding error of the products.
fn light_triangle_hit(t: LightTriangle, origin: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    let v0 = t.p[0] - origin;
    let v1 = t.p[1] - origin;
    let v2 = t.p[2] - origin;
    let e0 = v2 - v1;
    let e1 = v0 - v2;
    let e2 = v1 - v0;
    let sides = vec3<f32>(
        dot(direction, cross(v1, e0)),
        dot(direction, cross(v2, e1)),
        dot(direction, cross(v0, e2)),
    );
    let slack = LIGHT_EDGE_ERROR * vec3<f32>(
        length(v1) * length(e0),
        length(v2) * length(e1),
        length(v0) * length(e2),
    );
    let sum = sides.x + sides.y + sides.z;
    if (!all(sides >= -slack) && !all(sides <= slack)) || sum == 0.0 {
        return vec3<f32>(0.0);
    }
    let b = sides / sum;
    let to_light = light_triangle_toward(t, origin, b);
    return select(vec3<f32>(0.0), b, dot(to_light, direction) > 0.0);
}

fn light_rectangle_sample(
    s: LightRectangle,
    receiver: LightReceiver,
    u: vec2<f32>,
) -> LightShapeSample {
    var found: LightShapeSample;
    if light_is_in_plane(receiver, s.corner, s.n) {
        return found;
    }
    let seen = light_rectangle_seen(s, receiver.p);
    var place = u;
    var density = 1.0;
    if seen.solid_angle > 0.0 {
        let weights = light_rectangle_cosines(receiver, s);
        let warped = light_bilinear_sample(u, weights);
        density = light_bilinear_pdf(warped, weights) / seen.solid_angle;
        place = light_spherical_rectangle_sample(seen, warped);
    }
    found.p = s.corner + s.x * place.x + s.y * place.y;
    found.n = s.n;
    let to_light = light_rectangle_toward(s, receiver.p, place);
    let by_area = light_rectangle_by_area(s, to_light);
    let by_angle = vec4<f32>(light_unit_or(to_light, vec3<f32>(0.0)), density);
    let direction = select(by_area, by_angle, seen.solid_angle > 0.0);
    found.wi = direction.xyz;
    found.pdf = direction.w;
    if light_is_within_rounding(found, to_light) {
        found.pdf = light_rectangle_pdf(s, receiver, found.wi);
    }
    return found;
}

fn light_rectangle_pdf(s: LightRectangle, receiver: LightReceiver, wi: vec3<f32>) -> f32 {
    let hit = light_rectangle_hit(s, receiver.p, wi);
    if hit.z == 0.0 || light_is_in_plane(receiver, s.corner, s.n) {
        return 0.0;
    }
    let seen = light_rectangle_seen(s, receiver.p);
    if seen.solid_angle > 0.0 {
        let place = light_spherical_rectangle_invert(seen, hit.xy);
        return light_bilinear_pdf(place, light_rectangle_cosines(receiver, s)) / seen.solid_angle;
    }
    return light_rectangle_by_area(s, light_rectangle_toward(s, receiver.p, hit.xy)).w;
}

// From p to the point at `place`: not by way of the point itself, whose rounding grows with the
// coordinates of the scene.
fn light_rectangle_toward(s: LightRectangle, p: vec3<f32>, place: vec2<f32>) -> vec3<f32> {
    return (s.corner - p) + s.x * place.x + s.y * place.y;
}

// Direction and density of a point that is chosen by area. Where rounding has moved the receiver
// into the plane, the density is at least that over a half space.
fn light_rectangle_by_area(s: LightRectangle, to_light: vec3<f32>) -> vec4<f32> {
    let inv_area = 1.0 / (length(s.x) * length(s.y));
    let found = light_area_to_solid_angle(inv_area, to_light, s.n);
    let pdf = max(found.w, LIGHT_LEAST_DENSITY);
    return vec4<f32>(found.xyz, select(0.0, pdf, found.w > 0.0));
}

fn light_rectangle_seen(s: LightRectangle, p: vec3<f32>) -> LightSphericalRectangle {
    var seen = light_spherical_rectangle(s.corner, s.x, s.y, p);
    if !(seen.solid_angle > LIGHT_SMALL_SOLID_ANGLE) {
        seen.solid_angle = 0.0;
    }
    return seen;
}

fn light_rectangle_cosines(receiver: LightReceiver, s: LightRectangle) -> vec4<f32> {
    let d = s.corner - receiver.p;
    let none = vec3<f32>(0.0);
    return light_receiver_cosines(
        receiver,
        light_unit_or(d, none),
        light_unit_or(d + s.x, none),
        light_unit_or(d + s.y, none),
        light_unit_or(d + (s.x + s.y), none),
    );
}

// The place of the rectangle that the ray meets, and 1; or 0.
fn light_rectangle_hit(s: LightRectangle, origin: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    let to_corner = s.corner - origin;
    let cos_theta = dot(direction, s.n);
    let t = dot(to_corner, s.n) / cos_theta;
    if !(t > 0.0 && t <= LIGHT_MAX) {
        return vec3<f32>(0.0);
    }
    let p = direction * t - to_corner;
    let magnitude = t + length(to_corner) + length(s.corner);
    let error = LIGHT_HIT_ERROR * magnitude / abs(cos_theta);
    let edges_sq = vec2<f32>(dot(s.x, s.x), dot(s.y, s.y));
    let place = vec2<f32>(dot(p, s.x), dot(p, s.y)) / edges_sq;
    let slack = min(error / sqrt(edges_sq), vec2<f32>(LIGHT_WIDEST_SLACK));
    let is_hit = all(place >= -slack) && all(place <= 1.0 + slack);
    let at = clamp(place, vec2<f32>(0.0), vec2<f32>(1.0));
    return select(vec3<f32>(0.0), vec3<f32>(at, 1.0), is_hit);
}

// What a surface weighs directions by, at the corners of the square; all alike in a medium.
fn light_receiver_cosines(
    receiver: LightReceiver,
    d00: vec3<f32>,
    d10: vec3<f32>,
    d01: vec3<f32>,
    d11: vec3<f32>,
) -> vec4<f32> {
    if !light_has_normal(receiver) {
        return vec4<f32>(1.0);
    }
    let n = receiver.n;
    let cosines = abs(vec4<f32>(dot(d00, n), dot(d10, n), dot(d01, n), dot(d11, n)));
    return max(cosines, vec4<f32>(LIGHT_LEAST_COSINE));
}

// The unit vector along to_light, and the density per solid angle of a density per area; 0 edge-on.
fn light_area_to_solid_angle(pdf_area: f32, to_light: vec3<f32>, n: vec3<f32>) -> vec4<f32> {
    let dist_sq = dot(to_light, to_light);
    if !(dist_sq >= LIGHT_MIN && dist_sq <= LIGHT_MAX) {
        return vec4<f32>(0.0);
    }
    let wi = to_light * (1.0 / sqrt(dist_sq));
    let cos_theta = abs(dot(n, wi));
    let pdf = pdf_area * dist_sq / cos_theta;
    let has_pdf = cos_theta > 0.0 && pdf > 0.0 && pdf <= LIGHT_MAX;
    return select(vec4<f32>(0.0), vec4<f32>(wi, pdf), has_pdf);
}

// Whether rounding changes visibly where the direction of a sample meets the surface, and the
// density there: because the point is so close, compared with its coordinates, or because the
// direction comes in so low over the surface. Not where there is no sample.
fn light_is_within_rounding(sample: LightShapeSample, to_light: vec3<f32>) -> bool {
    let at = sample.p;
    let is_close = dot(to_light, to_light) < LIGHT_CLOSE * LIGHT_CLOSE * dot(at, at);
    let is_low = abs(dot(sample.wi, sample.n)) < LIGHT_GRAZING;
    return sample.pdf > 0.0 && (is_close || is_low);
}

// Points of a sphere as seen from a receiver: Sphere of light-sources.

struct LightSphere {
    center: vec3<f32>,
    radius: f32,
    // From the sphere's space to the scene.
    axes: mat3x3<f32>,
}

// The directions toward a sphere from outside; without height from inside and from its surface.
struct LightSphereCone {
    axis: vec3<f32>,
    sin_max: f32,
    one_minus_cos_max: f32,
}

fn light_sphere_sample(s: LightSphere, receiver: LightReceiver, u: vec2<f32>) -> LightShapeSample {
    var found: LightShapeSample;
    let cone = light_sphere_cone(s, receiver);
    if cone.one_minus_cos_max == 0.0 {
        found.n = s.axes * light_uniform_sphere(u);
        found.p = s.center + found.n * s.radius;
        let inv_area = 1.0 / light_sphere_area(s);
        let direction = light_area_to_solid_angle(inv_area, found.p - receiver.p, found.n);
        found.wi = direction.xyz;
        found.pdf = select(0.0, direction.w, dot(found.n, found.wi) > 0.0);
        found.p -= found.n * light_sphere_error(s);
        return found;
    }
    found.pdf = light_cone_pdf(cone.one_minus_cos_max);
    // The angle at the receiver, and from it the one at the centre.
    let one_minus_cos = cone.one_minus_cos_max * u.x;
    let sin = light_safe_sqrt(one_minus_cos * (2.0 - one_minus_cos));
    let cos = 1.0 - one_minus_cos;
    let sin_sum = min(sin / cone.sin_max, 1.0);
    let cos_sum = light_safe_sqrt(1.0 - sin_sum * sin_sum);
    let sin_alpha = sin_sum * cos - cos_sum * sin;
    let cos_alpha = cos_sum * cos + sin_sum * sin;
    let around = light_azimuth(u.y);
    let frame = light_frame(cone.axis);
    found.n = normalize(frame * -vec3<f32>(around * sin_alpha, cos_alpha));
    found.wi = normalize(frame * vec3<f32>(-around * sin, cos));
    found.p = s.center + found.n * (s.radius + light_sphere_error(s));
    return found;
}

fn light_sphere_pdf(s: LightSphere, receiver: LightReceiver, wi: vec3<f32>) -> f32 {
    let cone = light_sphere_cone(s, receiver);
    if cone.one_minus_cos_max > 0.0 {
        let sin = length(cross(cone.axis, wi));
        let is_hit = dot(cone.axis, wi) > 0.0 && sin <= cone.sin_max + LIGHT_DIRECTION_ERROR;
        return select(0.0, light_cone_pdf(cone.one_minus_cos_max), is_hit);
    }
    // By area, where the way out of the sphere counts.
    let to_center = s.center - receiver.p;
    let nearest = dot(to_center, wi);
    let offset = wi * nearest - to_center;
    let half_chord_sq = s.radius * s.radius - dot(offset, offset);
    if !(half_chord_sq >= 0.0) {
        return 0.0;
    }
    let half_chord = sqrt(half_chord_sq);
    let t = nearest + half_chord;
    let n = light_unit_or(offset + wi * half_chord, vec3<f32>(0.0));
    let pdf = light_area_to_solid_angle(1.0 / light_sphere_area(s), wi * t, n).w;
    return select(0.0, pdf, t > 0.0);
}

fn light_sphere_cone(s: LightSphere, receiver: LightReceiver) -> LightSphereCone {
    var cone: LightSphereCone;
    let to_center = s.center - receiver.p;
    let distance = length(to_center);
    if !(distance > s.radius) || light_sphere_is_own(s, receiver) {
        return cone;
    }
    cone.axis = to_center / distance;
    cone.sin_max = s.radius / distance;
    let sin_sq = cone.sin_max * cone.sin_max;
    cone.one_minus_cos_max = sin_sq / (1.0 + light_safe_sqrt(1.0 - sin_sq));
    return cone;
}

// Whether the receiver may be a point of the sphere, wherever rounding has put it.
fn light_sphere_is_own(s: LightSphere, receiver: LightReceiver) -> bool {
    if !light_has_normal(receiver) {
        return false;
    }
    let error = vec3<f32>(LIGHT_OWN_ERROR * light_sphere_size(s));
    let from_center = receiver.p - s.center;
    let own = receiver.n * s.radius;
    return all(abs(own - from_center) <= error) || all(abs(own + from_center) <= error);
}

// By how much a point is moved to the side from which it is seen: more than its rounding.
fn light_sphere_error(s: LightSphere) -> f32 {
    return LIGHT_SPHERE_ERROR * light_sphere_size(s);
}

fn light_sphere_size(s: LightSphere) -> f32 {
    let c = abs(s.center);
    return max(max(c.x, c.y), c.z) + s.radius;
}

fn light_sphere_area(s: LightSphere) -> f32 {
    return 12.566370614359172 * s.radius * s.radius;
}

fn light_cone_pdf(one_minus_cos: f32) -> f32 {
    let pdf = 1.0 / (6.2831853071795864 * one_minus_cos);
    return select(0.0, pdf, one_minus_cos > 0.0 && pdf <= LIGHT_MAX);
}

// The light that arrives from each light of a lights: LightSet of light-sources.

const LIGHT_INV_SPHERE: f32 = 0.07957747154594767;

struct LightSet {
    // The row of the first light, of four each.
    lights: u32,
    count: u32,
    // Of the scene.
    radius: f32,
}

// Light that arrives, as LightLiSample of the crate has it; there is none where pdf is 0.
struct LightLiSample {
    // Radiance; of a point light intensity over the squared distance, of a distant one irradiance.
    l: vec3<f32>,
    // Of the direction, per solid angle; 1 where a light has but one.
    pdf: f32,
    // The unit direction toward the light.
    wi: vec3<f32>,
    // Where a shadow ray ends.
    p_light: vec3<f32>,
    // Of the surface there, 0 without one.
    n_light: vec3<f32>,
}

// Four rows of a light.
struct LightRecord {
    kind: u32,
    sides: u32,
    // Where it is, or the direction toward it.
    a: vec3<f32>,
    // What it emits, and a number besides; of an environment map an axis.
    l: vec4<f32>,
    b: vec4<f32>,
    c: vec4<f32>,
}

// The set whose rows begin in row `first`: light_set_rows of the crate makes them.
fn light_set(first: u32) -> LightSet {
    let head = light_row(first);
    return LightSet(first + 1u, head.x, bitcast<f32>(head.y));
}

// A direction from which `light` arrives at the receiver, by u in [0, 1)^2. As on the CPU, the side
// of the receiver is not tested.
fn light_set_sample_li(
    lights: LightSet,
    light: u32,
    receiver: LightReceiver,
    u: vec2<f32>,
) -> LightLiSample {
    var sample: LightLiSample;
    if light >= lights.count {
        return sample;
    }
    let it = light_record(lights, light);
    if it.kind == LIGHT_KIND_POINT || it.kind == LIGHT_KIND_SPOT {
        return light_point_li(it, receiver);
    }
    if it.kind == LIGHT_KIND_DISTANT || it.kind == LIGHT_KIND_UNIFORM {
        let is_distant = it.kind == LIGHT_KIND_DISTANT;
        sample.wi = select(light_uniform_sphere(u), it.a, is_distant);
        sample.pdf = select(LIGHT_INV_SPHERE, 1.0, is_distant);
        sample.l = it.l.xyz;
        sample.p_light = light_beyond(lights, receiver, sample.wi);
        return sample;
    }
    if light_is_environment(it) {
        let found = light_environment_sample(light_record_environment(lights, light, it), u);
        let p = light_beyond(lights, receiver, found.wi);
        return LightLiSample(found.l, found.pdf, found.wi, p, vec3<f32>(0.0));
    }
    var at: LightShapeSample;
    if it.kind == LIGHT_KIND_TRIANGLE {
        at = light_triangle_sample(light_record_triangle(it), receiver, u);
    } else if it.kind == LIGHT_KIND_RECTANGLE {
        at = light_rectangle_sample(light_rectangle(it.a, it.b.xyz, it.c.xyz), receiver, u);
    } else if it.kind == LIGHT_KIND_SPHERE {
        at = light_sphere_sample(light_record_sphere(it), receiver, u);
    }
    let front = -dot(at.n, at.wi);
    let is_dark = (it.sides == LIGHT_SIDES_FRONT && !(front > 0.0))
        || (it.sides == LIGHT_SIDES_BACK && !(front < 0.0))
        || all(it.l.xyz == vec3<f32>(0.0));
    if at.pdf > 0.0 && !is_dark {
        sample = LightLiSample(it.l.xyz, at.pdf, at.wi, at.p, at.n);
    }
    return sample;
}

// The density with which light_set_sample_li chooses the direction wi; 0 for lights that have but
// one.
fn light_set_pdf_li(lights: LightSet, light: u32, receiver: LightReceiver, wi: vec3<f32>) -> f32 {
    if light >= lights.count {
        return 0.0;
    }
    let it = light_record(lights, light);
    if it.kind == LIGHT_KIND_UNIFORM {
        return LIGHT_INV_SPHERE;
    } else if it.kind == LIGHT_KIND_TRIANGLE {
        return light_triangle_pdf(light_record_triangle(it), receiver, wi);
    } else if it.kind == LIGHT_KIND_RECTANGLE {
        return light_rectangle_pdf(light_rectangle(it.a, it.b.xyz, it.c.xyz), receiver, wi);
    } else if it.kind == LIGHT_KIND_SPHERE {
        return light_sphere_pdf(light_record_sphere(it), receiver, wi);
    } else if light_is_environment(it) {
        return light_environment_toward(light_record_environment(lights, light, it), wi).pdf;
    }
    return 0.0;
}

// The radiance of `light` along a ray that leaves the scene in the direction wi: of skies alone.
fn light_set_le(lights: LightSet, light: u32, wi: vec3<f32>) -> vec3<f32> {
    if light >= lights.count {
        return vec3<f32>(0.0);
    }
    let it = light_record(lights, light);
    if light_is_environment(it) {
        return light_environment_toward(light_record_environment(lights, light, it), wi).l;
    }
    return select(vec3<f32>(0.0), it.l.xyz, it.kind == LIGHT_KIND_UNIFORM);
}

// A point outside of the scene.
fn light_beyond(lights: LightSet, receiver: LightReceiver, wi: vec3<f32>) -> vec3<f32> {
    return receiver.p + wi * (2.0 * lights.radius);
}

fn light_is_environment(it: LightRecord) -> bool {
    return it.kind == LIGHT_KIND_LAT_LONG || it.kind == LIGHT_KIND_EQUAL_AREA;
}

// Its axes are those of the record; its size and the row of its table, counted from the head of
// the set, are whole numbers in the last row.
fn light_record_environment(lights: LightSet, light: u32, it: LightRecord) -> LightEnvironment {
    let table = light_row(lights.lights + 4u * light + 3u);
    let turn = mat3x3<f32>(it.a, it.l.xyz, it.b.xyz);
    let is_lat_long = it.kind == LIGHT_KIND_LAT_LONG;
    return light_environment(lights.lights - 1u + table.x, table.yz, is_lat_long, turn);
}

fn light_record(lights: LightSet, light: u32) -> LightRecord {
    let first = lights.lights + 4u * light;
    let head = light_row(first);
    return LightRecord(
        head.w & 0xffu,
        head.w >> 8u,
        bitcast<vec3<f32>>(head.xyz),
        bitcast<vec4<f32>>(light_row(first + 1u)),
        bitcast<vec4<f32>>(light_row(first + 2u)),
        bitcast<vec4<f32>>(light_row(first + 3u)),
    );
}

fn light_record_triangle(it: LightRecord) -> LightTriangle {
    return light_triangle(array<vec3<f32>, 3>(it.a, it.b.xyz, it.c.xyz));
}

// The second axis is that of the other two, or its mirror image.
fn light_record_sphere(it: LightRecord) -> LightSphere {
    let y = cross(it.c.xyz, it.b.xyz) * it.b.w;
    return LightSphere(it.a, it.l.w, mat3x3<f32>(it.b.xyz, y, it.c.xyz));
}

fn light_point_li(it: LightRecord, receiver: LightReceiver) -> LightLiSample {
    var sample: LightLiSample;
    let to_light = it.a - receiver.p;
    let dist_sq = dot(to_light, to_light);
    if !(dist_sq >= LIGHT_MIN && dist_sq <= LIGHT_MAX) {
        return sample;
    }
    let wi = to_light * (1.0 / sqrt(dist_sq));
    var intensity = it.l.xyz;
    if it.kind == LIGHT_KIND_SPOT {
        intensity *= light_spot_falloff(it, -wi);
    }
    let l = intensity * (1.0 / dist_sq);
    if any(l > vec3<f32>(0.0)) && all(l <= vec3<f32>(LIGHT_MAX)) {
        sample = LightLiSample(l, 1.0, wi, it.a, vec3<f32>(0.0));
    }
    return sample;
}

// The relative intensity of a spot in the unit direction w, by its distance from the axis, which
// keeps its digits near it.
fn light_spot_falloff(it: LightRecord, w: vec3<f32>) -> f32 {
    let axis = it.b.xyz;
    let start = it.l.w;
    let end = it.b.w;
    let z = dot(axis, w);
    let aside = cross(axis, w);
    let x = select(1.0 - z, dot(aside, aside) / (1.0 + z), z > 0.0);
    let t = clamp((end - x) / (end - start), 0.0, 1.0);
    return select(select(t * t * (3.0 - 2.0 * t), 0.0, x >= end), 1.0, x <= start);
}

// The lights of a scene and the sampler that chooses among them.

struct LightScene {
    sampler: LightSampler,
    lights: LightSet,
}

// The lights whose rows begin in row `first`: light_scene_rows of the crate makes them.
fn light_scene(first: u32) -> LightScene {
    return LightScene(light_sampler(first + 1u), light_set(first + light_row(first).x));
}
