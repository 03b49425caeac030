"""Scenes of more than surfaces that stand where they are described: fog, holes, a picture of the sky, copies of an object.

    venv/bin/python make_beyond.py [NAME...]

writes what make.py writes, in the same way.
"""

import math
import sys

import mitsuba as mi
import numpy as np

from make import Scene, T, ball, bitmap, diffuse, floor, image, lamp_above, numbers, rgb, room

DEPTH = 32  # Mitsuba counts holes as vertices: paths so long that it does not matter.


def lines(scene, *added):
    scene.pbrt += ["AttributeBegin", *("  " + line for line in added), "AttributeEnd"]


def triangles(points, faces, uvs=None):
    uv = f' "point2 uv" [{numbers(uvs)}]' if uvs is not None else ""
    indices = " ".join(str(i) for face in faces for i in face)
    return f'Shape "trianglemesh" "point3 P" [{numbers(points)}] "integer indices" [{indices}]{uv}'


def filled(scene, points, faces, sigma_s, sigma_a, g):
    """A closed surface that light passes unchanged, with a medium inside."""
    lines(
        scene,
        f'MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [{numbers(sigma_s)}] '
        f'"rgb sigma_a" [{numbers(sigma_a)}] "float g" {g}',
        'MediumInterface "fog" ""',
        'Material "interface"',
        triangles(points, faces),
    )
    sigma_t = np.add(sigma_s, sigma_a)
    fog = {
        "type": "homogeneous",
        "sigma_t": rgb(sigma_t / max(sigma_t)),
        "scale": max(sigma_t),
        "albedo": rgb(sigma_s / sigma_t),
        "phase": {"type": "hg", "g": g},
    }
    shape = {"type": "ply", "filename": scene.ply(points, faces, None), "face_normals": True}
    scene.add(shape | {"bsdf": {"type": "null"}, "interior": fog})


def perforated(scene, points, file, shares, uvs, material):
    """A square of which each place is there by a share, by a picture of one channel."""
    faces = [[0, 1, 2], [0, 2, 3]]
    pbrt_material, bsdf = material
    texels = image(file, np.repeat(shares[:, :, None], 3, axis=2))
    lines(
        scene,
        f'Texture "{file}" "float" "imagemap" "string filename" "{file}"',
        pbrt_material,
        triangles(points, faces, uvs) + f' "texture alpha" "{file}"',
    )
    mask = {"type": "mask", "opacity": bitmap(texels, "repeat"), "bsdf": bsdf}
    scene.add({"type": "ply", "filename": scene.ply(points, faces, uvs), "face_normals": True, "bsdf": mask})


def copies(scene, points, faces, material, places):
    """An object in several places, each a matrix."""
    pbrt_material, bsdf = material
    scene.pbrt += ['ObjectBegin "thing"', "  " + pbrt_material, "  " + triangles(points, faces), "ObjectEnd"]
    thing = {"type": "ply", "filename": scene.ply(points, faces, None), "face_normals": True, "bsdf": bsdf}
    group = f"thing{len(scene.mitsuba)}"
    scene.add({"type": "shapegroup", "shape": thing})
    for place in places:
        lines(scene, f"Transform [{numbers(np.transpose(place))}]", 'ObjectInstance "thing"')
        scene.add({"type": "instance", "to_world": T(place), "group": {"type": "ref", "id": group}})


def sky(scene, radiance):
    """The radiance by direction: as a lat-long and as an equal-area picture for us, and as Mitsuba's own lat-long, whose first and
    last rows are the poles themselves."""
    n = 64
    centers, around = (np.arange(n) + 0.5) / n, 2 * np.pi * (np.arange(2 * n) + 0.5) / (2 * n)
    ours, theirs = (radiance(lat_long(np.pi * rows, around)) for rows in (np.linspace(0, 1, 4 * n + 1)[1::2], np.linspace(0, 1, 2 * n)))
    image(f"{scene.name}-lat-long.exr", ours)
    scene.add({"type": "envmap", "bitmap": mi.Bitmap(theirs.astype(np.float32))})
    image(f"{scene.name}-equal-area.exr", radiance(equal_area(*np.meshgrid(centers, centers)) @ Y_UP))
    lines(scene, "Rotate -90 1 0 0  # from z up to y up", f'LightSource "infinite" "string filename" "{scene.name}-equal-area.exr"')


def lat_long(t, p):
    """Directions by the angle from the pole, a row, and the angle around it, a column."""
    t, p = np.meshgrid(t, p, indexing="ij")
    return np.stack([np.sin(t) * np.sin(p), np.cos(t), -np.sin(t) * np.cos(p)], axis=-1)


def equal_area(u, v):
    """Directions of a square whose centre is +z, as pbrt has it (Clarberg's map)."""
    x, y = 2 * u - 1, 2 * v - 1
    distance = 1 - np.abs(x) - np.abs(y)
    r = 1 - np.abs(distance)
    phi = np.pi / 4 * ((np.abs(y) - np.abs(x)) / np.maximum(r, 1e-9) + 1)
    across = r * np.sqrt(2 - r * r)
    return np.stack(
        [
            np.copysign(np.cos(phi), x) * across,
            np.copysign(np.sin(phi), y) * across,
            np.copysign(1 - r * r, distance),
        ],
        axis=-1,
    )


Y_UP = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]  # row vectors with z up times this have y up


# The scenes.


def fog():
    s = Scene("fog", [0, 1.6, 5], [0, 0.8, 0], 45, DEPTH, spp=16384)
    s.integrator = "volpath"
    floor(s, diffuse([0.5, 0.5, 0.5]))
    low, high = np.array([-1.5, 0.1, -1.2]), np.array([1.2, 1.5, 1.0])
    points, faces = ball([0, 0, 0], 1.0)
    filled(s, low + (points + 1) / 2 * (high - low), faces, [1.5, 1.0, 0.5], [0.2, 0.4, 0.6], 0.5)
    s.mesh(*ball([0.3, 0.8, 0], 0.25, cuts=1), diffuse([0.7, 0.3, 0.3]))
    lamp_above(s, 2.5, 0.4, [20, 20, 22])
    return s


def grille():
    s = Scene("grille", [0, 1.6, 5], [0, 0.8, 0], 45, DEPTH, spp=16384)
    floor(s, diffuse([0.6, 0.6, 0.6]))
    shares = np.random.default_rng(6).uniform(0, 1, (4, 5)).round(1)
    corners = np.array([[-1.2, 0.1, -0.4], [0.9, 0.1, 0.2], [0.9, 1.5, 0.2], [-1.2, 1.5, -0.4]])
    perforated(s, corners, "holes.exr", shares, [[0, 0], [2, 0], [2, 1.5], [0, 1.5]], diffuse([0.7, 0.5, 0.2]))
    s.box([-0.5, 0, -1.4], [0.2, 0.9, -0.8], diffuse([0.3, 0.5, 0.7]))
    lamp = np.array([0.4, 0.3, -1.9]) + room()[2] * [1.0, 1.2, 0]
    s.quad(lamp, diffuse([0, 0, 0]), [6, 5, 4])
    s.constant([0.1, 0.12, 0.2])
    return s


def clouds():
    """A sky that is bright at one place, seen by its light alone: Mitsuba smooths its texels, we do not."""
    s = Scene("clouds", [0, 4, 4], [0, 0.4, 0], 40, depth=4, spp=8192)
    floor(s, diffuse([0.5, 0.45, 0.4]), half=8)
    s.box([0.3, 0, -0.6], [1.3, 1.2, 0.4], diffuse([0.7, 0.7, 0.2]))
    s.mesh(*ball([-0.9, 0.8, 0], 0.8), diffuse([0.6, 0.6, 0.7]))
    bright = np.array([0.6, 0.5, 0.3]) / math.sqrt(0.7)

    def radiance(d):
        glow = np.exp(10 * (d @ bright - 1))[..., None] * [5, 4, 2]
        waves = 1 + 0.5 * np.sin(5 * d[..., :1] + 1) * np.cos(4 * d[..., 2:])
        return glow + waves * [0.2, 0.3, 0.6] * (1.2 + d[..., 1:2])

    sky(s, radiance)
    return s


def orchard():
    """One object in many places, turned, stretched and mirrored."""
    s = Scene("orchard", [0, 2.6, 6], [0, 0.6, 0], 40, depth=4, spp=8192)
    floor(s, diffuse([0.5, 0.55, 0.5]))
    points, faces = ball([0, 0.5, 0], 0.5, cuts=1)
    points = points * [1, 1.4, 1] + [[0.3 * max(p[1] - 0.5, 0), 0, 0] for p in points]
    random = np.random.default_rng(8)
    places = []
    for i in range(12):
        turn = random.uniform(0, 2 * math.pi)
        place = np.eye(4)
        place[:3, :3] = [[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]]
        place[:3, :3] = place[:3, :3] @ np.diag(random.uniform(0.5, 1.1, 3)) * (1 if i % 3 else [[-1, 1, 1]])
        place[:3, 3] = [(i % 4 - 1.5) * 1.1, 0, (i // 4 - 1) * 1.3]
        places.append(place)
    copies(s, points, faces, diffuse([0.3, 0.6, 0.2]), places)
    lamp_above(s, 4, 0.8, [10, 9, 8])
    s.constant([0.2, 0.25, 0.4])
    return s


if __name__ == "__main__":
    for scene in (fog, grille, clouds, orchard):
        if len(sys.argv) == 1 or scene.__name__ in sys.argv[1:]:
            scene().make()
