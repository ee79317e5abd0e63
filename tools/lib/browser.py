# SPDX-License-Identifier: Apache-2.0
"""usage: browser.py ADDRESS PICTURE SECONDS: the page at ADDRESS after so many seconds as a PNG, or as a JPEG where
PICTURE ends in .jpg.

A headless Chromium, driven over its debugging pipe (DevTools protocol, without further packages)."""

import base64
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time


def chromium():
    return shutil.which("chromium") or shutil.which("chromium-browser")


class Browser:
    """One page of 1280x720 with software rendering."""

    def __init__(self, address, width=1280, height=720, theme="dark"):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.write_end = os.pipe()
        self.read_end, from_browser = os.pipe()

        def place_pipes():  # Chromium reads from 3 and writes to 4
            first = os.dup(to_browser)
            second = os.dup(from_browser)
            os.dup2(first, 3)
            os.dup2(second, 4)

        self.process = subprocess.Popen(
            [chromium(), "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--no-first-run", "--disable-background-networking", f"--user-data-dir={self.profile.name}",
             f"--window-size={width},{height}", "--remote-debugging-pipe", "about:blank"],
            preexec_fn=place_pipes, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer = b""
        self.number = 0
        self.session = None
        self.log = []
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": theme}])
        self.call("Runtime.enable")
        self.call("Page.enable")
        self.call("Page.navigate", url=address)

    def read_message(self, seconds):
        end = time.monotonic() + seconds
        while b"\0" not in self.buffer:
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.read_end], [], [], left)[0]:
                raise TimeoutError("Chromium does not answer")
            piece = os.read(self.read_end, 1 << 16)
            if not piece:
                raise RuntimeError("Chromium ended")
            self.buffer += piece
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.write_end, json.dumps(request).encode() + b"\0")
        while True:
            message = self.read_message(60)
            if message.get("method") in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled"):
                self.log.append(message["params"])
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def wait_for(self, expression, seconds=60):
        """Until the expression is true; its last value, false where it never was."""
        end = time.monotonic() + seconds
        while True:
            try:
                value = self.evaluate(expression)
            except RuntimeError:  # the page is not complete yet
                value = False
            if value or time.monotonic() > end:
                return value
            time.sleep(0.1)

    def exceptions(self):
        self.evaluate("0")
        return [p["exceptionDetails"].get("exception", {}).get("description", str(p)) for p in self.log if "exceptionDetails" in p]

    def screenshot(self, path=None):
        form = {"format": "jpeg", "quality": 85} if str(path).endswith(".jpg") else {"format": "png"}
        picture = base64.b64decode(self.call("Page.captureScreenshot", **form)["data"])
        if path:
            with open(path, "wb") as file:
                file.write(picture)
        return picture

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.write_end)
        os.close(self.read_end)
        self.profile.cleanup()


if __name__ == "__main__":
    if len(sys.argv) != 4 or chromium() is None:
        sys.exit(__doc__ if len(sys.argv) != 4 else "Chromium is not installed")
    page = Browser(sys.argv[1])
    time.sleep(float(sys.argv[3]))
    page.screenshot(sys.argv[2])
    page.close()
