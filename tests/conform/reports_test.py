"""The reports of `hmlfc conform`: HTML, JUnit, text."""

import re
import xml.etree.ElementTree as ElementTree

from conform_case import COARSE, ConformTest, main


class Reports(ConformTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        suite = ["conform", "--suite", cls.small, "--filter", "real/cards-main"]
        cls.text = cls.run_hmlfc(*suite, "--dut", COARSE, "-o", "failing").stdout.decode()
        message = "sh -c 'echo \"not <done> & quoted\" >&2; exit 3' {input} {output}"
        cls.run_hmlfc(*suite, "--dut", message, "-o", "refusing")

    def page(self, folder):
        return (self.folder / folder / "report.html").read_text()

    def test_messages_are_escaped(self):
        self.assertIn("not &lt;done&gt; &amp; quoted", self.page("refusing"))
        self.assertNotIn("<done>", self.page("refusing"))

    def test_page_stands_alone(self):
        page = self.page("failing")
        addresses = re.findall(r'(?:src|href)="([^"]{,30})', page)
        self.assertEqual(len(addresses), 3)
        for address in addresses:
            self.assertTrue(address.startswith("data:image/png;base64,"))
        for text in ("real/cards-main", "COL-3", "SHA-256", "Look first at <b>real/cards-main"):
            self.assertIn(text, page)

    def test_page_fits_a_phone_and_folds_what_was_not_run(self):
        page = self.page("failing")
        self.assertIn('<meta name="viewport" content="width=device-width', page)
        self.assertEqual(page.count("<table>"), page.count("<div class=scroll><table>"))
        shown = re.sub(r"<details>.*?</details>", "", page, flags=re.S)
        for text in ("error/magic", ">not run<"):
            self.assertIn(text, page)
        self.assertNotIn("error/magic", shown)
        self.assertNotIn('skipped">0 / ', page)
        self.assertLess(shown.index("real/cards-main"), shown.index("milestones"))

    def test_junit(self):
        suite = ElementTree.parse(self.folder / "failing/junit.xml").getroot().find("testsuite")
        self.assertEqual((suite.get("failures"), suite.get("errors")), ("1", "0"))
        self.assertEqual(int(suite.get("skipped")), int(suite.get("tests")) - 1)
        self.assertIn("clauses:", suite.find("testcase/failure").text)
        refused = ElementTree.parse(self.folder / "refusing/junit.xml").getroot()
        self.assertIn("not <done> & quoted", refused.find(".//failure").text)

    def test_text(self):
        self.assertRegex(self.text, r"fail +real/cards-main: view \d+,\d+ block \d+,\d+ \(pixel ")
        self.assertIn("clauses", self.text)
        self.assertRegex(self.text, r"fails: 1 fail, \d+ skipped, of \d+ vectors")
        self.assertIn("report.html", self.text)
        self.assertRegex(self.text, r"Look first at real/cards-main: view .*\n +hmlfc inspect .* --plane Y --block")


if __name__ == "__main__":
    main()
