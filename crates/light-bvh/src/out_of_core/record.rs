use std::io::{self, Read, Write};

use light_bounds::{EmissionLobe, LightBounds, LightExtent};
use light_math::Aabb;
use light_math::glam::Vec3;

/// A light in a scratch file, and its [`LobeRecord`] after it if it has one.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Record {
    light: u32,
    flags: u32,
    bounds: [[f32; 3]; 2],
    w: [f32; 3],
    phi: f32,
    cos_theta: [f32; 2],
}

const TWO_SIDED: u32 = 1;
const HAS_LOBE: u32 = 2;

#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct LobeRecord {
    power: f32,
    mean: [f32; 3],
    spread: f32,
}

/// Appends a light with a position.
pub(super) fn write(out: &mut impl Write, light: u32, extent: &LightExtent) -> io::Result<()> {
    let (bounds, lobe) = match extent {
        LightExtent::Bounded(bounds) => (bounds, None),
        LightExtent::Lobe(bounds, lobe) => (bounds, Some(lobe)),
        LightExtent::Infinite(_) => return Ok(()),
    };
    let flag = |is_set: bool, flag: u32| if is_set { flag } else { 0 };
    out.write_all(bytemuck::bytes_of(&Record {
        light,
        flags: flag(bounds.two_sided, TWO_SIDED) | flag(lobe.is_some(), HAS_LOBE),
        bounds: [bounds.bounds.min, bounds.bounds.max].map(|p| p.to_array()),
        w: bounds.w.to_array(),
        phi: bounds.phi,
        cos_theta: [bounds.cos_theta_o, bounds.cos_theta_e],
    }))?;
    lobe.map_or(Ok(()), |lobe| {
        out.write_all(bytemuck::bytes_of(&LobeRecord {
            power: lobe.power,
            mean: lobe.mean.to_array(),
            spread: lobe.spread,
        }))
    })
}

/// The next light, and its id.
pub(super) fn read(from: &mut impl Read) -> io::Result<(u32, LightExtent)> {
    let record: Record = pod(from)?;
    let [min, max] = record.bounds.map(Vec3::from_array);
    let [cos_theta_o, cos_theta_e] = record.cos_theta;
    let bounds = LightBounds {
        bounds: Aabb { min, max },
        w: Vec3::from_array(record.w),
        phi: record.phi,
        cos_theta_o,
        cos_theta_e,
        two_sided: record.flags & TWO_SIDED != 0,
    };
    if record.flags & HAS_LOBE == 0 {
        return Ok((record.light, LightExtent::Bounded(bounds)));
    }
    let lobe: LobeRecord = pod(from)?;
    let lobe = EmissionLobe {
        power: lobe.power,
        mean: Vec3::from_array(lobe.mean),
        spread: lobe.spread,
    };
    Ok((record.light, LightExtent::Lobe(bounds, lobe)))
}

fn pod<T: bytemuck::Pod>(from: &mut impl Read) -> io::Result<T> {
    let mut value = T::zeroed();
    from.read_exact(bytemuck::bytes_of_mut(&mut value))?;
    Ok(value)
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    #[test]
    fn lights_come_back() {
        let bounds = LightBounds {
            bounds: Aabb::new(Vec3::new(1.0, 2.0, 3.0), Vec3::new(4.0, 5.0, 6.0)),
            w: Vec3::Y,
            phi: 7.0,
            cos_theta_o: 0.5,
            cos_theta_e: -0.25,
            two_sided: true,
        };
        let lobe = EmissionLobe {
            power: 8.0,
            mean: Vec3::new(0.1, 0.2, 0.3),
            spread: 0.4,
        };
        let one_sided = LightBounds {
            two_sided: false,
            ..bounds
        };
        let lights = [
            LightExtent::Bounded(bounds),
            LightExtent::Lobe(one_sided, lobe),
            LightExtent::Bounded(one_sided),
        ];
        let mut bytes = Vec::new();
        for (id, light) in (7..).zip(&lights) {
            write(&mut bytes, id, light).expect("memory");
        }
        let mut from = &*bytes;
        for (id, light) in (7..).zip(lights) {
            assert_eq!(read(&mut from).expect("a light"), (id, light), "light {id}");
        }
        assert!(read(&mut from).is_err(), "no more");
    }
}
