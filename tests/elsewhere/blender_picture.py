"""The room by Blender's Cycles, by the module bpy, on one thread. Prints the CPU seconds of rendering
alone.

  blender_picture.py FOLDER NAME SPP SEED OUT.pfm     FOLDER: of bakeslab export --as cycles
"""
import math
import os
import sys
import time

import bpy
import numpy as np
from mathutils import Vector

import room

folder, name, spp, seed, out = sys.argv[1:]
out = os.path.abspath(out)
sys.path.insert(0, folder)
import canned_lights


def paint(albedo):
    material = bpy.data.materials.new('paint')
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    surface, output = tree.nodes.new('ShaderNodeBsdfDiffuse'), tree.nodes.new('ShaderNodeOutputMaterial')
    surface.inputs['Color'].default_value = *albedo, 1
    tree.links.new(surface.outputs[0], output.inputs['Surface'])
    return material


def add_room(scene):
    for part, albedo, faces in room.parts():
        mesh, first = bpy.data.meshes.new(part), 0
        corners = [room.z_up(p) for face in faces for p in face]
        polygons = []
        for face in faces:
            polygons.append(range(first, first + len(face)))
            first += len(face)
        mesh.from_pydata(corners, [], polygons)
        mesh.materials.append(paint(albedo))
        scene.collection.objects.link(bpy.data.objects.new(part, mesh))


def add_camera(scene):
    camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    camera.location = room.z_up(room.EYE)
    camera.rotation_euler = (Vector(room.z_up(room.TARGET)) - camera.location).to_track_quat('-Z', 'Y').to_euler()
    camera.data.sensor_fit, camera.data.angle = 'HORIZONTAL', math.radians(room.FOV)
    camera.data.clip_end = 1e4
    scene.collection.objects.link(camera)
    scene.camera = camera


def set_up(scene):
    render, cycles = scene.render, scene.cycles
    render.engine = 'CYCLES'
    cycles.samples, cycles.seed = int(spp), int(seed)
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.max_bounces = 0
    cycles.pixel_filter_type = 'BOX'   # a pixel wide, whatever filter_width is
    render.threads_mode, render.threads = 'FIXED', 1
    render.resolution_x, render.resolution_y = room.SIZE
    render.resolution_percentage = 100
    render.image_settings.file_format, render.image_settings.color_depth = 'OPEN_EXR', '32'
    render.filepath = out + '.exr'


def render():
    """CPU seconds; what it tells of its progress goes nowhere."""
    kept, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    start = time.process_time()
    bpy.ops.render.render(write_still=True)
    spent = time.process_time() - start
    os.dup2(kept, 1)
    return spent


bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
add_room(scene)
add_camera(scene)
set_up(scene)
lamp = canned_lights.add_lamp(os.path.join(folder, f'{name}.json'), scene)
a, b, c = map(math.radians, room.TURN)
lamp.rotation_mode, lamp.rotation_euler, lamp.location = 'XZY', (-a, -c, -b), room.z_up(room.MOVE)
print(f'{render():.4f}')
image = bpy.data.images.load(out + '.exr')
pixels = np.array(image.pixels[:], np.float32).reshape(image.size[1], image.size[0], 4)
room.write(out, pixels[::-1, :, :3])
