# SPDX-License-Identifier: Apache-2.0
"""Renders a volume under a sun and an even sky in Blender's Cycles, for scripts/bench_blender.py.

    blender -b --factory-startup --python-exit-code 1 --python scripts/blender_scene.py -- JOB.json

The job is a dictionary, see `scene` there, with the samples a pixel, the seed, the threads, the step
rate and the file to write. CPU seconds of the render, loading included, are written to JOB.json.out.
"""
import json
import math
import pathlib
import resource
import sys

import bpy
from mathutils import Matrix, Vector


def camera_to_world(origin, target):
    """Blender's camera looks along -Z with +Y up; the world's up is +Y here."""
    back = (Vector(origin) - Vector(target)).normalized()
    right = Vector((0.0, 1.0, 0.0)).cross(back).normalized()
    turn = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    return Matrix.Translation(Vector(origin)) @ turn


def add_camera(job):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(job["fov"])
    camera.clip_start, camera.clip_end = 0.01, 1e5
    thing = bpy.data.objects.new("camera", camera)
    thing.matrix_world = camera_to_world(job["origin"], job["target"])
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def add_sun(job):
    """A sun's strength is its irradiance; it shines along -Z of its object."""
    sun = bpy.data.lights.new("sun", "SUN")
    sun.angle = 0.0
    sun.energy = 1.0
    sun.color = job["irradiance"]
    thing = bpy.data.objects.new("sun", sun)
    thing.rotation_euler = Vector(job["direction"]).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)


def set_sky(job):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*job["radiance"], 1.0)
    background.inputs["Strength"].default_value = 1.0
    world.cycles.sampling_method = job["sky_sampling"]
    bpy.context.scene.world = world


def add_volume(job):
    """Extinction is density x scale: of it, the albedo scatters and the rest is absorbed."""
    volume = bpy.data.volumes.new("volume")
    volume.filepath = job["file"]
    volume.render.space = "WORLD"
    volume.render.precision = "FULL"
    volume.render.clipping = 0.0
    volume.render.step_size = 0.0  # the size of a voxel
    thing = bpy.data.objects.new("volume", volume)
    bpy.context.collection.objects.link(thing)

    material = bpy.data.materials.new("medium")
    material.use_nodes = True
    material.cycles.volume_sampling = job["volume_sampling"]
    material.cycles.volume_interpolation = "LINEAR"
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    density = tree.nodes.new("ShaderNodeAttribute")
    density.attribute_name = job["grid"]
    total = tree.nodes.new("ShaderNodeAddShader")
    scatter = tree.nodes.new("ShaderNodeVolumeScatter")
    scatter.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    scatter.inputs["Anisotropy"].default_value = job["g"]
    absorb = tree.nodes.new("ShaderNodeVolumeAbsorption")
    absorb.inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    for node, part in ((scatter, job["albedo"]), (absorb, 1.0 - job["albedo"])):
        scaled = tree.nodes.new("ShaderNodeMath")
        scaled.operation = "MULTIPLY"
        scaled.inputs[1].default_value = job["scale"] * part
        tree.links.new(density.outputs["Fac"], scaled.inputs[0])
        tree.links.new(scaled.outputs["Value"], node.inputs["Density"])
    tree.links.new(scatter.outputs["Volume"], total.inputs[0])
    tree.links.new(absorb.outputs["Volume"], total.inputs[1])
    tree.links.new(total.outputs["Shader"], output.inputs["Volume"])
    volume.materials.append(material)


def set_render(job):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = job["size"]
    scene.render.resolution_percentage = 100
    scene.render.threads_mode = "FIXED"
    scene.render.threads = job["threads"]
    scene.render.filepath = job["picture"]
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "32"
    scene.render.film_transparent = False
    scene.view_settings.view_transform = "Raw"

    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = job["spp"]
    cycles.seed = job["seed"]
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.time_limit = 0.0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.max_bounces = cycles.volume_bounces = cycles.transparent_max_bounces = 1024
    cycles.volume_step_rate = job["step_rate"]
    cycles.volume_max_steps = 1024


def main():
    path = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
    job = json.loads(path.read_text())
    if not bpy.app.build_options.openvdb:
        raise SystemExit("this Blender was built without OpenVDB")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    add_camera(job)
    add_sun(job)
    set_sky(job)
    add_volume(job)
    set_render(job)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    bpy.ops.render.render(write_still=True)
    seconds = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before
    path.with_suffix(".json.out").write_text(json.dumps({"seconds": seconds}))


main()
