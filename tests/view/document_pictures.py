"""The pictures of docs/view.md and README.md, drawn by the page itself and by `hmlfc render`.

usage: document_pictures.py PROGRAM VERSION [--update]

Without --update those of docs/view.md are drawn, and those of the repository have to have their size.
"""

import io
import math
import sys

from browser import Browser
from page_case import run_in_browser
from page_server import PageServer
from program import ROOT, CliTest

IMAGES = ROOT / "docs/images"
SIZE = 960, 600
INTO = "#mode=into&plane=Y&stage=picture"
LINKS = {
    "view_look": "#mode=look&camera=2.7,2.4,0&focus=-0.75&aperture=1&geometry=plane",
    "view_into": f"{INTO}&view=3,1&overlay=bits&show=tiles&block=38,24",
}
UPDATE = "--update" in sys.argv


def moving_links():
    """Pairs of a link and the milliseconds that it is shown: a drag, a change of focus, the bits of blocks."""
    turn = [2 * math.pi * step / 28 for step in range(28)]
    for angle in turn:
        yield f"#mode=look&camera={4 + 3 * math.sin(angle):.2f},{4 + 2 * math.sin(2 * angle):.2f},0", 80
    for angle in turn:
        yield f"#mode=look&camera=4,4,0&aperture=2&geometry=plane&focus={-3.5 * math.cos(angle) - 1.5:.2f}", 80
    for shown, time in (("", 900), ("&overlay=bits", 1400), ("&overlay=bits&show=tiles&block=70,60", 1800)):
        yield f"{INTO}&view=3,5{shown}", time


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

        self.stream("knights.hmlfc", "5x5", "320x240", 2, "--preset", "fast", "--quality", "75")
        for name, drawn in zip(LINKS, self.drawn("knights.hmlfc", LINKS.values())):
            self.assertEqual(drawn.size, SIZE)
            self.assertGreater(len(drawn.getcolors(SIZE[0] * SIZE[1])), 1000)
            if UPDATE:
                drawn.quantize(256, dither=Image.Dither.NONE).save(IMAGES / f"{name}.png", optimize=True)
            with Image.open(IMAGES / f"{name}.png") as picture:
                self.assertEqual(picture.size, SIZE)

    def test_pictures_of_readme(self):
        if UPDATE:
            self.draw_moving()
            self.draw_geometry()
        self.assertLess((IMAGES / "moving.webp").stat().st_size, 2 << 20)

    def draw_moving(self):
        links, times = zip(*moving_links())
        self.stream("knights.hmlfc", "9x9", "512x384", 3, "--preset", "fast", "--quality", "75")
        first, *others = [drawn.resize((720, 450)) for drawn in self.drawn("knights.hmlfc", links)]
        first.save(IMAGES / "moving.webp", save_all=True, append_images=others, duration=times, loop=0, quality=55)

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
