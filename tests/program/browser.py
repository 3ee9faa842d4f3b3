# diptych: a page in headless Chromium, for tests
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Speaks the DevTools protocol over the browser's own pipe (--remote-debugging-pipe): JSON messages that end in a zero
byte."""

import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

NAMES = ("chromium", "chromium-browser", "google-chrome")


def program():
    """Path of an installed Chromium; None without one."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Page:
    """One page of a browser of its own. messages: what it wrote to the console as warning or error, and uncaught
    exceptions.

    Raises RuntimeError where the browser refuses a command and TimeoutError where it does not answer.
    """

    def __init__(self, width, height, seconds=60):
        self.seconds, self.messages, self._count, self._rest, self._events = seconds, [], 0, b"", []
        self._profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self._write = os.pipe()
        self._read, from_browser = os.pipe()
        try:
            self._process = subprocess.Popen(
                ["/bin/sh", "-c", f'exec "$@" 3<&{to_browser} 4>&{from_browser}', "sh", program(), "--headless",
                 "--remote-debugging-pipe", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--no-first-run", "--user-data-dir=" + self._profile.name, "about:blank"],
                pass_fds=(to_browser, from_browser), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        finally:
            os.close(to_browser), os.close(from_browser)
        self._session = None
        target = next(t for t in self.command("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self._session = self.command("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.command(domain + ".enable")
        self.size(width, height)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._process.kill()
        self._process.wait()
        os.close(self._write), os.close(self._read)
        self._profile.cleanup()

    def size(self, width, height):
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=width < 600)

    def open(self, path):
        self._events.clear()
        self.command("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        end = time.monotonic() + self.seconds
        while not any(e.get("method") == "Page.loadEventFired" for e in self._events):
            self._receive(end)

    def run(self, script):
        """Value of a JavaScript expression."""
        answer = self.command("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def press(self, key):
        """A key as the keyboard sends it, to what has the focus."""
        for kind in ("rawKeyDown", "keyUp"):
            self.command("Input.dispatchKeyEvent", type=kind, key=key, code=key,
                         windowsVirtualKeyCode={"ArrowLeft": 37, "ArrowRight": 39, "Tab": 9}[key])

    def pdf(self):
        return base64.b64decode(self.command("Page.printToPDF", printBackground=True, preferCSSPageSize=True)["data"])

    def command(self, method, **parameters):
        self._count += 1
        message = {"id": self._count, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        end = time.monotonic() + self.seconds
        while True:
            answer = self._receive(end)
            if answer.get("id") == self._count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def _receive(self, end):
        while b"\0" not in self._rest:
            if not select.select([self._read], [], [], max(0.0, end - time.monotonic()))[0]:
                raise TimeoutError(f"Chromium said nothing for {self.seconds} s")
            part = os.read(self._read, 1 << 20)
            if not part:
                raise RuntimeError("Chromium ended")
            self._rest += part
        line, self._rest = self._rest.split(b"\0", 1)
        message = json.loads(line)
        if "method" in message:
            self._events.append(message)
            self._keep(message)
        return message

    def _keep(self, message):
        values = message["params"]
        if message["method"] == "Runtime.exceptionThrown":
            details = values["exceptionDetails"]
            self.messages.append(str(details.get("exception", details).get("description")))
        elif message["method"] == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning", "assert"):
            self.messages.append(str([a.get("value", a.get("description")) for a in values["args"]]))
        elif message["method"] == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning"):
            self.messages.append(values["entry"]["text"])
