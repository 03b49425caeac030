use std::path::Path;

use super::parse_ply;

#[test]
fn ply_in_text_and_binary() {
    let path = Path::new("a.ply");
    let head = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 4\nproperty float x\nproperty float \
             y\nproperty float z\nelement face 1\nproperty list uchar int \
             vertex_indices\nend_header\n"
        )
    };
    let text = head("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let expected = parse_ply(path, text.as_bytes()).expect("a mesh");
    assert_eq!(expected.indices, [[0, 1, 2], [0, 2, 3]], "a fan");
    let corners = [
        [0.0f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    for (format, little) in [("binary_little_endian", true), ("binary_big_endian", false)] {
        let mut bytes = head(format).into_bytes();
        for x in corners.as_flattened() {
            bytes.extend(if little {
                x.to_le_bytes()
            } else {
                x.to_be_bytes()
            });
        }
        bytes.push(4);
        for i in 0..4i32 {
            bytes.extend(if little {
                i.to_le_bytes()
            } else {
                i.to_be_bytes()
            });
        }
        let mesh = parse_ply(path, &bytes).expect("a mesh");
        assert_eq!(mesh, expected, "{format}");
        let error = parse_ply(path, &bytes[..bytes.len() - 1]).expect_err("cut");
        assert!(error.message.starts_with("expected more data"), "{error}");
    }
    let compressed = crate::gunzip::tests::gzipped(text.as_bytes());
    let mesh = parse_ply(path, &compressed).expect("a mesh");
    assert_eq!(mesh, expected, "gzip");
    let broken = [
        ("x\n", "a.ply:1: expected `ply`"),
        ("ply\n", "a.ply:2: expected `end_header`"),
        (
            "ply\nfoo\n",
            "a.ply:2: expected a line of a PLY header, found `foo`",
        ),
        ("ply\nend_header\n", "a.ply:3: expected a `format` line"),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
             end_header\n0 0\n",
            "a.ply:7: expected a property `z` of vertices",
        ),
        (
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int corners\nend_header\n\
             3 0 0 0\n",
            "a.ply:6: expected a list `vertex_indices` of faces",
        ),
        (
            "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int \
             vertex_indices\nend_header\n0\n",
            "a.ply:6: expected at least one face",
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float \
             y\nproperty float z\nend_header\n1 2 3\n",
            "a.ply:9: expected a number, found the end of the file",
        ),
    ];
    for (text, expected) in broken {
        let error = parse_ply(path, text.as_bytes()).expect_err(text);
        assert_eq!(error.to_string(), expected, "{text}");
    }
    let text = head("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 9\n";
    let error = parse_ply(path, text.as_bytes()).expect_err("an index");
    assert!(
        error.to_string().contains("vertex 9 of 4 does not exist"),
        "{error}"
    );
}
