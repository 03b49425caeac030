use super::*;
use crate::glam::{Vec2, Vec3};
use crate::{Color, Emission, Material, Surface};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

pub(super) fn parse(obj: &str, mtl: &str) -> Result<Scene, String> {
    let library = |path: &Path| match path.to_str() {
        Some("dir/a.mtl" | "dir/a b.mtl") => Ok(mtl.as_bytes().to_vec()),
        _ => Err(Diagnostic::file(path, "cannot be read: no such file")),
    };
    parse_obj(Path::new("dir/a.obj"), obj, Files::new(&library)).map_err(|error| error.to_string())
}

#[test]
fn reads_groups_materials_and_polygons() {
    let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n\
        o wall\nusemtl white\nf 1 2 3 4\ng lamp of mine\nusemtl lamp\nf -4/1/1 -3/2/1 -2/3/1\n\
        o wall\nusemtl white\nf 4 3 2\n";
    let mtl = "newmtl white\nKd .7 .8 .9\nnewmtl lamp # on\nKe 1 2 3\nKd 0 0 0\n";
    let scene = parse(obj, mtl).expect("a scene");
    assert_eq!(scene.warnings, [], "nothing ignored");
    let [wall, lamp] = &scene.meshes[..] else {
        panic!(
            "one mesh per group and material, not {}",
            scene.meshes.len()
        );
    };
    assert_eq!(wall.name, "wall", "name of `o`");
    assert_eq!(wall.positions.len(), 4, "shared vertices");
    let quad_and_back = [[0, 1, 2], [0, 2, 3], [3, 2, 1]];
    assert_eq!(wall.indices, quad_and_back, "a fan, then the second visit");
    assert_eq!(wall.normals, None, "flat");
    assert_eq!(lamp.name, "lamp of mine", "name of `g`");
    assert_eq!(lamp.normals, Some(vec![Vec3::Z; 3]), "normals");
    let uvs = vec![Vec2::ZERO, Vec2::X, Vec2::ONE];
    assert_eq!(lamp.uvs, Some(uvs), "texture coordinates");
    let emission = scene.material(lamp.material).emission;
    let expected = Emission::one_sided(Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(emission, Some(expected), "Ke");
    let reflectance = Color::Constant(Vec3::new(0.7, 0.8, 0.9));
    let white = &scene.material(wall.material).surface;
    assert_eq!(white, &Surface::Diffuse { reflectance }, "Kd");
}

#[test]
fn names_what_it_ignores_once() {
    let obj = format!("{TRIANGLE}curv 1\ncurv 2\nv 0 0 0 1 0 0\ns off\nusemtl x\nf 1 2 3\n");
    let scene = parse(&obj, "").expect("a scene");
    let warnings: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
    let expected = [
        "dir/a.obj:4: `curv` is not understood and was ignored",
        "dir/a.obj:6: `v` has vertex colours, which were ignored",
        "dir/a.obj:8: material `x` is grey: no `mtllib` line before",
    ];
    assert_eq!(warnings, expected, "one warning each");
    let obj = format!("mtllib a.mtl\n{TRIANGLE}f 1 2 3\n");
    let scene = parse(&obj, "newmtl a\nfoo 1\nfoo 2\n").expect("a scene");
    let warnings: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
    let expected = ["dir/a.mtl:2: `foo` is not understood and was ignored"];
    assert_eq!(warnings, expected, "one warning");
}

#[test]
fn library_names_may_hold_blanks_or_be_several() {
    let mtl = "newmtl a\n";
    for names in ["a b.mtl", "a.mtl a.mtl"] {
        let obj = format!("mtllib {names}\n{TRIANGLE}usemtl a\nf 1 2 3\n");
        parse(&obj, mtl).expect("a scene");
    }
}

/// What other tools read with a grey or flat surface is read so, and named.
#[test]
fn what_is_missing_is_grey_and_named() {
    let obj = format!(
        "mtllib b.mtl\nmtllib a.mtl\n{TRIANGLE}usemtl b\nf 1//1 2//2 3//-3\nusemtl b\nf 1 2 3\n"
    );
    let scene = parse(&obj, "newmtl a\n").expect("a scene");
    let warnings: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
    let expected = [
        "dir/a.obj:1: material library `b.mtl`: cannot be read: no such file; its materials are grey",
        "dir/a.obj:6: material `b` is grey: it is not in a.mtl, b.mtl",
        "dir/a.obj:7: `f` names normals, of which there are none: its faces are flat",
    ];
    assert_eq!(warnings, expected, "one warning each");
    let [mesh] = &scene.meshes[..] else {
        panic!("one mesh, not {}", scene.meshes.len());
    };
    assert_eq!(mesh.indices.len(), 2, "both faces");
    assert_eq!(mesh.normals, None, "flat");
    let grey = scene.material(mesh.material);
    assert_eq!(
        grey,
        &Material::diffuse("b", Vec3::splat(0.5)),
        "grey, with its name"
    );
}

/// Normals that a file lists behind the faces that name them are none yet.
#[test]
fn normals_come_before_their_faces() {
    for normal in ["1", "-1", "0"] {
        let obj = format!("{TRIANGLE}f 1//{normal} 2//{normal} 3//{normal}\nvn 0 0 1\n");
        let scene = parse(&obj, "").expect("a scene");
        assert_eq!(scene.meshes[0].normals, None, "{normal}");
        assert_eq!(scene.warnings.len(), 1, "named: {:?}", scene.warnings);
    }
}

/// What `tobj` alone would not read, or read otherwise.
#[test]
fn comments_tabs_and_continued_lines_are_read() {
    let obj = "mtllib\ta.mtl # the colours\nv 0 0 0 # origin\nv\t1 0 \\\n0\nv 0 1 0 2\n\
        vt .5\nvt 0 1 0\nusemtl\ta  b\ng\ta\tb\nf\t1/1 2/2 3/-1#x\nf 1/1 2/2 \\\n 3/1\n";
    let error = parse(obj, "newmtl a b\n").expect_err("a comment starts a word");
    assert_eq!(
        error, "dir/a.obj:10: expected v, v/vt, v//vn or v/vt/vn, found `3/-1#x`",
        "line"
    );
    let scene = parse(
        &obj.replace("#x", " #x"),
        "\tnewmtl a  b # x\n\tKd .5 # y\n",
    );
    let scene = scene.expect("a scene");
    assert_eq!(scene.warnings, [], "all read");
    let mesh = &scene.meshes[0];
    assert_eq!(
        (mesh.name.as_str(), mesh.indices.len()),
        ("a b", 2),
        "a group"
    );
    assert_eq!(mesh.positions[2], Vec3::Y * 0.5, "divided by its weight");
    assert_eq!(
        mesh.uvs.as_ref().expect("uvs")[0],
        Vec2::X * 0.5,
        "one coordinate"
    );
    assert_eq!(scene.material(mesh.material).name, "a b", "its material");
}

/// Attributes that change from face to face make meshes of their own.
#[test]
fn faces_of_unlike_attributes_do_not_mix() {
    let faces = "vt 0 0\nvt 1 1\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//1 3//1\n\
        f 1/2/1 2/1/1 3/1/1\nf 3 2 1\nf 3/2 2/2 1/2\n";
    let scene = parse(&format!("{TRIANGLE}{faces}"), "").expect("a scene");
    let shapes: Vec<_> = scene
        .meshes
        .iter()
        .map(|mesh| {
            (
                mesh.indices.len(),
                mesh.uvs.is_some(),
                mesh.normals.is_some(),
            )
        })
        .collect();
    let expected = [
        (2, false, false),
        (2, true, false),
        (1, false, true),
        (1, true, true),
    ];
    assert_eq!(shapes, expected, "four meshes");
    for mesh in &scene.meshes {
        let count = mesh.positions.len();
        assert!(
            mesh.uvs.as_ref().is_none_or(|all| all.len() == count),
            "one a vertex"
        );
        assert!(
            mesh.normals.as_ref().is_none_or(|all| all.len() == count),
            "one a vertex"
        );
    }
    let last = scene.meshes[1].uvs.as_ref().expect("uvs");
    assert_eq!(
        last[3..],
        [Vec2::ONE; 2],
        "of the last face, which shares a corner"
    );
}

/// Without anything that has to be cleaned `tobj` reads the same alone.
#[test]
fn cleaning_changes_nothing_of_a_plain_file() {
    let obj = include_str!("../../assets/cornell_box.obj");
    let mtl = include_str!("../../assets/cornell_box.mtl");
    let library = |_: &Path| Ok(mtl.into());
    let ours = parse_obj(Path::new("box.obj"), obj, Files::new(&library)).expect("a scene");
    let (models, materials) =
        tobj::load_obj_buf(&mut obj.as_bytes(), &tobj::GPU_LOAD_OPTIONS, |_| {
            tobj::load_mtl_buf(&mut mtl.as_bytes())
        })
        .expect("a scene");
    let materials = materials.expect("materials");
    assert_eq!(ours.meshes.len(), models.len(), "as many meshes");
    for (mesh, model) in ours.meshes.iter().zip(&models) {
        assert_eq!(mesh.name, model.name, "name");
        let position = |&i: &u32| Vec3::from_slice(&model.mesh.positions[3 * i as usize..]);
        let theirs: Vec<Vec3> = model.mesh.indices.iter().map(position).collect();
        let triangles = (0..mesh.indices.len()).flat_map(|index| mesh.triangle(index));
        assert_eq!(triangles.collect::<Vec<_>>(), theirs, "triangles");
        let material = &materials[model.mesh.material_id.expect("a material")];
        let emission = ours.material(mesh.material).emission;
        let theirs = material
            .emissive
            .map(|e| Emission::one_sided(Vec3::from(e)));
        assert_eq!(emission, theirs, "emission");
    }
}
