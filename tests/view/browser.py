"""Debian's Chromium without a window, driven with real input events."""

import importlib.util
import shutil
import time

SIZE = (1100, 760)


def missing():
    """Why there is no browser, or None."""
    if importlib.util.find_spec("selenium") is None:
        return "python3-selenium is missing"
    lacking = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
    return f"{' and '.join(lacking)} missing" if lacking else None


# WebGPU on the browser's own software device, where there is no GPU too.
WEBGPU = ("--enable-unsafe-webgpu", "--enable-features=Vulkan,WebGPU", "--use-vulkan=swiftshader", "--use-gl=angle",
          "--use-angle=swiftshader", "--use-webgpu-adapter=swiftshader", "--ignore-gpu-blocklist", "--disable-gpu-watchdog")


class Browser:
    """One Chromium with one tab. `page` is selenium's driver."""

    def __init__(self, cache, gpu=("--disable-gpu", "--force-prefers-reduced-motion")):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service

        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        width, height = SIZE
        for argument in (
            *("--headless=new", *gpu, "--disable-dev-shm-usage", "--hide-scrollbars"),
            *("--no-sandbox", "--disable-extensions", "--disable-background-networking", "--disable-component-update"),
            *(f"--window-size={width},{height}", f"--user-data-dir={cache}"),
        ):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.page = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)

    def end(self):
        self.page.quit()

    def script(self, code, *arguments):
        return self.page.execute_script(code, *arguments)

    def element(self, name):
        return self.page.find_element("css selector", f"#{name}")

    def open(self, address):
        """Loads the page anew, also where only what stands behind # differs."""
        self.page.get("about:blank")
        self.page.get(address)

    def until(self, what, condition, seconds=15):
        """The value of `condition()` once it is true."""
        end = time.monotonic() + seconds
        while True:
            value = condition()
            if value:
                return value
            if time.monotonic() > end:
                raise AssertionError(f"not within {seconds} s: {what}; the page says {self.complaints()}")
            time.sleep(0.02)

    def complaints(self):
        """What the page shows as errors, and what it wrote to the console."""
        texts = [self.script("return document.getElementById(arguments[0])?.textContent", name)
                 for name in ("warning", "notice", "look-error", "into-error")]
        return [text for text in texts if text] + [entry["message"] for entry in self.page.get_log("browser")]

    def text(self, name):
        return self.script("return document.getElementById(arguments[0]).textContent", name)

    def frame(self):
        """The query of the whole frame that is drawn, once the camera is still."""

        def settled():
            exact, query = self.script(
                "const canvas = document.getElementById('frame');"
                "return [canvas.dataset.exact, canvas.dataset.query]")
            wanted = self.text("look-command")
            values = [pair.split("=", 1) for pair in query[1:].split("&")] if query else []
            command = all(f"--{name} {value} " in wanted for name, value in values)
            return dict(values) if exact == "true" and command else None

        return self.until("a whole frame", settled)

    def pixels(self, name, *rectangle):
        """R, G, B of all pixels of a canvas, or of x, y, width, height."""
        return bytes(self.script(
            "const canvas = document.getElementById(arguments[0]);"
            "const [x, y, w, h] = arguments[1].length ? arguments[1] : [0, 0, canvas.width, canvas.height];"
            "const all = canvas.getContext('2d').getImageData(x, y, w, h).data;"
            "return Array.from(all).filter((_, at) => at % 4 < 3)", name, rectangle))

    def colours(self, name, places):
        """(R, G, B) of pixels x, y of a canvas, by its name or the element."""
        canvas = self.element(name) if isinstance(name, str) else name
        return [tuple(pixel) for pixel in self.script(
            "const [canvas, places] = arguments;"
            "const { width, data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);"
            "return places.map(([x, y]) => [...data.slice(4 * (width * y + x), 4 * (width * y + x) + 3)])", canvas, places)]

    def actions(self):
        from selenium.webdriver.common.action_chains import ActionChains

        return ActionChains(self.page, duration=10)

    def narrow(self, width, height):
        """As on a screen of this size."""
        self.page.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def wide(self):
        self.page.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def delay(self, milliseconds):
        """Lets every request wait as long."""
        self.page.execute_cdp_cmd("Network.enable", {})
        self.page.execute_cdp_cmd("Network.emulateNetworkConditions", {
            "offline": False, "latency": milliseconds, "downloadThroughput": -1, "uploadThroughput": -1})

    def touch(self, *positions):
        """One finger along positions (x, y) of the window."""
        send = lambda kind, points: self.page.execute_cdp_cmd("Input.dispatchTouchEvent", {
            "type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]})
        send("touchStart", positions[:1])
        for position in positions[1:]:
            send("touchMove", [position])
        send("touchEnd", [])
