#!/usr/bin/env python3
"""Renders a small library, opens its gallery in headless Chromium without a network and tries it out.

    gallery_page.py SKYLAPSE [--page FILE] [--screenshots FOLDER]

--page opens a gallery that is there instead, and only looks. Exit status 77: there is no Chromium here.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from browser import Browser, Page, check, check_events, start  # noqa: E402

# Names with what a link must not trip over; two sites, two airs, three elevations of the sun.
LIBRARY = """
title: "Two <cities> & more"
locations:
  - {name: Prague, latitude: 50.0755, longitude: 14.4378, zone: Europe/Prague}
  - {name: Quito, latitude: -0.1807, longitude: -78.4678, zone: America/Guayaquil}
time: {dates: [2026-06-21], sun_elevations: [-3 deg, 5 deg, 40 deg], half: morning}
air: {turbidity: [2, 4]}
sky: {model: hosek-wilkie}
camera: {projection: lat-long, look_at: {azimuth: 90 deg}, size: 64x32}
outputs:
  - image: "{site}/{date}_{sun_elevation}_t{turbidity}.exr"
  - image: "{site}/half/{date}_{sun_elevation}_t{turbidity}.exr"
    type: half
    sun: clip
  - image: "preview/{site}_{date}_{sun_elevation}_t{turbidity}.jpg"
  - sun: "{site}/{date}_{sun_elevation}_t{turbidity}_sun.json"
  - gallery: "pages/index.html"
    image: "preview/{site}_{date}_{sun_elevation}_t{turbidity}.jpg"
"""

# A map and a cube in one library, two grounds, and a camera so high that the sun is seen far below the level.
CAMERAS = """
location: {name: Orbit, latitude: 0, longitude: 0, height: 400 km}
time: {zone: UTC, dates: [2026-03-20], sun_elevations: [-14 deg], half: afternoon}
air: {ground_albedo: [0.1, grass]}
sky: {model: single-scattering}
cameras:
  - {name: whole sky, projection: lat-long, size: 64x32}
  - {name: six faces, projection: cube, size: 16}
outputs:
  - image: "{camera}_{albedo}.png"
  - gallery: index.html
    image: "{camera}_{albedo}.png"
"""


def cards(page):
    return page.eval("[...document.querySelectorAll('.sky')].map(c => Number(c.dataset.number))")


def choose(page, control, value):
    page.eval(f"(() => {{ const c = document.getElementById({json.dumps(control)}); c.value = {json.dumps(value)};"
              " c.dispatchEvent(new Event('input', {bubbles: true})); })()")


def press(page, key, target="document.activeElement"):
    page.eval(f"{target}.dispatchEvent(new KeyboardEvent('keydown', {{key: {json.dumps(key)}, bubbles: true, cancelable: true}}))")


def skies_of(folder):
    """What the manifest says, which the page does not read."""
    manifest = json.loads((folder / "manifest.json").read_text())
    return {f["frame"]: f for f in manifest["frames"]}


def light(frame):
    return frame["light"]["sky_horizontal_lux"] + frame["light"]["sun_horizontal_lux"]


def try_filters(page, skies):
    every = cards(page)
    check(every == sorted(skies), f"cards {every}, frames {sorted(skies)}")
    expect = lambda text, fits: check(cards(page) == [n for n in sorted(skies) if fits(skies[n])], text)
    choose(page, "by-site", "1")
    expect("the site does not filter", lambda f: f["site"] == "Quito")
    choose(page, "by-site", "")
    choose(page, "by-turbidity", "4")
    expect("turbidity does not filter", lambda f: f["turbidity"] == 4)
    choose(page, "by-turbidity", "")
    choose(page, "sun-from", "0")
    choose(page, "sun-to", "20")
    expect("the sun's elevation does not filter", lambda f: 0 <= f["sun"]["true_elevation_deg"] <= 20)
    page.eval("document.getElementById('filters').reset()")
    page.eval("new Promise(done => setTimeout(done, 50))")
    check(cards(page) == every, "reset does not bring all skies back")
    lights = sorted(light(f) for f in skies.values())
    limit = (lights[len(lights) // 2 - 1] + lights[len(lights) // 2]) / 2
    choose(page, "lux-from", str(limit))
    expect("illuminance does not filter", lambda f: light(f) >= limit)
    choose(page, "lux-from", "")
    choose(page, "by-text", "QUITO _t2")
    expect("words do not filter", lambda f: f["site"] == "Quito" and f["turbidity"] == 2)
    choose(page, "by-text", "nowhere")
    check(cards(page) == [] and not page.eval("document.getElementById('none').hidden"), "no word of an empty page")
    page.eval("document.getElementById('none-reset').click()")
    page.eval("new Promise(done => setTimeout(done, 50))")
    choose(page, "sort", "lux")
    lit = [light(skies[n]) for n in cards(page)]
    check(all(a <= b * (1 + 1e-5) for a, b in zip(lit, lit[1:])), f"not sorted by light: {lit}")
    page.eval("document.getElementById('down').click()")
    check(cards(page)[0] != cards(page)[-1] and light(skies[cards(page)[0]]) == max(lit), "the order does not turn round")
    page.eval("document.getElementById('down').click()")
    choose(page, "sort", "number")
    check(cards(page) == every, "the order does not come back")


def try_detail(page, skies, folder):
    number = cards(page)[1]
    page.eval(f"document.querySelector('[data-number=\"{number}\"]').focus()")
    page.eval("document.activeElement.click()")
    check(page.eval("location.hash") == f"#{number}", "the address does not name the sky")
    files = page.eval("[...document.querySelectorAll('.files li')].map(l => [l.querySelector('a').href, l.textContent])")
    frame = skies[number]
    check(len(files) == len(frame["files"]) == 4, f"{len(files)} files shown")
    for (url, text), known in zip(files, frame["files"]):
        check(known["sha256"] in text, "a hash is missing")
        check(url == (folder / known["path"]).resolve().as_uri(), f"{url} is not {known['path']}")
        if "horizontal_lux" in known.get("encoding", {}):
            check("by the model" in text, "irradiance after encoding is missing")
    check(page.eval("document.querySelectorAll('.facts div').length") >= 10, "facts are missing")
    page.eval("new Promise(done => setTimeout(done, 400))")
    before = page.eval("document.querySelector('.view p').textContent")
    check("\u2014 drag" in before, f"no view to look around in: {before}")
    press(page, "ArrowRight", "document.querySelector('.view canvas')")
    page.eval("new Promise(done => setTimeout(done, 200))")
    check(page.eval("document.querySelector('.view p').textContent") != before, "the view does not turn")
    check(page.eval("location.hash") == f"#{number}", "a key of the view went to the page")
    press(page, "ArrowRight", "document.getElementById('close')")
    check(page.eval("location.hash") == f"#{cards(page)[2]}", "no next sky by the arrow key")
    press(page, "Escape")
    check(page.eval("document.getElementById('detail').hidden"), "Escape does not close")
    check(page.eval("document.activeElement.dataset.number") == str(cards(page)[2]), "the focus is lost")


def try_cameras(program, skylapse, temporary, screenshots):
    """A picture that is no map is shown flat; cards tell skies of one moment apart."""
    folder = pathlib.Path(temporary) / "cameras"
    render(skylapse, CAMERAS, folder)
    browser = Browser(program, os.path.join(temporary, "profile-cameras"))
    try:
        page = Page(browser, (folder / "index.html").resolve().as_uri(), 1280, 900)
        texts = page.eval("[...document.querySelectorAll('.sky')].map(c => c.innerText)")
        check(len(set(texts)) == len(texts) == 4, f"cards look alike: {texts}")
        skies = skies_of(folder)
        for number in cards(page):
            page.eval(f"document.querySelector('[data-number=\"{number}\"]').click()")
            page.eval("new Promise(done => setTimeout(done, 300))")
            is_map = skies[number]["camera"] == "whole sky"
            check(page.eval("!!document.querySelector('.view canvas')") == is_map, f"sky {number}: a wrong view")
            check(page.eval("!!document.querySelector('.view img')") != is_map, f"sky {number}: no flat picture")
            # The horizon is 20 degrees down, the view opens no nearer to it than 10.
            check(not is_map or "10\u00b0 down" in page.eval("document.querySelector('.view p').textContent"),
                  "the view does not open on the sun")
            if screenshots and number == 1:
                page.screenshot(os.path.join(screenshots, "gallery_cameras_detail.png"))
            press(page, "Escape")
        if screenshots:
            page.screenshot(os.path.join(screenshots, "gallery_cameras.png"))
        check_events(browser.events)
    finally:
        browser.close()


def render(skylapse, text, folder):
    scene = folder.with_name(folder.name + ".yaml")
    scene.write_text(text)
    subprocess.run([skylapse, "render", str(scene), "-o", str(folder)], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def try_out(page, skies, folder):
    check(page.eval("document.getElementById('title').textContent") == "Two <cities> & more", "the title")
    page.eval("new Promise(done => setTimeout(done, 300))")
    check(page.eval("[...document.images].every(i => i.complete && i.naturalWidth > 0)"), "a picture is broken")
    check(page.eval("document.documentElement.scrollWidth <= innerWidth"), "the page is wider than its window")
    try_filters(page, skies)
    try_detail(page, skies, folder)
    before = page.eval("getComputedStyle(document.body).backgroundColor")
    page.eval("document.getElementById('theme').click()")
    check(page.eval("getComputedStyle(document.body).backgroundColor") != before, "light and dark are the same")
    page.eval("document.getElementById('theme').click()")
    press(page, "/", "document.body")
    check(page.eval("document.activeElement.id") == "by-text", "no search by the slash key")


def many(page_text, count):
    """The same page with `count` skies."""
    start = page_text.index('id="data">') + len('id="data">')
    end = page_text.index("</script>", start)
    data = json.loads(page_text[start:end])
    data["skies"] = [{**data["skies"][i % len(data["skies"])], "number": i + 1} for i in range(count)]
    return page_text[:start] + json.dumps(data).replace("<", "\\u003c") + page_text[end:]


def try_many(program, folder, page_file):
    count = 4008  # of 12, half with turbidity 2
    large = page_file.with_name("large.html")
    large.write_text(many(page_file.read_text(), count))
    browser = Browser(program, os.path.join(folder, "profile-many"))
    try:
        page = Page(browser, large.resolve().as_uri(), 1280, 900)
        first = len(cards(page))
        check(0 < first < 1000, f"{first} cards are made at once")
        check(page.eval("document.getElementById('count').textContent") == f"{count} skies", "skies are missing")
        page.eval("scrollTo(0, document.documentElement.scrollHeight)")
        page.eval("new Promise(done => setTimeout(done, 500))")
        check(len(cards(page)) > first, "no more cards when the page is scrolled")
        choose(page, "by-turbidity", "2")
        check(page.eval("document.getElementById('count').textContent") == f"{count // 2} of {count} skies", "filter of many")
        check_events(browser.events)
    finally:
        browser.close()


def main():
    arguments = start("skylapse", "page")
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary) / "a library #1"
        page_file = pathlib.Path(arguments.page) if arguments.page else folder / "pages" / "index.html"
        if not arguments.page:
            render(arguments.skylapse, LIBRARY, folder)
            check(not re.search(r"https?://(?!www\.w3\.org)", page_file.read_text()), "the page names a host")
        for name, width, height, dark in (("desktop", 1280, 900, False), ("phone", 390, 844, False),
                                          ("dark", 1280, 900, True)):
            browser = Browser(arguments.chromium, os.path.join(temporary, name))
            try:
                page = Page(browser, page_file.resolve().as_uri(), width, height, dark)
                if arguments.screenshots:
                    page.eval("new Promise(done => setTimeout(done, 600))")
                    page.screenshot(os.path.join(arguments.screenshots, f"gallery_{name}.png"))
                    page.eval("document.querySelectorAll('.sky')[3].click()")
                    page.eval("new Promise(done => setTimeout(done, 600))")
                    page.screenshot(os.path.join(arguments.screenshots, f"gallery_{name}_detail.png"))
                    press(page, "Escape")
                if not arguments.page:
                    try_out(page, skies_of(folder), folder)
                check_events(browser.events)
            finally:
                browser.close()
        if not arguments.page:
            try_many(arguments.chromium, temporary, page_file)
            try_cameras(arguments.chromium, arguments.skylapse, temporary, arguments.screenshots)
    print("the gallery works: desktop, phone, dark, thousands of skies")
    return 0


if __name__ == "__main__":
    sys.exit(main())
