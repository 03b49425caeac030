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
            // Wherever the texel is.
            for shift in [0.0, 3.0] {
                let square = SQUARE.map(|corner| corner.map(|x| x + shift));
                let level = Level {
                    start: DVec2::splat(-shift),
                    ..level(corners)
                };
                let [all, above] = areas(&polygon(&square), &level);
                assert!((all - 1.0).abs() < 1e-12, "{c}: {all}");
                let near = (above - expected).abs() < 1e-7;
                assert!(near, "{c}: {above}, {expected}");
            }
        }
    }
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
    assert_eq!(
        areas(&shown(|_| DVec2::ZERO), &level),
        [2.0, 0.0],
        "a point"
    );
}
