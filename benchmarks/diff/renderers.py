#!/usr/bin/env python3
"""What renderers really change: the figures behind the limits of skylapse diff's profiles.

    renderers.py [--build DIR]               tables (markdown) of the largest differences
    renderers.py --also NAME=FOLDER          holds a folder that another machine rendered, one with a GPU
                                             say, against EGL too (its scene: --print-scene)
One scene, three suns and four cameras, is rendered in each way and held against the first by
"skylapse diff --json"; a row is the largest value of each measure over all its pictures.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "tests/diff_cases/scenes/skies.yaml"
LINEAR = ["relative.max", "relative.p999", "relative.block_rms", "relative.row_rms", "relative.rms", "relative.bias",
          "relative.region.*", "irradiance", "harmonics", "chromaticity", "sun.shift_deg", "sun.flux",
          "position.shift_px", "flip.mean"]
DISPLAY = ["display.max", "display.block_rms", "display.rms", "display.bias", "position.shift_px", "flip.mean"]
# Ways to render the same: name, options, environment. The first is what the others are held against.
WAYS = [("EGL", [], {}), ("EGL again", [], {}), ("1 thread", ["--jobs", "1"], {"LP_NUM_THREADS": "0"}),
        ("4 threads", ["--jobs", "4"], {"LP_NUM_THREADS": "4"}), ("OSMesa", ["--backend", "osmesa"], {}),
        ("vectors of 128 bits", [], {"LP_NATIVE_VECTOR_WIDTH": "128"}),
        ("vectors of 512 bits", [], {"LP_NATIVE_VECTOR_WIDTH": "512"})]
BRUNETON = ["--set", "sky.model=bruneton"]
DAY = ["--set", "time.at=[2026-06-21T12:00+02:00, 2026-06-21T20:00+02:00]"]  # fits end at the horizon
HOSEK = [*DAY, "--set", "sky={model: hosek-wilkie}"]
SMALL = ["--set", "cameras=[{name: map, projection: lat-long, size: 64x32}]"]  # the processor takes its time
# Pairs of models and settings: name, options of A, options of B.
MODELS = [
    ("bruneton draft: processor in double", [*BRUNETON, *SMALL], [*BRUNETON, *SMALL, "--set", "sky.precision=double"]),
    ("bruneton draft: tables of half floats", [*BRUNETON], [*BRUNETON, "--set", "sky.precision=half"]),
    ("hosek-wilkie: processor and OpenGL", HOSEK, [*DAY, "--set", "sky={model: hosek-wilkie-gl}"]),
    ("bruneton: draft and standard", [*BRUNETON], [*BRUNETON, "--set", "sky.level=standard"]),
    ("bruneton and single-scattering", [*BRUNETON], ["--set", "sky={model: single-scattering, level: draft}"]),
    ("bruneton and hosek-wilkie", [*BRUNETON, *DAY], HOSEK),
]


def render(program, folder, options, environment):
    """Tables that renders share are kept apart: no way takes another's arithmetic."""
    env = dict(os.environ, XDG_CACHE_HOME=str(folder) + "-cache", **environment)
    subprocess.run([program, "render", "--quiet", SCENE, "--output", folder, *options], check=True, env=env)


def largest(program, a, b):
    """Largest value of each measure over the pictures of two folders, of EXR and PNG apart."""
    done = subprocess.run([program, "diff", a, b, "--quiet", "--profile", "cross-renderer", "--json", "-",
                           "--check", "metadata.time=ignore"], capture_output=True, text=True, timeout=600)
    if done.returncode not in (0, 1, 2):
        sys.exit(f"skylapse diff answers {done.returncode}: {done.stderr}")
    found = {"exr": {}, "png": {}}
    for pair in json.loads(done.stdout)["pairs"]:
        kind = found[pair["name"][-3:]]
        kind["pairs"] = kind.get("pairs", 0) + 1
        for m in pair["measures"]:
            if isinstance(m["value"], (int, float)):
                name = "relative.region.*" if m["name"].startswith("relative.region.") else m["name"]
                kind[name] = max(kind.get(name, 0), m["value"])
    return found


def print_rows(title, names, rows, kind):
    print(f"\n### {title}\n\n| | pictures | " + " | ".join(names) + " |\n" + "|---" * (len(names) + 2) + "|")
    for name, values in rows:
        v = values[kind]
        print(f"| {name} | {v.get('pairs', 0)} | " + " | ".join(f"{v[n]:.2g}" if n in v else "" for n in names) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--skylapse", type=pathlib.Path, help="default: BUILD/bin/skylapse")
    parser.add_argument("--also", action="append", default=[], metavar="NAME=FOLDER")
    parser.add_argument("--print-scene", action="store_true", help="the scene to render elsewhere, and stop")
    args = parser.parse_args()
    if args.print_scene:
        return print(SCENE.read_text(encoding="utf-8"))
    program = args.skylapse or args.build / "bin/skylapse"
    with tempfile.TemporaryDirectory(prefix="skylapse-renderers-") as name:
        folder = pathlib.Path(name)
        rows = []
        for index, (way, options, environment) in enumerate(WAYS):
            render(program, folder / f"way{index}", [*BRUNETON, *options], environment)
            if index > 0:
                rows.append((way, largest(program, folder / "way0", folder / f"way{index}")))
        for also in args.also:
            label, _, other = also.partition("=")
            rows.append((label, largest(program, folder / "way0", pathlib.Path(other))))
        print_rows("bruneton draft, against EGL: scene-linear", LINEAR, rows, "exr")
        print_rows("bruneton draft, against EGL: for displays", DISPLAY, rows, "png")
        sys.stdout.flush()
        models = []
        for index, (label, a, b) in enumerate(MODELS):
            for side, options in (("a", a), ("b", b)):
                render(program, folder / f"model{index}{side}", options, {})
            models.append((label, largest(program, folder / f"model{index}a", folder / f"model{index}b")))
        print_rows("Models and settings: scene-linear", LINEAR, models, "exr")
        print_rows("Models and settings: for displays", DISPLAY, models, "png")


if __name__ == "__main__":
    main()
