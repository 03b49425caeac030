use super::tests::read;

#[test]
fn broken_files_give_one_clear_line() {
    let cases = [
        ("", "a.pbrt: expected `WorldBegin`"),
        ("WorldBegin 3", "a.pbrt:1: expected a directive, found `3`"),
        (
            "WorldBegin \"x\"",
            "a.pbrt:1: expected a directive, found \"x\"",
        ),
        ("\nFoo", "a.pbrt:2: expected a directive, found `Foo`"),
        (
            "WorldBegin\nShape \"sphere\"\nShape \"sphere\" \"float radius\" 1e30",
            "a.pbrt:3: expected a size of at most about 1e19, found x from -1e30 to 1e30",
        ),
        (
            "WorldBegin\nShape \"disk\"\nShape \"disk\" \"float radius\" 1e19",
            "a.pbrt:3: expected a size of at most about 1e19, found x from -1e19 to 1e19",
        ),
        (
            "Translate 1 2",
            "a.pbrt:1: expected a distance, found the end of the file",
        ),
        (
            "Translate 1 2 x",
            "a.pbrt:1: expected a distance, found `x`",
        ),
        (
            "Scale 0 1 1 Camera \"perspective\"",
            "a.pbrt:1: expected a transform that can be inverted for the camera",
        ),
        (
            "Scale 1e30 1 1 Scale 1e30 1 1",
            "a.pbrt:1: expected a transform of finite numbers",
        ),
        (
            "WorldBegin Shape \"loopsubdiv\" \"integer levels\" 9 \"point3 P\" [0 0 0 1 0 0 0 1 0]",
            "a.pbrt:1: expected `levels` from 0 to 8, found 9",
        ),
        (
            "ActiveTransform Never",
            "a.pbrt:1: expected All, StartTime or EndTime, found `Never`",
        ),
        ("Option \"seed\" [ 3 4 ]", "a.pbrt:1: expected ], found `4`"),
        (
            "Option \"seed\" ]",
            "a.pbrt:1: expected the value of an option, found `]`",
        ),
        (
            "Camera \"orthographic\" \"float screenwindow\" [0 0 1 2]",
            "a.pbrt:1: expected two different numbers each in x and y of `screenwindow`",
        ),
        (
            "Camera \"spherical\" \"string mapping\" \"square\"",
            "a.pbrt:1: expected `mapping` to be \"equalarea\" or \"equirectangular\", found \"square\"",
        ),
        (
            "Rotate 1 0 0 0",
            "a.pbrt:1: expected an axis other than 0 0 0",
        ),
        (
            "LookAt 0 0 0 0 0 0 0 1 0",
            "a.pbrt:1: expected two points, and an up vector not along the view",
        ),
        (
            "WorldBegin\nCamera \"perspective\"",
            "a.pbrt:2: expected `Camera` before `WorldBegin`",
        ),
        (
            "WorldBegin Film \"rgb\"",
            "a.pbrt:1: expected `Film` before `WorldBegin`",
        ),
        (
            "WorldBegin PixelFilter \"box\"",
            "a.pbrt:1: expected `PixelFilter` before `WorldBegin`",
        ),
        (
            "WorldBegin AttributeBegin Sampler \"halton\"",
            "a.pbrt:1: expected `Sampler` before `WorldBegin`",
        ),
        (
            "WorldBegin Integrator \"path\"",
            "a.pbrt:1: expected `Integrator` before `WorldBegin`",
        ),
        (
            "WorldBegin Accelerator \"bvh\"",
            "a.pbrt:1: expected `Accelerator` before `WorldBegin`",
        ),
        (
            "WorldBegin\nWorldBegin",
            "a.pbrt:2: expected one `WorldBegin` only",
        ),
        ("AttributeEnd", "a.pbrt:1: expected `AttributeBegin` before"),
        ("TransformEnd", "a.pbrt:1: expected `TransformBegin` before"),
        ("ObjectEnd", "a.pbrt:1: expected `ObjectBegin` before"),
        (
            "Camera",
            "a.pbrt:1: expected a type in quotes, found the end of the file",
        ),
        (
            "Camera \"perspective\" \"float\" 1",
            "a.pbrt:1: expected \"TYPE NAME\", found \"float\"",
        ),
        (
            "Camera \"perspective\" \"float fov\" ]",
            "a.pbrt:1: expected a number as a value of `fov`, found `]`",
        ),
        (
            "Camera \"perspective\" \"float fov\" [1",
            "a.pbrt:1: expected a number as a value of `fov`, found the end of the file",
        ),
        (
            "Camera \"perspective\" \"float fov\" 200",
            "a.pbrt:1: expected `fov` between 0 and 180 degrees, found 200",
        ),
        ("Shape \"trianglemesh\"", "a.pbrt:1: expected \"point3 P\""),
        (
            "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1] \"string filename\" \"a.png\"",
            "a.pbrt:2: expected `filename` or `L`, found both",
        ),
        (
            "WorldBegin\nAreaLightSource \"diffuse\" \"rgb L\" [0 0 0] \"string filename\" \"a.png\"",
            "a.pbrt:2: expected `filename` or `L`, found both",
        ),
        (
            "WorldBegin\nLightSource \"point\" \"rgb I\" [1e38 1e38 1e38]",
            "a.pbrt:2: point light, amount: too large, the power of the light is not finite",
        ),
        (
            "WorldBegin\nLightSource \"distant\" \"float illuminance\" 3e38 \"float scale\" 2",
            "a.pbrt:2: distant light, emission: must be finite and not negative",
        ),
        (
            "WorldBegin\nAreaLightSource \"diffuse\" \"float power\" 3e38\n\
             Shape \"disk\" \"float radius\" 1e-3",
            "a.pbrt:3: expected a light of finite power",
        ),
        (
            "WorldBegin\nLightSource \"distant\" \"rgb L\" [1e20 1e20 1e20]\n\
             Shape \"sphere\" \"float radius\" 1e12",
            "a.pbrt:2: expected a light of finite power in a scene of this size",
        ),
        (
            "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1e20 1e20 1e20]\n\
             Shape \"sphere\" \"float radius\" 1e12",
            "a.pbrt:2: expected a light of finite power in a scene of this size",
        ),
        (
            "WorldBegin\nLightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 2 1 0 0 1 0]",
            "a.pbrt:2: portal infinite light, portal: must be a planar rectangle with an area",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0]",
            "a.pbrt:1: expected \"integer indices\" from 0 on",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0] \"integer indices\" [0 0 7]",
            "a.pbrt:1: vertex 7 of 1 does not exist",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0] \"integer indices\" [0 0]",
            "a.pbrt:1: expected three indices a triangle, found 2",
        ),
        (
            "Shape \"plymesh\"",
            "a.pbrt:1: expected \"string filename\"",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0]",
            "a.pbrt:1: expected as many normals and texture coordinates as vertices, 3",
        ),
        (
            "WorldBegin NamedMaterial \"a\"",
            "a.pbrt:1: expected a named material, found \"a\"",
        ),
        (
            "WorldBegin MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \
             NamedMaterial \"a\"",
            "a.pbrt:1: expected a named material, found \"a\"; the file names \"b\"",
        ),
        (
            "Integrator \"path\" \"int maxdepth\" 5",
            "a.pbrt:1: expected a type for `maxdepth`, found `int`; types are bool, integer, \
             float, point2, vector2, point3, vector3, normal, rgb, blackbody, spectrum, string \
             and texture",
        ),
        (
            "Attribute \"world\" \"float alpha\" 1",
            "a.pbrt:1: expected \"shape\", \"light\", \"material\", \"medium\" or \"texture\", \
             found \"world\"",
        ),
        (
            "Include \"a.pbrt\"",
            "a.pbrt:1: expected a file that does not include itself, or fewer than 32 in each \
             other",
        ),
    ];
    for (text, expected) in cases {
        let error = read("pbrt_broken", text).expect_err(text);
        assert_eq!(error, expected, "{text}");
    }
}
