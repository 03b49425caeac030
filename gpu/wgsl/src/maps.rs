//! Alias tables, octahedral codes and the equal-area map against those of light-math.

use light_gpu::alias_table_rows;
use light_math::distribution::AliasTable;
use light_math::glam::{Vec2, Vec3};
use light_math::{OctahedralVector, equal_area};

use crate::device::Device;
use crate::query::{Mapped, Query};

/// How far a unit vector or a place may be off, along each axis.
const ERROR: f32 = 2e-6;

/// Whether the shader answers as the crates do: an alias table with the same bits, octahedral codes
/// at most one step off, directions and places within `ERROR`.
///
/// # Errors
/// One line by the driver.
pub fn check(device: &Device, queries: &[Query]) -> Result<bool, String> {
    let weights: Vec<f32> = (0..1000u16).map(|i| f32::from(i % 97)).collect();
    let table = AliasTable::new(&weights).map_err(|e| e.to_string())?;
    let rows = alias_table_rows(table.bins());
    let (answers, _) = device.run::<Mapped>(("map", 3), &rows, queries)?;
    let mut unlike = 0;
    let mut steps = 0;
    let [mut decoded, mut direction, mut place] = [0.0f32; 3];
    for (query, theirs) in queries.iter().zip(&answers) {
        let sampled = table.sample(query.u());
        let rest = [(sampled.u >> 32) as u32, sampled.u as u32];
        let same = (sampled.index as u32, sampled.pmf, rest);
        unlike += u32::from(same != (theirs.index, theirs.pmf, theirs.u));
        let code = OctahedralVector::from_bits(theirs.code);
        let ((x, y), (x2, y2)) = (code.xy(), OctahedralVector::encode(query.n()).xy());
        steps = steps.max(x.abs_diff(x2).max(y.abs_diff(y2)));
        let off = |a: Vec3, b: [f32; 3]| (a - Vec3::from(b)).abs().max_element();
        decoded = decoded.max(off(code.decode(), theirs.decoded));
        let [high, low] = [query.u() >> 40, (query.u() & 0xffff_ffff) >> 8];
        let square = Vec2::new(high as f32, low as f32) / 16_777_216.0;
        direction = direction.max(off(equal_area::square_to_sphere(square), theirs.direction));
        let back = equal_area::sphere_to_square(theirs.direction.into());
        place = place.max((back - Vec2::from(theirs.place)).abs().max_element());
    }
    println!("\nalias table: {unlike} samples differ");
    println!("octahedral codes: at most {steps} steps off; decoded {decoded:.1e} off");
    println!("equal-area map: directions {direction:.1e}, places {place:.1e} off");
    Ok(unlike == 0 && steps <= 1 && decoded.max(direction).max(place) <= ERROR)
}
