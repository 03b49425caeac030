use super::{receiver_cosine, rectangle, rounding, solid_angle, sphere, triangle};

/// The numbers of the samples toward triangles, rectangles and spheres, by name, for ports of them
/// to another language.
pub const SHAPE_CONSTANTS: [(&str, f32); 13] = [
    ("CLOSE", rounding::CLOSE),
    ("DIRECTION_ERROR", sphere::DIRECTION_ERROR),
    ("EDGE_ERROR", triangle::EDGE_ERROR),
    ("GRAZING", rounding::GRAZING),
    ("HIT_ERROR", rounding::HIT_ERROR),
    ("LEAST_COSINE", receiver_cosine::SMALLEST),
    ("LEAST_DENSITY", solid_angle::LEAST_DENSITY),
    ("OWN_ERROR", sphere::OWN_ERROR),
    ("PARALLEL", rounding::PARALLEL),
    ("SMALL_BOUND", triangle::SMALL_BOUND),
    ("SMALL_SOLID_ANGLE", solid_angle::SMALL),
    ("SPHERE_ERROR", sphere::SPHERE_ERROR),
    ("WIDEST_SLACK", rectangle::WIDEST_SLACK),
];
