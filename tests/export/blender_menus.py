# blender_menus.py FOLDER NAME - what the add-on's menus do, without a window: its operators are
# called as the menus call them, with a path. FOLDER is of bakeslab export --as cycles. Exit status 1,
# and a traceback, where something is not as it should be.
import math
import os
import shutil
import subprocess
import sys

import bpy
from mathutils import Euler, Matrix, Vector

folder, name = sys.argv[1:]
path = os.path.join(folder, f'{name}.json')
sys.dont_write_bytecode = True
sys.path.insert(0, folder)
import canned_lights


def entries(menu):
    """The functions of the add-on that a menu draws."""
    return [draw for draw in getattr(bpy.types, menu)._dyn_ui_initialize() if draw.__module__ == 'canned_lights']


def near(a, b):
    return all(abs(x - y) < 1e-5 for row, other in zip(a, b) for x, y in zip(row, other))


def light_of(lamp):
    (holder,) = lamp.children
    return holder, holder.data


def energy(lamp):
    return light_of(lamp)[1].evaluated_get(bpy.context.evaluated_depsgraph_get()).energy


def radiance(lamp):
    """What the light's energy makes it, by Blender's rules."""
    bpy.context.view_layer.update()
    holder, light = light_of(lamp)
    if hasattr(light, 'normalize'):
        assert not light.normalize
        return energy(lamp) / math.pi
    scale = holder.matrix_world.to_scale()
    return energy(lamp) / (math.pi * light.size * light.size_y * abs(scale.x * scale.y))


bpy.ops.wm.read_factory_settings(use_empty=True)
canned_lights.register()
assert [len(entries(menu)) for menu in ('TOPBAR_MT_file_import', 'VIEW3D_MT_light_add')] == [1, 1]

# File > Import > Light slab: where lamp space is.
assert bpy.ops.import_scene.light_slab(filepath=path, gain=2) == {'FINISHED'}
lamp = bpy.context.view_layer.objects.active
assert lamp.name == name and lamp.type == 'EMPTY' and lamp.select_get()
assert near(lamp.matrix_world, Matrix())
holder, light = light_of(lamp)
assert light.type == 'AREA' and holder.visible_camera
assert abs(radiance(lamp) - 2) < 1e-5
lamp['gain'] = .5
lamp.update_tag()
assert abs(radiance(lamp) - .5) < 1e-5
lamp.scale, lamp.rotation_euler = (-3, 3, 3), (.3, .2, 1)
lamp.update_tag()
assert abs(radiance(lamp) - .5) < 1e-5

# Add > Light > Canned light: at the cursor, which is turned.
cursor = bpy.context.scene.cursor
cursor.location, cursor.rotation_euler = (1, 2, 3), (.1, .2, .3)
assert bpy.ops.object.canned_light_add(filepath=path) == {'FINISHED'}
second = bpy.context.view_layer.objects.active
assert second is not lamp and second.name != name and not lamp.select_get()
assert near(second.matrix_world, Matrix.Translation((1, 2, 3)) @ Euler((.1, .2, .3)).to_matrix().to_4x4())
assert abs(radiance(second) - 1) < 1e-5

# What is no lamp is told, and leaves nothing.
before = len(bpy.data.objects), len(bpy.data.images), len(bpy.data.collections)
bad = os.path.join(folder, 'bad.json')
with open(bad, 'w', encoding='ascii') as file:
    file.write('{"format": "something"}')
for wrong in (bad, os.path.join(folder, 'none.json'), os.path.join(folder, 'README.md')):
    try:
        bpy.ops.import_scene.light_slab(filepath=wrong)
        raise AssertionError(wrong)
    except RuntimeError as told:
        assert os.path.basename(wrong) in str(told), told
canned_lights.bl_info['blender'] = (99, 0, 0)
try:
    bpy.ops.import_scene.light_slab(filepath=path)
    raise AssertionError('an old Blender')
except RuntimeError as told:
    assert bpy.app.version_string in str(told), told
assert before == (len(bpy.data.objects), len(bpy.data.images), len(bpy.data.collections))

# The pictures are in the scene's file, and the lamp goes on without its folder.
image = next(node.image for node in light.node_tree.nodes if node.type == 'TEX_IMAGE')
assert image.packed_file and image.colorspace_settings.name == 'Non-Color'
saved = os.path.join(folder, 'saved.blend')
bpy.ops.wm.save_as_mainfile(filepath=saved)
moved = os.path.join(folder, 'moved.blend')
shutil.move(saved, moved)
bpy.ops.wm.open_mainfile(filepath=moved)
lamp = bpy.data.objects[name]
assert lamp['gain'] == .5
image = next(node.image for node in light_of(lamp)[1].node_tree.nodes if node.type == 'TEX_IMAGE')
assert image.packed_file and image.size[0] > 0
canned_lights.unregister()
assert not entries('TOPBAR_MT_file_import') and not entries('VIEW3D_MT_light_add')

# Without a window.
made = os.path.join(folder, 'made.blend')
subprocess.run((sys.executable, os.path.join(folder, 'canned_lights.py'), path, '--gain', '3', '--save', made, '--only'), check=True)
bpy.ops.wm.open_mainfile(filepath=made)
lamp = bpy.data.objects[name]
assert abs(radiance(lamp) - 3) < 1e-5 and lamp.users_collection[0].asset_data
wrong = subprocess.run((sys.executable, os.path.join(folder, 'canned_lights.py'), bad), capture_output=True, text=True, check=False)
assert wrong.returncode == 1 and wrong.stderr.count('\n') == 1 and 'bad.json' in wrong.stderr, wrong.stderr
