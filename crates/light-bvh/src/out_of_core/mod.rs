//! Trees of more lights than memory holds at once.
//!
//! Lights are read twice, in chunks: once for their number, power and box, once to write each into
//! a scratch file of its cell of space. A tree is then built for each cell below an upper tree over
//! the cells, and written into one form of bytes: that of
//! [`StoredLightBvh`](crate::StoredLightBvh), which a program maps into memory.
//!
//! In memory are 8 bytes a light, for what stands at the end of the form, and the lights of some
//! cells. With the feature `rayon` it reads, builds and writes at the same time.
//!
//! ```
//! use std::io::{self, Cursor};
//!
//! use light_bvh::out_of_core::{LightChunks, OutOfCoreBuild};
//! use light_bvh::{LightBvh, light_bounds::LightExtent};
//! # use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
//! # use light_bvh::light_bounds::LightBounds;
//! # fn lamp(i: u32) -> LightExtent {
//! #     LightExtent::Bounded(LightBounds {
//! #         bounds: Aabb::from_point(Vec3::new((i % 100) as f32, (i / 100) as f32, 3.0)),
//! #         w: Vec3::NEG_Z,
//! #         phi: 60.0,
//! #         cos_theta_o: 1.0,
//! #         cos_theta_e: 0.0,
//! #         two_sided: false,
//! #     })
//! # }
//!
//! /// Lamps by a rule; those of a file are read in the same way.
//! struct Lamps(std::ops::Range<u32>);
//!
//! impl LightChunks for Lamps {
//!     fn next_chunk(&mut self, chunk: &mut Vec<LightExtent>) -> io::Result<()> {
//!         chunk.extend(self.0.by_ref().take(1000).map(lamp));
//!         Ok(())
//!     }
//!
//!     fn rewind(&mut self) -> io::Result<()> {
//!         self.0 = 0..10_000;
//!         Ok(())
//!     }
//! }
//!
//! # let scratch = std::env::temp_dir().join(format!("lamps-{}", std::process::id()));
//! # std::fs::create_dir(&scratch)?;
//! let build = OutOfCoreBuild::new(&scratch).with_lights_at_once(2000);
//! let mut file = Cursor::new(Vec::new());
//! let tree = build.write(&mut Lamps(0..10_000), &mut file, |_, _| {})?;
//! # std::fs::remove_dir(&scratch)?;
//! assert_eq!(tree.held, 10_000);
//! assert_eq!(LightBvh::from_bytes(file.get_ref())?.view().order().len(), 10_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod build;
mod cells;
mod error;
mod group;
mod light_chunks;
mod record;
mod subtree;
mod tree_writer;
mod upper_tree;

pub use build::{BuildStage, OutOfCoreBuild, OutOfCoreTree};
pub use error::OutOfCoreError;
pub use light_chunks::{LightChunks, SliceChunks};
