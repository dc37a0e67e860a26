#!/usr/bin/env python3
"""Loads maps of orientation blender in Blender (Cycles, CPU) and looks where things are.

    blender_test.py DRAW_COMPASS SKYLAPSE [--pictures FOLDER]

The compass map must show north, east, south, west, up and down along +Y, +X, -Y, -X, +Z and -Z. A sky must
have its sun where the ephemeris puts it, within a pixel of the map. A level white surface under the whole
map, and under the map without disc with the sun of sun.json or of the dome's USD layer beside it, must send
back the illuminance that the manifest states. Exit status 77: there is no Blender here.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
HERE = pathlib.Path(__file__).resolve().parent

SCENE = """
location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}
time: {zone: Europe/Prague, date: 2026-06-21, at: ["07:00", "12:00", "18:30"]}
sky: {model: hosek-wilkie}
camera: {projection: lat-long, size: 1024x512}
outputs:
  - image: "map.####.exr"
    orientation: blender
  - image: "sky.####.exr"
    orientation: blender
    type: half
    sun: split
  - sun: "sun.####.json"
    orientation: blender
  - dome: "dome.####.usda"
    map: "sky.####.exr"
    orientation: blender
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("draw_compass")
    parser.add_argument("skylapse")
    parser.add_argument("--pictures")
    arguments = parser.parse_args()
    blender = shutil.which("blender")
    if not blender:
        print("skipped: there is no blender here (Debian package blender)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        subprocess.run([arguments.draw_compass, "blender", "lat-long", "1024", str(folder / "compass.exr")], check=True)
        (folder / "scene.yaml").write_text(SCENE)
        subprocess.run([arguments.skylapse, "render", str(folder / "scene.yaml"), "-o", str(folder)], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        done = subprocess.run([blender, "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "-P",
                               str(HERE / "in_blender.py"), "--", str(folder), arguments.pictures or ""],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        said = [line for line in done.stdout.splitlines() if line.startswith("| ")]
        print("\n".join(said))
        # Each check says so itself: a script that ends early has not passed.
        if done.returncode != 0 or "| all is where it must be" not in said:
            print("\n".join(done.stdout.splitlines()[-40:]))
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
