"""Scenes for which Mitsuba has other models than we (it takes the shadowing of facets toward the viewer and toward the
light as independent, and lets no light through a leaf), and what Cycles makes of them.

    python3.11 -m venv venv && venv/bin/pip install bpy==5.0.1 mitsuba==3.9.1
    venv/bin/python make_cycles.py

writes what make.py writes, and its rows into references.tsv.
"""

import math
import pathlib
import tempfile
import time

import bpy
import mathutils
import mitsuba as mi
import numpy as np

from make import BLOCKS, COPPER, RUNS, SIZE, ball, finish, floor, numbers, room

DEPTH = 32  # Cycles counts bounces in other ways: paths so long that it does not matter.


class Scene:
    """A scene in both languages."""

    def __init__(self, name, eye, target, fov, spp, depth=DEPTH, size=SIZE):
        self.name, self.spp, self.depth, self.size = name, spp, depth, size
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        camera = bpy.data.cameras.new("camera")
        camera.angle = math.radians(fov)
        looking = bpy.data.objects.new("camera", camera)
        forward = (mathutils.Vector(target) - mathutils.Vector(eye)).normalized()
        right = forward.cross(mathutils.Vector((0, 1, 0))).normalized()
        axes = mathutils.Matrix((right, right.cross(forward), -forward)).transposed()
        looking.matrix_world = mathutils.Matrix.Translation(eye) @ axes.to_4x4()
        self.scene.collection.objects.link(looking)
        self.scene.camera = looking
        self.pbrt = [
            f"# Written by make_cycles.py; paths of at most {depth} segments.",
            f'Film "rgb" "integer xresolution" {size} "integer yresolution" {size}',
            "Scale -1 1 1  # to a right-handed view",
            f"LookAt {numbers(eye)}  {numbers(target)}  0 1 0",
            f'Camera "perspective" "float fov" {fov}',
            "WorldBegin",
        ]

    def mesh(self, points, faces, material, radiance=None):
        """Triangles, which shine on both sides if at all."""
        pbrt_material, shade = material
        data = bpy.data.meshes.new("mesh")
        data.from_pydata([tuple(p) for p in points], [], [tuple(f) for f in faces])
        paint = bpy.data.materials.new("paint")
        paint.use_nodes = True
        nodes, links = paint.node_tree.nodes, paint.node_tree.links
        nodes.clear()
        out = nodes.new("ShaderNodeOutputMaterial")
        emission = ""
        if radiance is None:
            links.new(shade(nodes, links), out.inputs["Surface"])
        else:
            light = nodes.new("ShaderNodeEmission")
            light.inputs["Color"].default_value = (*radiance, 1)
            light.inputs["Strength"].default_value = 1
            links.new(light.outputs[0], out.inputs["Surface"])
            emission = f'AreaLightSource "diffuse" "rgb L" [{numbers(radiance)}] "bool twosided" true\n  '
        data.materials.append(paint)
        self.scene.collection.objects.link(bpy.data.objects.new("mesh", data))
        indices = " ".join(str(i) for face in faces for i in face)
        self.pbrt.append(
            f"AttributeBegin\n  {pbrt_material}\n  {emission}"
            f'Shape "trianglemesh" "point3 P" [{numbers(points)}] "integer indices" [{indices}]\nAttributeEnd'
        )

    def quad(self, points, material, radiance=None, uvs=None):
        assert uvs is None
        self.mesh(points, [[0, 1, 2], [0, 2, 3]], material, radiance)

    def constant(self, radiance):
        world = bpy.data.worlds.new("world")
        self.scene.world = world
        world.use_nodes = True
        sky = world.node_tree.nodes["Background"]
        sky.inputs["Color"].default_value = (*radiance, 1)
        sky.inputs["Strength"].default_value = 1
        self.pbrt.append(f'LightSource "infinite" "rgb L" [{numbers(radiance)}]')

    def picture(self, samples, seed):
        """What Cycles makes of it, with nothing on that trades truth for less noise, and what it says about that."""
        render, cycles = self.scene.render, self.scene.cycles
        render.engine = "CYCLES"
        render.resolution_x = render.resolution_y = self.size
        render.image_settings.file_format = "OPEN_EXR"
        render.image_settings.color_depth = "32"
        render.dither_intensity = 0
        cycles.samples, cycles.seed = samples, seed
        cycles.use_adaptive_sampling = cycles.use_denoising = False
        cycles.pixel_filter_type = "BOX"
        cycles.filter_width = 1
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
        cycles.light_sampling_threshold = cycles.blur_glossy = 0
        cycles.caustics_reflective = cycles.caustics_refractive = True
        cycles.max_bounces = self.depth - 2
        cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = self.depth - 2
        with tempfile.TemporaryDirectory() as folder:
            render.filepath = str(pathlib.Path(folder) / "run.exr")
            bpy.ops.render.render(write_still=True)
            file = mi.Bitmap(render.filepath)
            return np.array(file)[:, :, :3], file.metadata()

    def make(self):
        begin = time.time()
        runs = [self.picture(self.spp // RUNS, seed)[0] for seed in range(RUNS)]
        finish(self.name, self.pbrt, self.depth, self.spp, runs, time.time() - begin)


# Materials: what pbrt calls them, and what Cycles does.


def node(kind, inputs, **properties):
    def shade(nodes, _):
        shader = nodes.new(kind)
        for name, value in properties.items():
            setattr(shader, name, value)
        for name, value in inputs.items():
            shader.inputs[name].default_value = value
        return shader.outputs[0]

    return shade


def diffuse(reflectance):
    shade = node("ShaderNodeBsdfDiffuse", {"Color": (*reflectance, 1), "Roughness": 0})
    return f'Material "diffuse" "rgb reflectance" [{numbers(reflectance)}]', shade


def conductor(eta, k, alpha):
    inputs = {"IOR": eta, "Extinction": k, "Roughness": alpha**0.5}
    shade = node("ShaderNodeBsdfMetallic", inputs, distribution="GGX", fresnel_type="PHYSICAL_CONDUCTOR")
    return (
        f'Material "conductor" "rgb eta" [{numbers(eta)}] "rgb k" [{numbers(k)}] '
        f'"float roughness" {alpha} "bool remaproughness" false',
        shade,
    )


def leaf(reflectance, transmittance):
    def shade(nodes, links):
        both = nodes.new("ShaderNodeAddShader")
        parts = [("ShaderNodeBsdfDiffuse", reflectance), ("ShaderNodeBsdfTranslucent", transmittance)]
        for i, (kind, color) in enumerate(parts):
            links.new(node(kind, {"Color": (*color, 1)})(nodes, links), both.inputs[i])
        return both.outputs[0]

    return (
        f'Material "diffusetransmission" "rgb reflectance" [{numbers(reflectance)}] '
        f'"rgb transmittance" [{numbers(transmittance)}]',
        shade,
    )


def lamp_above(scene, y, half, radiance):
    points = [[-half, y, -half], [half, y, -half], [half, y, half], [-half, y, half]]
    scene.quad(points, diffuse([0, 0, 0]), radiance)


# The scenes.


def brushed():
    s = Scene("brushed", [0, 2.2, 5], [0, 0.7, 0], 40, spp=4096)
    floor(s, diffuse([0.5, 0.45, 0.4]))
    s.mesh(*ball([-0.9, 0.8, 0], 0.8), conductor(*COPPER, 0.5))
    s.mesh(*ball([0.9, 0.8, 0], 0.8), conductor([1.657, 0.880, 0.521], [9.224, 6.270, 4.837], 0.25))
    lamp_above(s, 4, 1.0, [8, 8, 9])
    s.constant([0.3, 0.35, 0.5])
    return s


def leaves():
    s = Scene("leaves", [0, 1.6, 5], [0, 0.8, 0], 45, spp=4096)
    floor(s, diffuse([0.6, 0.6, 0.6]))
    paper = leaf([0.3, 0.2, 0.1], [0.2, 0.6, 0.3])
    s.quad([[-1.5, 0.1, 0.5], [0.0, 0.1, -0.8], [0.0, 1.8, -0.8], [-1.5, 1.8, 0.5]], paper)
    s.quad([[0.3, 0.4, -0.3], [1.5, 0.6, -0.5], [1.5, 0.9, 0.9], [0.3, 0.7, 1.1]], paper)
    lamp_above(s, 3, 0.6, [10, 9, 8])
    lamp = np.array([-0.6, 0.4, -1.2]) + room()[2] * [0.5, 0.9, 0.0]
    s.quad(lamp, diffuse([0, 0, 0]), [4, 5, 6])
    return s


if __name__ == "__main__":
    for scene in (brushed, leaves):
        scene().make()
