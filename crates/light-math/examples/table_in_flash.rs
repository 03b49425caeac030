//! Tables that the compiler builds: nothing is allocated, nothing runs at start-up, and on a
//! microcontroller the numbers stay in read-only memory.
//!
//! `cargo run -p light-math --example table_in_flash`; it needs no allocator and builds for bare
//! targets as it is, but for the printing.

use light_math::distribution::{
    AliasBin, AliasTable, PiecewiseConstant1D, PiecewiseConstant2D, SummedAreaTable, TableError,
    Window, WindowedPiecewiseConstant2D,
};
use light_math::fraction;
use light_math::glam::Vec2;

/// Brightness of the lamps of a chain, to pick one in proportion.
const LAMPS: [f32; 5] = [1.0, 0.0, 4.0, 2.0, 1.0];
static CHAIN: AliasTable<[AliasBin; LAMPS.len()]> = match AliasTable::in_array(&LAMPS) {
    Ok(table) => table,
    Err(_) => panic!("a weight that makes no sense stops the build here"),
};

/// Intensity of a lamp by angle from its axis, in six steps up to 90 degrees.
const PROFILE: [f32; 6] = [9.0, 8.0, 6.0, 3.0, 1.0, 0.0];
static BY_ANGLE: PiecewiseConstant1D<[f32; PiecewiseConstant1D::table_len(PROFILE.len())]> =
    match PiecewiseConstant1D::in_array(&PROFILE) {
        Ok(table) => table,
        Err(_) => panic!("valid weights"),
    };

/// A sky of four by three texels, bright in one corner.
const SKY: [f32; 12] = [
    0.1, 0.1, 0.2, 0.3, //
    0.1, 0.3, 0.9, 1.0, //
    0.2, 0.5, 1.0, 8.0,
];
static WHOLE_SKY: PiecewiseConstant2D<[f32; PiecewiseConstant2D::table_len(4, 3)]> =
    match PiecewiseConstant2D::in_array(&SKY, 4, 3) {
        Ok(table) => table,
        Err(_) => panic!("valid weights"),
    };
static SKY_IN_PARTS: WindowedPiecewiseConstant2D<[u64; SKY.len()]> =
    match SummedAreaTable::in_array(&SKY, 4, 3) {
        Ok(table) => WindowedPiecewiseConstant2D::new(table),
        Err(_) => panic!("valid weights"),
    };

fn main() -> Result<(), TableError> {
    let lamp = CHAIN.sample(fraction::from_f64(0.6));
    println!("lamp {} with probability {}", lamp.index, lamp.pmf);

    let angle = BY_ANGLE.sample(0.3);
    println!("{:.1} degrees from its axis", 90.0 * angle.x);

    let texel = WHOLE_SKY.sample(Vec2::new(0.5, 0.9));
    println!("the sky at {}, density {:.3}", texel.p, texel.pdf);

    // The same sky through a window, without a second table.
    let seen = Window::new(Vec2::new(0.1, 0.2), Vec2::new(0.7, 0.6));
    if let Some(texel) = SKY_IN_PARTS.sample(Vec2::new(0.5, 0.9), &seen) {
        println!(
            "through the window at {}, density {:.3}",
            texel.p, texel.pdf
        );
    }

    // A caller's buffer serves as well.
    let mut buffer = [0.0; PiecewiseConstant1D::table_len(3)];
    let borrowed = PiecewiseConstant1D::build_into(&[1.0, 2.0, 1.0], &mut buffer)?;
    println!("a table on the stack: {:?}", borrowed.cdf());
    Ok(())
}
