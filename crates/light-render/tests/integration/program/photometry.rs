//! `lights ies`.

use crate::program::folder::{Folder, LAMP, stdout};

/// Files of 1986 have lines without a keyword.
#[test]
fn a_line_without_a_keyword_is_printed_alone() {
    let folder = Folder::new("ies-words");
    let numbers = "TILT=NONE\n1 1000 1 3 1 1 1 0 0 0\n1 1 50\n0 45 90\n0\n9 5 0\n";
    let file = folder.file("old.ies", &format!("A lamp\n{numbers}"));
    let text = stdout(&["ies", &file]);
    assert!(text.lines().any(|line| line == "A lamp"), "{text}");
    assert!(!text.contains("[]"), "{text}");
}

#[test]
fn the_plot_is_offered_where_none_is_drawn() {
    let folder = Folder::new("ies-plot");
    let file = folder.file("lamp.ies", LAMP);
    let is_offered = |args: &[&str]| stdout(args).contains("-o PLOT.svg draws it");
    assert!(is_offered(&["ies", &file]), "no plot yet");
    let plot = folder.path("lamp.svg");
    assert!(!is_offered(&["ies", &file, "-o", &plot]), "drawn");
}
