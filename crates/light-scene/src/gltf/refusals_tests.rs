use std::path::Path;

use super::parse_gltf;
use super::tests::{head, read};
use crate::Files;

#[test]
fn broken_documents_give_one_clear_line() {
    let node = |mesh: &str| {
        format!(r#""scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}], "meshes": [{mesh}]"#)
    };
    let primitive = |p: &str| node(&format!(r#"{{"primitives": [{p}]}}"#));
    let cases = [
        (
            r#""scene": 3"#.to_owned(),
            "a.gltf: scene: scenes[3] does not exist",
        ),
        (
            r#""scenes": [{"nodes": [0]}], "nodes": [{"children": [1]}, {"children": [0]}]"#.into(),
            "a.gltf: nodes[1].children[0]: expected a node that hangs nowhere else, found 0",
        ),
        (
            r#""nodes": [{}]"#.into(),
            "a.gltf: expected a member `scene` or `scenes`",
        ),
        (
            r#""scenes": [{"nodes": [0]}], "nodes": [{"scale": [1, 1]}]"#.into(),
            "a.gltf: nodes[0].scale: expected 3 numbers",
        ),
        (
            r#""scenes": [{"nodes": [0]}], "nodes": [{"rotation": [0, 0, 0, 0]}]"#.into(),
            "a.gltf: nodes[0]: expected a `rotation` of length 1",
        ),
        (
            r#""extensionsRequired": ["KHR_draco_mesh_compression"]"#.into(),
            "a.gltf: extensionsRequired[0]: expected meshes that are not compressed, found \
             \"KHR_draco_mesh_compression\"; `gltf-transform copy compressed.glb plain.glb` \
             unpacks meshes",
        ),
        (
            r#""extensionsRequired": ["X_squeeze"]"#.into(),
            "a.gltf: extensionsRequired[0]: expected an extension that is read, found \
             \"X_squeeze\"",
        ),
        (
            primitive(r#"{"attributes": {}}"#),
            "a.gltf: meshes[0].primitives[0].attributes: expected a member `POSITION`",
        ),
        (
            primitive(r#"{"attributes": {"POSITION": 9}}"#),
            "a.gltf: meshes[0].primitives[0].attributes.POSITION: accessors[9] does not exist",
        ),
        (
            primitive(r#"{"attributes": {"POSITION": 1}}"#),
            "a.gltf: accessors[1]: expected elements of 3 numbers",
        ),
        (
            primitive(r#"{"attributes": {"POSITION": 0}, "indices": 0}"#),
            "a.gltf: accessors[0]: expected single whole numbers of at least 0",
        ),
        (
            primitive(r#"{"attributes": {"POSITION": 0}}"#),
            "a.gltf: meshes[0].primitives[0]: expected three corners a triangle, found 4",
        ),
        (
            primitive(r#"{"attributes": {"POSITION": 0}, "material": 0}"#)
                + r#", "materials": [{"alphaMode": "SOFT"}]"#,
            "a.gltf: materials[0].alphaMode: expected OPAQUE, MASK or BLEND, found \"SOFT\"",
        ),
    ];
    for (json, expected) in cases {
        let error = read(&json).map(|_| ()).expect_err(&json);
        assert_eq!(error, expected, "{json}");
    }
}

#[test]
fn broken_accessors_are_named_and_ask_for_no_memory() {
    let scene = r#""scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 2}]}]"#;
    let cases = [
        (
            r#""count": 4, "type": "VEC3""#,
            r#""count": 5, "type": "VEC3""#,
            "a.gltf: accessors[0]: expected a view that holds 5 elements of 12 bytes from byte 0 \
             on, found 48 bytes",
        ),
        (
            r#""bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3""#,
            r#""componentType": 5126, "count": 999999999999, "type": "VEC3""#,
            "a.gltf: accessors[0].count: expected at most 536870912 numbers in all accessors that \
             are read, found 999999999999",
        ),
        (
            r#""byteOffset": 80, "byteLength": 12"#,
            r#""byteOffset": 18446744073709551615, "byteLength": 12"#,
            "a.gltf: bufferViews[2].byteLength: expected a part of a buffer of 92 bytes, found 12",
        ),
        (
            r#""bufferView": 2, "#,
            r#""bufferView": 2, "byteOffset": 2, "#,
            "a.gltf: accessors[2]: expected a view that holds 6 elements of 2 bytes from byte 2 \
             on, found 12 bytes",
        ),
        (
            r#""bufferView": 2, "#,
            r#""bufferView": 1, "#,
            "a.gltf: accessors[2]: element 3: vertex 16256 of 4 does not exist",
        ),
        (
            r#""byteLength": 48}"#,
            r#""byteLength": 48, "byteStride": 1}"#,
            "a.gltf: accessors[0]: expected a view that holds 4 elements of 12 bytes from byte 0 \
             on, found 48 bytes",
        ),
        (
            r#""byteLength": 92"#,
            r#""byteLength": 93"#,
            "a.gltf: buffers[0].byteLength: expected as many bytes as there are, 92, found 93",
        ),
        (
            "5126",
            "5124",
            "a.gltf: accessors[0].componentType: expected 5120, 5121, 5122, 5123, 5125 or 5126, \
             found 5124",
        ),
    ];
    for (good, bad, expected) in cases {
        let whole = format!("{{{} {scene}}}", head());
        let json = whole.replacen(good, bad, 1);
        assert_ne!(json, whole, "{good} is there");
        let error = parse_gltf(Path::new("a.gltf"), json.as_bytes(), Files::NONE);
        let error = error.map(|_| ()).expect_err(bad).to_string();
        assert_eq!(error, expected, "{bad}");
    }
}

/// Of files of the version before, what makes new ones of them is named.
#[test]
fn other_versions_are_refused() {
    let expected = r#"a.gltf: asset.version: expected version 2.0, found "#;
    for (version, more) in [
        ("1.0", "; `gltf-pipeline -i OLD -o NEW` makes 2.0 of it"),
        ("1.0.1", "; `gltf-pipeline -i OLD -o NEW` makes 2.0 of it"),
        ("3.0", ""),
    ] {
        let json = format!(r#"{{"asset": {{"version": "{version}"}}}}"#);
        let error = parse_gltf(Path::new("a.gltf"), json.as_bytes(), Files::NONE);
        let error = error.map(|_| ()).expect_err(version).to_string();
        assert_eq!(error, format!("{expected}\"{version}\"{more}"));
    }
}

/// What a file needs at least, not what it was written as, must be known.
#[test]
fn files_that_need_a_newer_version_are_refused() {
    let read = |least: &str| {
        let asset = format!(r#"{{"version": "2.1", "minVersion": "{least}"}}"#);
        let json = format!(r#"{{"asset": {asset}, "scenes": [{{"nodes": []}}]}}"#);
        let scene = parse_gltf(Path::new("a.gltf"), json.as_bytes(), Files::NONE);
        scene.map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(read("2.0"), Ok(()), "old enough");
    let expected = "a.gltf: asset.minVersion: expected version 2.0, the newest that is read, found \
                    \"2.1\"";
    assert_eq!(read("2.1"), Err(expected.to_owned()), "too new");
}
