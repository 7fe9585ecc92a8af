# canned_lights.py - light slabs in Blender 4.2 and newer, for Cycles: an add-on.
# Copyright: the authors of Canned light sources. Licence: GPL-3.0-or-later.
#
# File > Import > Light slab puts a lamp, NAME.json of bakeslab export, where its own space is;
# Add > Light > Canned light at the 3D cursor. A lamp is an empty, whose property "gain"
# multiplies its radiance, and an area light for each page below it; pictures are packed.
# Without a window, in Blender or with the bpy module, to the scene that is open or new:
#   blender -b [SCENE.blend] -P canned_lights.py -- NAME.json [--gain G] [--save OUT.blend]
#   python3 canned_lights.py NAME.json [--gain G] [--save OUT.blend]
#
# Frames: lamp space (x, y, z) is left-handed with y up; it is (x, z, y) here. An area light shines
# along its -z; its x is u, its y is v or, where that would be left-handed, -v.
# Radiance of the ray through (a, b, s, t): light-slab(5). The nodes look it up in the page's
# raster: a cell of (u, v) is a picture of Ns x Nt texels, interpolated as a texture; four of them
# are mixed.
import json
import math
import os
import sys

import bpy
from bpy_extras.io_utils import ImportHelper
from mathutils import Matrix, Vector

bl_info = {
    'name': 'Canned lights',
    'description': 'Lamps whose light was simulated once: light slabs, for Cycles',
    'author': 'Canned light sources',
    'version': (1, 0, 0),
    'blender': (4, 2, 0),
    'location': 'File > Import > Light slab; Add > Light > Canned light',
    'category': 'Lighting',
}


class LampError(Exception):
    """A lamp that cannot be read: one line for the user."""


def read(path):
    """Name and pages of NAME.json."""
    try:
        with open(path, encoding='utf-8') as file:
            lamp = json.load(file)
    except (OSError, ValueError) as reason:
        raise LampError(f'{path}: cannot be read: {reason}') from None
    if not isinstance(lamp, dict) or lamp.get('format') != 'light-slab-pages':
        raise LampError(f'{path}: is no lamp; make one with bakeslab export --as cycles')
    if lamp.get('version') != 1:
        raise LampError(f'{path}: is of version {lamp.get("version")}; this add-on knows 1')
    return lamp['name'], lamp['pages']


def turn(vector):
    """From lamp space."""
    return Vector((vector[0], vector[2], vector[1]))


class Page:
    """Geometry of a page, in Blender's frame."""

    def __init__(self, page):
        self.samples = page['samples']
        self.window = page['st_window']
        distance = page.get('st_distance')
        self.kappa = 1 / distance if distance else 0.0
        u, v, self.normal = (turn(page[key]) for key in ('u', 'v', 'normal'))
        self.center = turn(page['center'])
        self.edges = u.length, v.length
        self.u, self.v = u.normalized(), v.normalized()
        self.flip = -1 if self.u.cross(self.v).dot(self.normal) > 0 else 1

    def matrix(self):
        columns = self.u, self.v * self.flip, -self.normal, self.center
        return Matrix([[column[row] for column in columns] for row in range(3)] + [[0, 0, 0, 1]])


def load_image(path, samples):
    nu, nv, ns, nt = samples
    try:
        image = bpy.data.images.load(path, check_existing=False)
    except RuntimeError as reason:
        raise LampError(f'{path}: cannot be read: {reason}') from None
    if tuple(image.size) != (nu * ns, nv * nt):
        size = tuple(image.size)
        bpy.data.images.remove(image)
        raise LampError(f'{path}: is {size[0]}x{size[1]}, not {nu * ns}x{nv * nt}')
    image.colorspace_settings.name = 'Non-Color'
    image.alpha_mode = 'NONE'
    image.pack()
    return image


class Value:
    """A number of a node tree, with the operators of numbers."""

    def __init__(self, tree, socket):
        self.tree, self.socket = tree, socket

    def math(self, operation, *others, swap=False):
        node = self.tree.nodes.new('ShaderNodeMath')
        node.operation = operation
        values = (self, *others)
        for place, value in zip(node.inputs, values[::-1] if swap else values):
            if isinstance(value, Value):
                self.tree.links.new(value.socket, place)
            else:
                place.default_value = value
        return Value(self.tree, node.outputs[0])

    def __add__(self, other):
        return self.math('ADD', other)

    def __sub__(self, other):
        return self.math('SUBTRACT', other)

    def __rsub__(self, other):
        return self.math('SUBTRACT', other, swap=True)

    def __mul__(self, other):
        return self.math('MULTIPLY', other)

    def __truediv__(self, other):
        return self.math('DIVIDE', other)

    def clamped(self, low, high):
        return self.math('MAXIMUM', low).math('MINIMUM', high)


def split(tree, socket):
    """The components of a vector."""
    node = tree.nodes.new('ShaderNodeSeparateXYZ')
    tree.links.new(socket, node.inputs[0])
    return [Value(tree, output) for output in node.outputs]


def texture(tree, image, x, y):
    """The colour of a picture, between its texels."""
    place = tree.nodes.new('ShaderNodeCombineXYZ')
    for value, socket in zip((x, y), place.inputs):
        tree.links.new(value.socket, socket)
    node = tree.nodes.new('ShaderNodeTexImage')
    node.image, node.interpolation, node.extension = image, 'Linear', 'EXTEND'
    tree.links.new(place.outputs[0], node.inputs['Vector'])
    return node.outputs['Color']


def mix(tree, first, second, share):
    node = tree.nodes.new('ShaderNodeMix')
    node.data_type = 'VECTOR'
    inputs = [socket for socket in node.inputs if socket.enabled]
    for value, socket in zip((share.socket, first, second), inputs):
        tree.links.new(value, socket)
    return next(socket for socket in node.outputs if socket.enabled)


def ray(tree, page):
    """Position of a ray on the aperture, 0 to 1 along u and v, and its slopes s and t."""
    geometry = tree.nodes.new('ShaderNodeNewGeometry')
    x, y = split(tree, geometry.outputs['Parametric'])[:2]
    local = tree.nodes.new('ShaderNodeVectorTransform')
    local.vector_type, local.convert_from, local.convert_to = 'NORMAL', 'WORLD', 'OBJECT'
    tree.links.new(geometry.outputs['Incoming'], local.inputs['Vector'])
    right, up, back = split(tree, local.outputs['Vector'])
    cosine = back * -1.0
    s, t = right / cosine, up / (cosine * page.flip)
    if page.flip < 0:
        y = 1.0 - y
    if page.kappa:
        s = s + (x - .5) * (page.edges[0] * page.kappa)
        t = t + (y - .5) * (page.edges[1] * page.kappa)
    return x, y, s, t


def cells(value, count):
    """The two cells around a position from 0 to 1, and the share of the second."""
    place = (value * float(count) - .5).clamped(0.0, count - 1.0)
    first = place.math('FLOOR')
    return (first, (first + 1.0).math('MINIMUM', count - 1.0)), place - first


def make_nodes(tree, page, image):
    """Emission of the page's radiance, when the light's own is 1."""
    tree.nodes.clear()
    nu, nv, ns, nt = page.samples
    s0, s1, t0, t1 = page.window
    x, y, s, t = ray(tree, page)
    (columns, share_u), (rows, share_v) = cells(x, nu), cells(y, nv)
    k = ((s - s0) * (ns / (s1 - s0))).clamped(.5, ns - .5)
    l = ((t - t0) * (nt / (t1 - t0))).clamped(.5, nt - .5)
    xs = [(i * float(ns) + k) / float(nu * ns) for i in columns]
    ys = [1.0 - (j * float(nt) + l) / float(nv * nt) for j in rows]
    color = mix(tree, *(mix(tree, texture(tree, image, xs[0], at), texture(tree, image, xs[1], at),
                            share_u) for at in ys), share_v)
    lit = (((s - s0) * (s1 - s)).math('GREATER_THAN', 0.0)
           * ((t - t0) * (t1 - t)).math('GREATER_THAN', 0.0))
    emission = tree.nodes.new('ShaderNodeEmission')
    output = tree.nodes.new('ShaderNodeOutputLight')
    tree.links.new(color, emission.inputs['Color'])
    tree.links.new(lit.socket, emission.inputs['Strength'])
    tree.links.new(emission.outputs[0], output.inputs[0])


def drive_energy(light, lamp, holder, area):
    """Radiance 1 times the lamp's gain, however the lamp is scaled: energy is pi where it is not
    normalised; else, before 4.4, it is divided by pi and by the area in the scene."""
    driver = light.driver_add('energy').driver
    driver.type = 'SCRIPTED'
    gain = driver.variables.new()
    gain.name = 'gain'
    gain.targets[0].id, gain.targets[0].data_path = lamp, '["gain"]'
    driver.expression = f'gain * {math.pi!r}'
    if hasattr(light, 'normalize'):
        light.normalize = False
        return
    for axis in 'XY':
        scale = driver.variables.new()
        scale.name, scale.type = f'scale_{axis.lower()}', 'TRANSFORMS'
        scale.targets[0].id = holder
        scale.targets[0].transform_type = f'SCALE_{axis}'
        scale.targets[0].transform_space = 'WORLD_SPACE'
    driver.expression += f' * {area!r} * abs(scale_x * scale_y)'


def add_page(lamp, name, page, image, collection):
    light = bpy.data.lights.new(name, 'AREA')
    light.shape, light.spread = 'RECTANGLE', math.pi
    light.size, light.size_y = page.edges
    light.use_nodes = True
    make_nodes(light.node_tree, page, image)
    holder = bpy.data.objects.new(name, light)
    holder.visible_camera = True
    collection.objects.link(holder)
    holder.parent, holder.matrix_local = lamp, page.matrix()
    drive_energy(light, lamp, holder, page.edges[0] * page.edges[1])


def add_lamp(path, scene, place=None, gain=1.0):
    """Adds a lamp to a scene, in a collection of its own; its empty."""
    if bpy.app.version < bl_info['blender']:  # lights know no space of their own, and shine wrongly
        raise LampError(f'Blender 4.2 or newer is needed; this is {bpy.app.version_string}')
    name, pages = read(path)
    pages = [(Page(page), load_image(os.path.join(os.path.dirname(path), page['image']),
                                     page['samples'])) for page in pages]
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    lamp = bpy.data.objects.new(name, None)
    collection.objects.link(lamp)
    lamp.empty_display_size = max(pages[0][0].edges)
    lamp['gain'] = float(gain)
    lamp.id_properties_ui('gain').update(min=0.0, soft_max=10.0, description='Multiplies radiance')
    if place:
        lamp.matrix_world = place
    for number, (page, image) in enumerate(pages):
        add_page(lamp, f'{name} {number + 1}', page, image, collection)
    return lamp


class LampOperator(ImportHelper):
    """What both operators do."""
    filename_ext = '.json'
    bl_options = {'REGISTER', 'UNDO'}
    filter_glob: bpy.props.StringProperty(default='*.json', options={'HIDDEN'})
    gain: bpy.props.FloatProperty(name='Gain', default=1.0, min=0.0,
                                  description='Multiplies radiance')

    def place(self, context):
        return Matrix()

    def execute(self, context):
        try:
            lamp = add_lamp(self.filepath, context.scene, self.place(context), self.gain)
        except LampError as reason:
            self.report({'ERROR'}, str(reason))
            return {'CANCELLED'}
        for other in context.selected_objects:
            other.select_set(False)
        lamp.select_set(True)
        context.view_layer.objects.active = lamp
        return {'FINISHED'}


class ImportLightSlab(LampOperator, bpy.types.Operator):
    """Imports a lamp of bakeslab export, NAME.json, where its own space is"""
    bl_idname, bl_label = 'import_scene.light_slab', 'Light slab (.json)'


class AddCannedLight(LampOperator, bpy.types.Operator):
    """Adds a lamp of bakeslab export, NAME.json, at the 3D cursor"""
    bl_idname, bl_label = 'object.canned_light_add', 'Canned light'

    def place(self, context):
        return context.scene.cursor.matrix.copy()


def import_entry(menu, _context):
    menu.layout.operator(ImportLightSlab.bl_idname)


def add_entry(menu, _context):
    menu.layout.operator(AddCannedLight.bl_idname, icon='LIGHT_AREA')


ENTRIES = (('TOPBAR_MT_file_import', import_entry), ('VIEW3D_MT_light_add', add_entry))


def register():
    for operator in (ImportLightSlab, AddCannedLight):
        bpy.utils.register_class(operator)
    for menu, entry in ENTRIES:
        getattr(bpy.types, menu).append(entry)


def unregister():
    for menu, entry in ENTRIES:
        getattr(bpy.types, menu).remove(entry)
    for operator in (AddCannedLight, ImportLightSlab):
        bpy.utils.unregister_class(operator)


def main(arguments):
    import argparse
    parser = argparse.ArgumentParser(prog='canned_lights.py', description='Adds a lamp to a scene.')
    parser.add_argument('lamp', help='NAME.json of bakeslab export')
    parser.add_argument('--gain', type=float, default=1.0, help='multiplies radiance')
    parser.add_argument('--save', metavar='OUT.blend',
                        help='saves the scene; the lamp is an asset of it')
    parser.add_argument('--only', action='store_true', help='starts from an empty scene')
    options = parser.parse_args(arguments)
    options.lamp, options.save = (path and os.path.abspath(path)
                                  for path in (options.lamp, options.save))
    if options.only:
        bpy.ops.wm.read_factory_settings(use_empty=True)
    try:
        lamp = add_lamp(options.lamp, bpy.context.scene, gain=options.gain)
    except LampError as reason:
        sys.exit(f'canned_lights.py: {reason}')
    if options.save:
        lamp.users_collection[0].asset_mark()
        bpy.ops.wm.save_as_mainfile(filepath=options.save, compress=True)


if __name__ == '__main__':
    if '--' in sys.argv:
        main(sys.argv[sys.argv.index('--') + 1:])
    elif bpy.app.background:
        main(sys.argv[1:])
    else:
        register()
