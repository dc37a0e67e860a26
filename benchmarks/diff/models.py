#!/usr/bin/env python3
"""What models differ by, and what broken pictures differ by: the figures behind the profile cross-model.

    models.py [--build DIR]        a table (markdown); about four minutes
One scene, six skies, is rendered by each model. Each pair of models is held against each other as it comes,
and once more with the second picture broken and without a word about itself.
"""
import argparse
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "tests/diff_cases/scenes/models.yaml"
MODELS = {"bruneton": "bruneton, level: draft", "single-scattering": "single-scattering",
          "hosek-wilkie": "hosek-wilkie", "preetham": "preetham", "reference": "reference, samples: 8"}
MEASURES = ["irradiance", "harmonics", "sun.shift_deg", "sun.flux", "chromaticity", "flip.mean"]
# What is done to B: name, what the picture is made of, what oiiotool does to it.
AFTERNOON, NO_DISC = ["--set", "time.half=afternoon"], ["--set", "sky.sun_disc=off"]
BROKEN = [
    ("sun at 20 deg for 5 deg, 60 for 20, 5 for 60", "other", []), ("afternoon for morning", "afternoon", []),
    ("sun's disc left out", "no-disc", []), ("mirrored", "", ["--flop"]), ("upside down", "", ["--flip"]),
    ("turned by 5.6 deg (4 columns)", "", ["--cshift", "+4+0"]), ("turned by 1.4 deg (1 column)", "", ["--cshift", "+1+0"]),
    ("turned by 90 deg", "", ["--cshift", "+64+0"]), ("black", "", ["--mulc", "0"]),
    ("red and blue exchanged", "", ["--ch", "R=B,G,B=R"]), ("units of 10 000 cd/m2 (x 10)", "", ["--mulc", "10"]),
    ("in cd/m2 (x 1000)", "", ["--mulc", "1000"]), ("two stops darker", "", ["--mulc", "0.25"]),
]
NEXT = {"+05": "+20", "+20": "+60", "+60": "+05"}


def render(program, folder, model, options=()):
    env = dict(os.environ, XDG_CACHE_HOME=str(folder.parent / "cache"))
    subprocess.run([program, "render", "--quiet", SCENE, "--output", folder, "--set", f"sky={{model: {model}}}", *options],
                   check=True, env=env)


def damage(source, target, kind, options):
    target.mkdir()
    for file in source.glob("*.exr"):
        name = NEXT[file.name[:3]] + file.name[3:] if kind == "other" else file.name
        subprocess.run(["oiiotool", source / name, *options, "--eraseattrib", "skylapse:.*", "-o", target / file.name],
                       check=True, timeout=60)


def compared(program, a, b):
    """Of each picture its measures, and whether the profile's limits let it pass."""
    done = subprocess.run([program, "diff", a, b, "--quiet", "--profile", "cross-model", "--json", "-"],
                          capture_output=True, text=True, timeout=600)
    if done.returncode not in (0, 1, 2):
        sys.exit(f"skylapse diff answers {done.returncode}: {done.stderr}")
    pairs = json.loads(done.stdout)["pairs"]
    return [({m["name"]: m["value"] for m in p["measures"] if isinstance(m["value"], (int, float))}, p["verdict"])
            for p in pairs]


def row(name, found):
    """Smallest and largest of each measure, and how many pictures fail."""
    cells = []
    for m in MEASURES:
        values = [v[m] for v, _ in found if m in v]
        cells.append(f"{min(values):.2g} .. {max(values):.2g}" if values else "")
    fails = sum(s not in ("same", "warning") for _, s in found)
    print(f"| {name} | {len(found)} | " + " | ".join(cells) + f" | {fails} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--skylapse", type=pathlib.Path, help="default: BUILD/bin/skylapse")
    args = parser.parse_args()
    program = args.skylapse or args.build / "bin/skylapse"
    with tempfile.TemporaryDirectory(prefix="skylapse-models-") as name:
        folder = pathlib.Path(name)
        sides = [m for m in MODELS if m != "reference"]
        for m in MODELS:
            render(program, folder / m, MODELS[m])
        for m in sides:
            render(program, folder / f"{m}-afternoon", MODELS[m], AFTERNOON)
            render(program, folder / f"{m}-no-disc", MODELS[m], NO_DISC)
        print("| | pairs | " + " | ".join(MEASURES) + " | fail |\n" + "|---" * (len(MEASURES) + 3) + "|")
        honest = {}
        for a, b in itertools.combinations(MODELS, 2):
            honest[a, b] = compared(program, folder / a, folder / b)
            row(f"{a}, {b}", honest[a, b])
        row("**all models**", sum(honest.values(), []))
        for index, (what, kind, options) in enumerate(BROKEN):
            found = []
            for b in sides:
                source = folder / (f"{b}-{kind}" if kind in ("afternoon", "no-disc") else b)
                damage(source, folder / f"broken{index}-{b}", kind, options)
                for a in (m for m in sides if m != b):
                    found += compared(program, folder / a, folder / f"broken{index}-{b}")
            row(what, found)


if __name__ == "__main__":
    main()
