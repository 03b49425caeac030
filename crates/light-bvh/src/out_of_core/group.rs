use alloc::vec::Vec;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Write};
use std::path::PathBuf;

use light_bounds::LightExtent;
use light_math::glam::Vec3;

use crate::build::group_extent::group_extent;
use crate::build::light_primitive::LightPrimitive;
use crate::build::lights::phi;
use crate::build::scan::Scan;
use crate::out_of_core::record;

/// Sums over the lights of a group, by which the upper tree is built.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroupSums {
    pub(super) scan: Scan,
    /// Means of centres and axes, weighted by power.
    center: Vec3,
    axis: Vec3,
}

impl GroupSums {
    pub(super) const NOTHING: Self = Self {
        scan: Scan::NOTHING,
        center: Vec3::ZERO,
        axis: Vec3::ZERO,
    };

    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    fn add(&mut self, extent: &LightExtent) {
        let Some(bounds) = extent.bounded() else {
            return;
        };
        let power = phi(extent);
        let primitive = LightPrimitive::new(0, bounds, power);
        self.scan.add(power, primitive.center);
        if power > 0.0 {
            let share = (f64::from(power) / self.scan.power) as f32;
            self.center += (primitive.center - self.center) * share;
            self.axis += (primitive.axis - self.axis) * share;
        }
    }

    /// The group as if it were one light.
    pub(super) fn extent(&self) -> LightExtent {
        let Scan { power, centers, .. } = self.scan;
        if power > 0.0 {
            group_extent(self.center, self.axis, Some(power))
        } else {
            group_extent(centers.center(), Vec3::ZERO, None)
        }
    }
}

/// Lights in a scratch file, which is removed with the value.
#[derive(Debug)]
pub(super) struct Group {
    pub(super) sums: GroupSums,
    path: PathBuf,
}

impl Group {
    /// The lights, in the order in which they were written, and their ids.
    pub(super) fn read(&self) -> io::Result<(Vec<u32>, Vec<LightExtent>)> {
        let mut ids = Vec::with_capacity(self.sums.scan.count);
        let mut lights = Vec::with_capacity(self.sums.scan.count);
        self.for_each(|id, light| {
            ids.push(id);
            lights.push(*light);
            Ok(())
        })?;
        Ok((ids, lights))
    }

    /// Calls `each` with the id of each light, and the light.
    pub(super) fn for_each(
        &self,
        mut each: impl FnMut(u32, &LightExtent) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut file = BufReader::with_capacity(1 << 20, File::open(&self.path)?);
        for _ in 0..self.sums.scan.count {
            let (id, light) = record::read(&mut file)?;
            each(id, &light)?;
        }
        Ok(())
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        // What cannot be removed stays behind in the caller's folder; there is no one to tell.
        let _ = fs::remove_file(&self.path);
    }
}

/// A group that grows.
#[derive(Debug)]
pub(super) struct GroupWriter {
    file: BufWriter<File>,
    group: Group,
}

impl GroupWriter {
    /// A group in a new file.
    pub(super) fn create(path: PathBuf) -> io::Result<Self> {
        let file = BufWriter::with_capacity(1 << 16, File::create_new(&path)?);
        let sums = GroupSums::NOTHING;
        let group = Group { sums, path };
        Ok(Self { file, group })
    }

    /// Lights so far.
    pub(super) const fn count(&self) -> usize {
        self.group.sums.scan.count
    }

    pub(super) fn add(&mut self, id: u32, light: &LightExtent) -> io::Result<()> {
        self.group.sums.add(light);
        record::write(&mut self.file, id, light)
    }

    pub(super) fn finish(mut self) -> io::Result<Group> {
        self.file.flush()?;
        Ok(self.group)
    }
}
