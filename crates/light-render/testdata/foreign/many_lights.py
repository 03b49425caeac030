"""Noise times time of Cycles and of `lights` on the same scenes of many lights: which of them a user waits for longer.

    python3.11 -m venv venv && venv/bin/pip install bpy==5.0.1 mitsuba==3.9.1
    cargo build --release -p light-render
    venv/bin/python many_lights.py LIGHTS [SCENE...]

LIGHTS is the program that was built. Either renders the same description: 256 x 256 pixels, 64 samples each, direct light, two threads;
Cycles with its light tree and without what trades truth for noise (clamping, denoising, adaptive sampling), `lights` with its defaults.

The error is relMSE as of `lights compare`, over the pixels that show no lamp, against the mean of all pictures of the same renderer; means of
the whole and of blocks tell that the two agree. Time is that of all threads for the samples alone: CPU time of 64 samples less that of one,
so that reading the scene and building hierarchies count for neither, and other work on the machine for little. `wall` is what either says
of itself: 64 samples, no building.
"""

import json
import math
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import bpy
import mathutils
import mitsuba as mi
import numpy as np

from make import floor, numbers
from make_cycles import Scene, diffuse

SIZE, SPP, THREADS = 256, 64, 2
RUNS = 4


class Lamps(Scene):
    """A scene with lamps, of which Cycles has its own kinds."""

    def __init__(self, name, eye, target, fov):
        super().__init__(name, eye, target, fov, SPP, depth=2, size=SIZE)
        render, cycles = self.scene.render, self.scene.cycles
        render.threads_mode, render.threads = "FIXED", THREADS
        cycles.use_light_tree = True

    def box(self, low, high, material):
        """An upright box without a bottom."""
        (a, b, c), (d, e, f) = low, high
        points = [[x, y, z] for y in (b, e) for x, z in ((a, c), (a, f), (d, f), (d, c))]
        sides = [[0, 1, 2, 3][i] for i in range(4)]
        quads = [[i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4] for i in sides] + [[4, 5, 6, 7]]
        self.mesh(points, [t for q in quads for t in (q[:3], [q[0], q[2], q[3]])], material)

    def lamp(self, kind, position, power, color, axes=None, **properties):
        light = bpy.data.lights.new("lamp", kind)
        light.energy, light.color = power, color
        for name, value in properties.items():
            setattr(light, name, value)
        lamp = bpy.data.objects.new("lamp", light)
        lamp.matrix_world = mathutils.Matrix.Translation(position) @ mathutils.Matrix(axes or np.eye(3)).to_4x4()
        self.scene.collection.objects.link(lamp)

    def bulb(self, position, intensity):
        """A point light of this radiant intensity."""
        self.pbrt.append(f'LightSource "point" "point3 from" [{numbers(position)}] "rgb I" [{numbers(intensity)}]')
        self.lamp("POINT", position, 4 * math.pi, intensity, shadow_soft_size=0)

    def panel(self, center, half, radiance):
        """A square that shines down; for Cycles a lamp, which is no obstacle: to be hung where it would be none for us."""
        x, y, z = center
        points = [[x - half, y, z - half], [x + half, y, z - half], [x + half, y, z + half], [x - half, y, z + half]]
        self.pbrt.append(
            f'AttributeBegin\n  AreaLightSource "diffuse" "rgb L" [{numbers(radiance)}]\n'
            f'  Shape "trianglemesh" "point3 P" [{numbers(points)}] "integer indices" [0 1 2 0 2 3]\nAttributeEnd'
        )
        downward = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
        self.lamp("AREA", center, math.pi * (2 * half) ** 2, radiance, downward, shape="SQUARE", size=2 * half)


# The scenes: blocks on a floor, and lamps whose strengths differ a hundredfold.


def town(name, eye, target):
    s = Lamps(name, eye, target, 45)
    random = np.random.default_rng(3)
    floor(s, diffuse([0.6, 0.6, 0.6]), half=8)
    for _ in range(60):
        x, z = random.uniform(-7, 7, 2)
        width, depth, height = random.uniform([0.2, 0.2, 0.2], [0.8, 0.8, 1.5])
        s.box([x, 0, z], [x + width, height, z + depth], diffuse(random.uniform(0.3, 0.8, 3)))
    return s, random


def strength(random):
    return 10 ** random.uniform(-1, 1) * random.uniform(0.3, 1, 3)


def bulbs():
    """4,096 point lights among blocks"""
    s, random = town("bulbs", [0, 7, 12], [0, 0.3, 0])
    for position in random.uniform([-8, 0.05, -8], [8, 2.5, 8], (4096, 3)):
        s.bulb(position, 0.03 * strength(random))
    return s


def panels():
    """1,024 square panels of a ceiling, each one lamp for Cycles and two triangles for us"""
    s, random = town("panels", [0, 2.8, 7.5], [0, -0.5, 0])
    for i in range(1024):
        s.panel([(i % 32 - 15.5) / 2, 3, (i // 32 - 15.5) / 2], 0.05, strength(random) * 5)
    return s


def lanterns():
    """2,048 squares of a mesh among blocks, which shine on both sides"""
    s, random = town("lanterns", [0, 7, 12], [0, 0.3, 0])
    for radiance in [strength(random) * 20 for _ in range(16)]:
        points = []
        for center in random.uniform([-8, 0.1, -8], [8, 2.5, 8], (128, 3)):
            across, up = random.normal(size=(2, 3)) * 0.03
            points += [center, center + across, center + across + up, center + up]
        faces = [[4 * i, 4 * i + a, 4 * i + a + 1] for i in range(128) for a in (1, 2)]
        s.mesh(points, faces, diffuse([0, 0, 0]), radiance)
    return s


# The renderers: a picture, the CPU seconds of all that was done for it, and the seconds of rendering that it says itself.


def by_cycles(scene, samples, seed):
    before = resource.getrusage(resource.RUSAGE_SELF)
    pixels, about = scene.picture(samples, seed)
    minutes, seconds = about["cycles.ViewLayer.render_time"].split(":")[-2:]
    return pixels, cpu_seconds(resource.getrusage(resource.RUSAGE_SELF)) - cpu_seconds(before), 60 * int(minutes) + float(seconds)


def by_lights(program, file, samples, seed, depth=2):
    image = file.with_name("picture.exr")
    command = [program, "render", file, "-o", image, "--spp", samples, "--seed", seed, "--max-depth", depth]
    command += ["--threads", THREADS, "--quiet", "--json"]
    child = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, text=True)
    report = json.loads(child.stdout.read())
    _, status, usage = os.wait4(child.pid, 0)
    assert status == 0, f"{command} failed"
    return np.array(mi.Bitmap(str(image)))[:, :, :3], cpu_seconds(usage), report["seconds"]


def cpu_seconds(usage):
    return usage.ru_utime + usage.ru_stime


# Figures.


class Measured:
    """What a renderer makes of a scene: means of blocks and their variances, time, and relMSE over the pixels `counted`."""

    def __init__(self, render, counted):
        pictures, cpu, self.wall = zip(*[render(SPP, seed) for seed in range(RUNS)])
        reference = np.mean(pictures, axis=0)
        # The reference is the mean of all; that they are part of it is what the divisor RUNS - 1 corrects.
        errors = np.var(pictures, axis=0, ddof=1) / (reference**2 + 1e-2)
        self.rel_mse, self.whole_rel_mse = np.mean(errors[counted]), np.mean(errors)
        self.cpu = min(cpu) - min(render(1, seed)[1] for seed in range(RUNS))
        means = [blocks(picture) for picture in pictures]
        self.means, self.variances = np.mean(means, axis=0), np.var(means, axis=0, ddof=1) / RUNS

    def __str__(self):
        return (
            f"relMSE {self.rel_mse:.3g} ({self.whole_rel_mse:.3g} with lamps), {self.cpu:.2f} CPU s, wall {min(self.wall):.2f} s, "
            f"relMSE x CPU s {self.rel_mse * self.cpu:.3g}"
        )


def blocks(picture, side=32):
    n = SIZE // side
    return picture.reshape(n, side, n, side, 3).mean(axis=(1, 3))


def dark(lamps):
    """Where neither a pixel nor one beside it shows a lamp."""
    seen = np.pad(lamps.max(axis=2) > 0, 1)
    around = [np.roll(seen, (y, x), axis=(0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1)]
    return ~np.any(around, axis=0)[1:-1, 1:-1]


def compare(program, make):
    scene = make()
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / f"{scene.name}.pbrt"
        file.write_text("\n".join(scene.pbrt) + "\n")
        counted = dark(by_lights(program, file, 64, 0, depth=1)[0])
        ours = Measured(lambda samples, seed: by_lights(program, file, samples, seed), counted)
    theirs = Measured(lambda samples, seed: by_cycles(scene, samples, seed)[:3], counted)
    difference, variance = ours.means - theirs.means, ours.variances + theirs.variances
    z = difference.sum() / math.sqrt(variance.sum())
    lit = variance > 0
    z_squared = (difference[lit] ** 2 / variance[lit]).mean()
    print(f"{scene.name}: {make.__doc__}; {counted.mean():.0%} of the pixels show no lamp")
    print(f"  means {ours.means.mean():.5f}, {theirs.means.mean():.5f}: {z:.1f} standard errors apart; blocks' mean z^2 {z_squared:.2f}")
    print(f"  lights  {ours}")
    print(f"  Cycles  {theirs}")
    print(f"  ratio   {ours.rel_mse * ours.cpu / (theirs.rel_mse * theirs.cpu):.3f}", flush=True)


if __name__ == "__main__":
    program, *names = sys.argv[1:]
    for make in (bulbs, panels, lanterns):
        if not names or make.__name__ in names:
            compare(program, make)
