use super::*;
use alloc::vec::Vec;
use light_testkit::Rng;

const CELLS: u32 = 16;
const _: () = assert!(CELLS as usize == MajorantGrid::CELLS, "as many");

fn grid(rng: &mut Rng) -> MajorantGrid {
    let values: Vec<f32> = (0..CELLS.pow(3)).map(|_| rng.f32()).collect();
    MajorantGrid::new([CELLS; 3], values.into_iter())
}

/// The coordinates of `p` in cells, and the cell that holds it.
#[expect(clippy::cast_possible_truncation, reason = "within the grid")]
fn cell(p: Vec3) -> (Vec3, [i32; 3]) {
    let place = p * CELLS as f32;
    (place, place.floor().to_array().map(|x| x as i32))
}

/// Random rays through two layers: the segments follow each other from end to end of the span, and
/// the bound at each point is the sum of the maxima of its cell in both layers.
#[test]
fn a_walk_has_the_bound_of_the_cell_that_it_is_in() {
    let mut rng = Rng::new(81);
    let grids = [grid(&mut rng), grid(&mut rng)];
    let factors = [0.75, 2.0];
    let layers = [0, 1].map(|i| Some((&grids[i], factors[i])));
    let mut compared = 0;
    for i in 0..400 {
        let mut inside = || Vec3::new(rng.f32(), rng.f32(), rng.f32());
        let (o, to) = (inside(), inside());
        // Some rays are parallel to one axis or to two.
        let d = (to - o) * [Vec3::ONE, Vec3::new(1.0, 0.0, 1.0), Vec3::Y][i % 3];
        let (ray, span) = (Ray { o, d }, Span { t0: 0.1, t1: 0.9 });
        let mut t = span.t0;
        for segment in Majorants::cells(span, layers, &ray, Vec3::ZERO) {
            assert_eq!(segment.span.t0, t, "{ray:?} without gaps");
            t = segment.span.t1;
            let middle = ray.at(0.5 * (segment.span.t0 + t));
            let (place, cell) = cell(middle);
            if (place - place.round()).abs().min_element() > 1e-3 {
                let bound: f32 = (0..2).map(|i| grids[i].get(cell) * factors[i]).sum();
                assert_eq!(segment.sigma_maj, bound, "{ray:?} at {middle}");
                compared += 1;
            }
            for end in [segment.span.t0, t] {
                let half = (ray.at(end) - middle).abs().max_element() * CELLS as f32;
                assert!(half < 0.501, "{ray:?}: {segment:?} is longer than a cell");
            }
        }
        assert_eq!(t, span.t1, "{ray:?} to the end");
    }
    assert!(compared > 2000, "{compared} segments");
}

/// The rest of a ray beyond the grid belongs to the last cell, on both sides.
#[test]
fn a_walk_ends_with_the_last_cell_of_the_grid() {
    let grid = grid(&mut Rng::new(82));
    let span = Span { t0: 0.0, t1: 9.0 };
    for (d, last) in [(Vec3::NEG_Z, 0), (Vec3::Z, 15)] {
        let o = Vec3::new(0.5, 0.5, 0.53);
        let layers = [Some((&grid, 1.0)), None];
        let walk = Majorants::cells(span, layers, &Ray { o, d }, Vec3::ZERO);
        let segments: Vec<MajorantSegment> = walk.collect();
        assert_eq!(
            segments.len(),
            if last == 0 { 9 } else { 8 },
            "cells along {d}"
        );
        let end = segments[segments.len() - 1];
        assert_eq!(
            (end.span.t1, end.sigma_maj),
            (9.0, grid.get([8, 8, last])),
            "{d}"
        );
    }
}
