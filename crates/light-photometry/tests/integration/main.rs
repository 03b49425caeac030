//! The integration tests of light-photometry, as one program.

#![cfg(feature = "alloc")]

mod eulumdat;
mod lm63;
