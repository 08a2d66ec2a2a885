"""The reports of `hmlfc conform`: HTML, text."""

from html.parser import HTMLParser

from conform_case import COARSE, ConformTest, main

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
        cls.text = cls.run_hmlfc(*suite, "--dut", COARSE, "-o", "failing").stdout.decode()
        message = f"sh -c 'echo \"{MARKED.replace(chr(34), '')}\" >&2; exit 3' {{input}} {{output}}"
        cls.run_hmlfc(*suite, "--dut", message, "-o", "refusing")

    def test_messages_are_escaped(self):
        page = Page()
        page.feed((self.folder / "refusing" / "report.html").read_text())
        self.assertIn("not <done> & quoted", page.text)

    def test_page_stands_alone(self):
        page = Page()
        page.feed((self.folder / "failing" / "report.html").read_text())
        self.assertEqual(page.open, [])
        self.assertEqual(len(page.pictures), 3)
        for address in page.addresses:
            self.assertTrue(address.startswith("data:image/png;base64,"))
        for text in ("real/cards-main", "COL-3", "SHA-256", "Look first at real/cards-main"):
            self.assertIn(text, page.text)

    def test_text(self):
        self.assertRegex(self.text, r"fail +real/cards-main: view \d+,\d+ block \d+,\d+ \(pixel ")
        self.assertIn("clauses", self.text)
        self.assertRegex(self.text, r"fails: 1 fail, \d+ skipped, of \d+ vectors")
        self.assertIn("report.html", self.text)
        self.assertRegex(self.text, r"Look first at real/cards-main: view .*\n +hmlfc inspect .* --plane Y --block")


if __name__ == "__main__":
    main()
