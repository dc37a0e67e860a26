#!/usr/bin/env python3
"""Time of a 1024 x 512 lat-long sky as float EXR: ours against headless Blender with its Nishita sky texture
(Cycles on the CPU, one sample, panoramic camera), by turns in one run. Prints seconds, their spread and the ratios.
usage: benchmarks/hdri/blender.py [PROGRAM] [ROUNDS]"""
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

program = sys.argv[1] if len(sys.argv) > 1 else "build/release/bin/skylapse"
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
blender = shutil.which("blender")
if blender is None:
    sys.exit("Blender is not installed: apt-get install blender")

SCENE = """
import bpy, math, sys, time
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = 'CYCLES'
scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = 'CPU', 1, False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 1024, 512, 100
scene.render.image_settings.file_format, scene.render.image_settings.color_depth = 'OPEN_EXR', '32'
scene.render.image_settings.exr_codec = 'ZIP'
camera = bpy.data.cameras.new('camera')
camera.type, camera.cycles.panorama_type = 'PANO', 'EQUIRECTANGULAR'
scene.camera = bpy.data.objects.new('camera', camera)
scene.camera.rotation_euler = (math.pi / 2, 0, 0)
scene.collection.objects.link(scene.camera)
world = scene.world = bpy.data.worlds.new('world')
world.use_nodes = True
sky = world.node_tree.nodes.new('ShaderNodeTexSky')
sky.sky_type = 'NISHITA'
world.node_tree.links.new(sky.outputs[0], world.node_tree.nodes['Background'].inputs[0])
for i in range(int(sys.argv[-1])):
    sky.sun_elevation = math.radians(5 + 5 * i)
    scene.render.filepath = sys.argv[-2] + '/%d.exr' % i
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    print('MAP', time.monotonic() - start, flush=True)
"""


def job(folder, name, maps, model):
    suns = ", ".join(f"{5 + 3 * i} deg" for i in range(maps))
    path = f"{folder}/{name}.yaml"
    with open(path, "w", encoding="utf-8") as text:
        text.write("location: {name: P, latitude: 0, longitude: 0, height: 0 m}\n"
                   f"time: {{zone: UTC, date: 2026-03-20, half: afternoon, sun_elevations: [{suns}]}}\n"
                   f"camera: {{projection: lat-long, size: 1024x512}}\nsky: {{model: {model}}}\n"
                   'outputs: [{image: "{sun_elevation}.exr"}]\n')
    return path


def ours(folder, path):
    """Seconds of the whole process, milliseconds of its stages."""
    start = time.monotonic()
    text = subprocess.run([program, "render", path, "-o", folder + "/ours", "--overwrite", "--json", "-q"], check=True,
                          capture_output=True, text=True).stdout
    return time.monotonic() - start, json.loads(text)["stage_milliseconds"]


def theirs(folder, maps):
    """Seconds of the whole process, and of each map within it, the first apart."""
    start = time.monotonic()
    done = subprocess.run([blender, "-b", "-noaudio", "--python-exit-code", "1", "--python", folder + "/scene.py",
                           "--", folder, str(maps)], check=True, capture_output=True, text=True).stdout
    whole = time.monotonic() - start
    return whole, [float(line.split()[1]) for line in done.splitlines() if line.startswith("MAP ")]


def told(name, seconds):
    print(f"{name:58} {statistics.median(seconds):8.3f} s  ({min(seconds):.3f} to {max(seconds):.3f})")
    return statistics.median(seconds)


with tempfile.TemporaryDirectory() as folder:
    with open(folder + "/scene.py", "w", encoding="utf-8") as text:
        text.write(SCENE)
    models = ["hosek-wilkie", "bruneton"]
    single = {m: job(folder, "one_" + m, 1, m) for m in models}
    many = {m: job(folder, "many_" + m, 24, m) for m in models}
    for m in models:
        ours(folder, single[m])  # libraries and, of bruneton, tables are in the cache, as for a library's second map
    one = {m: [] for m in models}
    each = {m: [] for m in models}
    stages = {}
    alone, later = [], []
    for _ in range(rounds):
        later += theirs(folder, 3)[1][1:]
        alone.append(theirs(folder, 1)[0])
        for m in models:
            one[m].append(ours(folder, single[m])[0])
            seconds, stages[m] = ours(folder, many[m])
            each[m].append(seconds / 24)
version = subprocess.run([blender, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
print(f"{version}, {len(os.sched_getaffinity(0))} cores, {rounds} rounds by turns, median (least to most)")
blender_alone = told("Blender, one map, whole process", alone)
blender_later = told("Blender, each further map of one process", later)
for m in models:
    told(f"skylapse {m}, one map, whole process", one[m])
    told(f"skylapse {m}, each of 24 maps, whole process", each[m])
    print(f"  one map {blender_alone / statistics.median(one[m]):.1f} times as fast as Blender's, "
          f"one of many {blender_later / statistics.median(each[m]):.1f} times (against its further maps), "
          f"{blender_alone / statistics.median(each[m]):.1f} times (against one process a map)")
    print("  of 24 maps [ms of a thread]: " + ", ".join(f"{k} {v:.0f}" for k, v in stages[m].items()))
