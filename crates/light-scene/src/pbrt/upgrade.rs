/// What to do with a file that is written for pbrt-v3.
pub(super) const UPGRADE: &str = "this is written as for pbrt-v3: \
     `pbrt --upgrade OLD.pbrt > NEW.pbrt` of pbrt-v4 makes a file that is read";
