//! How the default tree is built and refitted.

pub(crate) mod binned_split;
pub(crate) mod bins;
pub(crate) mod builder;
pub(crate) mod cluster;
pub(crate) mod clustering;
pub(crate) mod dominant;
pub(crate) mod group_extent;
pub(crate) mod light_primitive;
pub(crate) mod lights;
pub(crate) mod morton;
pub(crate) mod morton_entry;
pub(crate) mod morton_range;
pub(crate) mod node_children;
pub(crate) mod options;
pub(crate) mod quality;
pub(crate) mod radix_sort;
pub(crate) mod refit;
pub(crate) mod scan;
pub(crate) mod split_group;
pub(crate) mod subtree;
pub(crate) mod topology;

#[cfg(test)]
mod tests;
