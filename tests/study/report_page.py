#!/usr/bin/env python3
"""Opens a study's report in headless Chromium without a network and tries it out.

    report_page.py TEST_STUDY [--report FILE] [--screenshots FOLDER]

TEST_STUDY writes a report of made-up measurements (or --report names a real one). Exit status 77:
there is no Chromium here.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from browser import Browser, Page, check, check_events, start  # noqa: E402


def first_column(page, index):
    return page.eval(f"[...document.querySelectorAll('#rungs tbody tr')].map(r => r.cells.length > {index} ?"
                     f" r.cells[{index}].textContent : null)")


def try_out(page):
    check(page.eval("document.querySelectorAll('figure svg').length") >= 3, "figures are missing")
    check(page.eval("[...document.querySelectorAll('figure svg')].every(s => s.getBoundingClientRect().height > 100)"),
          "a figure has no height")
    check(page.eval("document.querySelectorAll('figure g[data-rung]').length") > 3, "figures have no marks")
    check(page.eval("[...document.images].every(i => i.complete && i.naturalWidth > 0)"), "a picture is broken")
    check(page.eval("document.querySelectorAll('#cheapest tbody tr').length") >= 1, "there is no short answer")
    check(page.eval("document.documentElement.scrollWidth <= window.innerWidth"), "the page is wider than the screen")

    # Sorting: once up, again down, rows without a value last.
    press = "[...document.querySelectorAll('#rungs thead button')].find(b => b.textContent === '%s').click()"
    page.eval(press % "Rung")
    up = [x for x in first_column(page, 0) if x]
    page.eval(press % "Rung")
    down = [x for x in first_column(page, 0) if x]
    check(len(up) > 3 and sorted(up, key=str.lower) == sorted(down, key=str.lower), "sorting loses rows")
    check(up[0] == down[-1] and up[0] != up[-1], "sorting does not turn round")
    check(page.eval("document.querySelector('#rungs th[aria-sort]').textContent") == "Rung", "no column is marked")

    # Filters.
    rows = "document.querySelectorAll('#rungs tbody tr').length"
    every = page.eval(rows)
    page.eval("(() => { const b = document.getElementById('by-front'); b.checked = true; b.dispatchEvent(new Event('input')); })()")
    check(0 < page.eval(rows) < every, "the front does not filter")
    page.eval("(() => { const b = document.getElementById('by-front'); b.checked = false; b.dispatchEvent(new Event('input')); })()")
    check(page.eval(rows) == every, "rows do not come back")

    # Larger pictures take more time, and details open and close.
    answer = "document.querySelector('#cheapest tbody').textContent"
    before = page.eval(answer)
    page.eval("(() => { const s = document.getElementById('size'); s.value = 60; s.dispatchEvent(new Event('input')); })()")
    check(page.eval(answer) != before, "the size of the picture changes nothing")
    page.eval("document.querySelector('figure g[data-rung]').dispatchEvent(new MouseEvent('click', {bubbles: true}))")
    check(page.eval("!document.getElementById('detail').hidden"), "a mark opens no details")
    check(page.eval("document.querySelectorAll('#detail .facts div').length") > 10, "details are empty")
    page.eval("document.dispatchEvent(new KeyboardEvent('keydown', {key: 'Escape'}))")
    check(page.eval("document.getElementById('detail').hidden"), "Escape does not close details")


def main():
    arguments = start("test_study", "report")
    with tempfile.TemporaryDirectory() as folder:
        report = arguments.report
        if not report:
            subprocess.run([arguments.test_study, "--gtest_filter=StudyReport.WritesItsFiles"], check=True,
                           stdout=subprocess.DEVNULL, env={**os.environ, "SKYLAPSE_STUDY_REPORT": folder})
            report = os.path.join(folder, "report.html")
        url = pathlib.Path(report).resolve().as_uri()
        for name, width, height, dark in (("desktop", 1280, 900, False), ("phone", 390, 844, False),
                                          ("dark", 1280, 900, True)):
            browser = Browser(arguments.chromium, os.path.join(folder, name))
            try:
                page = Page(browser, url, width, height, dark)
                if arguments.screenshots:
                    page.screenshot(os.path.join(arguments.screenshots, name + ".png"), full=True)
                try_out(page)
                check_events(browser.events)
            finally:
                browser.close()
    print("the report works: desktop, phone, dark")
    return 0


if __name__ == "__main__":
    sys.exit(main())
