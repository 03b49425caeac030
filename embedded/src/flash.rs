//! The scene in flash, as the build script wrote it: borrowed, never copied.

use light_bvh::StoredLightBvh;
use light_math::OctahedralVector;
use light_math::distribution::{AliasBin, AliasTable, PiecewiseConstant2D};
use light_photometry::{PhotometricWebRef, WebType};

use crate::light_record::LightRecord;
use crate::scene_records::{PointRecord, SkyRecord, WebRecord};
use crate::sky::Sky;

/// Bytes at a multiple of 32, as a tree needs them.
#[repr(C, align(32))]
struct Aligned<T: ?Sized>(T);

/// The bytes of a file of the build script.
macro_rules! flash {
    ($file:literal) => {{
        static BYTES: &Aligned<[u8]> =
            &Aligned(*include_bytes!(concat!(env!("OUT_DIR"), "/", $file)));
        &BYTES.0
    }};
}

/// What the build script wrote is of the right form: everything else is a fault of the build.
fn sound<T, E>(result: Result<T, E>) -> T {
    match result {
        Ok(value) => value,
        Err(_) => panic!("the scene in flash is not what the build script writes"),
    }
}

fn slice<T: bytemuck::AnyBitPattern>(bytes: &'static [u8]) -> &'static [T] {
    sound(bytemuck::try_cast_slice(bytes))
}

/// One record, and the numbers behind it.
fn record<T: bytemuck::AnyBitPattern>(bytes: &'static [u8]) -> (T, &'static [f32]) {
    let (head, numbers) = bytes.split_at(size_of::<T>());
    (slice::<T>(head)[0], slice(numbers))
}

/// The tree of all lights with a position.
pub(crate) fn tree() -> StoredLightBvh<'static> {
    sound(StoredLightBvh::from_bytes(flash!("tree.bin")))
}

/// All lights with a position, by id.
pub(crate) fn lights() -> &'static [LightRecord] {
    slice(flash!("lights.bin"))
}

/// Their powers as an alias table.
pub(crate) fn powers() -> AliasTable<&'static [AliasBin]> {
    sound(AliasTable::from_bins(slice(flash!("powers.bin"))))
}

/// Their axes.
pub(crate) fn axes() -> &'static [OctahedralVector] {
    slice(flash!("axes.bin"))
}

/// Points on surfaces.
pub(crate) fn points() -> &'static [PointRecord] {
    slice(flash!("points.bin"))
}

/// The sky.
pub(crate) fn sky() -> Sky {
    let (record, numbers) = record::<SkyRecord>(flash!("sky.bin"));
    let n = record.size as usize;
    let (table, texels) = numbers.split_at(PiecewiseConstant2D::table_len(n, n));
    Sky {
        record,
        texels: sound(bytemuck::try_cast_slice(texels)),
        table: sound(PiecewiseConstant2D::from_table(table, n, n, record.mean)),
    }
}

/// The intensities of a lamp.
pub(crate) fn web() -> PhotometricWebRef<'static> {
    let (record, numbers) = record::<WebRecord>(flash!("web.bin"));
    let (vertical, rest) = numbers.split_at(record.vertical as usize);
    let (horizontal, candelas) = rest.split_at(record.horizontal as usize);
    sound(PhotometricWebRef::new(
        WebType::C,
        vertical,
        horizontal,
        candelas,
    ))
}
