//! The queries of `light_embedded::choices`.

#![cfg_attr(target_os = "none", no_std, no_main)]

light_embedded::entry!(light_embedded::choices);
