"""The pictures of docs/view.md and README.md, drawn by the pages themselves and by `hmlfc render`.

usage: document_pictures.py PROGRAM VERSION [--update]

Without --update those of docs/view.md are drawn, and those of the repository have to have their size.
"""

import io
import math
import sys

from browser import WEBGPU, Browser
from page_case import run_in_browser
from page_server import PageServer
from program import ROOT, CliTest
from publish_test import PATIENCE, serve_site

IMAGES = ROOT / "docs/images"
SIZE = 960, 600
INTO = "#mode=into&plane=Y&stage=picture"
LINKS = {
    "view_look": "#mode=look&camera=2,2,0&focus=-0.75&aperture=1&geometry=plane",
    "view_into": f"{INTO}&view=3,1&overlay=bits&show=tiles&block=38,24",
}
UPDATE = "--update" in sys.argv


# The moving picture of README.md: the camera circles, then the focus goes where somebody taps, in parts of the frame.
TAPS, CIRCLE, GLIDE = ((0.5, 0.8), (0.5, 0.35)), 18, 7
DRAW = """
const [place, tap, done] = arguments;
Promise.all([import('/app/player.js').then(page => page.player), import('/app/dom.js')]).then(async ([view, {placeOn}]) => {
  view.change(place);
  while (view.drawing || view.wanted || view.glide) await new Promise(next => setTimeout(next, 20));
  const mark = document.getElementById('mark');
  mark.hidden = !tap;
  mark.style.setProperty('animation', 'none', 'important');
  const [x, y] = tap ?? [0.5, 0.5];
  placeOn(view.canvas, mark, x, y);
  done(await view.frames.focusOf(view.frameCamera(), Math.floor(x * view.canvas.width), Math.floor(y * view.canvas.height)));
}).catch(error => done(String(error)));"""


class Pictures(CliTest):
    @classmethod
    def prepare(cls):
        cls.browser = Browser(cls.folder / "profile")
        cls.addClassCleanup(cls.browser.end)
        cls.browser.narrow(*SIZE)

    def stream(self, file, grid, size, baseline, *options):
        self.hmlfc(*f"synth --scene knights --grid {grid} --size {size} --baseline {baseline} -o views".split())
        self.hmlfc("encode", "views", "-o", file, *options)

    def drawn(self, file, links):
        from PIL import Image

        with PageServer(self.folder, file) as server:
            for link in links:
                self.browser.open(server.address + link)
                if "mode=look" in link:
                    self.browser.frame()
                else:
                    name = "block" if "block=" in link else "into-command"
                    self.browser.until(name, lambda name=name: self.browser.text(name))
                    self.browser.until("the picture", lambda: self.browser.script(
                        "window.scrollTo(0, 0); return document.getElementById('picture').dataset.shown"))
                yield Image.open(io.BytesIO(self.browser.page.get_screenshot_as_png())).convert("RGB")

    def test_page(self):
        from PIL import Image

        self.stream("knights.hmlfc", "5x5", "480x320", 3, "--preset", "fast", "--quality", "75")
        for name, drawn in zip(LINKS, self.drawn("knights.hmlfc", LINKS.values())):
            self.assertEqual(drawn.size, SIZE)
            self.assertGreater(len(drawn.getcolors(SIZE[0] * SIZE[1])), 1000)
            if UPDATE:
                drawn.quantize(256, kmeans=2, dither=Image.Dither.NONE).save(IMAGES / f"{name}.png", optimize=True)
            with Image.open(IMAGES / f"{name}.png") as picture:
                self.assertEqual(picture.size, SIZE)

    def test_pictures_of_readme(self):
        if UPDATE:
            self.draw_moving()
            self.draw_geometry()
        self.assertLess((IMAGES / "moving.webp").stat().st_size, 3 << 19)

    def draw_moving(self):
        """The published page."""
        from PIL import Image

        self.run_hmlfc(*"synth --scene knights --grid 9x9 --size 720x480 --baseline 3 -o views".split())
        self.run_hmlfc(*"encode views -o knights.hmlfc --preset fast --quality 90".split())
        self.hmlfc("publish", "knights.hmlfc", "-o", "site", "--title", "Knights", "--text", "81 pictures in one file")
        browser = Browser(self.folder / "gpu", (*WEBGPU, "--force-prefers-reduced-motion"))
        self.addCleanup(browser.end)
        browser.page.set_script_timeout(PATIENCE)
        browser.narrow(880, 645)
        browser.open(serve_site(self.folder / "site"))
        pictures = []

        def draw(tap=None, **place):
            found = browser.page.execute_async_script(DRAW, place, tap)
            pictures.append(Image.open(io.BytesIO(browser.page.get_screenshot_as_png())).convert("RGB"))
            return found

        focus = draw(TAPS[-1])
        for tap in TAPS:
            for turn in (2 * math.pi * step / CIRCLE for step in range(CIRCLE)):
                draw(u=4 + 2 * math.sin(turn), v=4 + 0.7 * math.sin(2 * turn), focus=focus)
            there = draw(tap, u=4, v=4)
            for part in (step / GLIDE for step in range(1, GLIDE + 1)):
                draw(tap if part < 1 else None, focus=focus + (there - focus) * part * part * (3 - 2 * part))
            focus = there
        first, *others = [picture.resize((720, 528), Image.LANCZOS) for picture in pictures[1:]]
        first.save(IMAGES / "moving.webp", save_all=True, append_images=others, duration=80, loop=0, quality=60, method=6)

    def draw_geometry(self):
        """Where no view was encoded: with a plane, with geometry, and the view."""
        from PIL import Image

        self.stream("wide.hmlfc", "5x5", "480x360", 5, "--views", "0..4:2,0..4:2", "--quality", "80")
        for name in ("plane", "stream"):
            self.hmlfc(*f"render wide.hmlfc --camera 0.5,0.5 --geometry {name} -o {name}.png".split())
        picture = Image.new("RGB", (880, 216), "white")
        for left, name in zip((0, 296, 592), ("plane.png", "stream.png", "views/01_01.png")):
            picture.paste(Image.open(self.folder / name).crop((96, 140, 384, 356)), (left, 0))
        picture.save(IMAGES / "geometry.png", optimize=True)


if __name__ == "__main__":
    run_in_browser()
