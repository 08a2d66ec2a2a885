"""A test with a browser and small streams."""

import sys

from browser import Browser, missing
from page_server import PageServer
from pictures import read_png
from program import CliTest, main

WIDTH, HEIGHT = 96, 64


def run_in_browser():
    """Runs the tests of the program, or skips them where there is no browser."""
    reason = missing()
    if reason:
        print(f"skipped: {reason}")
        sys.exit(77)
    main()


class PageCase(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*f"synth --scene cards --grid 5x5 --size {WIDTH}x{HEIGHT} --baseline 3 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc".split())
        cls.hmlfc(*"encode views -o tree.hmlfc --profile main --quality 60".split())
        cls.browser = Browser(cls.folder / "profile")
        cls.addClassCleanup(cls.browser.end)
        cls.servers = {}

    @classmethod
    def serve(cls, *arguments):
        """A server that lives as long as the class."""
        if arguments not in cls.servers:
            cls.servers[arguments] = PageServer(cls.folder, *arguments)
            cls.addClassCleanup(cls.servers[arguments].end)
        return cls.servers[arguments]

    def tearDown(self):
        said = [entry["message"] for entry in self.browser.page.get_log("browser")]
        self.assertEqual([text for text in said if "willReadFrequently" not in text], [])  # of pixels()

    def open(self, link="", file="a.hmlfc", *arguments):
        address = self.serve(file, *arguments).address
        self.browser.open(address + link)
        return address

    def render(self, query, file="a.hmlfc"):
        """Samples of the frame of `hmlfc render`."""
        options = [word for name, value in query.items() for word in (f"--{name}", value)]
        self.hmlfc("render", file, *options, "-o", "frame.png")
        return bytes(read_png(self.folder / "frame.png").samples)

    def frame_is_that_of_render(self, file="a.hmlfc"):
        query = self.browser.frame()
        self.assertEqual(self.browser.pixels("frame"), self.render(query, file))
        return query
