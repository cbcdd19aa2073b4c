"""Writes a scene of `scenes.py` as a Heliostat scene file."""

import json
from scenes import matrix, times

# Our rectangles lie in the plane y = 0 and face up.
STAND_UP = [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0]]


def material(name, m):
    head = f"[[material]]\nname = {json.dumps(name)}\n"
    if m["kind"] == "matte":
        return head + f"[material.standard]\nbase_color = {m['albedo']}\nspecular = 0\n"
    if m["kind"] == "metal":
        conductor = f"conductor = {{ n = {m['n']}, k = {m['k']} }}"
        return head + f"[material.standard]\nmetalness = 1\nroughness = {m['roughness']}\n{conductor}\n"
    return head + (
        f"[material.standard]\nbase_color = 1\ntransmission = 1\nior = {m['ior']}\nroughness = {m['roughness']}\n"
    )


def shape(thing):
    if "mesh" in thing:
        return 'mesh = "mesh"'
    sizes = {"sphere": "radius", "rectangle": "size", "cuboid": "size"}
    key = sizes[thing["shape"]]
    return f"{thing['shape']} = {{ {key} = {thing[key]} }}"


def place(thing):
    m = matrix(thing)
    if thing.get("shape") == "rectangle":
        m = times(m, STAND_UP)
    return f"matrix = {m}"


def to_toml(scene, size, samples, seed, integrator):
    camera = scene["camera"]
    parts = [
        f"[render]\nwidth = {size[0]}\nheight = {size[1]}\nsamples = {samples}\nseed = {seed}\n"
        f'integrator = "{integrator}"\nfilter = "box"\n',
        f"[camera]\nposition = {camera['position']}\nlook_at = {camera['look_at']}\nfov = {camera['fov']}\n",
    ]
    if "environment" in scene:
        parts.append(f"[environment]\nimage = {json.dumps(scene['environment'])}\n")
    lights = {name: m for name, m in scene["materials"].items() if m["kind"] == "light"}
    parts += [material(name, m) for name, m in scene["materials"].items() if name not in lights]
    for thing in scene["objects"]:
        if "mesh" in thing:
            parts.append(f'[[mesh]]\nname = "mesh"\nfile = {json.dumps(thing["mesh"])}\nsmooth_angle = 0\n')
    for thing in scene["objects"]:
        if thing["material"] in lights:
            radiance = lights[thing["material"]]["radiance"]
            parts.append(f"[[light]]\nintensity = {radiance}\narea = {{ {shape(thing)}, {place(thing)} }}\n")
        else:
            parts.append(f"[[object]]\nmaterial = {json.dumps(thing['material'])}\n{shape(thing)}\n{place(thing)}\n")
    return "\n".join(parts)
