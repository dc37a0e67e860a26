#!/usr/bin/env python3
"""The project's own golden pictures, checked with its own command.

    golden.py SKYLAPSE                       renders scenes/ and holds them against accepted/
    golden.py SKYLAPSE --self-check          accepted pictures of different scenes must differ
    golden.py SKYLAPSE --broken              the check itself: a wrong sky must not pass
    golden.py SKYLAPSE --accept --note WHY   shows what differs and accepts it for this renderer
Exit 0 if all is as it should be.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
ACCEPTED = FOLDER / "accepted"
SCENES = sorted(p.stem for p in (FOLDER / "scenes").glob("*.yaml"))
# Wrong skies: the scene, and what is changed in it.
BROKEN = [("noon", "air.turbidity=2.6"), ("noon", "sky.sun_disc=off"), ("evening", "air.ground_albedo=0.58"),
          ("space", "time.at=[2026-03-20T17:01Z]"), ("fits", "air.turbidity=3.1")]
DIFFERENT = 2


def render(program, scene, folder, *options):
    # From here, so that goldens name their scene by a path that holds on any machine.
    subprocess.run([program, "render", "--quiet", f"scenes/{scene}.yaml", "--output", folder, *options], check=True,
                   cwd=FOLDER)


def diff(program, *arguments):
    """Its exit code; what it says goes on."""
    return subprocess.run([program, "diff", *arguments], timeout=300).returncode


def check(program, folder):
    for scene in SCENES:
        render(program, scene, folder / scene)
    return diff(program, folder, "--golden-dir", ACCEPTED) in (0, 1)


def self_check(program):
    return diff(program, "--self-check", "--golden-dir", ACCEPTED) == 0


def broken(program, folder):
    fine = True
    for index, (scene, change) in enumerate(BROKEN):
        output = folder / str(index)
        render(program, scene, output / scene, "--set", change)
        others = [o for s in SCENES if s != scene for o in ("--ignore", f"{s}/**")]
        code = diff(program, output, "--golden-dir", ACCEPTED, *others, "--quiet")
        if code != DIFFERENT:
            print(f"{scene} with {change}: exit {code}, should be {DIFFERENT}")
            fine = False
    return fine


def accept(program, folder, note):
    for scene in SCENES:
        render(program, scene, folder / scene)
    return diff(program, folder, "--golden-dir", ACCEPTED, "--update-golden", "--note", note) in (0, 1, DIFFERENT)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--self-check", action="store_true")
    parser.add_argument("--broken", action="store_true")
    parser.add_argument("--accept", action="store_true")
    parser.add_argument("--note", default="")
    args = parser.parse_args()
    program = args.program.resolve()
    folder = pathlib.Path(tempfile.mkdtemp(prefix="skylapse-golden-"))
    try:
        if args.accept:
            fine = accept(program, folder, args.note)
        elif args.self_check:
            fine = self_check(program)
        else:
            fine = (broken if args.broken else check)(program, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    sys.exit(0 if fine else 1)


if __name__ == "__main__":
    main()
