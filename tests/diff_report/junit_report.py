#!/usr/bin/env python3
"""Holds a JUnit report against the rules of the schema that Jenkins reads by (junit-10.xsd of its xunit
plugin): which element may stand in which, which attributes each may have and must have, counts.

    junit_report.py TEST_DIFF [--file FILE]

TEST_DIFF writes a report of every kind of case (or --file names a real one).
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

# element: (children, attributes that must be there, those that may)
RULES = {
    "testsuites": ({"testsuite"}, set(), {"name", "time", "tests", "failures", "errors"}),
    "testsuite": ({"testcase", "properties", "system-out", "system-err"}, {"name", "tests", "failures", "errors"},
                  {"time", "skipped", "timestamp", "hostname", "id", "package", "file", "log", "url", "group"}),
    "testcase": ({"skipped", "error", "failure", "system-out", "system-err"}, {"name"}, {"time", "classname", "group"}),
    "failure": (set(), set(), {"type", "message"}),
    "error": (set(), set(), {"type", "message"}),
    "skipped": (set(), set(), {"type", "message"}),
    "system-out": (set(), set(), set()),
}
TIME = re.compile(r"[0-9]*(\.[0-9]*)?")


def complaints(element):
    children, needed, allowed = RULES[element.tag]
    for name in needed - set(element.keys()):
        yield f"{element.tag} has no {name}"
    for name in set(element.keys()) - needed - allowed:
        yield f"{element.tag} has {name}"
    if "time" in element.keys() and not TIME.fullmatch(element.get("time")):
        yield f"time of {element.tag}: {element.get('time')}"
    for child in element:
        if child.tag not in children:
            yield f"{element.tag} holds {child.tag}"
        else:
            yield from complaints(child)


def counts(element):
    return [str(len(list(element.iter(tag)))) for tag in ("testcase", "failure", "error")]


def check(path):
    root = ElementTree.parse(path).getroot()
    found = list(complaints(root)) if root.tag in RULES else [f"the root is {root.tag}"]
    for element in (root, *root.iter("testsuite")):
        stated = [element.get(name) for name in ("tests", "failures", "errors")]
        if stated != counts(element):
            found.append(f"{element.tag} states {stated}, holds {counts(element)}")
    if len(list(root.iter("testcase"))) < 1:
        found.append("there are no cases")
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("test_diff")
    parser.add_argument("--file")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = arguments.file
        if not path:
            path = os.path.join(folder, "junit.xml")
            subprocess.run([arguments.test_diff, "--gtest_filter=JunitReport.WritesItsFile"], check=True,
                           stdout=subprocess.DEVNULL, env={**os.environ, "SKYLAPSE_JUNIT_REPORT": path})
        found = check(path)
    print("\n".join(found) or "the report keeps the schema's rules")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
