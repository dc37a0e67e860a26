#!/usr/bin/env python3
"""Puts the list of hard cases into docs/stability.md, each with the tests that hold it.

    tools/hard_cases.py            writes the tables between the markers of docs/stability.md
    tools/hard_cases.py --check    fails if the tables there are old, or name a test that is not
                                   in tests/, or a case lacks one of its four lines

The list is tests/stability/hard_cases.txt; tests are found in the sources, so that nothing has to
be built. Standard library only.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- hard cases: begin -->", "<!-- hard cases: end -->"
FIELDS = ("case", "risk", "code", "tests")
TEST = re.compile(r"^\s*(TEST|TEST_F|TEST_P|TYPED_TEST)\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)


def tests_in(folder):
    """Suite.Test -> the file that defines it."""
    found = {}
    for path in sorted(folder.glob("**/*.cpp")):
        for _, suite, name in TEST.findall(path.read_text(encoding="utf-8")):
            found.setdefault(f"{suite}.{name}", path)
    return found


def read_cases(text):
    """[(part, [case])], a case being a dictionary of FIELDS."""
    parts = []
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("## "):
            parts.append((line[3:], []))
        elif line and not line.startswith("#"):
            key, _, value = line.partition(":")
            if key not in FIELDS or not parts:
                raise SystemExit(f"hard_cases.txt: not a line of a case: {line}")
            if key == "case":
                parts[-1][1].append({})
            parts[-1][1][-1][key] = value.strip()
    return parts


def problems(parts, tests):
    for _, cases in parts:
        for case in cases:
            for field in FIELDS:
                if not case.get(field):
                    yield f"{case.get('case', '?')}: there is no {field}"
            for name in case.get("tests", "").split():
                if name not in tests:
                    yield f"{case['case']}: there is no test {name}"


def table(parts, tests, root):
    lines = []
    for part, cases in parts:
        lines += [f"### {part}", "", "| case | what could go wrong | what the code does | held by |",
                  "|---|---|---|---|"]
        for case in cases:
            links = [f"[{name}](../{tests[name].relative_to(root)})" for name in case["tests"].split()]
            lines.append(f"| {case['case']} | {case['risk']} | {case['code']} | {', '.join(links)} |")
        lines.append("")
    count = sum(len(cases) for _, cases in parts)
    names = {name for _, cases in parts for case in cases for name in case["tests"].split()}
    lines.append(f"{count} cases, held by {len(names)} tests.")
    return "\n".join(lines)


def self_test():
    """A missing test and a missing line must be found, or silence means nothing."""
    parts = read_cases("## P\ncase: a\nrisk: r\ncode: c\ntests: A.B C.D\n\ncase: b\nrisk: r\ntests: A.B\n")
    found = list(problems(parts, {"A.B": pathlib.Path("x")}))
    assert found == ["a: there is no test C.D", "b: there is no code"], found


def main():
    self_test()
    tests = tests_in(ROOT / "tests")
    parts = read_cases((ROOT / "tests/stability/hard_cases.txt").read_text(encoding="utf-8"))
    wrong = list(problems(parts, tests))
    if wrong:
        print("\n".join(wrong), file=sys.stderr)
        return 1
    docs = ROOT / "docs/stability.md"
    text = docs.read_text(encoding="utf-8")
    before, after = text.split(BEGIN)[0], text.split(END)[1]
    new = f"{before}{BEGIN}\n{table(parts, tests, ROOT)}\n{END}{after}"
    if "--check" not in sys.argv:
        docs.write_text(new, encoding="utf-8")
    elif new != text:
        print("docs/stability.md is old: run tools/hard_cases.py", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
