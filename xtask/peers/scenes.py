"""Scenes for comparisons with other renderers: each is described once and written for every renderer from that.

A scene is a dictionary: a camera, materials by name, objects, an optional environment. Lengths in metres, angles in degrees,
y up, colours linear Rec.709. Materials are of four kinds that every renderer has exactly:

    matte       albedo
    metal       n, k, roughness (the width of the GGX distribution is its square; small, because not all renderers keep the
                light that facets throw at each other: at 0.3 Mitsuba loses 1 % of white metal seen from above, 9 % at a
                cosine of 0.2)
    glass       ior, roughness
    light       radiance, one-sided, along the normal
"""

import math

WHITE, RED, GREEN = [0.725, 0.71, 0.68], [0.63, 0.065, 0.05], [0.14, 0.45, 0.091]
GOLD = {"kind": "metal", "n": [0.143, 0.375, 1.442], "k": [3.983, 2.386, 1.603]}


def rectangle(material, size, translate, rotate=(0, 0, 0)):
    """In the plane z = 0 before it is turned, its normal along +z."""
    return {"shape": "rectangle", "size": size, "translate": translate, "rotate": rotate, "material": material}


def box(material, size, translate, rotate=(0, 0, 0)):
    return {"shape": "cuboid", "size": size, "translate": translate, "rotate": rotate, "material": material}


def sphere(material, radius, translate):
    return {"shape": "sphere", "radius": radius, "translate": translate, "rotate": (0, 0, 0), "material": material}


def room(lamp):
    """Five walls of a box of side 2 around the origin, open towards the camera, and a lamp under the ceiling."""
    return [
        rectangle("white", [2, 2], [0, -1, 0], [-90, 0, 0]),
        rectangle("white", [2, 2], [0, 1, 0], [90, 0, 0]),
        rectangle("white", [2, 2], [0, 0, -1]),
        rectangle("red", [2, 2], [-1, 0, 0], [0, 90, 0]),
        rectangle("green", [2, 2], [1, 0, 0], [0, -90, 0]),
        rectangle("lamp", lamp, [0, 0.99, 0], [90, 0, 0]),
    ]


ROOM_MATERIALS = {
    "white": {"kind": "matte", "albedo": WHITE},
    "red": {"kind": "matte", "albedo": RED},
    "green": {"kind": "matte", "albedo": GREEN},
    "lamp": {"kind": "light", "radiance": [17, 12, 4]},
}
ROOM_CAMERA = {"position": [0, 0, 3.9], "look_at": [0, 0, 0], "fov": 39.3077}


def cornell():
    return {
        "camera": ROOM_CAMERA,
        "materials": ROOM_MATERIALS,
        "objects": room([0.47, 0.38])
        + [
            box("white", [0.6, 1.2, 0.6], [-0.33, -0.4, -0.28], [0, 18.25, 0]),
            box("white", [0.6, 0.6, 0.6], [0.33, -0.7, 0.38], [0, -16.6, 0]),
        ],
    }


def glossy():
    return {
        "camera": ROOM_CAMERA,
        "materials": ROOM_MATERIALS
        | {"gold": GOLD | {"roughness": 0.2}, "steel": GOLD | {"n": [2.9, 2.95, 2.6], "k": [3.1, 2.9, 2.8], "roughness": 0.15}},
        "objects": room([0.8, 0.8])
        + [sphere("gold", 0.45, [-0.4, -0.55, -0.3]), box("steel", [0.5, 0.7, 0.5], [0.4, -0.65, 0.2], [0, 30, 0])],
    }


def glass():
    return {
        "camera": ROOM_CAMERA,
        "materials": ROOM_MATERIALS
        | {"clear": {"kind": "glass", "ior": 1.5, "roughness": 0}, "frosted": {"kind": "glass", "ior": 1.5, "roughness": 0.2}},
        "objects": room([1.4, 1.4])
        + [sphere("clear", 0.4, [-0.4, -0.55, -0.2]), sphere("frosted", 0.35, [0.45, -0.6, 0.3])],
    }


def sky(direction):
    """Radiance of a smooth sky from a unit direction: a horizon, a zenith and a soft sun. Whatever a renderer takes for the place
    of a pixel, half a pixel to the side is hardly another value."""
    x, y, z = direction
    sun = math.exp(30 * (x * 0.48 + y * 0.6 + z * 0.64 - 1))
    height = 0.5 + 0.5 * y
    return [0.3 + 0.1 * height + 12 * sun, 0.3 + 0.2 * height + 11 * sun, 0.3 + 0.4 * height + 9 * sun]


def sky_rows(width):
    """Rows of an equirectangular picture from the top; its middle is towards -z, and +x lies to the right of that."""
    for row in range(width // 2):
        theta = math.pi * (row + 0.5) / (width // 2)
        columns = (2 * math.pi * ((column + 0.5) / width - 0.5) for column in range(width))
        yield [
            sky((math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi))) for phi in columns
        ]


def environment(mesh, image):
    """A mesh of about unit size around the origin on a floor, under an environment map. Its faces are flat, because renderers
    differ in what they do where a shading normal looks away."""
    return {
        "camera": {"position": [1.2, 0.9, 2.6], "look_at": [0, -0.1, 0], "fov": 40},
        "materials": {"floor": {"kind": "matte", "albedo": [0.4, 0.4, 0.4]}, "body": GOLD | {"roughness": 0.1}},
        "objects": [
            rectangle("floor", [6, 6], [0, -1, 0], [-90, 0, 0]),
            {"mesh": mesh, "translate": [0, 0, 0], "rotate": (0, 0, 0), "material": "body"},
        ],
        "environment": image,
    }


def matrix(thing):
    """Columns of the rotation x, then y, then z of fixed axes, and the translation."""
    x, y, z = (math.radians(angle) for angle in thing["rotate"])
    cx, sx, cy, sy, cz, sz = math.cos(x), math.sin(x), math.cos(y), math.sin(y), math.cos(z), math.sin(z)
    rows = [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ]
    return [row + [offset] for row, offset in zip(rows, thing["translate"])]


def times(a, b):
    """The product of two 3 by 4 matrices."""
    return [
        [sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0) for j in range(4)] for i in range(3)
    ]


def named(mesh=None, image=None):
    """All scenes; `mesh` is an OBJ file and `image` the [sky](sky_rows) in a file, for the last one."""
    scenes = {"cornell": cornell(), "glossy": glossy(), "glass": glass()}
    return scenes | {"environment": environment(mesh, image)} if mesh and image else scenes
