#!/usr/bin/env python3
"""Error of the level ground's irradiance by small maps, in percent, after encoding: a table for each air, a row for
each sun. `sky`: without the disc. usage: benchmarks/hdri/sizes.py [PROGRAM]"""
import json
import subprocess
import sys
import tempfile

program = sys.argv[1] if len(sys.argv) > 1 else "build/release/bin/skylapse"
AIRS = [("hosek-wilkie", 2, "0 m"), ("bruneton", 10, "0 m"), ("bruneton", 1.5, "4 km"), ("bruneton", 1.5, "30 km")]
VIEWS = [("lat-long", w, f"{w}x{w // 2}") for w in (64, 128, 256, 512, 1024)]
VIEWS += [("cube", s, f"{s}") for s in (16, 64)] + [("octahedral", s, f"{s}") for s in (64, 256)]
VIEWS += [("mirror-ball", s, f"{s}") for s in (64, 256)]


def outputs():
    for projection, number, size in VIEWS:
        layout = ", layout: vertical-strip" if projection == "cube" else ""
        for content in ("sky", "radiance"):
            yield (f'  - {{image: "{projection}{number}{content}_{{sun_elevation}}.exr", content: {content}, '
                   f"projection: {projection}, size: {size}{layout}, compression: none}}\n")


for model, turbidity, height in AIRS:
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/job.yaml", "w", encoding="utf-8") as job:
            job.write(f"location: {{name: P, latitude: 0, longitude: 0, height: {height}}}\n"
                      "time: {zone: UTC, date: 2026-03-20, half: afternoon, sun_elevations: [-6 deg, -3 deg, -1 deg, "
                      "-0.4 deg, 0 deg, 0.5 deg, 1 deg, 2 deg, 3 deg, 5 deg, 10 deg, 40 deg, 89.5 deg]}\n"
                      "camera: {projection: lat-long, size: 128x64}\n"
                      f"air: {{turbidity: {turbidity}}}\nsky: {{model: {model}}}\noutputs:\n" + "".join(outputs()))
        subprocess.run([program, "render", folder + "/job.yaml", "-o", folder + "/out", "-q"], check=True)
        with open(folder + "/out/manifest.json", encoding="utf-8") as text:
            manifest = json.load(text)
    print(f"\n{model}, turbidity {turbidity}, {height}\n   sun " +
          " ".join(f"{p[:4]:>4}{n:<5} {'':4}" for p, n, _ in VIEWS))
    for frame in manifest["frames"]:
        error = {f["path"].split("_")[0]: f["encoding"].get("error_percent", float("nan")) for f in frame["files"]}
        print(f"{frame['sun']['elevation_deg']:6.2f} " + " ".join(
            f"{error[f'{p}{n}sky']:7.3f}{error[f'{p}{n}radiance']:7.3f}" for p, n, _ in VIEWS))
