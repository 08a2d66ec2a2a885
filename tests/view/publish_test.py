#!/usr/bin/env python3
"""hmlfc publish: its page in Chromium, with and without WebGPU, on hosts with and without ranges.

usage: publish_test.py HMLFC
"""

import http.server
import json
import re
import threading
import time
from pathlib import Path

from browser import WEBGPU, Browser
from page_case import run_in_browser
from pictures import read_png
from program import CliTest

TITLE, TEXT = 'Cards & "cups" <b>', "25 photographs of a table"


class Handler(http.server.SimpleHTTPRequestHandler):
    """A host of static files; it answers requests for ranges where `ranges` is set."""

    root, ranges, sent = None, True, 0

    def translate_path(self, path):
        return str(Handler.root / path.split("?")[0].lstrip("/"))

    def do_GET(self):
        wanted = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if not wanted or not Handler.ranges:
            return super().do_GET()
        data = Path(self.translate_path(self.path)).read_bytes()
        part = data[int(wanted[1]):int(wanted[2]) + 1]
        Handler.sent += len(part)
        self.send_response(206)
        self.send_header("Content-Type", "application/octet-stream")
        self.send_header("Content-Range", f"bytes {wanted[1]}-{int(wanted[1]) + len(part) - 1}/{len(data)}")
        self.send_header("Content-Length", str(len(part)))
        self.end_headers()
        self.wfile.write(part)

    def log_message(self, *_):
        pass


class PublishTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 5x5 --size 96x64 --baseline 3 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc".split())
        cls.hmlfc("publish", "a.hmlfc", "-o", "site", "--title", TITLE, "--text", TEXT, "--address", "https://example.org/x")
        Handler.root = cls.folder / "site"
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        cls.addClassCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        cls.address = f"http://127.0.0.1:{server.server_port}/"
        cls.browser = Browser(cls.folder / "profile", WEBGPU)
        cls.addClassCleanup(cls.browser.end)
        cls.browser.page.set_script_timeout(300)

    def until_drawn(self):
        """Waits for the first frame, or for the sentence instead of it; the kernels take long on a software device."""
        end = time.monotonic() + 400
        while time.monotonic() < end:
            drawn, notice = self.browser.script(
                "return [document.body.classList.contains('live'), document.getElementById('notice').textContent]")
            if drawn or notice:
                return notice
            time.sleep(0.2)
        self.fail(f"no frame: {self.browser.page.get_log('browser')}")

    def frame(self):
        """The camera of the frame that stays, and its samples."""
        camera, texels = self.browser.page.execute_async_script("""
            const done = arguments[0];
            (async () => {
              const player = await (await import('/app/player.js')).player;
              while (player.drawing || player.wanted) await new Promise(next => setTimeout(next, 20));
              done([player.canvas.dataset.drawn, Array.from(await player.field.renderer.pixels())]);
            })().catch(error => done([String(error), []]));""")
        return json.loads(camera), bytes(value for at, value in enumerate(texels) if at % 4 != 3)

    def equals_render(self):
        camera, samples = self.frame()
        words = "--camera {u},{v},{z} --look-at {atU},{atV},{atZ} --size {width}x{height}".format(**camera).split()
        geometry = "stream" if camera["geometry"] and not camera["aperture"] else "plane"
        self.hmlfc("render", "a.hmlfc", *words, "--focus", str(camera["focus"]), "--aperture", str(camera["aperture"]),
                   "--geometry", geometry, "-o", "frame.png")
        self.assertEqual(samples, bytes(read_png(self.folder / "frame.png").samples))
        return camera

    def press(self, *keys):
        self.browser.element("frame").send_keys(*keys)

    def test_live(self):
        for ranges in (True, False):
            with self.subTest(ranges=ranges):
                Handler.ranges = ranges
                self.browser.open(self.address)
                self.assertEqual(self.until_drawn(), "")
                self.browser.until("an idle camera", lambda: self.frame_place() != "2,2")
                self.press(" ")
                before = self.equals_render()
                self.press("\ue014", "\ue015", "+")
                after = self.equals_render()
                self.assertEqual((after["v"], after["z"]), (min(4, before["v"] + 0.25), before["z"] + 0.25))
                self.browser.actions().click(self.browser.element("frame")).perform()
                self.browser.until("a mark", lambda: self.browser.element("mark").is_displayed())
                self.browser.until("blur", lambda: self.frame()[0]["aperture"] == 1)
                self.equals_render()
                self.press("?")
                self.assertTrue(self.browser.element("help").is_displayed())
        said = [one["message"] for one in self.browser.page.get_log("browser")]
        self.assertEqual([text for text in said if "powerPreference" not in text], [])

    def frame_place(self):
        camera = json.loads(self.browser.script("return document.getElementById('frame').dataset.drawn"))
        return f"{camera['u']},{camera['v']}"

    def test_nothing_else_is_loaded(self):
        Handler.ranges = True
        self.browser.open(self.address)
        self.assertEqual(self.until_drawn(), "")
        loaded = self.browser.script("return performance.getEntriesByType('resource').map(one => one.name)")
        self.assertEqual([name for name in loaded if not name.startswith((self.address, "data:"))], [])

    def test_damage(self):
        stream = Handler.root / "light-field.hmlfc"
        intact = stream.read_bytes()
        for damaged, wanted in ((intact[:2000], "error 1 "), (b"\x89PNG" + intact[4:], "no .hmlfc stream")):
            with self.subTest(wanted):
                stream.write_bytes(damaged)
                try:
                    self.browser.open(self.address)
                    self.assertIn(wanted, self.until_drawn())
                finally:
                    stream.write_bytes(intact)

    def test_page(self):
        page = (Handler.root / "index.html").read_text()
        for part in ("<title>Cards &amp; &quot;cups&quot; &lt;b&gt;</title>", f'content="{TEXT}"',
                     'content="https://example.org/x/still.png"', "default-src 'none'"):
            self.assertIn(part, page)
        self.assertNotIn("{{", page)
        self.assertEqual((Handler.root / "light-field.hmlfc").read_bytes(), (self.folder / "a.hmlfc").read_bytes())
        self.assertIn(b"acTL", (Handler.root / "loop.png").read_bytes()[:200])
        self.hmlfc("publish", "a.hmlfc", "-o", "site", "--title", TITLE, "--text", TEXT, "--address", "https://example.org/x")

    def test_without_webgpu(self):
        browser = Browser(self.folder / "plain")
        try:
            browser.open(self.address)
            text = browser.until("a sentence", lambda: browser.text("notice"))
            self.assertIn("no WebGPU", text)
            self.assertTrue(browser.script("return document.getElementById('still').src").endswith("loop.png"))
        finally:
            browser.end()


if __name__ == "__main__":
    run_in_browser()
