"""Makes a scene of `scenes.py` in Mitsuba 3."""

import mitsuba as mi
from scenes import matrix


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def bsdf(m):
    if m["kind"] == "matte":
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(m["albedo"])}}
    if m["kind"] == "light":
        return {"type": "diffuse", "reflectance": rgb([0, 0, 0])}
    rough = {"distribution": "ggx", "alpha": m["roughness"] ** 2} if m["roughness"] > 0 else {}
    prefix = "rough" if rough else ""
    if m["kind"] == "metal":
        metal = {"type": prefix + "conductor", "eta": rgb(m["n"]), "k": rgb(m["k"])} | rough
        return {"type": "twosided", "bsdf": metal}
    return {"type": prefix + "dielectric", "int_ior": m["ior"], "ext_ior": 1.0} | rough


def transform(thing, scale=(1, 1, 1)):
    rows = [[value * factor for value, factor in zip(row, (*scale, 1))] for row in matrix(thing)]
    return mi.ScalarTransform4f(rows + [[0, 0, 0, 1]])


def shape(thing):
    if "mesh" in thing:
        return {"type": "obj", "filename": thing["mesh"], "face_normals": True, "to_world": transform(thing)}
    if thing["shape"] == "sphere":
        radius = thing["radius"]
        return {"type": "sphere", "to_world": transform(thing, (radius, radius, radius))}
    # Mitsuba's rectangle and cube have sides of 2.
    half = [0.5 * side for side in thing["size"]] + [1]
    kind = {"rectangle": "rectangle", "cuboid": "cube"}[thing["shape"]]
    return {"type": kind, "to_world": transform(thing, half[:3])}


def to_mitsuba(scene, size, integrator):
    camera = scene["camera"]
    look = mi.ScalarTransform4f().look_at(origin=camera["position"], target=camera["look_at"], up=[0, 1, 0])
    film = {"type": "hdrfilm", "width": size[0], "height": size[1], "pixel_format": "rgb", "rfilter": {"type": "box"}}
    world = {
        "type": "scene",
        "integrator": integrator,
        "sensor": {
            "type": "perspective",
            "fov": camera["fov"],
            "fov_axis": "y",
            "near_clip": 1e-3,
            "to_world": look,
            "film": film | {"component_format": "float32"},
            "sampler": {"type": "independent"},
        },
    }
    if "environment" in scene:
        world["environment"] = {
            "type": "envmap",
            "filename": scene["environment"],
            "to_world": mi.ScalarTransform4f().rotate([0, 1, 0], 180),
        }
    for i, thing in enumerate(scene["objects"]):
        m = scene["materials"][thing["material"]]
        light = {"emitter": {"type": "area", "radiance": rgb(m["radiance"])}} if m["kind"] == "light" else {}
        world[f"object{i}"] = shape(thing) | {"bsdf": bsdf(m)} | light
    return mi.load_dict(world)
