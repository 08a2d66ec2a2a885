"""hmlfc view --dut: a decoder whose fault is known beside the golden model, and the way there from a report."""

import json
import shlex
import sys
from pathlib import Path

from faulty_decoder import OFF, X, Y, off
from page_case import WIDTH, IntoCase, run_in_browser
from pictures import read_png
from program import DIFFERENT, ROOT, USAGE

SCRIPT = f"{sys.executable} -B {Path(__file__).parent / 'faulty_decoder.py'}"
LINES = f"lines: {SCRIPT} lines"
COMMAND = SCRIPT + " {hmlfc} {input} {output}"
BLOCK = X // 4, Y // 4


class Dut(IntoCase):
    VIEW = 0, 1

    def right(self):
        """R, G, B of pixel X, Y by the golden model."""
        self.hmlfc("decode", "a.hmlfc", "--view", "0,1", "-o", "decoded")
        at = 3 * (WIDTH * Y + X)
        return tuple(read_png(self.folder / "decoded" / "00_01.png").samples[at : at + 3])

    def test_its_picture_and_the_difference(self):
        red, green, blue = self.right()
        sign = 1 if off(red) > red else -1
        for dut in LINES, COMMAND:
            self.look("a.hmlfc", "--dut", dut, stage="dut-picture")
            self.assertEqual(self.at(X, Y), (off(red), green, blue))
            self.look("a.hmlfc", "--dut", dut, stage="dut-difference")
            self.assertEqual(self.at(X, Y), (128 + 4 * OFF * sign, 128, 128))
            for x, y in (X + 1, Y), (X, Y - 1), (0, 0), (70, 50):
                self.assertEqual(self.at(x, y), (128, 128, 128))

    def test_wrong_blocks_are_an_overlay(self):
        self.look("a.hmlfc", "--dut", LINES, stage="dut-difference", overlay="dut")
        self.assertIn(f"{OFF}{OFF} the largest difference", self.browser.text("legend"))
        for x, y in (4 * BLOCK[0], 4 * BLOCK[1]), (4 * BLOCK[0] + 3, 4 * BLOCK[1] + 3):
            self.assertNotEqual(self.at(x, y), (128, 128, 128))
        for x, y in (4 * BLOCK[0] - 1, 4 * BLOCK[1]), (4 * BLOCK[0], 4 * BLOCK[1] + 4):
            self.assertEqual(self.at(x, y), (128, 128, 128))
        self.move_to(X, Y).perform()
        self.browser.until("its value", lambda: f"differs by up to {OFF}" in self.browser.text("hover"))

    def test_both_are_shown_side_by_side_and_move_together(self):
        from selenium.webdriver.common.actions.wheel_input import ScrollOrigin

        self.look("a.hmlfc", "--dut", LINES, beside="dut-picture")
        red, green, blue = self.right()
        self.assertEqual(self.at(X, Y), (red, green, blue))
        self.assertEqual(self.at(X, Y, "picture-beside"), (off(red), green, blue))
        before = self.placement()[0]
        origin = ScrollOrigin.from_element(self.browser.element("picture-beside"))
        self.browser.actions().scroll_from_origin(origin, 0, -120).perform()
        self.browser.until("a zoom", lambda: self.placement()[0] > before)
        self.assertEqual(self.placement(), self.placement("picture-beside"))
        boxes = [self.browser.script("const box = document.getElementById(arguments[0]).getBoundingClientRect();"
                                     "return [box.left, box.right]", name) for name in ("picture", "picture-beside")]
        self.assertLess(boxes[0][1], boxes[1][0])
        self.browser.element("beside").send_keys("n")
        self.browser.until("one picture", lambda: not self.browser.element("picture-beside").is_displayed())

    def wrong_cells(self):
        return self.browser.script(
            "return [...document.querySelectorAll('#other .matrix')].map((table) =>"
            "  [table.caption.textContent, [...table.querySelectorAll('td')].map((cell) => [cell.textContent, cell.className])])"
        )

    def test_the_pinned_block_has_the_wrong_stages(self):
        self.look("a.hmlfc", "--dut", LINES, block=f"{BLOCK[0]},{BLOCK[1]}")
        text = self.browser.until("the other", lambda: self.browser.page.find_elements("css selector", "#other"))[0].text
        stages = self.inspect(BLOCK)["levels"][-1]["stages"]
        wrong = [name for name in ("residual", "sample") if name in stages]
        self.assertRegex(text, rf"{len(wrong)} of \d+ stages differ")
        at = 4 * (Y % 4) + X % 4
        tables = dict(self.wrong_cells())
        for name in wrong:
            values = sum(stages[name]["values"], [])
            values[at] += 1
            (cells,) = [cells for title, cells in tables.items() if title.startswith(f"level 0: {name}, lines")]
            self.assertEqual([int(number) for number, _ in cells], values)
            self.assertEqual([place for place, (_, kind) in enumerate(cells) if kind == "wrong"], [at])
        self.look("a.hmlfc", "--dut", LINES, block=f"{BLOCK[0] + 1},{BLOCK[1]}")
        self.browser.until("no fault", lambda: "stages that it reports are right" in self.browser.text("block"))

    def test_without_a_trace_the_pinned_block_has_its_pixels(self):
        self.look("a.hmlfc", "--dut", COMMAND, block=f"{BLOCK[0]},{BLOCK[1]}")
        self.browser.until("the other", lambda: "R,G,B, " in self.browser.text("block"))
        red, green, blue = self.right()
        marked = [text for _, cells in self.wrong_cells() for text, kind in cells if kind == "wrong"]
        self.assertEqual(marked, [f"{off(red)},{green},{blue}"])

    def test_a_decoder_that_ends_is_named_and_the_page_goes_on(self):
        dut = f"lines: {SCRIPT} dies"
        self.open("#mode=into&view=0,1&stage=dut-picture", "a.hmlfc", "--dut", dut)
        text = self.browser.until("an error", lambda: self.browser.text("into-error"))
        self.assertIn("no view today", text)
        self.assertIn("view 0,1", text)
        self.look("a.hmlfc", "--dut", dut, stage="sample")
        self.assertEqual(self.browser.text("into-error"), "")
        self.assertEqual(self.serve("a.hmlfc", "--dut", dut).ask("dut-picture", {"view": "0,1"})[0], 422)
        self.browser.page.get_log("browser")  # the status 422 of errors

    def test_a_failure_of_the_report_opens_here(self):
        result = self.run_hmlfc("conform", "--suite", ROOT / "vectors", "--filter", "syntax/base-main", "--dut", COMMAND,
                                "-o", "report", "--json")
        self.assertEqual(result.returncode, DIFFERENT)
        (failed,) = [one for one in json.loads(result.stdout)["runs"][0]["results"] if one["status"] == "fail"]
        self.assertIn(failed["view"].replace("'", "&#39;")[:20], (self.folder / "report" / "report.html").read_text())
        words = shlex.split(failed["view"])
        self.assertEqual(words[:2], ["hmlfc", "view"])
        self.open("", *words[2:])
        self.browser.until("both", lambda: "R,G,B, " in self.browser.text("block"))
        place = failed["difference"]
        self.assertIn(f"view row {place['view_row']}, column {place['view_col']}", self.browser.text("block"))
        self.assertTrue(self.browser.element("picture-beside").is_displayed())
        (text,) = [text for _, cells in self.wrong_cells() for text, kind in cells if kind == "wrong"]
        self.assertIn(str(place["actual"]), text)
        shown = json.loads(self.browser.element("picture").get_attribute("data-shown"))
        self.assertEqual(shown["block"], f"{place['block_x']},{place['block_y']}")

    def test_options_that_do_not_fit(self):
        self.refused(USAGE, "view", "a.hmlfc", "--no-browser", "--view", "0,1", says="--block")
        place = ["--view", "0,1", "--plane", "Y", "--block", "99,0"]
        self.refused(USAGE, "view", "a.hmlfc", "--no-browser", *place, says="does not exist")
        self.refused(USAGE, "view", "a.hmlfc", "--no-browser", "--dut", "decode {input}", says="{output}")
        self.assertEqual(self.serve("a.hmlfc").ask("dut-picture", {"view": "0,1"})[0], 400)


if __name__ == "__main__":
    run_in_browser()
