use core::error::Error;
use core::fmt;

use crate::node::wide_node::{WIDTH, WideNode};
use crate::query::bvh_ref::LightBvhRef;
use crate::visibility::factor_code::{LARGEST, LEAST};

/// Nodes of a tree that a cell copies at most.
pub const MAX_COPIED_NODES: usize = 24;

/// A node in the copy of the top of a tree: which of its children are copied too, and where.
///
/// 4 bytes. The copies of its children follow each other in the order of the children, those of
/// different nodes in the order of the nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct CopiedNode {
    /// Bit `k` is set if child `k` is copied.
    pub opened: u16,
    /// The place of the first of these copies in the cell.
    pub first: u16,
}

/// The visibility of lights from one cell: a copy of the top of a tree, in which every child has a
/// factor that multiplies its importance.
///
/// Borrowed: 20 bytes a copied node. Codes of factors are those of
/// [`encode_factor`](crate::visibility::encode_factor), entry `k` for child `k`; those of empty
/// slots do not count.
#[derive(Clone, Copy, Debug)]
pub struct CellFactors<'a> {
    shape: &'a [CopiedNode],
    factors: &'a [[u8; WIDTH]],
}

impl<'a> CellFactors<'a> {
    /// A cell without factors: choices are those of the tree.
    pub const PLAIN: Self = Self {
        shape: &[],
        factors: &[],
    };

    /// The cell of these copied nodes, the root first, and their factors, one entry a node.
    ///
    /// # Errors
    /// The first rule that is broken: see [`CellFactorsError`]. Reads every node once.
    pub fn new(
        tree: &LightBvhRef<'_>,
        shape: &'a [CopiedNode],
        factors: &'a [[u8; WIDTH]],
    ) -> Result<Self, CellFactorsError> {
        if shape.len() != factors.len() {
            return Err(CellFactorsError::Lengths);
        }
        copied_nodes(tree, shape)?;
        let mut codes = factors.iter().flatten();
        if !codes.all(|code| (LEAST..=LARGEST).contains(code)) {
            return Err(CellFactorsError::Factor);
        }
        Ok(Self { shape, factors })
    }

    /// The same without a check against the tree, for cells that were made or checked by this
    /// crate.
    pub(super) const fn of(shape: &'a [CopiedNode], factors: &'a [[u8; WIDTH]]) -> Self {
        Self { shape, factors }
    }

    /// The copied nodes, the root first; empty in a plain cell.
    #[must_use]
    pub const fn shape(&self) -> &'a [CopiedNode] {
        self.shape
    }

    /// The codes of the factors of the children of each copied node.
    #[must_use]
    pub const fn factors(&self) -> &'a [[u8; WIDTH]] {
        self.factors
    }

    /// Whether there are no factors.
    #[must_use]
    pub const fn is_plain(&self) -> bool {
        self.shape.is_empty()
    }

    /// Bytes of the copied nodes and their factors.
    #[must_use]
    pub const fn bytes(&self) -> usize {
        size_of_val(self.shape) + size_of_val(self.factors)
    }

    /// The place of the copy of child `child` of the node at `place`; `None` if it is not copied.
    #[inline(always)]
    pub(super) fn below(&self, place: usize, child: usize) -> Option<usize> {
        self.shape.get(place)?.copy_of(child)
    }
}

impl CopiedNode {
    /// The place of the copy of a child, if it is copied.
    #[inline(always)]
    pub(super) fn copy_of(self, child: usize) -> Option<usize> {
        if self.opened >> child & 1 == 0 {
            return None;
        }
        let before = self.opened & ((1 << child) - 1);
        Some(usize::from(self.first) + before.count_ones() as usize)
    }
}

/// The index in the tree of each node of a copy, and 0 beyond them.
pub(super) fn copied_nodes(
    tree: &LightBvhRef<'_>,
    shape: &[CopiedNode],
) -> Result<[u32; MAX_COPIED_NODES], CellFactorsError> {
    let mut nodes = [0; MAX_COPIED_NODES];
    if shape.len() > MAX_COPIED_NODES || (!shape.is_empty() && tree.is_empty()) {
        return Err(CellFactorsError::Links);
    }
    // Copies follow each other, so that none has two parents and each comes after its own.
    let mut next = usize::from(!shape.is_empty());
    for (place, copied) in shape.iter().enumerate() {
        if place >= next || (copied.opened != 0 && usize::from(copied.first) != next) {
            return Err(CellFactorsError::Links);
        }
        let node = tree.nodes().get(nodes[place] as usize);
        let node = node.ok_or(CellFactorsError::Links)?;
        for child in (0..WIDTH).filter(|&child| copied.opened >> child & 1 == 1) {
            let index = inner_child(tree, nodes[place], node, child);
            *nodes.get_mut(next).ok_or(CellFactorsError::Links)? =
                index.ok_or(CellFactorsError::Links)?;
            next += 1;
        }
    }
    if next == shape.len() {
        Ok(nodes)
    } else {
        Err(CellFactorsError::Links)
    }
}

/// The index of the node that child `child` of a node is, if it is one of the tree.
pub(super) fn inner_child(
    tree: &LightBvhRef<'_>,
    index: u32,
    node: &WideNode,
    child: usize,
) -> Option<u32> {
    let below = node.child_base.checked_add(u32::try_from(child).ok()?)?;
    let parent = tree.nodes().get(below as usize)?.parent as usize;
    let is_child = child < usize::from(node.inner) && parent == WIDTH * index as usize + child;
    is_child.then_some(below)
}

/// Why arrays are not a cell of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CellFactorsError {
    /// There are not as many entries of factors as copied nodes.
    Lengths,
    /// The copied nodes are not the top of the tree, not in order, or more than
    /// [`MAX_COPIED_NODES`].
    Links,
    /// A code is outside of its domain, `120..=240`.
    Factor,
}

impl fmt::Display for CellFactorsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lengths => "expected one entry of factors a copied node",
            Self::Links => "the copied nodes are not the top of the tree",
            Self::Factor => "the code of a factor is outside of 120 to 240",
        })
    }
}

impl Error for CellFactorsError {}
