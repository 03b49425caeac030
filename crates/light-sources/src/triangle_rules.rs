/// Barycentric coordinates of a place of a triangle, and its weight.
pub(crate) type Node = ([f64; 3], f64);

/// Exact for polynomials up to degree 2: the middles of the sides.
pub(crate) const DEGREE_2: [Node; 3] = [
    ([0.5, 0.5, 0.0], 1.0 / 3.0),
    ([0.0, 0.5, 0.5], 1.0 / 3.0),
    ([0.5, 0.0, 0.5], 1.0 / 3.0),
];

/// Exact for polynomials up to degree 5.
///
/// # Source
/// `[Radon1948]`: the centroid, and two triples on the medians.
pub(crate) const DEGREE_5: [Node; 7] = {
    const A: f64 = 0.101_286_507_323_456_34;
    const B: f64 = 0.470_142_064_105_115_1;
    const WEIGHT_A: f64 = 0.125_939_180_544_827_17;
    const WEIGHT_B: f64 = 0.132_394_152_788_506_16;
    [
        ([1.0 / 3.0; 3], 0.225),
        ([1.0 - 2.0 * A, A, A], WEIGHT_A),
        ([A, 1.0 - 2.0 * A, A], WEIGHT_A),
        ([A, A, 1.0 - 2.0 * A], WEIGHT_A),
        ([1.0 - 2.0 * B, B, B], WEIGHT_B),
        ([B, 1.0 - 2.0 * B, B], WEIGHT_B),
        ([B, B, 1.0 - 2.0 * B], WEIGHT_B),
    ]
};
