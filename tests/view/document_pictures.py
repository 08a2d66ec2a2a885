"""The pictures of docs/view.md, drawn by the page itself.

usage: document_pictures.py PROGRAM VERSION [--update]

Without --update the pictures are drawn, and those of the repository have to have their size.
"""

import io
import sys

from browser import Browser
from page_case import run_in_browser
from page_server import PageServer
from program import ROOT, CliTest

SIZE = 960, 600
LINKS = {
    "view_look": "#mode=look&camera=2.7,2.4,0&focus=-0.75&aperture=1&geometry=plane",
    "view_into": "#mode=into&view=3,1&plane=Y&stage=picture&overlay=bits&show=tiles&block=38,24",
}
UPDATE = "--update" in sys.argv


class Pictures(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene knights --grid 5x5 --size 320x240 --baseline 2 -o knights".split())
        cls.hmlfc(*"encode knights -o knights.hmlfc --preset fast --quality 75".split())
        cls.browser = Browser(cls.folder / "profile")
        cls.addClassCleanup(cls.browser.end)
        cls.browser.narrow(*SIZE)

    def test_pictures(self):
        from PIL import Image

        with PageServer(self.folder, "knights.hmlfc") as server:
            for name, link in LINKS.items():
                self.browser.open(server.address + link)
                if "look" in name:
                    self.browser.frame()
                else:
                    self.browser.until("the block", lambda: self.browser.text("block"))
                    self.browser.script("window.scrollTo(0, 0)")
                drawn = Image.open(io.BytesIO(self.browser.page.get_screenshot_as_png())).convert("RGB")
                self.assertEqual(drawn.size, SIZE)
                self.assertGreater(len(drawn.getcolors(SIZE[0] * SIZE[1])), 1000)
                kept = ROOT / f"docs/images/{name}.png"
                if UPDATE:
                    drawn.quantize(256, dither=Image.Dither.NONE).save(kept, optimize=True)
                with Image.open(kept) as picture:
                    self.assertEqual(picture.size, SIZE)


if __name__ == "__main__":
    run_in_browser()
