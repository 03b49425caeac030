#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| light_testkit::fuzz::instanced_trees(data));
