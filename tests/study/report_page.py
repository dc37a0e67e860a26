#!/usr/bin/env python3
"""Opens a study's report in headless Chromium without a network and tries it out.

    report_page.py TEST_STUDY [--report FILE] [--screenshots FOLDER]

TEST_STUDY writes a report of made-up measurements (or --report names a real one). Exit status 77:
there is no Chromium here. The browser is driven through its DevTools pipe (file descriptors 3 and 4),
so nothing but Python is needed.
"""
import argparse
import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


class Browser:
    """Chromium behind a pair of pipes; messages are JSON, each ended by a null byte."""

    def __init__(self, program, profile):
        to_child, self.out = os.pipe()
        self.inp, from_child = os.pipe()

        def wire():
            # Through high numbers: 3 and 4 may be in use as one of the four ends.
            a, b = os.dup2(to_child, 100), os.dup2(from_child, 101)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
             "--disable-dev-shm-usage", "--disable-background-networking", "--no-first-run",
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={profile}", "about:blank"],
            preexec_fn=wire, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_child)
        os.close(from_child)
        self.buffer, self.count, self.events = b"", 0, []

    def read(self):
        while b"\0" not in self.buffer:
            more = os.read(self.inp, 1 << 20)
            if not more:
                raise RuntimeError("Chromium went away")
            self.buffer += more
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def ask(self, method, session=None, **parameters):
        self.count += 1
        request = {"id": self.count, "method": method, "params": parameters}
        if session:
            request["sessionId"] = session
        os.write(self.out, json.dumps(request).encode() + b"\0")
        while True:
            answer = self.read()
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def close(self):
        self.process.kill()
        self.process.wait()


class Page:
    def __init__(self, browser, url, width, height, dark=False):
        self.browser = browser
        target = browser.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.ask(f"{domain}.enable")
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                 mobile=width < 600)
        if dark:
            self.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.ask("Page.navigate", url=url)
        while not any(e.get("method") == "Page.loadEventFired" for e in browser.events):
            browser.events.append(browser.read())

    def ask(self, method, **parameters):
        return self.browser.ask(method, session=self.session, **parameters)

    def eval(self, code):
        result = self.ask("Runtime.evaluate", expression=code, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise AssertionError(f"{code}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def screenshot(self, path, full=False):
        picture = self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=full)
        pathlib.Path(path).write_bytes(base64.b64decode(picture["data"]))


def check(condition, text):
    if not condition:
        raise AssertionError(text)


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


def check_events(events):
    for event in events:
        method, parameters = event.get("method", ""), event.get("params", {})
        if method == "Runtime.exceptionThrown" or (method == "Runtime.consoleAPICalled" and
                                                   parameters["type"] in ("error", "warning")):
            raise AssertionError(f"console: {parameters}")
        if method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            raise AssertionError(f"log: {parameters}")
        if method == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            check(url.startswith(("file:", "data:", "about:")), f"the report asks for {url[:200]}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("test_study")
    parser.add_argument("--report")
    parser.add_argument("--screenshots")
    arguments = parser.parse_args()
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not program:
        print("skipped: there is no chromium here (Debian package chromium)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        report = arguments.report
        if not report:
            subprocess.run([arguments.test_study, "--gtest_filter=StudyReport.WritesItsFiles"], check=True,
                           stdout=subprocess.DEVNULL, env={**os.environ, "SKYLAPSE_STUDY_REPORT": folder})
            report = os.path.join(folder, "report.html")
        url = pathlib.Path(report).resolve().as_uri()
        for name, width, height, dark in (("desktop", 1280, 900, False), ("phone", 390, 844, False),
                                          ("dark", 1280, 900, True)):
            browser = Browser(program, os.path.join(folder, name))
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
