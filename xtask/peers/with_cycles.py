"""Renders a scene of `scenes.py` with Cycles, by a Python that has `bpy` (Blender as a module).

    python with_cycles.py SCENE.json PICTURE.exr SIZE SAMPLES SEED THREADS

Prints the seconds of processor time that rendering took, start and preparation of the scene left out. Blender's z is up: a
point (x, y, z) of the scene is (x, -z, y) there. Spheres are meshes of 128 rows with smooth normals.
"""

import json
import math
import sys
import time

import bpy
from mathutils import Matrix, Vector
from scenes import matrix

SCENE, PICTURE = sys.argv[1:3]
SIZE, SAMPLES, SEED, THREADS = map(int, sys.argv[3:7])
UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))

scene = json.load(open(SCENE))
bpy.ops.wm.read_factory_settings(use_empty=True)
blender = bpy.context.scene


def rgba(values):
    return (*values, 1)


def material(name, m):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    node = lambda kind: tree.nodes.new("ShaderNode" + kind)
    if m["kind"] == "matte":
        shader = node("BsdfDiffuse")
        shader.inputs["Color"].default_value = rgba(m["albedo"])
    elif m["kind"] == "metal":
        shader = node("BsdfMetallic")
        shader.fresnel_type, shader.distribution = "PHYSICAL_CONDUCTOR", "MULTI_GGX"
        shader.inputs["IOR"].default_value, shader.inputs["Extinction"].default_value = m["n"], m["k"]
        shader.inputs["Roughness"].default_value = m["roughness"]
    elif m["kind"] == "glass":
        shader = node("BsdfGlass")
        shader.distribution = "MULTI_GGX"
        shader.inputs["Color"].default_value = (1, 1, 1, 1)
        shader.inputs["IOR"].default_value, shader.inputs["Roughness"].default_value = m["ior"], m["roughness"]
    else:
        shader = one_sided(tree, node, m["radiance"])
        made.cycles.emission_sampling = "FRONT"
    tree.links.new(shader.outputs[0], node("OutputMaterial").inputs["Surface"])
    return made


def one_sided(tree, node, radiance):
    """Light to the front, black behind."""
    strength = max(radiance)
    emission, black, mix, geometry = node("Emission"), node("BsdfDiffuse"), node("MixShader"), node("NewGeometry")
    emission.inputs["Color"].default_value = rgba([value / strength for value in radiance])
    emission.inputs["Strength"].default_value = strength
    black.inputs["Color"].default_value = (0, 0, 0, 1)
    tree.links.new(geometry.outputs["Backfacing"], mix.inputs[0])
    tree.links.new(emission.outputs[0], mix.inputs[1])
    tree.links.new(black.outputs[0], mix.inputs[2])
    return mix


def rectangle_mesh(size):
    x, y = (0.5 * side for side in size)
    return [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], [(0, 1, 2, 3)]


def cuboid_mesh(size):
    x, y, z = (0.5 * side for side in size)
    corners = [(x * (i & 1 or -1), y * (i >> 1 & 1 or -1), z * (i >> 2 or -1)) for i in range(8)]
    return corners, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def sphere_mesh(radius, rows=128):
    columns, points = 2 * rows, [(0, 0, radius), (0, 0, -radius)]
    for row in range(1, rows):
        theta = math.pi * row / rows
        ring = (2 * math.pi * column / columns for column in range(columns))
        points += [
            (radius * math.sin(theta) * math.cos(phi), radius * math.sin(theta) * math.sin(phi), radius * math.cos(theta))
            for phi in ring
        ]
    at = lambda row, column: 2 + (row - 1) * columns + column % columns
    faces = [(0, at(1, c), at(1, c + 1)) for c in range(columns)]
    faces += [(at(rows - 1, c), 1, at(rows - 1, c + 1)) for c in range(columns)]
    faces += [
        (at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)) for r in range(1, rows - 1) for c in range(columns)
    ]
    return points, faces


def file_mesh(name):
    points, faces = [], []
    for line in open(name):
        kind, *words = line.split() or [""]
        if kind == "v":
            points.append(tuple(map(float, words[:3])))
        if kind == "f":
            faces.append(tuple(int(word.split("/")[0]) - 1 for word in words))
    return points, faces


def place(thing, materials):
    if "mesh" in thing:
        points, faces = file_mesh(thing["mesh"])
    else:
        made = {"rectangle": rectangle_mesh, "cuboid": cuboid_mesh, "sphere": sphere_mesh}[thing["shape"]]
        points, faces = made(thing.get("size", thing.get("radius")))
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(points, [], faces)
    mesh.materials.append(materials[thing["material"]])
    if thing.get("shape") == "sphere":
        mesh.shade_smooth()
    made = bpy.data.objects.new("object", mesh)
    made.matrix_world = UP @ Matrix([*matrix(thing), (0, 0, 0, 1)])
    blender.collection.objects.link(made)


def camera(c):
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit, lens.angle = "VERTICAL", math.radians(c["fov"])
    position, target = Vector(c["position"]), Vector(c["look_at"])
    back = (position - target).normalized()
    right = Vector((0, 1, 0)).cross(back).normalized()
    rows = zip(right, back.cross(right), back, position)
    made = bpy.data.objects.new("camera", lens)
    made.matrix_world = UP @ Matrix([*rows, (0, 0, 0, 1)])
    blender.collection.objects.link(made)
    blender.camera = made


def environment(image):
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    tree = world.node_tree
    texture, turn, where = (tree.nodes.new("ShaderNode" + kind) for kind in ("TexEnvironment", "Mapping", "TexCoord"))
    texture.image = bpy.data.images.load(image)
    # Its middle is seen along +y instead of +x.
    turn.inputs["Rotation"].default_value = (0, 0, -math.pi / 2)
    tree.links.new(where.outputs["Generated"], turn.inputs["Vector"])
    tree.links.new(turn.outputs["Vector"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    blender.world = world


def settings():
    render, cycles = blender.render, blender.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    cycles.samples, cycles.seed, cycles.pixel_filter_type = SAMPLES, SEED, "BOX"
    # Defaults that stop early, or bias.
    cycles.use_adaptive_sampling, cycles.use_denoising, cycles.use_auto_tile = False, False, False
    cycles.sample_clamp_indirect, cycles.blur_glossy = 0, 0
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, kind + "_bounces", 64)
    render.threads_mode, render.threads = "FIXED", THREADS
    render.resolution_x, render.resolution_y, render.resolution_percentage = SIZE, SIZE, 100
    image = render.image_settings
    image.file_format, image.color_depth, image.color_mode = "OPEN_EXR", "32", "RGB"
    render.filepath = PICTURE


materials = {name: material(name, m) for name, m in scene["materials"].items()}
for thing in scene["objects"]:
    place(thing, materials)
camera(scene["camera"])
if "environment" in scene:
    environment(scene["environment"])
settings()
start = time.process_time()
bpy.ops.render.render(write_still=True)
print("seconds", time.process_time() - start)
