use super::*;
use crate::float::ONE_MINUS_EPSILON;

const WEIGHTS: [f32; 6] = [0.0, 1.0, 3.0, 0.0, 0.0, 4.0];

#[test]
fn samples_densities_and_inverses() {
    let d = PiecewiseConstant2D::new(&WEIGHTS, 3, 2).expect("valid weights");
    let d = d
        .over(Vec2::new(-1.0, 0.0), Vec2::new(2.0, 2.0))
        .expect("domain");
    assert_eq!(d.integral(), 8.0, "integral");
    assert_eq!(d.pdf(Vec2::new(0.5, 0.5)), 0.125, "density");
    assert_eq!(d.pdf(Vec2::new(0.5, 1.5)), 0.0, "empty texel");
    assert_eq!(d.pdf(Vec2::new(3.0, 1.5)), 0.0, "outside");
    for x in [0.0, 0.2, 0.25, 0.9, ONE_MINUS_EPSILON] {
        for y in [0.0, 0.2, 0.5, 0.9, ONE_MINUS_EPSILON] {
            let u = Vec2::new(x, y);
            let s = d.sample(u);
            assert!(s.pdf > 0.0 && s.pdf == d.pdf(s.p), "density at {u}");
            let back = d.invert(s.p).expect("inside");
            assert!(back.distance(u) < 1e-6, "round trip of {u}: {back}");
        }
    }
    assert_eq!(d.invert(Vec2::splat(5.0)), None, "outside");
}

#[test]
fn empty_rows_at_both_ends_are_never_reached() {
    let mut weights = [0.0; 100];
    for (i, weight) in weights[30..70].iter_mut().enumerate() {
        *weight = 0.1 + i as f32 / 7.0;
    }
    let d = PiecewiseConstant2D::new(&weights, 10, 10).expect("valid weights");
    for y in [0.0, 1e-9, 0.5, 0.999_999_9, ONE_MINUS_EPSILON] {
        let s = d.sample(Vec2::splat(y));
        assert!((3..7).contains(&s.texel[1]) && s.pdf > 0.0, "row at {y}");
    }
}

#[test]
fn storage_is_a_choice() {
    static IN_FLASH: PiecewiseConstant2D<[f32; 17]> =
        match PiecewiseConstant2D::in_array(&WEIGHTS, 3, 2) {
            Ok(table) => table,
            Err(_) => panic!("valid weights"),
        };
    let mut buffer = [0.0; PiecewiseConstant2D::table_len(3, 2)];
    let borrowed = PiecewiseConstant2D::build_into(&WEIGHTS, 3, 2, &mut buffer).expect("fits");
    assert_eq!(IN_FLASH.table(), borrowed.table(), "same builder");
    let again = PiecewiseConstant2D::from_table(borrowed.table(), 3, 2, borrowed.mean());
    assert_eq!(again, Ok(borrowed), "stored and used again");
    let wrong = PiecewiseConstant2D::from_table(&borrowed.table()[1..], 3, 2, 1.0);
    assert!(wrong.is_err(), "shifted");
    let wrong = [0.0, f32::NAN, f32::INFINITY]
        .map(|mean| PiecewiseConstant2D::from_table(borrowed.table(), 3, 2, mean).err());
    assert_eq!(wrong, [Some(TableError::Malformed); 3], "means");
    let mut falling = IN_FLASH.table().to_vec();
    falling.reverse();
    let wrong = PiecewiseConstant2D::from_table(falling, 3, 2, 1.0).err();
    assert_eq!(wrong, Some(TableError::Malformed), "reversed");
}

#[test]
fn refuses() {
    let new = |w: &[f32], nx, ny| PiecewiseConstant2D::new(w, nx, ny).map(|_| ());
    let mismatch = |expected, found| Err(TableError::SizeMismatch { expected, found });
    assert_eq!(new(&[1.0; 5], 3, 2), mismatch(6, 5), "missing texel");
    assert_eq!(
        new(&[1.0], usize::MAX, 2),
        mismatch(usize::MAX, 1),
        "nonsense size"
    );
    assert_eq!(new(&[], 0, 0), Err(TableError::Empty), "empty");
    assert_eq!(new(&[0.0; 4], 2, 2), Err(TableError::AllZero), "zero");
    let over = |max: Vec2| {
        let table = PiecewiseConstant2D::new(&[1.0], 1, 1).expect("valid weights");
        table.over(Vec2::ZERO, max).map(|_| ())
    };
    assert_eq!(over(Vec2::X), Err(TableError::Domain), "flat");
    for [x, y] in [[1e30, 1e30], [1e-30, 1e-30]] {
        let found = over(Vec2::new(x, y));
        assert_eq!(found, Err(TableError::Overflow), "{x} by {y}");
    }
}
