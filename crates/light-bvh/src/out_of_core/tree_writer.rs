use alloc::vec;
use alloc::vec::Vec;
use std::io::{self, Seek, SeekFrom, Write};

use crate::build::scan::{Scan, expect_addressable};
use crate::build::topology::low_word;
use crate::bytes::{HEADER, Header};
use crate::node::moments::Moments;
use crate::node::wide_node::{NOWHERE, WIDTH, WideNode};
use crate::out_of_core::error::OutOfCoreError;
use crate::out_of_core::subtree::Subtree;
use crate::out_of_core::upper_tree::UpperTree;

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
    tree: UpperTree,
    /// From the root on.
    open: Vec<OpenNode>,
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

/// A node of the upper tree that is being written: its place is known, and what is below its first
/// children.
struct OpenNode {
    place: Place,
    upper: WideNode,
    /// Where its children begin.
    base: usize,
    light_base: u32,
    /// Of its first children.
    moments: Vec<Moments>,
}

impl<'o, W: Write + Seek> TreeWriter<'o, W> {
    /// No node yet of a tree of `scan`, with slots for `lights` lights, over whose groups is `tree`.
    pub(super) fn new(
        out: &'o mut W,
        lights: usize,
        scan: &Scan,
        tree: UpperTree,
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
            tree,
            open: Vec::new(),
        })
    }

    /// How many lights are in the trees written so far.
    pub(super) fn held(&self) -> usize {
        self.order.len()
    }

    /// Writes the tree of the next group.
    pub(super) fn add(&mut self, subtree: Subtree) -> Result<(), OutOfCoreError> {
        let root = self.next_place()?;
        let moments = subtree.moments;
        self.write(root, subtree)?;
        self.close(moments);
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

    /// The place of the next group, for which the nodes above it are opened.
    fn next_place(&mut self) -> io::Result<Place> {
        if self.nodes == 0 {
            let base = self.reserve(1)?;
            debug_assert_eq!(base, 0, "the root comes first");
            if self.tree.is_one_group() {
                return Ok(Place::ROOT);
            }
            self.open(Place::ROOT, 0)?;
        }
        loop {
            let node = &self.open[self.open.len() - 1];
            let k = node.moments.len();
            let place = node.place.child(node.base, k);
            if k >= usize::from(node.upper.inner) {
                return Ok(place);
            }
            self.open(place, node.upper.child_base as usize + k)?;
        }
    }

    fn open(&mut self, place: Place, upper: usize) -> io::Result<()> {
        let upper = self.tree.0[upper];
        let count = usize::from(upper.count);
        let base = self.reserve(count)?;
        self.open.push(OpenNode {
            place,
            upper,
            base,
            light_base: low_word(self.order.len()),
            moments: Vec::with_capacity(count),
        });
        Ok(())
    }

    /// Takes the moments of a child of the last open node, and closes those that are full.
    fn close(&mut self, mut moments: Moments) {
        while let Some(mut open) = self.open.pop() {
            open.moments.push(moments);
            let count = open.upper.count;
            if open.moments.len() < usize::from(count) {
                self.open.push(open);
                return;
            }
            let mut node = WideNode {
                inner: count,
                count,
                child_base: low_word(open.base),
                light_base: open.light_base,
                parent: open.place.parent,
                ..WideNode::EMPTY
            };
            moments = node.encode_children(&open.moments);
            self.late.push((open.place.index, node));
        }
    }

    /// Writes the tree of a group, whose root has a place already.
    fn write(&mut self, root: Place, subtree: Subtree) -> Result<(), OutOfCoreError> {
        let Subtree { mut nodes, ids, .. } = subtree;
        // What is below the root follows what was written before.
        let below = self.nodes;
        let index = |k: usize| if k == 0 { root.index } else { below + k - 1 };
        expect_addressable(below + nodes.len())?;
        let light_base = low_word(self.order.len());
        self.order.extend_from_slice(&ids);
        for (k, node) in nodes.iter_mut().enumerate() {
            node.child_base = low_word(index(node.child_base as usize));
            node.light_base += light_base;
            node.parent = match node.parent as usize {
                _ if k == 0 => root.parent,
                slot => low_word(index(slot / WIDTH) * WIDTH + slot % WIDTH),
            };
            let own = usize::from(node.inner)..node.children();
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
