use ::lights::sources::LightDesc;

use super::data_uri::tests::data_uri;
use super::tests::read;
use crate::glam::Vec3;

#[test]
fn punctual_lights_in_candela_and_lux_emit_along_minus_z() {
    let scene = read(
        r#""scenes": [{"nodes": [0, 1, 2]}], "nodes": [
            {"name": "bulb", "translation": [1, 2, 3], "scale": [7, 7, 7],
            "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"rotation": [0.70710678, 0, 0, -0.70710678],
            "extensions": {"KHR_lights_punctual": {"light": 1}}},
            {"extensions": {"KHR_lights_punctual": {"light": 2}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": 683, "color": [1, 0.5, 0], "range": 9},
            {"type": "spot", "intensity": 1366, "spot": {"innerConeAngle": 0.2,
            "outerConeAngle": 0.4}},
            {"type": "directional", "intensity": 68.3}]}}"#,
    )
    .expect("a scene");
    let warnings: Vec<_> = scene.warnings.iter().map(|w| w.message.as_str()).collect();
    let expected = [
        "extensions.KHR_lights_punctual.lights[0]: `range` was ignored: light goes on for ever",
        "accessors: was ignored",
        "bufferViews: was ignored",
    ];
    assert_eq!(warnings, expected, "nothing else");
    assert_eq!(scene.light_names, ["bulb", "", ""], "of the nodes");
    let [
        LightDesc::Point(point),
        LightDesc::Spot(spot),
        LightDesc::Distant(sun),
    ] = &scene.lights[..]
    else {
        panic!("three lights");
    };
    assert_eq!(point.position, Vec3::new(1.0, 2.0, 3.0), "place");
    assert_eq!(
        point.emission,
        Vec3::new(1.0, 0.5, 0.0),
        "683 cd of white are 1 W/sr"
    );
    assert_eq!(spot.emission, Vec3::splat(2.0), "1366 cd");
    assert_eq!((spot.falloff_start, spot.angle), (0.2, 0.4), "cone");
    let axis = spot.transform.transform_vector3(Vec3::Z);
    assert!(
        axis.abs_diff_eq(Vec3::NEG_Y, 1e-6),
        "turned down, not {axis}"
    );
    assert!(sun.direction.abs_diff_eq(Vec3::Z, 1e-6), "it comes from +z");
    assert!(sun.emission.abs_diff_eq(Vec3::splat(0.1), 1e-6), "68.3 lx");
}

#[test]
fn measured_luminaires_look_along_minus_z() {
    let file =
        "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 100\n0 60 90\n0\n500 250 0\n";
    let scene = read(&format!(
        r#""scenes": [{{"nodes": [0]}}],
        "nodes": [{{"extensions": {{"EXT_lights_ies": {{"light": 0, "multiplier": 0.5}}}}}}],
        "extensions": {{"EXT_lights_ies": {{"lights": [{{"uri": "{}"}}]}}}}"#,
        data_uri(file.as_bytes())
    ))
    .expect("a scene");
    let [LightDesc::Goniometric(light)] = &scene.lights[..] else {
        panic!("one light");
    };
    let toward = |w: Vec3| {
        let local = light.transform.inverse().transform_vector3(w);
        let uv = ::lights::math::equal_area::sphere_to_square(local);
        light.distribution.nearest(uv).x
    };
    assert!(
        toward(Vec3::NEG_Z) > 0.97,
        "full ahead: {}",
        toward(Vec3::NEG_Z)
    );
    let aside = Vec3::new(0.866, 0.0, -0.5);
    assert!(
        (toward(aside) - 0.5).abs() < 0.03,
        "half at 60 degrees: {}",
        toward(aside)
    );
    assert_eq!(toward(Vec3::Z), 0.0, "nothing behind");
    let web = ::lights::photometry::parse_lm63(file, |_| Err(String::new()))
        .expect("a luminaire")
        .web;
    let lumens = ::lights::math::spectrum::photometric::Lumen(0.5 * web.total_lumens());
    let amount = ::lights::sources::IntensityAmount::LuminousPower(lumens);
    assert_eq!(light.amount, amount, "half as much");
}

/// The extension's own frame: the zero of both angles along -z, level planes in x and y, and angles
/// of type C counter-clockwise.
#[test]
fn measured_luminaires_are_not_mirrored() {
    let file = "IESNA:LM-63-2002\nTILT=NONE\n1 9000 1 2 4 1 2 0 0 0\n1 1 100\n0 180\n0 90 180 270\n\
        100 100\n200 200\n300 300\n400 400\n";
    let scene = read(&format!(
        r#""scenes": [{{"nodes": [0]}}],
        "nodes": [{{"extensions": {{"EXT_lights_ies": {{"light": 0}}}}}}],
        "extensions": {{"EXT_lights_ies": {{"lights": [{{"uri": "{}"}}]}}}}"#,
        data_uri(file.as_bytes())
    ))
    .expect("a scene");
    let [LightDesc::Goniometric(light)] = &scene.lights[..] else {
        panic!("one light");
    };
    for (w, quarters) in [
        (Vec3::X, 1.0),
        (Vec3::Y, 2.0),
        (Vec3::NEG_X, 3.0),
        (Vec3::NEG_Y, 4.0),
    ] {
        let local = light.transform.inverse().transform_vector3(w);
        let uv = ::lights::math::equal_area::sphere_to_square(local);
        let found = light.distribution.nearest(uv).x * 4.0;
        assert!((found - quarters).abs() < 0.05, "{w}: {found} quarters");
    }
}

/// As exporters write a spot with a sharp edge.
#[test]
fn spots_may_have_a_sharp_edge() {
    let spot = |inner: f32, outer: f32| {
        let scene = read(&format!(
            r#""scenes": [{{"nodes": [0]}}],
            "nodes": [{{"extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}}],
            "extensions": {{"KHR_lights_punctual": {{"lights": [{{"type": "spot",
            "spot": {{"innerConeAngle": {inner}, "outerConeAngle": {outer}}}}}]}}}}"#
        ))?;
        match &scene.lights[..] {
            [LightDesc::Spot(spot)] => Ok((spot.falloff_start, spot.angle)),
            other => panic!("one spot, not {other:?}"),
        }
    };
    assert_eq!(spot(0.5, 0.5), Ok((0.5, 0.5)), "sharp");
    assert_eq!(spot(0.0, 0.5), Ok((0.0, 0.5)), "soft");
    for (inner, outer) in [(0.6, 0.5), (0.0, 0.0), (-0.1, 0.5), (0.5, 1.6)] {
        let error = spot(inner, outer);
        let expected = "expected an `outerConeAngle` above 0, of at most pi/2, and an \
                        `innerConeAngle` from 0 on, not above it";
        assert!(
            error.is_err_and(|e: String| e.ends_with(expected)),
            "{inner} {outer}"
        );
    }
}
