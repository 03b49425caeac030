"""Scenes for two renderers, and what Mitsuba 3 makes of them.

    python -m venv venv && venv/bin/pip install mitsuba==3.9.1 numpy
    venv/bin/python make.py [NAME...]

writes NAME.pbrt and NAME.exr beside this file, the standard errors of the means of its blocks of 8 x 8 pixels into
NAME-error.exr, and figures of the whole into references.tsv. Only the description of a scene is shared; what its words
mean is left to either renderer.
"""

import math
import pathlib
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

HERE = pathlib.Path(__file__).parent
SIZE = 48  # pixels a side
BLOCKS = 6  # of 8 x 8 pixels a side
RUNS = 16

mi.set_variant("scalar_rgb")
T = mi.ScalarTransform4f


def numbers(values):
    return " ".join(f"{float(v):.9g}" for v in np.asarray(values).flatten())


class Scene:
    """A scene in both languages."""

    def __init__(self, name, eye, target, fov, depth, spp, lens=None):
        self.name, self.depth, self.spp, self.integrator = name, depth, spp, "path"
        self.scratch = pathlib.Path(tempfile.mkdtemp())
        camera = f'"float fov" {fov}'
        sensor = {
            "type": "perspective",
            "fov": fov,
            "fov_axis": "smaller",
            "to_world": T().look_at(origin=eye, target=target, up=[0, 1, 0]),
            "film": {
                "type": "hdrfilm",
                "width": SIZE,
                "height": SIZE,
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": "independent"},
        }
        if lens:
            radius, distance = lens
            camera += f' "float lensradius" {radius} "float focaldistance" {distance}'
            sensor |= {"type": "thinlens", "aperture_radius": radius, "focus_distance": distance}
        self.pbrt = [
            f"# Written by make.py; paths of at most {depth} segments.",
            f'Film "rgb" "integer xresolution" {SIZE} "integer yresolution" {SIZE}',
            "Scale -1 1 1  # to a right-handed view",
            f"LookAt {numbers(eye)}  {numbers(target)}  0 1 0",
            f'Camera "perspective" {camera}',
            "WorldBegin",
        ]
        self.mitsuba = {"type": "scene", "sensor": sensor}

    def add(self, thing):
        self.mitsuba[f"thing{len(self.mitsuba)}"] = thing

    def mesh(self, points, faces, material, radiance=None, uvs=None, texture=None):
        """Triangles; `radiance` leaves the side from which they run counter-clockwise."""
        pbrt_material, bsdf = material
        self.pbrt.append("AttributeBegin")
        self.pbrt.append("  " + pbrt_material)
        shape = {"type": "ply", "filename": self.ply(points, faces, uvs), "face_normals": True}
        shape["bsdf"] = bsdf
        if texture is not None:
            file, texels = texture
            self.pbrt.append(f'  AreaLightSource "diffuse" "string filename" "{file}"')
            shape["emitter"] = {"type": "area", "radiance": bitmap(texels, "clamp")}
        elif radiance is not None:
            self.pbrt.append(f'  AreaLightSource "diffuse" "rgb L" [{numbers(radiance)}]')
            shape["emitter"] = {"type": "area", "radiance": rgb(radiance)}
        uv = f' "point2 uv" [{numbers(uvs)}]' if uvs is not None else ""
        indices = " ".join(str(i) for face in faces for i in face)
        self.pbrt.append(
            f'  Shape "trianglemesh" "point3 P" [{numbers(points)}] "integer indices" [{indices}]{uv}'
        )
        self.pbrt.append("AttributeEnd")
        self.add(shape)

    def quad(self, points, material, radiance=None, **more):
        self.mesh(points, [[0, 1, 2], [0, 2, 3]], material, radiance, **more)

    def box(self, low, high, material):
        for face in room():
            inward = np.asarray(low) + face * (np.asarray(high) - np.asarray(low))
            self.quad(inward[::-1], material)

    def ply(self, points, faces, uvs):
        file = self.scratch / f"{len(self.mitsuba)}.ply"
        names = ["x", "y", "z"] + (["u", "v"] if uvs is not None else [])
        header = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
        header += [f"property float {n}" for n in names]
        header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
        rows = np.hstack([points, uvs]) if uvs is not None else np.asarray(points)
        lines = header + [numbers(row) for row in rows] + ["3 " + " ".join(map(str, f)) for f in faces]
        file.write_text("\n".join(lines) + "\n")
        return str(file)

    def point(self, position, intensity):
        self.pbrt.append(f'LightSource "point" "point3 from" [{numbers(position)}] "rgb I" [{numbers(intensity)}]')
        self.add({"type": "point", "position": position, "intensity": rgb(intensity)})

    def spot(self, position, target, angle, intensity):
        """A cone with a hard rim: the two renderers round it off in different ways."""
        self.pbrt.append(
            f'LightSource "spot" "point3 from" [{numbers(position)}] "point3 to" [{numbers(target)}] '
            f'"float coneangle" {angle} "float conedeltaangle" 0 "rgb I" [{numbers(intensity)}]'
        )
        self.add(
            {
                "type": "spot",
                "to_world": T().look_at(origin=position, target=target, up=[0.1, 0.2, 1]),
                "cutoff_angle": angle,
                "beam_width": angle * 0.99999,
                "intensity": rgb(intensity),
            }
        )

    def distant(self, travel, irradiance):
        self.pbrt.append(
            f'LightSource "distant" "point3 from" [0 0 0] "point3 to" [{numbers(travel)}] "rgb L" [{numbers(irradiance)}]'
        )
        self.add({"type": "directional", "direction": travel, "irradiance": rgb(irradiance)})

    def constant(self, radiance):
        self.pbrt.append(f'LightSource "infinite" "rgb L" [{numbers(radiance)}]')
        self.add({"type": "constant", "radiance": rgb(radiance)})

    def make(self):
        self.mitsuba["integrator"] = {"type": self.integrator, "max_depth": self.depth, "rr_depth": 1000}
        scene = mi.load_dict(self.mitsuba)
        begin = time.time()
        runs = [np.array(mi.render(scene, spp=self.spp // RUNS, seed=s)) for s in range(RUNS)]
        finish(self.name, self.pbrt, self.depth, self.spp, runs, time.time() - begin)


def finish(name, pbrt, depth, spp, runs, seconds):
    """Writes the scene, its picture, its errors and its row."""
    mean = np.mean(runs, axis=0)
    error = deviation([run.mean(axis=(0, 1)) for run in runs])
    rel_mse = np.mean(deviation(runs) ** 2 / (mean**2 + 1e-2))
    blocks = [run.reshape(BLOCKS, SIZE // BLOCKS, BLOCKS, SIZE // BLOCKS, 3).mean(axis=(1, 3)) for run in runs]
    (HERE / f"{name}.pbrt").write_text("\n".join(pbrt) + "\n")
    mi.Bitmap(mean.astype(np.float32)).write(str(HERE / f"{name}.exr"))
    mi.Bitmap(deviation(blocks).astype(np.float32)).write(str(HERE / f"{name}-error.exr"))
    figures = [*mean.mean(axis=(0, 1)), *error, rel_mse]
    row = "\t".join([name, str(depth), str(spp), *(f"{figure:.6g}" for figure in figures)])
    print(f"{name}: {seconds:.0f} s, mean {mean.mean(axis=(0, 1))}, relMSE {rel_mse:.2e}", flush=True)
    table = HERE / "references.tsv"
    rows = table.read_text().splitlines()[1:] if table.exists() else []
    rows = [old for old in rows if not old.startswith(name + "\t")] + [row]
    head = "scene\tdepth\tspp\tmean_r\tmean_g\tmean_b\terror_r\terror_g\terror_b\trel_mse"
    table.write_text("\n".join([head, *sorted(rows)]) + "\n")


def deviation(runs):
    """The standard error of the mean of all runs."""
    return np.std(runs, axis=0, ddof=1) / math.sqrt(RUNS)


def rgb(values):
    return {"type": "rgb", "value": [float(v) for v in np.broadcast_to(values, 3)]}


def bitmap(texels, wrap):
    """An image whose first row is at v = 1 as in pbrt (in Mitsuba it is at 0)."""
    return {
        "type": "bitmap",
        "bitmap": mi.Bitmap(np.asarray(texels[::-1], dtype=np.float32)),
        "raw": True,
        "wrap_mode": wrap,
    }


def image(file, texels):
    texels = texels.astype(np.float32)
    mi.Bitmap(texels).write(str(HERE / file))
    return texels


# Materials: what pbrt calls them, and what Mitsuba does.


def diffuse(reflectance):
    bsdf = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(reflectance)}}
    return f'Material "diffuse" "rgb reflectance" [{numbers(np.broadcast_to(reflectance, 3))}]', bsdf


def diffuse_image(file, texels):
    bsdf = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": bitmap(texels, "repeat")}}
    return (
        f'Texture "{file}" "spectrum" "imagemap" "string filename" "{file}"\n'
        f'  Material "diffuse" "texture reflectance" "{file}"',
        bsdf,
    )


def conductor(eta, k, alpha):
    kind = {"type": "roughconductor", "distribution": "ggx", "alpha": alpha} if alpha else {"type": "conductor"}
    bsdf = kind | {"eta": rgb(eta), "k": rgb(k)}
    return (
        f'Material "conductor" "rgb eta" [{numbers(eta)}] "rgb k" [{numbers(k)}] '
        f'"float roughness" {alpha} "bool remaproughness" false',
        {"type": "twosided", "bsdf": bsdf},
    )


def dielectric(eta, alpha):
    kind = {"type": "roughdielectric", "distribution": "ggx", "alpha": alpha} if alpha else {"type": "dielectric"}
    return (
        f'Material "dielectric" "float eta" {eta} "float roughness" {alpha} "bool remaproughness" false',
        kind | {"int_ior": eta, "ext_ior": 1.0},
    )


def thin_dielectric(eta):
    return (
        f'Material "thindielectric" "float eta" {eta}',
        {"type": "thindielectric", "int_ior": eta, "ext_ior": 1.0},
    )


def coated(reflectance, eta):
    plastic = {
        "type": "plastic",
        "diffuse_reflectance": rgb(reflectance),
        "int_ior": eta,
        "ext_ior": 1.0,
        "nonlinear": True,
    }
    return (
        f'Material "coateddiffuse" "rgb reflectance" [{numbers(reflectance)}] "float eta" {eta} "float roughness" 0',
        {"type": "twosided", "bsdf": plastic},
    )


# Shapes.


def room():
    """The faces of [0, 1]^3, counter-clockwise seen from inside: floor, ceiling, back, left, right, front."""
    faces = [
        "000 001 101 100",
        "010 110 111 011",
        "000 100 110 010",
        "000 010 011 001",
        "100 101 111 110",
        "001 011 111 101",
    ]
    return [np.array([[float(d) for d in corner] for corner in face.split()]) for face in faces]


def ball(center, radius, cuts=2):
    """An icosahedron with each face cut into four, `cuts` times."""
    g = (1 + 5**0.5) / 2
    points = [p for a in (-1, 1) for b in (-g, g) for p in ([0, a, b], [a, b, 0], [b, 0, a])]
    points = [np.array(p) / np.linalg.norm(p) for p in points]
    side = min(np.linalg.norm(points[0] - p) for p in points[1:]) * 1.01
    near = lambda a, b: np.linalg.norm(points[a] - points[b]) < side
    faces = [
        (a, b, c)
        for a in range(12)
        for b in range(a + 1, 12)
        for c in range(b + 1, 12)
        if near(a, b) and near(b, c) and near(a, c)
    ]
    outward = lambda f: np.dot(np.cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]), points[f[0]]) > 0
    faces = [f if outward(f) else (f[0], f[2], f[1]) for f in faces]
    for _ in range(cuts):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                m = points[a] + points[b]
                points.append(m / np.linalg.norm(m))
                middles[key] = len(points) - 1
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return np.array(points) * radius + np.asarray(center), faces


def floor(scene, material, half=4.0, uvs=None):
    scene.quad([[-half, 0, -half], [-half, 0, half], [half, 0, half], [half, 0, -half]], material, uvs=uvs)


def lamp_above(scene, y, half, radiance):
    points = [[-half, y, -half], [half, y, -half], [half, y, half], [-half, y, half]]
    scene.quad(points, diffuse(0.0), radiance)


# The scenes.

COPPER = [0.200, 0.924, 1.102], [3.912, 2.452, 2.142]


def cornell():
    s = Scene("cornell", [0.5, 0.5, 0.97], [0.5, 0.4, 0.0], 75, depth=8, spp=16384)
    white, red, green = diffuse([0.75] * 3), diffuse([0.6, 0.1, 0.1]), diffuse([0.1, 0.5, 0.1])
    for face, material in zip(room(), [white, white, white, red, green, white]):
        s.quad(face, material)
    lamp = np.array([0.35, 0.98, 0.35]) + room()[1] * [0.3, 0, 0.3]
    s.quad(lamp, diffuse([0.5] * 3), [9, 7, 5])
    s.box([0.2, 0, 0.3], [0.5, 0.5, 0.6], white)
    return s


def metals():
    s = Scene("metals", [0, 2.2, 5], [0, 0.7, 0], 40, depth=6, spp=8192)
    floor(s, diffuse([0.5, 0.45, 0.4]))
    s.mesh(*ball([-0.9, 0.8, 0], 0.8), conductor(*COPPER, 0.1))
    s.mesh(*ball([0.9, 0.8, 0], 0.8), conductor([1.657, 0.880, 0.521], [9.224, 6.270, 4.837], 0))
    lamp_above(s, 4, 1.0, [8, 8, 9])
    s.constant([0.3, 0.35, 0.5])
    return s


def glasses():
    s = Scene("glasses", [0, 2.2, 5], [0, 0.7, 0], 40, depth=8, spp=32768)
    floor(s, diffuse([0.5, 0.45, 0.4]))
    s.mesh(*ball([-1.0, 0.8, 0], 0.8), dielectric(1.5, 0.1))
    s.mesh(*ball([0.9, 0.8, 0.2], 0.7), dielectric(1.33, 0))
    s.quad([[-0.4, 0.1, 1.4], [0.5, 0.1, 1.2], [0.5, 1.0, 1.2], [-0.4, 1.0, 1.4]], thin_dielectric(1.5))
    lamp_above(s, 4, 1.5, [4, 4, 4.5])
    s.constant([0.3, 0.35, 0.5])
    return s


def lacquer():
    s = Scene("lacquer", [0, 2.2, 5], [0, 0.7, 0], 40, depth=6, spp=8192)
    floor(s, coated([0.6, 0.3, 0.2], 1.5))
    s.mesh(*ball([-0.9, 0.8, 0], 0.8), coated([0.1, 0.5, 0.8], 1.5))
    s.box([0.3, 0, -0.6], [1.3, 1.2, 0.4], coated([0.7, 0.7, 0.2], 1.3))
    lamp_above(s, 4, 1.0, [8, 8, 9])
    s.constant([0.3, 0.35, 0.5])
    return s


def spots():
    s = Scene("spots", [0, 3, 6], [0, 0.5, 0], 40, depth=4, spp=4096)
    floor(s, diffuse([0.5, 0.55, 0.6]))
    s.box([-0.8, 0, -0.5], [0, 1, 0.3], diffuse([0.7, 0.3, 0.3]))
    s.mesh(*ball([0.9, 0.6, 0.3], 0.6), diffuse([0.3, 0.7, 0.3]))
    s.spot([2, 3, 2], [0.3, 0.3, 0], 18, [40, 30, 20])
    s.spot([-3, 2, 1], [-0.5, 0, 0.5], 12, [5, 10, 30])
    s.point([0.2, 2.5, 1.5], [2, 2, 2.5])
    s.distant([1, -2, -1], [0.3, 0.3, 0.2])
    return s


def lens():
    s = Scene("lens", [0, 1.6, 5], [0, 0.6, 0], 35, depth=5, spp=8192, lens=(0.25, 4.0))
    floor(s, diffuse([0.5, 0.5, 0.5]))
    for i in range(5):
        low = np.array([-2 + 0.9 * i, 0, 2.0 - 1.2 * i])
        s.box(low, low + [0.5, 1.2, 0.5], diffuse([0.2 + 0.15 * i, 0.6, 0.8 - 0.15 * i]))
    s.distant([-1, -2, -1.5], [2, 1.8, 1.6])
    s.constant([0.4, 0.5, 0.7])
    return s


def screen():
    """A picture that shines, a lamp that shines on both sides, a floor with a pattern."""
    s = Scene("screen", [0, 1.6, 5], [0, 0.8, 0], 45, depth=4, spp=8192)
    tiles = image("tiles.exr", np.random.default_rng(4).uniform(0.05, 0.9, (5, 3, 3)))
    floor(s, diffuse_image("tiles.exr", tiles), uvs=[[0, 0], [0.5, 4], [4, 4.5], [3.5, 0.5]])
    s.quad([[-4, 0, -2.5], [4, 0, -2.5], [4, 4, -2.5], [-4, 4, -2.5]], diffuse([0.5, 0.5, 0.5]))
    picture = image("picture.exr", np.random.default_rng(5).uniform(0, 1, (4, 4, 3)) ** 4 * 10)
    points = [[-1.6, 0.2, -1.5], [0.4, 0.2, -1.9], [0.4, 1.9, -1.9], [-1.6, 1.9, -1.5]]
    uvs = [[0, 0], [1, 0], [1, 1], [0, 1]]
    s.quad(points, diffuse([0, 0, 0]), uvs=uvs, texture=("picture.exr", picture))
    leaf = np.array([[1.2, 0.3, -0.5], [1.8, 0.3, 0.2], [1.8, 1.3, 0.2], [1.2, 1.3, -0.5]])
    s.quad(leaf, diffuse([0.2, 0.2, 0.2]), [2, 3, 1])
    s.quad(leaf[::-1] + [1e-4, 0, -1e-4], diffuse([0.2, 0.2, 0.2]), [2, 3, 1])
    return s


def lanterns():
    """Three hundred little lamps of strengths that differ a thousandfold, some of them in each other's way."""
    s = Scene("lanterns", [0, 3, 6], [0, 0.8, 0], 45, depth=3, spp=32768)
    floor(s, diffuse([0.6, 0.6, 0.6]))
    s.box([-1.5, 0, -1], [-0.5, 1.5, 0], diffuse([0.7, 0.7, 0.7]))
    s.mesh(*ball([1.0, 0.7, 0], 0.7), conductor(*COPPER, 0.3))
    random = np.random.default_rng(9)
    for _ in range(150):
        center = random.uniform([-3, 0.05, -3], [3, 2.5, 3])
        across, up = random.normal(size=(2, 3)) * 0.04
        radiance = 10 ** random.uniform(-0.5, 2.5) * random.uniform(0.2, 1, 3)
        s.quad([center, center + across, center + across + up, center + up], diffuse([0, 0, 0]), radiance)
    return s


SCENES = [cornell, metals, glasses, lacquer, spots, lens, screen, lanterns]


if __name__ == "__main__":
    for make in SCENES:
        if len(sys.argv) == 1 or make.__name__ in sys.argv[1:]:
            make().make()
