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


def grey(colour):
    """What an overlay lies over."""
    return sum(weight * value for weight, value in zip((0.2126, 0.7152, 0.0722), colour))


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


class IntoCase(PageCase):
    """Tests that look into view `VIEW`."""

    VIEW = 0, 0

    def shown(self, **wanted):
        """Waits until the picture is that of the link."""

        def settled():
            link = self.browser.script(
                "return Object.fromEntries(new URLSearchParams(location.hash.slice(1)));")
            shown = self.browser.script("return document.getElementById('picture').dataset.shown")
            return shown and all(link.get(name) == value for name, value in wanted.items())

        self.browser.until(f"the picture {wanted}", settled)

    def look(self, file="a.hmlfc", *arguments, **link):
        pairs = {"mode": "into", "view": ",".join(map(str, self.VIEW)), **link}
        address = self.open("#" + "&".join(f"{name}={value}" for name, value in pairs.items()), file, *arguments)
        self.shown(**link)
        return address

    def inspect(self, block, *options, file="a.hmlfc"):
        place = ["--view", ",".join(map(str, self.VIEW)), "--plane", "Y", "--block", ",".join(map(str, block))]
        return self.hmlfc_json("inspect", file, *place, *options)

    def colours(self, samples, name="picture"):
        """(R, G, B) on the screen at the middle of each sample x, y of the picture."""
        scale, left, top = self.placement(name)
        places = [[int(left + (x + 0.5) * scale), int(top + (y + 0.5) * scale)] for x, y in samples]
        return self.browser.colours(name, places)

    def at(self, x, y, name="picture"):
        return self.colours([(x, y)], name)[0]

    def placement(self, name="picture"):
        data = self.browser.script("return {...document.getElementById(arguments[0]).dataset}", name)
        return float(data["scale"]), float(data["x"]), float(data["y"])

    def close_to(self, got, expected, what):
        for a, b in zip(got, expected):
            self.assertLessEqual(abs(a - b), 2, f"{what}: {got}, not {expected}")

    def move_to(self, x, y):
        """The pointer, to a sample."""
        scale, left, top = self.placement()
        canvas = self.browser.element("picture")
        width, height = canvas.size["width"], canvas.size["height"]
        return self.browser.actions().move_to_element_with_offset(
            canvas, round(left + (x + 0.5) * scale - width / 2), round(top + (y + 0.5) * scale - height / 2))
