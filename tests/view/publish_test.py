#!/usr/bin/env python3
"""hmlfc publish: its page in Chromium, with and without WebGPU, on hosts with and without ranges; and in Firefox.

usage: publish_test.py HMLFC
"""

import http.server
import itertools
import json
import random
import re
import shutil
import subprocess
import threading
from pathlib import Path

from browser import WEBGPU, Browser
from page_case import run_in_browser
from pictures import read_png
from program import PROGRAM, USAGE, CliTest

PATIENCE = 400  # seconds: frames and kernels take long on a software device of a busy machine
TITLE, TEXT = 'Cards & "cups" <b>', "25 photographs of a table"


class Handler(http.server.SimpleHTTPRequestHandler):
    """A host of static files; with `ranges`, it answers requests for those, and may claim other sizes. It may be busy at first."""

    root, ranges, versions, claimed, busy, asked = None, True, None, None, 0, []

    def translate_path(self, path):
        return str(Handler.root / path.split("?")[0].lstrip("/"))

    def do_GET(self):
        if Handler.busy and self.path.endswith(".hmlfc"):
            Handler.busy -= 1
            return self.send_error(503)
        wanted = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if not wanted or not Handler.ranges:
            return super().do_GET()
        data = Path(self.translate_path(self.path)).read_bytes()
        part = data[int(wanted[1]):int(wanted[2]) + 1]
        self.send_response(206)
        if Handler.versions:
            self.send_header("ETag", f'"{next(Handler.versions)}"')
        self.send_header("Content-Type", "application/octet-stream")
        self.send_header("Content-Range", f"bytes {wanted[1]}-{int(wanted[1]) + len(part) - 1}/{Handler.claimed or len(data)}")
        self.send_header("Content-Length", str(len(part)))
        self.end_headers()
        self.wfile.write(part)

    def log_message(self, *_):
        Handler.asked.append(self.path)


def serve_site(root):
    """The address of a host of this folder."""
    Handler.root = root
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/"


class PublishTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 5x5 --size 96x64 --baseline 3 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc".split())
        cls.hmlfc("publish", "a.hmlfc", "-o", "site", "--title", TITLE, "--text", TEXT, "--address", "https://example.org/x")
        cls.address = serve_site(cls.folder / "site")
        cls.browser = Browser(cls.folder / "profile", WEBGPU)
        cls.addClassCleanup(cls.browser.end)
        cls.browser.page.set_script_timeout(PATIENCE)

    def until_drawn(self):
        """Waits for the first frame, or for the sentence instead of it, which it gives."""
        self.until("a frame or a sentence", lambda: self.browser.script(
            "const { classList } = document.body; return classList.contains('live') || classList.contains('recorded')"))
        return self.browser.text("notice")

    def until(self, what, condition):
        return self.browser.until(what, condition, PATIENCE)

    def frame(self):
        """The camera of the frame that stays, and its samples."""
        camera, texels = self.browser.page.execute_async_script("""
            const done = arguments[0];
            (async () => {
              const player = await (await import('/app/player.js')).player;
              while (player.drawing || player.wanted || player.glide) await new Promise(next => setTimeout(next, 20));
              done([player.canvas.dataset.drawn, Array.from(await player.frames.field.renderer.pixels())]);
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
        """One visit, since kernels take long to compile."""
        self.browser.open(self.address)
        self.assertEqual(self.until_drawn(), "")
        self.until("an idle camera", lambda: '"u":2,"v":2,' not in self.browser.script(
            "return document.getElementById('frame').dataset.drawn"))
        self.press(" ")
        before = self.equals_render()
        self.assertEqual(before["aperture"], 1)
        self.press("\ue014", "\ue015", "+")
        after = self.equals_render()
        self.assertEqual((after["v"], after["z"]), (min(4, before["v"] + 0.25), before["z"] + 0.25))
        self.press("]")  # to a focus that no block has
        after = self.frame()[0]
        self.browser.actions().click(self.browser.element("frame")).perform()
        self.until("a mark", lambda: self.browser.element("mark").is_displayed())
        self.until("another focus", lambda: self.frame()[0]["focus"] != after["focus"])
        self.equals_render()
        self.press("a", "a", "a")
        self.assertEqual(self.equals_render()["aperture"], 0)
        self.press("?")
        self.assertTrue(self.browser.element("help").is_displayed())
        self.browser.actions().send_keys("?").perform()
        self.assertFalse(self.browser.element("help").is_displayed())
        loaded = self.browser.script("return performance.getEntriesByType('resource').map(one => one.name)")
        self.assertEqual([name for name in loaded if not name.startswith((self.address, "data:"))], [])
        self.assertEqual(self.browser.complaints(), [])
        self.apertures_between()
        self.lost_device()

    def test_host_without_ranges(self):
        Handler.ranges = False
        self.addCleanup(setattr, Handler, "ranges", True)
        Handler.busy = 2
        self.browser.open(self.address + "#camera=1,3,0&focus=0.5&aperture=2")
        self.assertEqual(self.until_drawn(), "")
        self.assertLessEqual({"u": 1, "v": 3, "focus": 0.5, "aperture": 2}.items(), self.equals_render().items())
        self.press("]")
        self.until("a link", lambda: "#camera=1,3,0&focus=0.55&aperture=2" in self.browser.page.current_url)
        self.browser.page.get_log("browser")  # says that the host was busy

    def apertures_between(self):
        """What is shown of a frame between two apertures is the sum of their parts."""
        shown = [self.shown(aperture) for aperture in (1, 1.25, 2)]
        self.assertTrue(shown[0] != shown[2])
        worst = max(abs(0.75 * one + 0.25 * two - between) for one, between, two in zip(*shown))
        self.assertLess(worst, 1)

    def shown(self, aperture):
        return self.browser.page.execute_async_script("""
            const [aperture, done] = arguments;
            (async () => {
              const player = await (await import('/app/player.js')).player;
              player.end();
              const {canvas: {width, height}, frames: {field, field: {renderer: {device}}}} = player;
              const texture = device.createTexture(
                  {size: [width, height], format: navigator.gpu.getPreferredCanvasFormat(), usage: 16 | 1});
              const camera = player.frames.record({...player.frameCamera(), u: 2, v: 2, focus: 0, aperture});
              await field.draw(camera, 0, {getCurrentTexture: () => texture});
              const bytesPerRow = 256 * Math.ceil(width / 64);
              const buffer = device.createBuffer({size: bytesPerRow * height, usage: 1 | 8});
              const encoder = device.createCommandEncoder();
              encoder.copyTextureToBuffer({texture}, {buffer, bytesPerRow}, [width, height]);
              device.queue.submit([encoder.finish()]);
              await buffer.mapAsync(1);
              done(Array.from(new Uint8Array(buffer.getMappedRange())).filter((_, at) => at % bytesPerRow < 4 * width));
            })().catch(error => done(String(error)));""", aperture)

    def lost_device(self):
        self.browser.script("import('/app/player.js').then(page => page.player)"
                            ".then(({frames}) => frames.field.renderer.device.destroy())")
        self.assertIn("device was lost", self.until("a sentence", lambda: self.browser.text("notice")))
        self.assertTrue(self.browser.script("return document.getElementById('still').src").endswith("loop.png"))
        self.browser.page.get_log("browser")

    def test_damage(self):
        stream = Handler.root / "light-field.hmlfc"
        intact = stream.read_bytes()
        noise = random.Random(1).randbytes(len(intact))
        damages = ((intact[:400] + noise[400:], 0, "A part of this light field is damaged"), (intact[:2000], 0, "is damaged or cut (error 1)"),
                   (noise, 0, "no light field"), (intact, 2**31, "is damaged or cut (error 9)"), (intact, 2**31 + 1, "more than 2 GiB"))
        self.addCleanup(stream.write_bytes, intact)
        self.addCleanup(setattr, Handler, "claimed", None)
        for damaged, Handler.claimed, wanted in damages:
            with self.subTest(wanted):
                stream.write_bytes(damaged)
                self.browser.open(self.address)
                self.assertIn(wanted, self.until_drawn())
        self.browser.page.get_log("browser")  # says why, too

    def test_a_file_that_changes(self):
        stream = Handler.root / "light-field.hmlfc"
        self.addCleanup(stream.write_bytes, stream.read_bytes())
        self.hmlfc(*"encode views -o large.hmlfc --lossless".split())
        stream.write_bytes((self.folder / "large.hmlfc").read_bytes())
        Handler.versions = itertools.count()
        self.addCleanup(setattr, Handler, "versions", None)
        self.browser.open(self.address)
        self.assertIn("file has changed", self.until_drawn())
        self.browser.page.get_log("browser")

    def test_files_of_others_stay(self):
        own = self.folder / "own/app/player.js"
        own.parent.mkdir(parents=True)
        own.write_text("mine")
        self.refused(USAGE, "publish", "a.hmlfc", "-o", "own", says="app/player.js: is there already")
        self.assertEqual(own.read_text(), "mine")

    def test_an_interrupted_run_leaves_what_was_there(self):
        self.hmlfc("publish", "a.hmlfc", "-o", "cut")
        site = self.folder / "cut"
        before = {path: path.read_bytes() for path in site.rglob("*.*") if path.is_file()}
        with subprocess.Popen([PROGRAM, "publish", "a.hmlfc", "-o", "cut", "--focus", "9"], cwd=self.folder) as run:
            while run.poll() is None and not list(site.glob(".hmlfc-*/app")):
                pass
            run.kill()
        self.assertEqual({path: path.read_bytes() for path in before}, before)
        self.hmlfc("publish", "a.hmlfc", "-o", "cut", "--focus", "9")
        self.assertIn('data-far="9.00"', (site / "index.html").read_text())
        self.assertEqual(sorted(path for path in site.rglob("*.*") if path.is_file()), sorted(before))
        self.refused(USAGE, "publish", "a.hmlfc", "-o", "cut", "--address", "example.org", says="https://")

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
        browser = Browser(self.folder / "plain", ("--disable-gpu",))
        self.addCleanup(browser.end)
        browser.open(self.address)
        self.assertIn("no WebGPU", browser.until("a sentence", lambda: browser.text("notice"), PATIENCE))
        self.assertTrue(browser.script("return document.getElementById('still').src").endswith("loop.png"))

    def test_in_firefox(self):
        """The page's script comes to the stream or, where there is no WebGPU, to the recording."""
        if (firefox := shutil.which("firefox-esr")) is None:
            self.skipTest("firefox-esr is missing")
        Handler.asked.clear()
        command = [firefox, "--headless", "--no-remote", "--profile", self.folder, "--screenshot", self.folder / "page.png"]
        subprocess.run([*command, self.address], stderr=subprocess.DEVNULL, timeout=PATIENCE, check=True)
        self.assertTrue({"/light-field.hmlfc", "/loop.png"} & set(Handler.asked), Handler.asked)


if __name__ == "__main__":
    run_in_browser()
