"""A headless Chromium with one page, spoken to over a pipe: no port is opened, and nothing is resolved."""
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-extensions", "--enable-unsafe-swiftshader",
         "--host-resolver-rules=MAP * ~NOTFOUND", "--remote-debugging-pipe"]
PATIENCE = 60  # s
KEY_CODES = {"Enter": 13, "Escape": 27, " ": 32, "PageUp": 33, "PageDown": 34, "ArrowLeft": 37, "ArrowRight": 39, "Tab": 9}


def chromium():
    return shutil.which("chromium")


class Browser:
    """send() asks, wait() lets events come; what the page logged and fetched is kept."""

    def __init__(self, width=1300, height=1000, *flags):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        (self.from_us, to_us), (from_it, self.from_it) = os.pipe(), os.pipe()
        # Chromium reads from descriptor 3 and writes to 4.
        command = f'exec 3<&{self.from_us} 4>&{self.from_it}; exec "$@"'
        self.process = subprocess.Popen(
            ["bash", "-c", command, "bash", chromium(), *FLAGS, *flags, f"--user-data-dir={self.profile.name}", f"--window-size={width},{height}"],
            pass_fds=[self.from_us, self.from_it], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(self.from_us)
        os.close(self.from_it)
        self.to_it, self.answers = to_us, from_it
        self.buffer, self.number, self.session = b"", 0, None
        self.errors, self.requests, self.events = [], [], []
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.send(f"{domain}.enable")
        self.send("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)
        self.resize(width, height)

    def close(self):
        try:
            self.session = None
            self.send("Browser.close")
        except (EOFError, OSError):
            pass
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.to_it)
        os.close(self.answers)
        self.profile.cleanup()

    def send(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to_it, json.dumps(message).encode() + b"\0")
        return self.take(self.number)

    def take(self, number):
        deadline = time.monotonic() + PATIENCE
        while True:
            message = self.read(deadline - time.monotonic())
            if message.get("id") == number:
                if "error" in message:
                    raise RuntimeError(message["error"]["message"])
                return message["result"]
            self.note(message)

    def read(self, seconds):
        while b"\0" not in self.buffer:
            if not select.select([self.answers], [], [], max(0, seconds))[0]:
                raise TimeoutError("Chromium does not answer")
            more = os.read(self.answers, 1 << 20)
            if not more:
                raise EOFError("Chromium has ended")
            self.buffer += more
        text, _, self.buffer = self.buffer.partition(b"\0")
        return json.loads(text)

    def note(self, message):
        method, about = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.errors.append(about["exceptionDetails"].get("exception", {}).get("description") or about["exceptionDetails"]["text"])
        if method == "Runtime.consoleAPICalled" and about["type"] in ("error", "assert"):
            self.errors.append(str([one.get("value") for one in about["args"]]))
        if method == "Log.entryAdded" and about["entry"]["level"] == "error":
            self.errors.append(about["entry"]["text"])
        if method == "Network.requestWillBeSent":
            self.requests.append(about["request"]["url"])

    def open(self, path, fragment=""):
        """Until the page's script is ready; returns the ms that the page took, by its own clock."""
        self.send("Page.navigate", url=pathlib.Path(path).resolve().as_uri() + fragment)
        return int(self.until("document.documentElement?.dataset.ready"))

    def run(self, expression):
        done = self.send("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True, userGesture=True)
        if "exceptionDetails" in done:
            raise RuntimeError(done["exceptionDetails"].get("exception", {}).get("description", expression))
        return done["result"].get("value")

    def until(self, expression):
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            value = self.run(expression)
            if value:
                return value
            time.sleep(0.05)
        raise TimeoutError(f"never true: {expression}")

    def resize(self, width, height):
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def prefer(self, **features):
        """prefers_color_scheme="dark" and the like."""
        self.send("Emulation.setEmulatedMedia", features=[{"name": name.replace("_", "-"), "value": value} for name, value in features.items()])

    def press(self, key, code=None, text=None):
        parameters = {"key": key, "code": code or key, "windowsVirtualKeyCode": KEY_CODES.get(key, 0)}
        if text:
            parameters["text"] = text
        self.send("Input.dispatchKeyEvent", type="keyDown", **parameters)
        self.send("Input.dispatchKeyEvent", type="keyUp", key=key, code=code or key)

    def mouse(self, kind, x, y, buttons=0):
        self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left" if kind != "mouseMoved" else "none", buttons=buttons, clickCount=1)

    def drag(self, start, end):
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start, 1)
        for k in range(1, 6):
            self.mouse("mouseMoved", start[0] + (end[0] - start[0]) * k / 5, start[1] + (end[1] - start[1]) * k / 5, 1)
        self.mouse("mouseReleased", *end)

    def box(self, selector):
        """x, y, width and height of an element, scrolled into view."""
        return self.run(f"(() => {{ const one = document.querySelector({json.dumps(selector)}); one.scrollIntoView({{block: 'center', behavior: 'instant'}}); "
                        "const box = one.getBoundingClientRect(); return [box.x, box.y, box.width, box.height]; })()")

    def picture(self, path, whole=False):
        data = self.send("Page.captureScreenshot", format="png", captureBeyondViewport=whole)["data"]
        pathlib.Path(path).write_bytes(base64.b64decode(data))

    def pdf(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.send("Page.printToPDF", printBackground=True)["data"]))
