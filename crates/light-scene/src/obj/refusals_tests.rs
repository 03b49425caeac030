use super::tests::parse;
use super::*;

fn error(obj: &str, mtl: &str) -> String {
    parse(obj, mtl).expect_err("an error")
}

#[test]
fn broken_obj_lines_give_one_clear_line() {
    let cases = [
        (
            "v 0 0\n",
            "dir/a.obj:1: expected a vertex coordinate, found the end of the line",
        ),
        (
            "\nv 0 x 0\n",
            "dir/a.obj:2: expected a vertex coordinate, found `x`",
        ),
        (
            "v 0 inf 0\nf 1 1 1\n",
            "dir/a.obj:1: expected a vertex coordinate, found `inf`",
        ),
        (
            "v 0 1 0 1e-40\nv 1 1 1\nf 1 2 2\n",
            "dir/a.obj:1: expected a weight other than 0",
        ),
        (
            "v 0 0 x # y\nf 1 1 9\n",
            "dir/a.obj:1: expected a vertex coordinate, found `x`",
        ),
        ("v 0 1 0 0\n", "dir/a.obj:1: expected a weight other than 0"),
        (
            "vt\n",
            "dir/a.obj:1: expected a texture coordinate, found the end of the line",
        ),
        (
            "vt 0 x\n",
            "dir/a.obj:1: expected a texture coordinate, found `x`",
        ),
        (
            "v 0 0 0\nvn 0 0 nan\nf 1//1 1//1 1//1",
            "dir/a.obj:2: expected a normal's coordinate, found `nan`",
        ),
        (
            "v 0 0 0\nvn 0 0 1\nf 1//2 1//1 1//1",
            "dir/a.obj:3: normal 2 of 1 does not exist",
        ),
        ("f 1 2 3\n", "dir/a.obj:1: vertex 1 of 0 does not exist"),
        (
            "v 0 0 0\nf 1 1\n",
            "dir/a.obj:2: expected at least three corners, found 2",
        ),
        (
            "v 0 0 0\nf 1 1 0\n",
            "dir/a.obj:2: vertex 0 of 1 does not exist",
        ),
        (
            "v 0 0 0\nf 1/1 1/1 1/1\n",
            "dir/a.obj:2: texture coordinate 1 of 0 does not exist",
        ),
        (
            "v 0 0 0\nf 1 1 a\n",
            "dir/a.obj:2: expected v, v/vt, v//vn or v/vt/vn, found `a`",
        ),
        (
            "v 0 0 0\nf 1 1 1/////\n",
            "dir/a.obj:2: expected v, v/vt, v//vn or v/vt/vn, found `1/////`",
        ),
        (
            "v 0 0 0\nf 1 1 //\n",
            "dir/a.obj:2: expected v, v/vt, v//vn or v/vt/vn, found `//`",
        ),
        (
            "v 0 0 0\nvt 0 0\nf 1 1 1/1\n",
            "dir/a.obj:3: expected all corners alike: v, v/vt, v//vn or v/vt/vn",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 -1e30 0\nf 1 2 3\n",
            "dir/a.obj:3: expected a size of at most about 1e19, found y from -1e30 to 0.0",
        ),
        ("usemtl\n", "dir/a.obj:1: expected a material's name"),
        ("mtllib\n", "dir/a.obj:1: expected a file name"),
        ("", "dir/a.obj: expected at least one face (`f`)"),
        (
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
            "dir/a.obj: expected at least one face (`f`) with an area",
        ),
    ];
    for (obj, expected) in cases {
        assert_eq!(error(obj, "newmtl a\n"), expected, "{obj}");
    }
}

#[test]
fn missing_file_is_named() {
    let error = read_obj(Path::new("no/such.obj")).expect_err("an error");
    let shown = error.to_string();
    assert!(
        shown.starts_with("no/such.obj: cannot be read: "),
        "{shown}"
    );
}
