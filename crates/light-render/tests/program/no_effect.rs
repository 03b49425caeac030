//! Flags that change nothing: the picture is made, and one line says so.

use crate::folder::{Folder, LIT, SMALL, lights};

#[test]
fn a_flag_without_effect_is_named() {
    let folder = Folder::new("no-effect");
    let scene = folder.scene(LIT);
    let sky = "Camera \"perspective\" WorldBegin LightSource \"infinite\"";
    let sky = folder.file("sky.pbrt", sky);
    let [exr, png] = ["a.exr", "a.png"].map(|name| folder.path(name));
    let said = |scene: &str, out: &str, more: &[&str]| {
        let output = lights(&[&["render", scene, "-o", out], &SMALL[..], more].concat());
        let said = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(0), "{more:?}: {said}");
        said
    };
    for (scene, out, more) in [
        (&scene, &exr, &["--step", "0.5"][..]),
        (&scene, &png, &["--half"]),
        (&scene, &exr, &["--env-scale", "2"]),
        (&sky, &exr, &["--light-scale", "2"]),
    ] {
        let words = said(scene, out, more);
        assert_eq!(words.lines().count(), 1, "{more:?}: {words}");
        for word in ["warning", more[0], "no effect"] {
            assert!(words.contains(word), "{word} in {words}");
        }
        assert_eq!(said(scene, out, &[more, &["-q"]].concat()), "", "{more:?}");
    }
    for (scene, more) in [
        (&scene, &["--half"][..]),
        (&scene, &["--light-scale", "2"]),
        (&sky, &["--env-scale", "2"]),
        (
            &scene,
            &["--integrator", "single-scattering-classic", "--step", "0.5"],
        ),
    ] {
        assert_eq!(said(scene, &exr, more), "", "{more:?} has an effect");
    }
}
