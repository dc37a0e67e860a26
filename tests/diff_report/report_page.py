#!/usr/bin/env python3
"""Opens pages of comparisons in headless Chromium without a network and tries every control.

    report_page.py TEST_DIFF [--pages FOLDER] [--screenshots FOLDER]

TEST_DIFF writes pages of made-up pictures (or --pages names a folder where it has). Pixels are read back
from the canvas. Exit status 77: there is no Chromium here.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from browser import Browser, Page, check, check_events, start  # noqa: E402

KEYS = {" ": "Space"}


def settled(page, condition, text):
    """Waits until a condition on the page holds; pictures are unpacked out of step."""
    for _ in range(400):
        if page.eval(condition):
            return
        time.sleep(0.02)
    raise AssertionError(f"{text} (never: {condition})")


def drawn(page):
    page.eval("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def key(page, name, shift=False):
    for kind in ("keyDown", "keyUp"):
        page.ask("Input.dispatchKeyEvent", type=kind, key=name, modifiers=8 if shift else 0,
                 **({"text": name} if len(name) == 1 and kind == "keyDown" else {}))
    drawn(page)


def choose(page, name):
    page.eval(f"choose(data.pairs.findIndex(p => p.n === {name!r}), false)")
    settled(page, "!data.pairs[chosen].pic || data.pairs[chosen].pic.note !== undefined || view.pictures !== null && view.number === chosen",
            f"{name} does not open")
    drawn(page)


def put(page, element, value):
    event = "change" if element == "exposure-number" else "input"
    page.eval(f"(() => {{ const e = byId('{element}'); e.value = {value!r}; e.dispatchEvent(new Event('{event}')); }})()")
    drawn(page)


def pixel(page, x, y, panel=0):
    """Colour of the canvas where a pixel of the picture is drawn, in one of the panels."""
    drawn(page)
    return page.eval(f"(() => {{ const p = panels().list[{panel}], r = devicePixelRatio, [a, b] = toScreen(p, {x} + 0.5, {y} + 0.5);"
                     " return [...pen.getImageData(Math.round(a * r), Math.round(b * r), 1, 1).data].slice(0, 3); })()")


def colours(page, panel=0):
    """How many different greys a panel shows around the sun."""
    drawn(page)
    return page.eval(f"(() => {{ const p = panels().list[{panel}], r = devicePixelRatio, [a, b] = toScreen(p, 177, 37), [c, d] = toScreen(p, 184, 44);"
                     " const q = pen.getImageData(a * r, b * r, (c - a) * r, (d - b) * r).data; const s = new Set();"
                     " for (let i = 0; i < q.length; i += 4) s.add(q[i]); return s.size; })()")


def text(page, element):
    return page.eval(f"byId('{element}').textContent")


def at_the_sun(page):
    page.eval("byId('marks').checked && byId('marks').click(); toWorst([180, 40])")
    page.eval("view.cursor = null; redraw()")
    drawn(page)


def try_exposure(page):
    choose(page, "site/f.0001.exr")
    page.eval("setMode('overview')")
    at_the_sun(page)
    check(pixel(page, 180, 40) == [255, 255, 255], f"the sun is not white at {text(page, 'exposure-text')}: {pixel(page, 180, 40)}")
    check(colours(page) < 12, "the sun's disc shows structure although it is far too bright")
    put(page, "exposure", "-12")
    check(text(page, "exposure-text") == "\u221212 stops", f"exposure: {text(page, 'exposure-text')}")
    # 5006.2 / 4096 is beyond white, its rim (0.55 of that) is not.
    rim = pixel(page, 183, 40)
    check(100 < rim[0] < 255 and colours(page) >= 5, f"no structure in the disc at -12 stops: {rim}, {colours(page)} greys")
    put(page, "exposure-number", "-14")
    # Red 5006.2 at -14 stops: 0.30556 is sRGB 150; green 4755.35: 0.29025, 147.
    got = pixel(page, 180, 40)
    check(abs(got[0] - 150) <= 1 and abs(got[1] - 147) <= 1, f"the disc at -14 stops: {got}")
    key(page, "]")
    check(text(page, "exposure-text") == "\u221213.5 stops", "] does not brighten")
    key(page, "[")
    key(page, "0")
    check(text(page, "exposure-text") != "\u221214 stops" and pixel(page, 180, 40) == [255, 255, 255], "0 does not expose by itself")


def try_modes(page):
    choose(page, "site/f.0001.exr")
    at_the_sun(page)
    put(page, "exposure-number", "-14")
    bright, dark = 100, 60
    for mode, panel_a, panel_b in (("1", 0, 1),):
        key(page, mode)
        check(pixel(page, 178, 40, panel_a)[0] > bright > dark > pixel(page, 178, 40, panel_b)[0], "A and B look alike beside the sun")
        check([p["name"] for p in page.eval("panels().list")] == ["a", "b", "relative", "flip"], "the overview has no maps")
    key(page, "2")
    put(page, "wipe", "100")
    check(pixel(page, 178, 40)[0] > bright, "the wipe at 100 % is not A")
    put(page, "wipe", "0")
    check(pixel(page, 178, 40)[0] < dark, "the wipe at 0 % is not B")
    key(page, "3")
    seen = set()
    for _ in range(60):
        seen.add(pixel(page, 178, 40)[0] > bright)
        time.sleep(0.05)
        if len(seen) == 2:
            break
    check(len(seen) == 2, "nothing blinks")
    key(page, " ")
    first = pixel(page, 178, 40)[0] > bright
    key(page, " ")
    check(first != (pixel(page, 178, 40)[0] > bright), "Space does not change the picture")
    key(page, "4")
    cold, warm = pixel(page, 178, 40), pixel(page, 186, 40)
    check(cold[2] > cold[0] and warm[0] > warm[2], f"relative: darker {cold}, brighter {warm}")
    key(page, "5")
    cold, warm = pixel(page, 178, 40), pixel(page, 186, 40)
    check(cold[2] > cold[0] and warm[0] > warm[2], f"absolute: darker {cold}, brighter {warm}")
    before = pixel(page, 186, 40)
    put(page, "range", page.eval("byId('range').max"))
    check(sum(pixel(page, 186, 40)) < sum(before), "the range changes nothing")
    page.eval("byId('range-auto').click()")
    check(pixel(page, 186, 40) == before, "the range does not come back")
    words = text(page, "range-text")
    key(page, ">")
    check(text(page, "range-text") != words, "> does not widen the range")
    key(page, "6")
    check(sum(pixel(page, 178, 40)) > sum(pixel(page, 178, 120)), "FLIP shows nothing")
    key(page, "1")


def try_reading(page):
    choose(page, "site/f.0001.exr")
    page.eval("byId('stage').focus(); view.cursor = [179, 40]")
    key(page, "ArrowRight", shift=True)
    words = text(page, "readout")
    # The file holds R 5006.2, G 4755.4; the page keeps them to 0.024 %.
    check("(180, 40)" in words and "5006" in words and "4756" in words, f"readout: {words}")
    seen = page.eval("skyAt(view.grid, 180.5, 40.5)")
    sun = page.eval("data.pairs[chosen].sun")
    check(abs(seen["azimuth"] - sun[0]) < 0.02 and abs(seen["elevation"] - sun[1]) < 0.02, f"{seen} is not {sun}")
    check(f"azimuth {sun[0]:.2f}" in words, f"no azimuth in the readout: {words}")
    box = page.eval("(() => { const b = canvas.getBoundingClientRect(), p = panels().list[0], [x, y] = toScreen(p, view.x, view.y); return [b.left + x, b.top + y]; })()")
    page.ask("Input.dispatchMouseEvent", type="mouseMoved", x=box[0], y=box[1])
    drawn(page)
    at = page.eval("[Math.floor(view.x), Math.floor(view.y)]")
    check(all(abs(page.eval("view.cursor")[i] - at[i]) <= 1 for i in (0, 1)), "the pointer reads another pixel")
    check("%" in text(page, "readout") or "equal" in text(page, "readout"), "no change in the readout")


def try_zoom(page):
    choose(page, "site/f.0001.exr")
    key(page, "f")
    fit = page.eval("zoomNow()")
    key(page, "w")
    check(page.eval("zoomNow()") > fit and page.eval("view.x") == 180.5 and page.eval("view.y") == 40.5, "W does not go to the worst place")
    key(page, "o")
    check(abs(page.eval("zoomNow() * devicePixelRatio") - 1) < 1e-9, "O is not one to one")
    key(page, "+")
    check(abs(page.eval("zoomNow() * devicePixelRatio") - 1.5) < 1e-9, "+ does not zoom")
    x = page.eval("view.x")
    page.eval("byId('stage').focus()")
    key(page, "ArrowRight")
    check(page.eval("view.x") > x, "arrows do not move the picture")
    box = page.eval("(() => { const b = canvas.getBoundingClientRect(); return [b.left + 60, b.top + 60]; })()")
    page.eval("byId('stage').scrollIntoView({block: 'center'})")
    box = page.eval("(() => { const b = canvas.getBoundingClientRect(); return [b.left + 60, b.top + 60]; })()")
    x = page.eval("view.x")
    for kind, dx in (("mousePressed", 0), ("mouseMoved", 30), ("mouseReleased", 30)):
        page.ask("Input.dispatchMouseEvent", type=kind, x=box[0] + dx, y=box[1], button="left", buttons=1, clickCount=1)
    check(page.eval("view.x") < x, "dragging does not move the picture")
    zoom = page.eval("zoomNow()")
    page.eval("byId('stage').focus({preventScroll: true})")
    page.ask("Input.dispatchMouseEvent", type="mouseWheel", x=box[0], y=box[1], deltaX=0, deltaY=-200)
    settled(page, f"zoomNow() > {zoom}", "the wheel does not zoom")
    key(page, "f")
    check(page.eval("zoomNow()") == fit, "F does not fit")


def try_odd_samples(page):
    name = "site/<b>\"f&.0002'.exr"
    choose(page, name)
    key(page, "1")
    page.eval("byId('marks').checked || byId('marks').click(); zoomTo(8, 200.5, 100.5)")
    words = text(page, "odd")
    check("1 NaN, 1 infinite, 3 negative" in words, f"odd samples: {words}")
    check(pixel(page, 200, 100, 1) == [255, 0, 255], f"NaN is {pixel(page, 200, 100, 1)}")
    check(pixel(page, 200, 100, 0) != [255, 0, 255], "NaN shows in A")
    page.eval("zoomTo(8, 20.5, 20.5)")
    check(pixel(page, 20, 20, 1) == [0, 255, 255], f"Inf is {pixel(page, 20, 20, 1)}")
    page.eval("zoomTo(8, 60.5, 60.5)")
    check(pixel(page, 60, 60, 1) == [255, 225, 0], f"a negative pixel is {pixel(page, 60, 60, 1)}")
    page.eval("byId('marks').click()")
    check(pixel(page, 60, 60, 1) == [0, 0, 0], "marks do not go")
    page.eval("byId('marks').click(); view.cursor = [200, 100]; showReadout()")
    check("NaN" in text(page, "readout"), "the readout hides NaN")
    check(page.eval("document.querySelector('h2').textContent").endswith(name), "the name is not text")
    put(page, "channel", "0")
    check(pixel(page, 200, 100, 1) != [255, 0, 255], "red shows green's NaN")
    put(page, "channel", "1")
    page.eval("zoomTo(8, 200.5, 100.5)")
    check(pixel(page, 200, 100, 1) == [255, 0, 255], "green hides its NaN")
    put(page, "channel", "-1")
    check(page.eval("document.querySelectorAll('#findings li').length") == 3, "findings are missing")
    page.eval("document.querySelector('#findings .place').click()")
    check(page.eval("view.x") == 200.5, "a finding does not lead to its place")


def try_others(page):
    choose(page, "site/f.0003.exr")
    check("Sizes differ" in text(page, "picture-note"), "no word about sizes")
    check(page.eval("[...byId('modes').children].filter(b => b.disabled).length") == 5, "differences of sizes that differ are offered")
    choose(page, "shown.png")
    check("code values" in text(page, "measures"), "display pictures have no code values")
    check(text(page, "exposure-text") == "0 stops", "display pictures are exposed")
    # Blue of A at (200, 20) in code values, shown unchanged.
    page.eval("byId('marks').checked && byId('marks').click(); zoomTo(8, 200.5, 20.5)")
    held = page.eval("Math.round(255 * view.pictures.a.planes[2][20 * 256 + 200])")
    check(abs(pixel(page, 200, 20)[2] - held) <= 1, f"code value {held} is shown as {pixel(page, 200, 20)[2]}")
    page.eval("byId('marks').click()")
    for name, words in (("site/f.0005.exr", "cannot be read"), ("gone.exr", "the file has gone")):
        choose(page, name)
        check(page.eval("byId('viewer').hidden") and words in text(page, "no-pictures"), f"{name}: {text(page, 'no-pictures')}")


def try_list(page):
    rows = "document.querySelectorAll('#rows tbody tr').length"
    names = "[...document.querySelectorAll('#rows tbody .name button')].map(b => b.textContent)"
    check("4 of 8 pictures differ" in text(page, "verdict") and "1 picture cannot be read" in text(page, "verdict"), text(page, "verdict"))
    check("f.0009.exr is missing" in text(page, "whole"), "findings of the whole are missing")
    check(page.eval(rows) == 8 and page.eval(names)[0] == "site/f.0005.exr", "rows are missing, or not the worst first")
    put(page, "by-name", "F.000")
    check(page.eval(rows) == 5, "names do not filter")
    put(page, "by-name", "")
    put(page, "by-check", "nan")
    check(page.eval(rows) == 1, "checks do not filter")
    put(page, "by-check", "")
    put(page, "by-region", "sun's disc")
    check(page.eval(names) == ["site/f.0001.exr"], f"regions do not filter: {page.eval(names)}")
    put(page, "by-region", "")
    chip = "[...document.querySelectorAll('.chip')].find(c => c.textContent.includes('%s')).click()"
    page.eval(chip % "warning")
    check(page.eval(names) == ["site/f.0004.exr"], "verdicts do not filter")
    page.eval(chip % "same")
    check(page.eval(rows) == 3, "two verdicts are not shown together")
    page.eval(chip % "warning")
    page.eval(chip % "same")
    press = "[...document.querySelectorAll('#rows thead button')].find(b => b.textContent === '%s').click()"
    for column in ("Picture", "Check", "Region", "\u00d7 limit", "Verdict"):
        page.eval(press % column)
        up = page.eval(names)
        page.eval(press % column)
        down = page.eval(names)
        check(sorted(up) == sorted(down) and len(up) == 8 and up == down[::-1], f"{column} does not sort")
    page.eval(press % "Picture")
    page.eval(press % "Verdict")
    settled(page, "[...document.querySelectorAll('.thumb')].some(c => [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data].some((v, i) => i % 4 < 3 && v > 60))",
            "no small map is drawn")
    page.eval("document.activeElement.blur(); choose(Number(document.querySelector('#rows tbody tr').dataset.pair), false)")
    first = page.eval("chosen")
    key(page, "j")
    check(page.eval("chosen") != first, "J does not go on")
    key(page, "k")
    check(page.eval("chosen") == first, "K does not go back")
    key(page, "?")
    check(page.eval("!byId('help').hidden"), "no help")
    key(page, "?")
    page.eval("byId('by-name').focus()")
    key(page, "j")
    check(page.eval("chosen") == first and page.eval("byId('by-name').value") == "j", "letters in a field are taken for keys")
    put(page, "by-name", "")
    page.eval("document.activeElement.blur()")


def try_names(page):
    """Every control has a name, and the focus goes through the page in the order that is seen."""
    nameless = page.eval("""[...document.querySelectorAll('button, input, select, [tabindex="0"]')].filter(e => e.offsetParent !== null)
        .filter(e => !(e.textContent.trim() || e.getAttribute('aria-label') || e.labels && e.labels.length)).map(e => e.outerHTML)""")
    check(not nameless, f"controls without a name: {nameless}")
    check(page.eval("[...document.querySelectorAll('[tabindex]')].every(e => e.tabIndex <= 0)"), "the order of the focus is forced")
    check(page.eval("document.documentElement.scrollWidth <= window.innerWidth"), "the page is wider than the screen")
    check(page.eval("[...document.querySelectorAll('#rows .badge')].every(b => b.textContent.length > 2)"), "a verdict is a colour alone")


def try_page(page, screenshots, name):
    settled(page, "chosen >= 0", "nothing is chosen")
    choose(page, "site/f.0001.exr")
    if screenshots:
        page.screenshot(os.path.join(screenshots, name + ".png"))
        page.screenshot(os.path.join(screenshots, name + "_full.png"), full=True)
    for attempt in (try_list, try_exposure, try_modes, try_reading, try_zoom, try_odd_samples, try_others):
        attempt(page)
        try_names(page)
    before = page.eval("getComputedStyle(document.body).backgroundColor")
    page.eval("byId('theme').click()")
    check(before != page.eval("getComputedStyle(document.body).backgroundColor"), "the theme does not change")


def try_empty(page, screenshots, name):
    check("No pictures were compared" in text(page, "verdict"), text(page, "verdict"))
    check(page.eval("byId('detail').hidden"), "details of nothing")


def try_many(page, screenshots, name):
    check(page.eval("document.querySelectorAll('#rows tbody tr').length") == 200, "not 200 rows")
    page.eval("byId('more').click()")
    check(page.eval("document.querySelectorAll('#rows tbody tr').length") == 400, "no more rows")
    put(page, "by-name", "14999")
    check(page.eval("document.querySelectorAll('#rows tbody tr').length") == 1, "5000 pairs do not filter")
    put(page, "by-name", "")
    choose(page, "site_of_a_sequence/frame.10001.exr")
    check("skylapse diff 'golden/site_of_a_sequence" in text(page, "no-pictures"), "no word about pictures")
    if screenshots:
        page.screenshot(os.path.join(screenshots, name + ".png"))


def main():
    arguments = start("test_diff", "pages")
    with tempfile.TemporaryDirectory() as folder:
        pages = arguments.pages
        if not pages:
            pages = folder
            subprocess.run([arguments.test_diff, "--gtest_filter=DiffPage.WritesItsFiles:DiffPage.OfFive*"], check=True,
                           stdout=subprocess.DEVNULL, env={**os.environ, "SKYLAPSE_DIFF_PAGE": folder})
        for name, file, width, height, dark, attempt in (
                ("desktop", "index.html", 1440, 1000, False, try_page), ("dark", "index.html", 1280, 900, True, try_page),
                ("phone", "index.html", 390, 844, False, try_page), ("empty", "empty.html", 1280, 900, False, try_empty),
                ("many", "many.html", 1440, 1000, False, try_many)):
            browser = Browser(arguments.chromium, os.path.join(folder, "profile_" + name))
            try:
                page = Page(browser, (pathlib.Path(pages).resolve() / file).as_uri(), width, height, dark)
                attempt(page, arguments.screenshots, name)
                check_events(browser.events)
            except AssertionError as problem:
                if arguments.screenshots:
                    page.screenshot(os.path.join(arguments.screenshots, "failed.png"))
                raise AssertionError(f"{name}: {problem}") from problem
            finally:
                browser.close()
    print("the page works: desktop, dark, phone, without pairs, with 5000")
    return 0


if __name__ == "__main__":
    sys.exit(main())
