#!/usr/bin/env python3
"""What runs of one program on one machine differ by: the figures behind the profile same-renderer.

    reruns.py [--build DIR]      a table (markdown): files that are the same byte by byte
Six skies by each model, in six kinds of files, with one thread, with four, in two shards and in two runs; and,
where valgrind is installed, by the kernels for a processor without AVX-512, which valgrind does not have.
"""
import argparse
import filecmp
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "tests/diff_cases/scenes/models.yaml"
MODELS = ["hosek-wilkie", "preetham", "single-scattering", "bruneton, level: draft",
          "bruneton, level: draft, precision: double", "reference, samples: 4"]
NAME = "{sun_elevation}_{turbidity}"
OUTPUTS = [f'{{image: "{NAME}.exr", type: float}}', f'{{image: "half_{NAME}.exr", type: half}}',
           f'{{image: "{NAME}.hdr"}}', f'{{image: "{NAME}.png"}}', f'{{image: "u16_{NAME}.png", type: u16}}',
           f'{{image: "{NAME}.jpg"}}']
# How a job is run: name, the options of each of its runs, what runs the program.
WAYS = [("again, 1 thread", [["--jobs", "1"]], []), ("4 threads", [["--jobs", "4"]], []),
        ("two shards", [["--shard", "2/2"], ["--shard", "1/2"]], []),
        ("two runs", [["--frames", "1-3"], []], [])]
VALGRIND = ("without AVX-512", [["--jobs", "1"]], ["valgrind", "--quiet", "--tool=none"])


def render(program, folder, model, runs, before):
    settings = [f"sky={{model: {model}}}", "camera={projection: lat-long, size: 64x32}", "exposure={ev: 14 EV}",
                f"outputs=[{', '.join(OUTPUTS)}]"]
    env = dict(os.environ, XDG_CACHE_HOME=str(folder) + "-cache")  # tables are computed anew by each way
    for options in runs:
        command = [*before, program, "render", "--quiet", SCENE, "--output", folder, *options]
        subprocess.run([*command, *(x for s in settings for x in ("--set", s))], check=True, env=env,
                       stderr=subprocess.DEVNULL, timeout=600)


def equal(a, b):
    """Files of two folders that are the same byte by byte."""
    names = sorted(p.name for p in a.iterdir() if p.suffix != ".json" and p.is_file())
    same, _, _ = filecmp.cmpfiles(a, b, names, shallow=False)
    return f"{len(same)} of {len(names)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--skylapse", type=pathlib.Path, help="default: BUILD/bin/skylapse")
    args = parser.parse_args()
    program = args.skylapse or args.build / "bin/skylapse"
    with tempfile.TemporaryDirectory(prefix="skylapse-reruns-") as name:
        folder = pathlib.Path(name)
        print("| equal to a run with one thread | " + " | ".join(w[0] for w in [*WAYS, VALGRIND]) + " |")
        print("|---" * (len(WAYS) + 2) + "|")
        for index, model in enumerate(MODELS):
            render(program, folder / f"{index}", model, [["--jobs", "1"]], [])
            # llvmpipe makes its kernels at run time: those of OpenGL are what renderers.py is about.
            fits = model in ("hosek-wilkie", "preetham") and shutil.which("valgrind")
            cells = []
            for number, (_, runs, before) in enumerate([*WAYS, *([VALGRIND] if fits else [])]):
                render(program, folder / f"{index}-{number}", model, runs, before)
                cells.append(equal(folder / f"{index}", folder / f"{index}-{number}"))
            print(f"| {model} | " + " | ".join([*cells, *[""] * (len(WAYS) + 1 - len(cells))]) + " |", flush=True)


if __name__ == "__main__":
    main()
