"""The reports of `hmlfc conform`: JUnit XML, HTML, text."""

import struct
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser

from conform_case import ConformTest, faulty, main

MARKED = "not <done> & \"quoted\""


class Page(HTMLParser):
    """Tags that are open, pictures, addresses and the text of a page."""

    def __init__(self):
        super().__init__()
        self.open = []
        self.pictures = []
        self.addresses = []
        self.text = ""

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "img":
            self.pictures.append(attributes["src"])
        self.addresses += [attributes[name] for name in ("href", "src") if name in attributes]
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        self.text += data


class Reports(ConformTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        suite = ["conform", "--suite", cls.small, "--filter", "real/cards-main"]
        cls.text = cls.run_hmlfc(*suite, "--dut", faulty("chroma_shifted"), "-o", "failing").stdout.decode()
        message = f"sh -c 'echo \"{MARKED.replace(chr(34), '')}\" >&2; exit 3' {{input}} {{output}}"
        cls.run_hmlfc(*suite, "--dut", message, "-o", "refusing")

    def test_junit_counts(self):
        suite = ElementTree.parse(self.folder / "failing" / "junit.xml").getroot().find("testsuite")
        vectors = self.manifest["vectors"]
        self.assertEqual(int(suite.get("tests")), len(vectors))
        self.assertEqual(int(suite.get("failures")), 1)
        self.assertEqual(int(suite.get("skipped")), len(vectors) - 1)
        failures = suite.findall("testcase/failure")
        self.assertEqual(len(failures), 1)
        self.assertIn("clauses:", failures[0].text)

    def test_messages_are_escaped(self):
        suite = ElementTree.parse(self.folder / "refusing" / "junit.xml").getroot()
        self.assertIn("not <done> & quoted", suite.find(".//failure").text)
        page = Page()
        page.feed((self.folder / "refusing" / "report.html").read_text())
        self.assertIn("not <done> & quoted", page.text)

    def test_page_stands_alone(self):
        page = Page()
        page.feed((self.folder / "failing" / "report.html").read_text())
        self.assertEqual(page.open, [])
        self.assertEqual(len(page.pictures), 4)
        for address in page.addresses:
            self.assertTrue(address.startswith("data:image/png;base64,"))
        for text in ("real/cards-main", "COL-3", "SHA-256", "Look first at real/cards-main", "128 or more"):
            self.assertIn(text, page.text)

    def test_heat_map(self):
        """Four pixels a block and a grey one between views; black where a block is right."""
        (vector,) = [v for v in self.manifest["vectors"] if v["id"] == "real/cards-main"]
        shape = vector["output"]
        (picture,) = (self.folder / "failing").glob("*/failures/real/cards-main/heat.png")
        columns, rows = (-(-shape[side] // 4) for side in ("width", "height"))
        size = struct.unpack(">II", picture.read_bytes()[16:24])
        self.assertEqual(size, (shape["cols"] * (4 * columns + 1) - 1, shape["rows"] * (4 * rows + 1) - 1))

    def test_text(self):
        self.assertRegex(self.text, r"fail +real/cards-main: view \d+,\d+ block \d+,\d+ \(pixel ")
        self.assertIn("clauses", self.text)
        self.assertRegex(self.text, r"fails: 1 fail, \d+ skipped, of \d+ vectors")
        self.assertIn("report.html", self.text)
        self.assertRegex(self.text, r"Look first at real/cards-main: view .*\n +hmlfc inspect .* --plane Co --block")


if __name__ == "__main__":
    main()
