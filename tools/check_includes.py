#!/usr/bin/env python3
"""Checks that includes go down the layers only, and prints each one that does not.

A file in src/ or cli/ may include its own folder and folders of a lower number. Third-party
libraries are allowed in the folders that own them.
"""
import pathlib
import re
import sys

LAYER = {"cli": 7, "study": 6, "diff": 6, "pipeline": 5, "plan": 4, "config": 3, "sky": 2, "output": 2,
         "astro": 1, "image": 1, "color": 1, "gpu": 1, "core": 0, "data": 0}
OWNER = [(r"yaml-cpp/", {"src/config/yaml_"}), (r"OpenColorIO/", {"src/color/", "src/output/"}),
         (r"OpenImageIO/", {"src/output/"}), (r"(EGL|GL)/", {"src/gpu/"}),
         (r"erfa", {"src/astro/"}), (r"GeographicLib/", {"src/astro/"}), (r"date/", {"src/astro/"}),
         (r"CLI/", {"cli/"}), (r"tbb/", {"src/core/", "src/pipeline/"})]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def folder_of(path):
    parts = path.parts
    return "cli" if parts[0] == "cli" else parts[1] if parts[0] == "src" and len(parts) > 2 else None


def violations(root):
    for path in sorted([*root.glob("src/**/*.h"), *root.glob("src/**/*.cpp"), *root.glob("cli/*")]):
        relative = path.relative_to(root)
        if path.suffix not in (".h", ".cpp"):
            continue
        folder = folder_of(relative)
        for _, target in INCLUDE.findall(path.read_text(encoding="utf-8")):
            other = target.split("/")[0]
            if folder and other in LAYER and other != folder and LAYER[other] >= LAYER[folder]:
                yield f"{relative}: {folder} ({LAYER[folder]}) includes {target} ({LAYER[other]})"
            for pattern, owners in OWNER:
                if re.match(pattern, target) and not any(str(relative).startswith(o) for o in owners):
                    yield f"{relative}: {target} belongs in {', '.join(sorted(owners))}"


def self_test():
    """The checker must find a planted violation, or its silence means nothing."""
    import tempfile
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "src/core").mkdir(parents=True)
        (root / "src/core/bad.h").write_text('#include "plan/plan.h"\n#include <yaml-cpp/yaml.h>\n')
        assert len(list(violations(root))) == 2, "planted violations were not found"


if __name__ == "__main__":
    self_test()
    found = list(violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) if found else "includes go down the layers")
    sys.exit(1 if found else 0)
