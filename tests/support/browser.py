"""Headless Chromium, driven through its DevTools pipe (file descriptors 3 and 4), so that nothing but
Python is needed. There is no network: every host is unknown to the browser."""
import argparse
import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77


def find_chromium():
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def start(program, page):
    """Arguments of a page's test: `program` makes pages, --`page` names one that is there. Ends with
    SKIPPED where there is no Chromium; else adds `chromium`."""
    parser = argparse.ArgumentParser()
    parser.add_argument(program)
    parser.add_argument(f"--{page}")
    parser.add_argument("--screenshots")
    arguments = parser.parse_args()
    arguments.chromium = find_chromium()
    if not arguments.chromium:
        print("skipped: there is no chromium here (Debian package chromium)")
        sys.exit(SKIPPED)
    return arguments


class Browser:
    """Chromium behind a pair of pipes; messages are JSON, each ended by a null byte."""

    def __init__(self, program, profile, flags=()):
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
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={profile}", *flags, "about:blank"],
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


def check_events(events):
    """No complaint on the console, no request but for files."""
    for event in events:
        method, parameters = event.get("method", ""), event.get("params", {})
        if method == "Runtime.exceptionThrown" or (method == "Runtime.consoleAPICalled" and
                                                   parameters["type"] in ("error", "warning")):
            raise AssertionError(f"console: {parameters}")
        if method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            raise AssertionError(f"log: {parameters}")
        if method == "Network.requestWillBeSent":
            url = parameters["request"]["url"]
            check(url.startswith(("file:", "data:", "about:", "blob:")), f"the page asks for {url[:200]}")
