use alloc::format;
use alloc::vec;
use alloc::vec::Vec;
use std::io;
use std::path::Path;

use light_bounds::LightExtent;
use light_math::Aabb;

use crate::build::morton::{Grid, KEY_BITS};
use crate::build::scan::Scan;
use crate::out_of_core::group::{Group, GroupWriter};

/// Eight cells along each axis: as many files are open at once, of the 1,024 that systems allow.
const CELL_BITS: u32 = 9;

/// Divides lights among scratch files, by the cells of space in which their centres are.
#[derive(Debug)]
pub(super) struct Cells<'a> {
    scratch: &'a Path,
    /// The most lights of a group.
    most: usize,
    /// Files made so far.
    files: usize,
}

impl<'a> Cells<'a> {
    pub(super) const fn new(scratch: &'a Path, most: usize) -> Self {
        Self {
            scratch,
            most,
            files: 0,
        }
    }

    /// No lights yet, of which there will be `count` with centres in the box `centers`.
    pub(super) fn begin(&self, count: usize, centers: &Aabb) -> Distribution {
        Distribution {
            cells: (0..1 << CELL_BITS).map(|_| None).collect(),
            grid: if count > self.most {
                Grid::new(centers)
            } else {
                None
            },
            full: Vec::new(),
        }
    }

    /// Adds a light.
    pub(super) fn add(
        &mut self,
        to: &mut Distribution,
        id: u32,
        light: &LightExtent,
    ) -> io::Result<()> {
        let slot = &mut to.cells[cell(to.grid.as_ref(), light)];
        let in_order = to.grid.is_none();
        if let Some(full) = slot.take_if(|writer| in_order && writer.count() == self.most) {
            to.full.push(full.finish()?);
        }
        let writer = match slot {
            Some(writer) => writer,
            None => slot.insert(self.new_group()?),
        };
        writer.add(id, light)
    }

    fn new_group(&mut self) -> io::Result<GroupWriter> {
        let name = format!("lights-{}.part", self.files);
        self.files += 1;
        GroupWriter::create(self.scratch.join(name))
    }

    /// The groups of all lights that were added, along a Morton curve.
    pub(super) fn finish(&mut self, lights: Distribution) -> io::Result<Vec<Group>> {
        let mut all = lights.full;
        let mut cells = Vec::new();
        for writer in lights.cells.into_iter().flatten() {
            cells.push(writer.finish()?);
        }
        for cell in cells {
            all.append(&mut self.divide(cell)?);
        }
        Ok(all)
    }

    /// The group, or its parts where it has too many lights. These are in smaller cells: a box of
    /// centres is never one cell, so that it ends.
    fn divide(&mut self, group: Group) -> io::Result<Vec<Group>> {
        let Scan { count, centers, .. } = group.sums.scan;
        if count <= self.most {
            return Ok(vec![group]);
        }
        let mut parts = self.begin(count, &centers);
        group.for_each(|id, light| self.add(&mut parts, id, light))?;
        drop(group);
        self.finish(parts)
    }
}

/// Lights on their way into groups.
#[derive(Debug)]
pub(super) struct Distribution {
    /// `None`: groups are filled one after the other.
    grid: Option<Grid>,
    cells: Vec<Option<GroupWriter>>,
    /// Groups that are full.
    full: Vec<Group>,
}

fn cell(grid: Option<&Grid>, light: &LightExtent) -> usize {
    let key = match (grid, light.bounded()) {
        (Some(grid), Some(bounds)) => grid.key(bounds.bounds.center()) >> (KEY_BITS - CELL_BITS),
        _ => 0,
    };
    usize::try_from(key).unwrap_or(0)
}
