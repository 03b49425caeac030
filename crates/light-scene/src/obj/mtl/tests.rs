use super::*;
use crate::glam::{Vec2, Vec3};
use crate::image::tests::png;
use crate::{Alpha, Color, ColorImage, Emission, Surface};

/// The scene with the materials of a library beside two images: one of a grey texel, one of a red
/// texel in a hole.
fn read(mtl: &str) -> Result<Scene, String> {
    let grey = png(image::GrayImage::from_pixel(1, 1, image::Luma([51])));
    let hole = png(image::RgbaImage::from_pixel(
        1,
        1,
        image::Rgba([255, 0, 0, 102]),
    ));
    let beside = |path: &Path| match path.to_str() {
        Some("dir/a b.png") => Ok(grey.clone()),
        Some("dir/hole.png") => Ok(hole.clone()),
        _ => Err(Diagnostic::file(path, "cannot be read")),
    };
    let mut scene = Scene::default();
    parse_mtl(Path::new("dir/a.mtl"), mtl, Files::new(&beside), &mut scene)
        .map_err(|error| error.to_string())?;
    Ok(scene)
}

fn warnings(mtl: &str) -> Vec<String> {
    let scene = read(mtl).expect("a scene");
    scene.warnings.iter().map(ToString::to_string).collect()
}

/// What share of the surface is there, if the library says something about it.
fn share(mtl: &str) -> Option<Color> {
    let scene = read(&format!("newmtl a\n{mtl}")).expect("a scene");
    assert_eq!(scene.warnings, [], "{mtl}");
    let share = |Alpha {
                     opacity: share,
                     cutoff,
                 }| {
        assert_eq!(cutoff, None, "by share");
        share
    };
    scene.materials[0].alpha.map(share)
}

fn grey(share: f32) -> Option<Color> {
    Some(Color::Constant(Vec3::splat(share)))
}

#[test]
fn broken_lines_give_one_clear_line() {
    let cases = [
        (
            "",
            "dir/a.mtl: expected at least one material (`newmtl NAME`)",
        ),
        (
            "Kd 1 1 1\n",
            "dir/a.mtl:1: expected `newmtl NAME` before `Kd`",
        ),
        ("newmtl\n", "dir/a.mtl:1: expected a material's name"),
        (
            "newmtl a\nKd\n",
            "dir/a.mtl:2: expected a colour channel, found the end of the line",
        ),
        (
            "newmtl a\nKd 1 1\n",
            "dir/a.mtl:2: expected a colour channel, found the end of the line",
        ),
        (
            "newmtl a\nKe 1 -1 1\n",
            "dir/a.mtl:2: expected colour channels of at least 0",
        ),
        (
            "newmtl a\nNi -1\n",
            "dir/a.mtl:2: expected an index of refraction of at least 0, found -1",
        ),
        (
            "newmtl a\nd -halo .5\n",
            "dir/a.mtl:2: expected a dissolve, found `-halo`",
        ),
        (
            "newmtl a\nTr -1\n",
            "dir/a.mtl:2: expected a transparency of at least 0, found -1",
        ),
        (
            "newmtl a\nillum 11\n",
            "dir/a.mtl:2: expected an illumination model of 0 to 10, found `11`",
        ),
        ("newmtl a\nmap_d\n", "dir/a.mtl:2: expected a file name"),
        (
            "newmtl a\nmap_d -s 2\n",
            "dir/a.mtl:2: expected a file name",
        ),
        (
            "newmtl a\nmap_Kd -o a.png\n",
            "dir/a.mtl:2: expected a number, found `a.png`",
        ),
        (
            "newmtl a\nmap_Kd -clamp a.png\n",
            "dir/a.mtl:2: expected `-clamp on` or `-clamp off`",
        ),
    ];
    for (mtl, expected) in cases {
        assert_eq!(read(mtl).expect_err("an error"), expected, "{mtl}");
    }
}

#[test]
fn missing_textures_are_named() {
    let mtl = "newmtl a\nKd .2\nmap_Kd no.png\nmap_d no.png\n";
    let scene = read(mtl).expect("a scene");
    let reflectance = Color::Constant(Vec3::splat(0.2));
    let diffuse = Surface::Diffuse { reflectance };
    assert_eq!(scene.materials[0].surface, diffuse, "`Kd` alone");
    assert_eq!(scene.materials[0].alpha, None, "all of it");
    let left_out = "dir/no.png: cannot be read; the texture was left out";
    assert_eq!(warnings(mtl), [format!("dir/a.mtl:3: {left_out}")], "once");
}

#[test]
fn surfaces_mean_what_the_documentation_says() {
    let surface = |mtl: &str| {
        let scene = read(&format!("newmtl a\n{mtl}")).expect("a scene");
        assert_eq!(scene.warnings, [], "{mtl}");
        scene.materials[0].surface.clone()
    };
    let mirror = Surface::Mirror {
        reflectance: Vec3::splat(0.9),
    };
    assert_eq!(surface("Ks .9 .9 .9\nillum 5"), mirror, "illum 5");
    assert_eq!(surface("Ks .9\nKd 0\nillum 3"), mirror, "illum 3");
    let reflectance = Color::Constant(Vec3::splat(0.4));
    let matt = Surface::Diffuse { reflectance };
    assert_eq!(surface("Kd .4\nNs 9\nKa 1 1 1"), matt, "one number");
    assert_eq!(surface("Kd .4\nKs 0 0 0\nillum 3"), matt, "no mirror");
    let glass = Surface::Dielectric {
        eta: 1.3,
        alpha: Vec2::ZERO,
    };
    assert_eq!(surface("Ni 1.3\nillum 7"), glass, "illum 7");
    let lacquer = Surface::CoatedDiffuse {
        reflectance,
        eta: 1.4,
        alpha: Vec2::splat(0.25),
    };
    assert_eq!(surface("Kd .4\nPr .5\nKs .5\nNi 1.4"), lacquer, "Pr");
    let gold = Surface::conductor_of_reflectance(Vec3::new(1.0, 0.7, 0.3), Vec2::splat(0.25));
    assert_eq!(surface("Pm 1\nPr .5\nKd 1 .7 .3"), gold, "Pm");
}

#[test]
fn what_does_not_count_is_named_once() {
    let mtl = "newmtl a\nKs .5\nnewmtl b\nKs .5\nnewmtl c\nillum 5\nKd 1\nnewmtl d\nillum 4\n\
        map_Kd a b.png\n\
        newmtl e\nPm .6\nmap_Kd a b.png\nnewmtl f\nd .5\nTr .7\nbump a b.png\nTf 1\nTf 1\n\
        newmtl g\nmap_Kd c.dds\nnewmtl h\nKd 0 2 0\nKd 3\nd 2\nnewmtl i\nNi 0\nillum 7\n";
    let expected = [
        "dir/a.mtl:1: `Ks` of a matt surface was ignored: expected `Pr` of a lacquered one, or \
         `illum 3` or `5` of a mirror",
        "dir/a.mtl:5: `Kd` of a mirror was ignored",
        "dir/a.mtl:8: `Kd` of glass was ignored",
        "dir/a.mtl:11: `map_Kd` of a metal was taken as its mean",
        "dir/a.mtl:11: `Pm` was taken as the nearer of 0 and 1",
        "dir/a.mtl:14: `Tr` was ignored: expected 1 minus `d`",
        "dir/a.mtl:17: `bump` is not understood and was ignored",
        "dir/a.mtl:18: `Tf` is not understood and was ignored",
        "dir/a.mtl:21: `c.dds` was ignored: expected .exr, .hdr, .pfm, .png, .tga or .jpg",
        "dir/a.mtl:23: `Kd` above 1 was taken as 1",
        "dir/a.mtl:25: `d` above 1 was taken as 1",
        "dir/a.mtl:26: the glass of `illum 4`, `6`, `7` or `9` was taken as matt: expected `Ni` \
         above 0",
    ];
    assert_eq!(warnings(mtl), expected, "one warning each");
}

#[test]
fn dissolve_is_how_much_is_there() {
    assert_eq!(share("Kd 1"), None, "all of it");
    assert_eq!(share("d 1"), None, "all of it");
    assert_eq!(share("d .25"), grey(0.25), "d");
    assert_eq!(share("Tr .25"), grey(0.75), "Tr is 1 - d");
    assert_eq!(share("d .25\nTr .75"), grey(0.25), "both");
    assert_eq!(share("d .25\nillum 9\nNi 1.5"), None, "glass passes light");
}

#[test]
fn opacity_is_the_alpha_channel_or_the_brightness() {
    for (file, factor, texel) in [("hole.png", "", 0.4), ("a b.png", "d .5\n", 0.2)] {
        let scene = read(&format!("newmtl a\n{factor}map_d {file}")).expect("a scene");
        let Some(Color::Image(shown)) = scene.materials[0].alpha.map(|alpha| alpha.opacity) else {
            panic!("{file}: an image");
        };
        let image = &scene.images[shown.image.0 as usize];
        assert_eq!(image.texels(), [Vec3::splat(texel)], "{file}: as written");
        let expected = if factor.is_empty() { 1.0 } else { 0.5 };
        assert_eq!(shown.scale, Vec3::splat(expected), "{file}: times `d`");
    }
}

#[test]
fn images_color_surfaces_and_lights() {
    let scene = read("newmtl a\nKd .5\nmap_Kd a b.png\nmap_Ke a b.png\nmap_d a b.png\n");
    let scene = scene.expect("a scene");
    assert_eq!(scene.images.len(), 2, "colours and opacities, each once");
    let texture = |scale: f32| {
        Color::Image(ColorImage {
            scale: Vec3::splat(scale),
            ..ColorImage::new(crate::ImageId(0))
        })
    };
    let material = &scene.materials[0];
    let reflectance = texture(0.5);
    let diffuse = Surface::Diffuse { reflectance };
    assert_eq!(material.surface, diffuse, "times `Kd`");
    let radiance = material.emission.map(|Emission { radiance, .. }| radiance);
    assert_eq!(radiance, Some(texture(1.0)), "map_Ke alone");
}

#[test]
fn options_place_the_image() {
    let mtl = "newmtl a\nmap_Kd -blendu on -s 2 3 1 -mm 0 1 -o .5 -clamp on a b.png\n";
    let scene = read(mtl).expect("a scene");
    let Surface::Diffuse {
        reflectance: Color::Image(shown),
    } = scene.materials[0].surface
    else {
        panic!("an image");
    };
    let place = shown.mapping.transform.transform_point2(Vec2::ONE);
    assert_eq!(place, Vec2::new(2.5, 3.0), "scaled, then moved");
    assert_eq!(
        shown.mapping.wrap,
        [lights::sources::Wrap::Clamp; 2],
        "once"
    );
    let warning = "dir/a.mtl:2: option `-mm` is not understood and was ignored";
    assert_eq!(warnings(mtl), [warning], "named");
}

/// Lines, images and whole materials are looked at one after another.
#[test]
fn warnings_come_in_the_order_of_lines() {
    let warnings = warnings(
        "newmtl a\nillum 2\nKs 1 1 1\nmap_Ke -bm 1 none.png\nmap_Kd -bm 1 a b.png\nKx 1\n\
         newmtl b\nPm 0.7\nmap_d -cc on a b.png\nKy 1\n",
    );
    let lines = warnings.iter().map(|warning| {
        let (line, _) = warning.strip_prefix("dir/a.mtl:")?.split_once(':')?;
        line.parse().ok()
    });
    let expected = [1, 4, 4, 6, 7, 9, 10].map(Some);
    assert_eq!(lines.collect::<Vec<Option<u8>>>(), expected, "{warnings:?}");
}

#[test]
fn a_material_that_is_described_again_is_named() {
    let mtl = "newmtl a\nKe 1 1 1\nnewmtl b\nnewmtl a\nKe 2 2 2\n";
    let expected = "dir/a.mtl:4: material `a` is described again: the last one counts";
    assert_eq!(warnings(mtl), [expected], "the second one");
}
