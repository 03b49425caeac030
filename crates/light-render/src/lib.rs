//! light-render
