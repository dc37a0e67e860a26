#!/usr/bin/env python3
"""Runs comparisons over pairs of pictures of which it is known what should be said to them.

    cases.py                      a table (markdown): skylapse diff beside idiff, each case and the sums
    cases.py --check              skylapse alone; exit 1 if it decides any case wrongly
    cases.py --measures           the largest value of each measure over the innocent pairs, and its limits
    cases.py --only 'S0*,P40'     some cases
The pairs are made by the program diff_cases (tests/diff_cases).
"""
import argparse
import concurrent.futures
import csv
import fnmatch
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIMEOUT_S = 60
# As it comes, and as render farms use it: 1 % of the pixels may be off by 0.004, half a code value more than one.
IDIFF = {"idiff": [], "idiff -fail 0.004 -failpercent 1": ["-fail", "0.004", "-failpercent", "1"]}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path, help="build folder")
    parser.add_argument("--skylapse", type=pathlib.Path, help="default: BUILD/bin/skylapse")
    parser.add_argument("--generator", type=pathlib.Path, help="default: BUILD/bin/diff_cases")
    parser.add_argument("--folder", type=pathlib.Path, help="keep the pictures here; what is there is used again")
    parser.add_argument("--check", action="store_true", help="skylapse alone, exit 1 on a wrong decision")
    parser.add_argument("--measures", action="store_true", help="what innocent changes come to, beside the limits")
    parser.add_argument("--few", action="store_true", help="fewer frames, as in the tests")
    parser.add_argument("--only", default="*", help="ids, with wildcards, separated by commas")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


def run(command):
    """Exit code and output; a command that hangs or is killed is a decision, and a wrong one."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=TIMEOUT_S)
        return done.returncode, (done.stdout + done.stderr).strip()
    except subprocess.TimeoutExpired:
        return -1, f"no answer within {TIMEOUT_S} s"


def idiff(options, a, b):
    """idiff knows files alone: of folders the worst of their pictures, and a missing one is an error."""
    if not a.is_dir():
        return run(["idiff", *options, a, b])[0]
    names = {p.relative_to(f) for f in (a, b) for p in f.rglob("*") if p.suffix in (".exr", ".png")}
    codes = [run(["idiff", *options, a / name, b / name])[0] for name in sorted(names)]
    return min(codes) if min(codes) < 0 else max(codes)


def is_right(case, code):
    """Whether an exit code is what the list asks for."""
    return str(code) in case["exits"].split(",")


def is_right_of_idiff(case, code):
    """idiff: 0 and 1 pass, 2 to 4 are failures (difference, size, file)."""
    return code in (0, 1) if case["kind"] == "innocent" else code in (2, 3, 4)


def decide(case, folder, program, with_idiff):
    a, b = folder / case["a"], folder / case["b"]
    case["skylapse diff"], case["said"] = run([program, "diff", *case["options"].split(), a, b])
    for name, options in IDIFF.items() if with_idiff else ():
        case[name] = idiff(options, a, b)
    return case


def measured(case, folder, program):
    """Values of the measures that have limits, of the worst of its pairs."""
    command = [program, "diff", "--quiet", "--json", "-", folder / case["a"], folder / case["b"]]
    values = {}
    for pair in json.loads(run(command)[1])["pairs"]:
        for m in pair["measures"]:
            name = m["name"]
            if name.startswith(("relative.region", "display.region")):
                name = ".".join([name.split(".")[0], "region.*", name.split(".")[-1]])
            if m["fail_limit"] is not None and isinstance(m["value"], (int, float)):
                values[name] = max(values.get(name, (-1.0, "", 0, 0)), (m["value"], case["id"], m["warn_limit"], m["fail_limit"]))
    return values


def print_measures(cases, folder, program, jobs):
    worst = {}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for values in pool.map(lambda c: measured(c, folder, program), cases):
            for name, value in values.items():
                worst[name] = max(worst.get(name, (-1.0, "", 0, 0)), value)
    print("| measure | largest of innocent pairs | case | warns above | fails above | limit / largest |\n" + "|---" * 6 + "|")
    for name, (value, case, warn, fail) in sorted(worst.items()):
        print(f"| `{name}` | {value:.2g} | {case} | {warn:g} | {fail:g} | " + (f"{fail / value:.1f}" if value else "") + " |")


def mark(right):
    return "" if right else " **wrong**"


def print_table(cases):
    tools = ["skylapse diff", *IDIFF]
    for kind, should in (("sabotage", "must fail"), ("innocent", "must pass")):
        rows = [c for c in cases if c["kind"] == kind]
        if not rows:
            continue
        print(f"\n### {kind.capitalize()}: {should}\n\n| case | frame | what | " + " | ".join(tools) + " |")
        print("|---" * (3 + len(tools)) + "|")
        for c in rows:
            cells = [f"{c[t]}" + mark((is_right if t == tools[0] else is_right_of_idiff)(c, c[t])) for t in tools]
            print(f"| {c['id']} | {c['frame']} | {c['what']} | " + " | ".join(cells) + " |")
    print("\n### Sums\n\n| tool | sabotages caught | innocents passed | wrong |\n|---|---|---|---|")
    for tool in tools:
        judge = is_right if tool == tools[0] else is_right_of_idiff
        right = {k: [judge(c, c[tool]) for c in cases if c["kind"] == k] for k in ("sabotage", "innocent")}
        wrong = sum(not r for rs in right.values() for r in rs)
        print(f"| {tool} | " + " | ".join(f"{sum(r)} of {len(r)}" for r in right.values()) + f" | {wrong} |")


def main():
    args = arguments()
    program = args.skylapse or args.build / "bin/skylapse"
    generator = args.generator or args.build / "bin/diff_cases"
    folder = args.folder or pathlib.Path(tempfile.mkdtemp(prefix="skylapse-diff-cases-"))
    try:
        if not (folder / "list.tsv").exists():
            made = subprocess.run([generator, folder, program, *(["few"] if args.few else [])], stdout=sys.stderr)
            if made.returncode != 0:
                sys.exit(f"{generator} failed")
        with open(folder / "list.tsv", encoding="utf-8") as file:
            listed = list(csv.DictReader(file, delimiter="\t"))
        cases = [c for c in listed if any(fnmatch.fnmatch(c["id"], p) for p in args.only.split(","))]
        if not cases:
            sys.exit("no case is called so")
        if args.measures:
            return print_measures([c for c in cases if c["kind"] == "innocent"], folder, program, args.jobs)
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            cases = list(pool.map(lambda c: decide(c, folder, program, not args.check), cases))
    finally:
        if not args.folder:
            shutil.rmtree(folder, ignore_errors=True)
    wrong = [c for c in cases if not is_right(c, c["skylapse diff"])]
    if not args.check:
        print_table(cases)
    for c in wrong:
        print(f"{c['id']} ({c['kind']}, {c['frame']}: {c['what']}): exit {c['skylapse diff']}, should be "
              f"{c['exits']}\n    {c['said']}", file=sys.stderr)
    print(f"{len(cases)} cases, {len(wrong)} decided wrongly", file=sys.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
