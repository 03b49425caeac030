use alloc::vec;
use alloc::vec::Vec;
use std::io::{self, Seek, SeekFrom, Write};

use crate::build::builder::build;
use crate::build::lights::Lights;
use crate::build::options::LightBvhOptions;
use crate::build::refit;
use crate::build::scan::{Scan, expect_addressable};
use crate::build::topology::low_word;
use crate::bytes::{HEADER, Header};
use crate::node::moments::Moments;
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::out_of_core::error::OutOfCoreError;
use crate::out_of_core::group::Group;

/// Writes the bytes of a tree from the first node to the last.
///
/// Nodes are in the order of every tree: the children of a node side by side, then what is below
/// the first of them. So a refit of the tree in the bytes works as of any other.
pub(super) struct TreeWriter<'o, W> {
    out: &'o mut W,
    /// Where the tree begins in `out`.
    start: u64,
    /// Nodes written so far, those without content included.
    nodes: usize,
    /// Nodes whose content became known after they were written.
    late: Vec<(usize, WideNode)>,
    order: Vec<u32>,
    slots: Vec<u32>,
    power: f64,
    options: LightBvhOptions,
}

/// Where a node is in the tree.
#[derive(Clone, Copy)]
pub(super) struct Place {
    index: usize,
    /// Slot of the node in its parent.
    parent: u32,
    /// Levels above it.
    depth: usize,
}

impl Place {
    const ROOT: Self = Self {
        index: 0,
        parent: NOWHERE,
        depth: 0,
    };

    fn child(self, base: usize, k: usize) -> Self {
        Self {
            index: base + k,
            parent: low_word(self.index * WIDTH + k),
            depth: self.depth + 1,
        }
    }
}

/// The upper tree: its nodes, whose lights are groups, and these in the order that the nodes refer
/// to.
pub(super) struct UpperTree {
    pub(super) nodes: Vec<WideNode>,
    pub(super) groups: Vec<Option<Group>>,
}

impl<'o, W: Write + Seek> TreeWriter<'o, W> {
    /// No node yet of a tree of `scan`, with slots for `lights` lights.
    pub(super) fn new(
        out: &'o mut W,
        lights: usize,
        scan: &Scan,
        options: LightBvhOptions,
    ) -> io::Result<Self> {
        let start = out.stream_position()?;
        out.write_all(&[0; HEADER])?;
        Ok(Self {
            out,
            start,
            nodes: 0,
            late: Vec::new(),
            order: Vec::with_capacity(scan.count),
            slots: vec![NOWHERE; lights],
            power: scan.power,
            options,
        })
    }

    /// Writes the whole tree; `progress` is told how many lights are in it.
    pub(super) fn write(
        &mut self,
        mut tree: UpperTree,
        progress: &mut dyn FnMut(usize),
    ) -> Result<(), OutOfCoreError> {
        if !tree.groups.is_empty() {
            let base = self.reserve(1)?;
            debug_assert_eq!(base, 0, "the root comes first");
            if let [group] = &mut *tree.groups {
                self.group(Place::ROOT, group.take(), progress)?;
            } else {
                self.upper_node(Place::ROOT, 0, &mut tree, progress)?;
            }
        }
        Ok(())
    }

    /// Writes what follows the nodes, and what is known at the end; the number of nodes and of
    /// bytes.
    pub(super) fn finish(self, power: f32) -> io::Result<(usize, u64)> {
        let counts = [self.nodes, self.order.len(), self.slots.len(), 0];
        self.out.write_all(bytemuck::cast_slice(&self.order))?;
        self.out.write_all(bytemuck::cast_slice(&self.slots))?;
        let end = self.out.stream_position()?;
        for (index, node) in &self.late {
            let offset = HEADER + index * size_of::<WideNode>();
            self.out.seek(SeekFrom::Start(self.start + offset as u64))?;
            self.out.write_all(bytemuck::bytes_of(node))?;
        }
        self.out.seek(SeekFrom::Start(self.start))?;
        let header = Header::new(counts, power);
        self.out.write_all(bytemuck::bytes_of(&header))?;
        self.out.seek(SeekFrom::Start(end))?;
        self.out.flush()?;
        Ok((self.nodes, end - self.start))
    }

    /// Room for so many nodes whose content is not known yet; the place of the first.
    fn reserve(&mut self, count: usize) -> io::Result<usize> {
        let base = self.nodes;
        for _ in 0..count {
            self.out.write_all(bytemuck::bytes_of(&WideNode::EMPTY))?;
        }
        self.nodes += count;
        Ok(base)
    }

    /// Writes a node of the upper tree and what is below it.
    fn upper_node(
        &mut self,
        place: Place,
        upper: usize,
        tree: &mut UpperTree,
        progress: &mut dyn FnMut(usize),
    ) -> Result<Moments, OutOfCoreError> {
        let (node, light_base) = (tree.nodes[upper], low_word(self.order.len()));
        let (inner, count) = (usize::from(node.inner), usize::from(node.count));
        let base = self.reserve(count)?;
        let mut moments = [Moments::NOTHING; WIDTH];
        for (k, moments) in moments[..count].iter_mut().enumerate() {
            let child = place.child(base, k);
            *moments = if k < inner {
                self.upper_node(child, node.child_base as usize + k, tree, progress)?
            } else {
                let group = tree.groups[node.light_base as usize + k - inner].take();
                self.group(child, group, progress)?
            };
        }
        let mut node = WideNode {
            inner: node.count,
            count: node.count,
            child_base: low_word(base),
            light_base,
            parent: place.parent,
            ..WideNode::EMPTY
        };
        let moments = &moments[..count];
        node.encode_children(moments);
        self.late.push((place.index, node));
        Ok(Moments::join(moments))
    }

    /// Writes the tree of a group, whose root has a place already.
    fn group(
        &mut self,
        root: Place,
        group: Option<Group>,
        progress: &mut dyn FnMut(usize),
    ) -> Result<Moments, OutOfCoreError> {
        let Some(group) = group else {
            return Ok(Moments::NOTHING);
        };
        let (ids, lights) = group.read()?;
        let scan = group.sums.scan;
        // Its file is not needed any more.
        drop(group);
        let (topology, order) = build(&lights, &scan, &self.options, root.depth);
        let mut nodes = topology.nodes();
        let moments = refit::fill(&mut nodes, &order, &Lights::new(&lights, self.power));
        self.add(root, nodes, order.iter().map(|&k| ids[k as usize]))?;
        progress(self.order.len());
        Ok(moments)
    }

    /// Adds a tree of some of the lights: its nodes, of which the first is at `root`, and the ids
    /// of its lights in its order.
    fn add(
        &mut self,
        root: Place,
        mut nodes: Vec<WideNode>,
        ids: impl Iterator<Item = u32>,
    ) -> Result<(), OutOfCoreError> {
        // What is below the root follows what was written before.
        let below = self.nodes;
        let index = |k: usize| if k == 0 { root.index } else { below + k - 1 };
        expect_addressable(below + nodes.len())?;
        let light_base = low_word(self.order.len());
        self.order.extend(ids);
        for (k, node) in nodes.iter_mut().enumerate() {
            node.child_base = low_word(index(node.child_base as usize));
            node.light_base += light_base;
            node.parent = match node.parent as usize {
                _ if k == 0 => root.parent,
                slot => low_word(index(slot / WIDTH) * WIDTH + slot % WIDTH),
            };
            let own = usize::from(node.inner)..usize::from(node.count);
            for (child, &light) in own.zip(&self.order[node.light_base as usize..]) {
                self.slots[light as usize] = low_word(index(k) * WIDTH + child);
            }
        }
        if let Some((first, rest)) = nodes.split_first() {
            self.late.push((root.index, *first));
            self.out.write_all(bytemuck::cast_slice(rest))?;
            self.nodes += rest.len();
        }
        Ok(())
    }
}
