//! light-sources
