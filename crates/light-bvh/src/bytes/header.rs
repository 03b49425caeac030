use core::error::Error;
use core::fmt;

use light_bounds::LightGroups;

use crate::node::wide_node::{WIDTH, WideNode};

/// The first bytes of every tree.
const MAGIC: [u8; 8] = *b"LightBvh";

/// The form of the bytes; changes whenever the meaning of a byte of a node does.
const VERSION: u32 = 5;

/// What precedes the nodes, which so keep their alignment.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C, align(32))]
pub(crate) struct Header {
    magic: [u8; 8],
    version: u32,
    nodes: u32,
    order: u32,
    slots: u32,
    /// The power of all lights.
    power: f32,
    /// Nodes with groups of lights: all or none.
    groups: u32,
}

/// Bytes of the header.
pub(crate) const HEADER: usize = size_of::<Header>();

const _: () = assert!(HEADER == 32, "no padding");

impl Header {
    /// The header of a tree with so many nodes, lights in them, lights in all, and nodes with
    /// groups of lights.
    #[cfg(feature = "alloc")]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a tree addresses its parts by 32 bits"
    )]
    pub(crate) const fn new([nodes, order, slots, groups]: [usize; 4], power: f32) -> Self {
        Self {
            magic: MAGIC,
            version: VERSION,
            nodes: nodes as u32,
            order: order as u32,
            slots: slots as u32,
            power,
            groups: groups as u32,
        }
    }

    /// The header at the start of `bytes`, at any alignment, and the nodes, order, slots and groups
    /// that follow it, if there are as many bytes as it states.
    pub(super) fn split(bytes: &[u8]) -> Result<(Self, [&[u8]; 4]), TreeBytesError> {
        let (start, rest) = bytes
            .split_at_checked(HEADER)
            .ok_or(TreeBytesError::NoTree)?;
        let header: Self = bytemuck::pod_read_unaligned(start);
        if header.magic != MAGIC {
            return Err(TreeBytesError::NoTree);
        }
        if header.version != VERSION {
            let found = header.version;
            return Err(TreeBytesError::Version { found });
        }
        let expected = header.bytes();
        if bytes.len() as u64 != expected {
            return Err(TreeBytesError::Length { expected });
        }
        let (nodes, rest) = rest.split_at(header.nodes as usize * size_of::<WideNode>());
        let (order, rest) = rest.split_at(4 * header.order as usize);
        let (slots, groups) = rest.split_at(4 * header.slots as usize);
        Ok((header, [nodes, order, slots, groups]))
    }

    /// Bytes of the whole.
    fn bytes(&self) -> u64 {
        let [nodes, order] = [self.nodes, self.order].map(u64::from);
        let [slots, groups] = [self.slots, self.groups].map(u64::from);
        let of_node = size_of::<[LightGroups; WIDTH]>() as u64;
        let bytes = nodes * size_of::<WideNode>() as u64 + groups * of_node;
        HEADER as u64 + bytes + 4 * (order + slots)
    }

    pub(super) const fn power(&self) -> f32 {
        self.power
    }
}

/// Why bytes cannot be used as a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TreeBytesError {
    /// They do not begin with the mark of a tree.
    NoTree,
    /// They are of another version of this crate, or of a machine with another order of bytes.
    Version {
        /// The version in the header.
        found: u32,
    },
    /// They are fewer or more than the header states.
    Length {
        /// The number in the header.
        expected: u64,
    },
    /// They do not begin at a multiple of 32, and cannot be used where they are.
    Alignment,
    /// The nodes do not refer to each other and to the lights as those of a tree do.
    Links,
}

impl fmt::Display for TreeBytesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTree => f.write_str("the bytes do not begin as a tree does"),
            Self::Version { found } => {
                write!(f, "the tree has version {found}, expected {VERSION}")
            }
            Self::Length { expected } => write!(f, "expected {expected} bytes of a tree"),
            Self::Alignment => f.write_str(
                "the bytes do not begin at a multiple of 32; LightBvh::from_bytes copies any",
            ),
            Self::Links => f.write_str("the nodes are no tree of the lights"),
        }
    }
}

impl Error for TreeBytesError {}
