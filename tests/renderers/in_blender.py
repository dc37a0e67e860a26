"""Runs inside Blender: see blender_test.py. Lines that begin with "| " are its report."""
import json
import math
import pathlib
import sys

import bpy
from mathutils import Vector

folder = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
pictures = sys.argv[sys.argv.index("--") + 2]
WHITE = 683.0  # cd/m^2 of 1.0 in a map
LUMINANCE = (0.2126, 0.7152, 0.0722)  # Rec. 709, ITU-R BT.709-6
MARKS = {  # colour of the disc of each mark, and where it must be in Blender's world
    "north": ((0.9, 0.05, 0.05), (0, 1, 0)), "east": ((0.9, 0.8, 0.05), (1, 0, 0)),
    "south": ((0.05, 0.8, 0.8), (0, -1, 0)), "west": ((0.1, 0.2, 0.95), (-1, 0, 0)),
    "up": ((1, 1, 1), (0, 0, 1)), "down": ((0, 0, 0), (0, 0, -1))}


def degrees_apart(a, b):
    """Of nearly the same directions: no arc cosine of numbers that are nearly 1."""
    return math.degrees(2 * math.asin(min(1, (a.normalized() - b.normalized()).length / 2)))


def say(text):
    print("| " + text, flush=True)


def check(condition, text):
    if not condition:
        raise AssertionError(text)


def empty_scene(width, height, samples):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    return scene


def set_world(scene, file, resolution=1024):
    """`resolution`: of Cycles' map of where light comes from. Between a pixel with the sun and one without
    the map is interpolated: a map of chances as coarse as its pixels rarely looks at that slope."""
    world = scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    node = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = bpy.data.images.load(str(file))
    node.image.colorspace_settings.name = "Linear"
    world.node_tree.links.new(node.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = resolution


def camera_at(scene, place, towards, fov):
    data = bpy.data.cameras.new("camera")
    data.angle = math.radians(fov)
    camera = bpy.data.objects.new("camera", data)
    camera.location = place
    camera.rotation_euler = Vector(towards).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def render(scene, name):
    """Scene-linear pixels, row by row from the bottom. Blender's own numpy may be missing."""
    path = folder / (name + ".exr")
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Raw"
    samples = image.pixels[:]
    pixels = [samples[i:i + 3] for i in range(0, len(samples), 4)]
    bpy.data.images.remove(image)
    return pixels


def luminance(rgb):
    return sum(w * c for w, c in zip(LUMINANCE, rgb))


def try_marks():
    for name, (color, towards) in MARKS.items():
        scene = empty_scene(32, 32, 4)
        set_world(scene, folder / "compass.exr")
        camera_at(scene, (0, 0, 0), towards, 20)  # the disc has a diameter of 24 deg
        pixels = render(scene, "mark")
        share = sum(all(abs(a - b) < 0.02 for a, b in zip(p, color)) for p in pixels) / len(pixels)
        say(f"compass {name:5}: {100 * share:.0f} % of the view along {towards} has its colour")
        check(share > 0.4, name)  # the letter covers the rest


def try_sun(number, sun):
    """Centroid of the light around the place where the sun must be, in a view of 8 deg."""
    scene = empty_scene(128, 128, 16)
    set_world(scene, folder / f"map.{number:04}.exr")
    to_sun = Vector(sun["disc"]["apparent_centre"]["axes"])
    beside = (to_sun + 0.02 * to_sun.orthogonal().normalized()).normalized()  # not by symmetry
    camera = camera_at(scene, (0, 0, 0), beside, 8)
    light = [luminance(p) for p in render(scene, "sun")]
    disc = [(i, v) for i, v in enumerate(light) if v > 0.02 * max(light)]  # not the sky around it
    whole = sum(v for _, v in disc)
    x = sum(v * (i % 128 + 0.5) for i, v in disc) / whole / 64 - 1
    y = sum(v * (i // 128 + 0.5) for i, v in disc) / whole / 64 - 1
    reach = math.tan(math.radians(4))
    seen = (camera.rotation_euler.to_matrix() @ Vector((x * reach, y * reach, -1))).normalized()
    off = degrees_apart(seen, to_sun)
    say(f"sun {number}: elevation {sun['disc']['apparent_centre']['elevation_deg']:.2f} deg, "
        f"seen {off:.3f} deg away; a pixel of the map is {360 / 1024:.3f} deg")
    check(off < 360 / 1024, "the sun is elsewhere")


def add_white_floor(scene):
    bpy.ops.mesh.primitive_plane_add(size=20)
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    material.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)


def add_sun(scene, sun):
    """A sun lamp's strength is the irradiance of a surface that faces it."""
    data = bpy.data.lights.new("sun", "SUN")
    rgb = sun["normal_irradiance"]["rgb"]
    data.energy = max(rgb)
    data.color = [c / max(rgb) for c in rgb]
    data.angle = math.radians(sun["disc"]["angular_diameter_deg"])
    lamp = bpy.data.objects.new("sun", data)
    lamp.rotation_euler = Vector(sun["light_comes_from"]["axes"]).to_track_quat("Z", "Y").to_euler()
    scene.collection.objects.link(lamp)


def illuminance(scene, name):
    """Of the floor, in lux: a white Lambertian surface of radiance L has pi L."""
    camera_at(scene, (0, 0, 3), (0, 0, -1), 10)
    pixels = render(scene, name)
    return math.pi * WHITE * sum(luminance(p) for p in pixels) / len(pixels)


def try_light(number, sun, frame):
    lights = frame["light"]
    truth = lights["sky_horizontal_lux"] + lights["sun_horizontal_lux"]
    for what, map_file, with_sun in (("whole map", "map", False), ("map without disc, sun.json", "sky", True)):
        scene = empty_scene(16, 16, 1024)
        set_world(scene, folder / f"{map_file}.{number:04}.exr", 4096)
        if with_sun:
            add_sun(scene, sun)
        add_white_floor(scene)
        measured = illuminance(scene, "floor")
        say(f"light {number}: {what}: {measured:.0f} lux, by the manifest {truth:.0f}: {100 * (measured / truth - 1):+.2f} %")
        # What a map of the library may be off by (docs/hdri.md); noise is far below.
        check(abs(measured / truth - 1) < 0.005, "the light is not the manifest's")


def try_layer(number, sun):
    """What Blender makes of the USD layer, where it was built with USD: it knows distant lights, not domes."""
    if "usd_import" not in dir(bpy.ops.wm):
        say(f"layer {number}: not read, this Blender was built without USD")
        return
    empty_scene(16, 16, 1)
    bpy.ops.wm.usd_import(filepath=str(folder / f"dome.{number:04}.usda"))
    lamps = [o for o in bpy.data.objects if o.type == "LIGHT" and o.data.type == "SUN"]
    check(len(lamps) == 1, f"{len(lamps)} suns in the layer")
    to_sun = (lamps[0].matrix_world.to_quaternion() @ Vector((0, 0, 1))).normalized()
    off = degrees_apart(to_sun, Vector(sun["light_comes_from"]["axes"]))
    say(f"layer {number}: the sun's light is {off:.4f} deg away, {math.degrees(lamps[0].data.angle):.4f} deg wide, "
        f"strength {lamps[0].data.energy:.4g} of {max(sun['normal_irradiance']['rgb']):.4g}")
    check(off < 0.01, "the layer's light comes from elsewhere")
    check(abs(math.degrees(lamps[0].data.angle) - sun["disc"]["angular_diameter_deg"]) < 1e-3, "its width")


def take_picture(number, sun):
    """For eyes: a matte and a mirror ball on a grey floor under the map without disc, the sun beside it."""
    scene = empty_scene(640, 360, 96)
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.exposure = -3.5
    set_world(scene, folder / f"sky.{number:04}.exr")
    add_sun(scene, sun)
    add_white_floor(scene)
    bpy.context.object.data.materials[0].node_tree.nodes["Diffuse BSDF"].inputs["Color"].default_value = (0.3, 0.3, 0.3, 1)
    for x, metallic, roughness in ((-1.2, 0, 1), (1.2, 1, 0.02)):
        bpy.ops.mesh.primitive_uv_sphere_add(location=(x, 0, 1), segments=96, ring_count=48)
        bpy.ops.object.shade_smooth()
        material = bpy.data.materials.new("ball")
        material.use_nodes = True
        shader = material.node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = (0.8, 0.8, 0.8, 1)
        shader.inputs["Metallic"].default_value, shader.inputs["Roughness"].default_value = metallic, roughness
        bpy.context.object.data.materials.append(material)
    camera_at(scene, (0, -8, 2.2), (0, 8, -1.1), 45)  # looks north
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = str(pathlib.Path(pictures) / f"blender.{number:04}.png")
    bpy.ops.render.render(write_still=True)


frames = {f["frame"]: f for f in json.loads((folder / "manifest.json").read_text())["frames"]}
try_marks()
for n in (1, 2, 3):
    sun_file = json.loads((folder / f"sun.{n:04}.json").read_text())
    if pictures:
        take_picture(n, sun_file)
    try_sun(n, sun_file)
    try_light(n, sun_file, frames[n])
    try_layer(n, sun_file)
say("all is where it must be")
