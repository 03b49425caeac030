use super::*;

/// Places are surface parameters.
fn polygon(corners: &[[f64; 2]]) -> UvPolygon {
    let corner = |&uv: &[f64; 2]| Corner {
        uv: uv.into(),
        place: uv.into(),
    };
    UvPolygon::new(&corners.iter().map(corner).collect::<alloc::vec::Vec<_>>())
}

fn level(corners: [[f64; 2]; 2]) -> Level {
    Level {
        start: DVec2::ZERO,
        slope: DVec2::ONE,
        corners,
    }
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// The area, and that above the level.
fn areas(polygon: &UvPolygon, level: &Level) -> [f64; 2] {
    let mut areas = [0.0; 2];
    each_node(polygon, level, |node, weight| {
        areas[0] += weight;
        areas[1] += weight * f64::from(u8::from(level.at(node.place) >= 0.0));
    });
    areas
}

/// Below the hyperbola `x y = c` lie `c (1 - ln c)` of the unit square, however near it comes
/// to its asymptotes.
#[test]
fn the_area_beside_a_hyperbola() {
    for c in [0.9f64, 0.5, 0.1, 1e-2, 1e-4, 1e-8] {
        let below = c * (1.0 - c.ln());
        for (corners, expected) in [
            ([[-c, -c], [-c, 1.0 - c]], 1.0 - below),
            ([[1.0 - c, -c], [-c, -c]], 1.0 - below),
            ([[c, c], [c, c - 1.0]], below),
        ] {
            // Wherever the texel is, and however it lies in the image.
            let one = DVec2::ONE;
            for (shift, size) in [(0.0, one), (3.0, one), (3.0, DVec2::new(2.0, 0.5))] {
                let place = |uv: DVec2| uv * size + shift;
                let square = polygon(&SQUARE).with_places(place);
                let level = Level {
                    start: -shift / size,
                    slope: 1.0 / size,
                    corners,
                };
                let [all, above] = areas(&square, &level);
                assert!((all - 1.0).abs() < 1e-12, "{c}: {all}");
                let near = (above - expected).abs() < 1e-7;
                assert!(near, "{c}: {above}, {expected}");
            }
        }
    }
}

/// It follows a hyperbola down to where it leaves the polygon, a hundred times farther from its
/// asymptote than where it enters.
#[test]
fn the_area_beside_the_end_of_a_hyperbola() {
    for c in [0.1f64, 1e-2, 1e-3] {
        // x (y + c) >= c, from x = 2 c on, where y is 1/2 - c.
        let rectangle = [[2.0 * c, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0 * c, 1.0]];
        let below = c * (0.5 / c).ln() - c * (1.0 - 2.0 * c);
        for size in [DVec2::ONE, DVec2::new(1.0, 5.0)] {
            let shown = polygon(&rectangle).with_places(|uv| uv * size);
            let level = Level {
                slope: 1.0 / size,
                ..level([[-c, 0.0], [-c, 1.0]])
            };
            let [all, above] = areas(&shown, &level);
            assert!((all - 1.0 + 2.0 * c).abs() < 1e-12, "{c}: {all}");
            assert!((all - above - below).abs() < 1e-7, "{c}: {above}, {below}");
        }
    }
}

#[test]
fn at_the_pole_nothing_changes_along_the_other_axis() {
    for corners in [
        [[0.5, -2.0], [3.0, 0.25]],
        [[-1.0, 4.0], [0.75, -0.5]],
        [[0.0, 3.0], [0.5, 1.0]],
    ] {
        let level = Level {
            start: DVec2::new(0.25, -1.5),
            slope: DVec2::new(3.0, -0.5),
            corners,
        };
        let x = level.pole(Axis::X);
        let change = level.at(DVec2::new(x, 0.0)) - level.at(DVec2::new(x, 1.0));
        assert!(change.abs() < 1e-12, "x = {x}: {change}");
        let y = level.pole(Axis::Y);
        let change = level.at(DVec2::new(0.0, y)) - level.at(DVec2::new(1.0, y));
        assert!(change.abs() < 1e-12, "y = {y}: {change}");
    }
}

#[test]
fn a_parabola_has_up_to_two_roots() {
    let of = |f: fn(f64) -> f64| {
        let mut found = roots(f(0.0), f(0.5), f(1.0));
        found.sort_unstable_by(f64::total_cmp);
        found
    };
    for (found, expected) in [
        (of(|x| 3.0 * (x - 0.25) * (x - 0.625)), [0.25, 0.625]),
        (of(|x| (x - 0.75) * (x + 2.0)), [0.75, 1.0]),
        (of(|x| (0.125 - x) * (x - 3.0)), [0.125, 1.0]),
        (of(|x| x * x + 0.1), [1.0; 2]),
        (of(|x| x - 0.5), [0.5, 1.0]),
        (of(|_| 1.0), [1.0; 2]),
    ] {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{found}, {expected}");
        }
    }
}

/// Without gaps, and no more of them than the bits of the distances.
#[test]
fn pieces_fill_an_interval() {
    for (start, end) in [(0.0, 1.0), (0.25, 0.5), (0.0, 5e-324)] {
        for pole in [-1.0, -1e-6, start, end, 1.5, f64::INFINITY, f64::NAN] {
            let mut found = alloc::vec::Vec::new();
            pieces([start, end], pole, |piece| found.push(piece));
            found.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            assert_eq!(found[0][0], start, "{pole}");
            assert_eq!(found[found.len() - 1][1], end, "{pole}");
            assert!(found.windows(2).all(|two| two[0][1] == two[1][0]), "{pole}");
            assert!(found.len() < 40, "{pole}: {}", found.len());
            let near = |[a, b]: &[f64; 2]| b - a <= 1.001 * ((a - pole).max(pole - b) + 1e-9);
            assert!(
                !pole.is_finite() || found.iter().all(near),
                "{pole}: {found:?}"
            );
        }
    }
}

/// On both sides of the level, polynomials of degree 3 have their exact integrals.
#[test]
fn nodes_are_spread_over_both_sides() {
    for at in [-1.0, 0.05, 0.33, 0.5, 0.85, 2.0] {
        for along in [[[-at, 1.0 - at]; 2], [[-at; 2], [1.0 - at; 2]]] {
            let mut sums = [0.0; 3];
            each_node(
                &polygon(&SQUARE),
                &level(along),
                |Corner { place, .. }, weight| {
                    sums[0] += place.x * weight;
                    sums[1] += place.x.powi(3) * weight;
                    sums[2] += place.x * place.y * place.y * weight;
                },
            );
            for (sum, expected) in sums.into_iter().zip([1.0 / 2.0, 1.0 / 4.0, 1.0 / 6.0]) {
                assert!((sum - expected).abs() < 1e-12, "{at}: {sum}, {expected}");
            }
        }
    }
}

#[test]
fn roots_have_the_digits_of_double_precision() {
    for x in [2.0f64, 1e-9, 0.25, 12345.0, 1e30] {
        let error = (sqrt(x) / x.sqrt() - 1.0).abs();
        assert!(error < 1e-14, "{x}: {error}");
    }
    assert_eq!(sqrt(0.0), 0.0, "of nothing");
}

/// A polygon, cut by lines, has the areas of its parts; so have two hyperbolas of a saddle.
#[test]
fn straight_lines_and_saddles() {
    let hexagon = [
        [0.2, 0.0],
        [0.9, 0.0],
        [1.0, 0.3],
        [0.8, 1.0],
        [0.1, 0.9],
        [0.0, 0.4],
    ];
    let whole = polygon(&hexagon);
    for at in [-1.0, 0.05, 0.2, 0.33, 0.5, 0.85, 0.95, 2.0] {
        let [below, above] = whole.split(Axis::X, at);
        let expected = [&whole, &above].map(|p| p.triangles().map(doubled_area).sum::<f64>());
        let found = areas(&whole, &level([[-at, 1.0 - at]; 2]));
        for (found, expected) in found.into_iter().zip(expected) {
            let near = (found - 0.5 * expected).abs() < 1e-12;
            assert!(near, "{at}: {found}, {expected}, {below:?}");
        }
    }
    // (x - 1/2) (y - 1/2) >= 1/16, on both sides of the middle.
    let c = 1.0 / 16.0;
    let saddle = level([[0.25 - c, -0.25 - c], [-0.25 - c, 0.25 - c]]);
    let each = 0.25 - c * (1.0 - (4.0 * c).ln());
    let [all, part] = areas(&polygon(&SQUARE), &saddle);
    assert!((all - 1.0).abs() < 1e-12, "{all}");
    assert!((part - 2.0 * each).abs() < 1e-7, "{part}, {each}");
}

/// What a mapping shrinks to a line keeps its surface, and so does what it shrinks to a point.
#[test]
fn surfaces_without_a_place_of_their_own() {
    let uvs = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
    let shown = |place: fn(DVec2) -> DVec2| {
        let corner = |uv: [f64; 2]| Corner {
            uv: uv.into(),
            place: place(uv.into()),
        };
        UvPolygon::new(&uvs.map(corner))
    };
    let level = level([[-0.5, 0.5]; 2]);
    let [all, above] = areas(&shown(|uv| DVec2::new(0.5 * uv.x, 0.25)), &level);
    assert!(
        (all - 2.0).abs() < 1e-12 && (above - 0.5).abs() < 1e-12,
        "x: {all}, {above}"
    );
    let [all, above] = areas(&shown(|uv| DVec2::new(0.75, uv.y)), &level);
    assert!(
        (all - 2.0).abs() < 1e-12 && (above - 2.0).abs() < 1e-12,
        "y: {all}, {above}"
    );
    let [all, above] = areas(&shown(|uv| DVec2::new(0.5, uv.y)), &level);
    assert!(
        (all - 2.0).abs() < 1e-12 && (above - 2.0).abs() < 1e-12,
        "on the level itself: {all}, {above}"
    );
    for (place, expected) in [
        (DVec2::ZERO, [2.0, 0.0]),
        (DVec2::new(0.75, 0.25), [2.0; 2]),
    ] {
        let shown = polygon(&uvs).with_places(|_| place);
        assert_eq!(areas(&shown, &level), expected, "the point {place}");
    }
}
