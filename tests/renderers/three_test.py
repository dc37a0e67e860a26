#!/usr/bin/env python3
"""Shows maps and cubes of orientation three in three.js, in headless Chromium, and looks where things are.

    three_test.py DRAW_COMPASS SKYLAPSE THREE

THREE is the folder of the npm package (npm install --prefix build/three three@0.187). North, east, south,
west, up and down of the compass must stand along -Z, +X, +Z, -X, +Y and -Y, as a lat-long map and as six
images; the sun of a lat-long map and of a KTX 2 cube where sun.json says. Exit status 77: no Chromium or no
three.js here.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from browser import SKIPPED, Browser, Page, check, find_chromium  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
SIZE = 64
MARKS = {
    "north": ((0.9, 0.05, 0.05), (0, 0, -1)), "east": ((0.9, 0.8, 0.05), (1, 0, 0)),
    "south": ((0.05, 0.8, 0.8), (0, 0, 1)), "west": ((0.1, 0.2, 0.95), (-1, 0, 0)),
    "up": ((1, 1, 1), (0, 1, 0)), "down": ((0, 0, 0), (0, -1, 0))}
SCENE = """
location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}
time: {zone: Europe/Prague, date: 2026-06-21, at: ["07:00", "12:00", "18:30"]}
sky: {model: hosek-wilkie}
camera: {projection: lat-long, size: 1024x512}
outputs:
  - {image: "map.####.exr", orientation: three}
  - {image: "cube.####.ktx2", projection: cube, size: 256, type: float, orientation: three}
  - {image: "sky.####.exr", content: sky, projection: lat-long, size: 64x32}
  - {sun: "sun.####.json", orientation: three}
  - {dome: "dome.####.usda", map: "sky.####.exr"}
"""


def look(page, towards, fov):
    seen = page.eval(f"tryOut.look({json.dumps(list(towards))}, {fov})")
    pixels = [seen["pixels"][i:i + 3] for i in range(0, 4 * SIZE * SIZE, 4)]
    return pixels, seen["axes"]


def try_marks(page, what):
    for name, (color, towards) in MARKS.items():
        pixels, _ = look(page, towards, 20)
        share = sum(all(abs(a - b) < 0.02 for a, b in zip(p, color)) for p in pixels) / len(pixels)
        print(f"{what} {name:5}: {100 * share:.0f} % of the view along {towards} has its colour")
        check(share > 0.4, f"{what}: {name} is elsewhere")


def try_sun(page, what, sun, bound):
    """Centroid of the disc's light in a view of 8 deg beside it."""
    to_sun = sun["disc"]["apparent_centre"]["axes"]
    pixels, m = look(page, [to_sun[0] + 0.015, to_sun[1] - 0.01, to_sun[2] + 0.012], 8)
    light = [0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in pixels]
    disc = [(i, v) for i, v in enumerate(light) if v > 0.02 * max(light)]
    whole, reach = sum(v for _, v in disc), math.tan(math.radians(4))
    x = (sum(v * (i % SIZE + 0.5) for i, v in disc) / whole / (SIZE / 2) - 1) * reach
    y = (sum(v * (i // SIZE + 0.5) for i, v in disc) / whole / (SIZE / 2) - 1) * reach
    seen = [x * m[k] + y * m[4 + k] - m[8 + k] for k in range(3)]
    seen = [v / math.hypot(*seen) for v in seen]
    off = math.degrees(2 * math.asin(math.dist(seen, to_sun) / 2))
    print(f"{what}: the sun is seen {off:.3f} deg away; a pixel is {bound:.3f} deg")
    check(off < bound, f"{what}: the sun is elsewhere")


def try_layer(page, text):
    """A parser that is not ours finds the prims, and their attributes in them."""
    layer = page.eval(f"tryOut.usda({json.dumps(text)})")
    sky = layer['def Xform "Sky"']
    dome, sun = sky['def DomeLight "Dome"'], sky['def DistantLight "Sun"']
    check(dome["asset inputs:texture:file"] == "@./sky.0001.exr@", "the layer's map")
    check(dome["token inputs:texture:format"] == '"latlong"' and "matrix4d xformOp:transform" in dome, "the dome")
    for attribute in ("float inputs:angle", "float inputs:intensity", "color3f inputs:color", "bool inputs:normalize",
                      "matrix4d xformOp:transform", "uniform token[] xformOpOrder"):
        check(attribute in sun, f"the sun has no {attribute}")
    print("usda: prims and attributes are read")


def main():
    parser = argparse.ArgumentParser()
    for name in ("draw_compass", "skylapse", "three"):
        parser.add_argument(name)
    arguments = parser.parse_args()
    program, three = find_chromium(), pathlib.Path(arguments.three).resolve()
    if not program or not (three / "build" / "three.module.js").exists():
        print("skipped: no chromium, or no three.js (npm install --prefix build/three three@0.187)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        draw = lambda *args: subprocess.run([arguments.draw_compass, "three", *args], check=True)
        draw("lat-long", "1024", str(folder / "compass.exr"))
        draw("cube", "256", str(folder / "compass_{face}.png"))
        (folder / "scene.yaml").write_text(SCENE)
        subprocess.run([arguments.skylapse, "render", str(folder / "scene.yaml"), "-o", str(folder)], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        page_text = (HERE / "three_page.html").read_text().replace("THREE/", three.as_uri() + "/")
        (folder / "page.html").write_text(page_text)
        browser = Browser(program, os.path.join(temporary, "profile"),
                          ["--allow-file-access-from-files", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"])
        try:
            page = Page(browser, (folder / "page.html").as_uri(), 400, 400)
            page.eval("new Promise(done => { const t = setInterval(() => { if (window.ready) { clearInterval(t); done(); } }, 20); setTimeout(done, 20000); })")
            check(page.eval("window.ready === true"), f"three.js does not start: {[e for e in browser.events if 'exception' in str(e).lower()][:2]}")
            print("three.js r" + page.eval("tryOut.revision"))
            page.eval("tryOut.latLong('compass.exr')")
            try_marks(page, "lat-long")
            page.eval("tryOut.cube(" + json.dumps([f"compass_{f}.png" for f in ("px", "nx", "py", "ny", "pz", "nz")]) + ")")
            try_marks(page, "six images")
            try_layer(page, (folder / "dome.0001.usda").read_text())
            for n in (1, 2, 3):
                sun = json.loads((folder / f"sun.{n:04}.json").read_text())
                page.eval(f"tryOut.latLong('map.{n:04}.exr')")
                try_sun(page, f"lat-long {n}", sun, 360 / 1024)
                check(page.eval(f"tryOut.ktx2('cube.{n:04}.ktx2')") == 9, "a face of 256 pixels has 9 levels")
                try_sun(page, f"ktx2 {n}", sun, 90 / 256)
        finally:
            browser.close()
    print("all is where it must be")
    return 0


if __name__ == "__main__":
    sys.exit(main())
