"""hmlfc view: what stands beside the picture of blocks: clauses, search, CSV, the bar."""

from page_case import HEIGHT, WIDTH, IntoCase, run_in_browser

COLUMNS, ROWS = WIDTH // 4, HEIGHT // 4


class Beside(IntoCase):
    VIEW = 1, 3

    def test_clauses_have_their_text(self):
        self.look(block="10,6")
        self.browser.until("the block", lambda: self.browser.text("block"))
        self.browser.page.find_element("xpath", "//button[.='IDX-4']").click()
        text = self.browser.until("the clause", lambda: self.browser.text("clause-text"))
        self.assertTrue(text.startswith("[IDX-4]"), text)
        self.assertNotIn("[IDX-5]", text)
        self.assertNotIn("|", text)
        cells = self.browser.script("return [...document.querySelectorAll('#clause-text td')].map((cell) => cell.textContent)")
        self.assertIn("bad_root_entry", cells)

    def find(self, words):
        from selenium.webdriver.common.keys import Keys

        self.browser.element("find").clear()
        self.browser.element("find").send_keys(words, Keys.ENTER)

    def test_what_is_typed_is_found(self):
        self.look(block="10,6")
        self.browser.until("the block", lambda: self.browser.text("block"))
        rows = "return [...document.querySelectorAll('.fields tbody tr%s')].map((row) => [...row.cells].map((cell) => cell.textContent))"
        fields = self.browser.script(rows % "")
        for words, wanted in (fields[-1][1], fields[-1]), (fields[2][3], next(row for row in fields if row[3] == fields[2][3])):
            self.find(words)
            self.assertEqual(self.browser.until(words, lambda: self.browser.script(rows % ".found")), [wanted])
        self.find("0xffffff")
        self.browser.until("a refusal", lambda: "reads nothing" in self.browser.text("find-error"))
        self.find("til-9")
        self.browser.until("the clause", lambda: self.browser.text("clause-text").startswith("[TIL-9] Block values."))

    def test_blocks_are_saved_as_csv(self):
        address = self.look("tree.hmlfc", block="10,6")
        told = next(server for server in self.servers.values() if server.address == address).json("blocks", {"view": "1,3", "plane": "Y"})
        self.browser.page.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(self.folder)})
        self.browser.element("save-csv").click()
        self.browser.until("the file", lambda: (self.folder / "blocks.csv").exists())
        rows = (self.folder / "blocks.csv").read_bytes().decode().split("\r\n")
        self.assertEqual(rows[0], "x,y,state,bits,read,level_counts,steps,disparities,vectors,error")
        self.assertEqual(len(rows), COLUMNS * ROWS + 2)
        for at in 0, COLUMNS + 5, COLUMNS * ROWS - 1:
            x, y, state, bits, read = rows[1 + at].split(",")[:5]
            self.assertEqual((int(x), int(y), int(bits), int(read)), (at % COLUMNS, at // COLUMNS, told["bits"][at], told["read"][at]))
            self.assertEqual(state, self.inspect((int(x), int(y)), file="tree.hmlfc")["levels"][-1]["state"])

    def test_another_stream_is_looked_into_beside(self):
        self.look("a.hmlfc", "--original", "tree.hmlfc", beside="twin", stage="sample", block="10,6")
        own, twin = (self.inspect((10, 6), file=file)["levels"][-1]["stages"]["sample"]["values"] for file in ("a.hmlfc", "tree.hmlfc"))
        for name, values in ("picture", own), ("picture-beside", twin):
            self.assertEqual(self.at(42, 25, name), (values[1][2],) * 3)
        marked = self.browser.script("return [...document.querySelectorAll('#block > section')].map((half) => [...half.querySelectorAll("
                                     "  '.matrix:last-of-type td')].slice(-16).map((cell) => [Number(cell.textContent), cell.className === 'wrong']))")
        pairs = list(zip(sum(own, []), sum(twin, [])))
        self.assertEqual(marked, [[[a, a != b] for a, b in pairs], [[b, a != b] for a, b in pairs]])
        self.assertTrue(self.browser.page.find_elements("css selector", ".differs"))
        # A stream of other blocks, with fewer levels: nothing of the two is compared.
        self.hmlfc(*"encode views -o large.hmlfc --block 8".split())
        self.look("tree.hmlfc", "--original", "large.hmlfc", beside="twin", stage="sample", block="10,6", levels="2")
        self.browser.until("both", lambda: "Block x 5, y 3" in self.browser.text("block"))
        self.assertFalse(self.browser.page.find_elements("css selector", ".wrong, .differs"))

    def test_the_bar_below_the_picture_moves(self):
        from selenium.webdriver.common.keys import Keys

        self.look()
        before = self.browser.element("picture").size["height"]
        self.browser.element("split").send_keys(Keys.ARROW_UP * 3)
        self.assertLess(self.browser.element("picture").size["height"], before - 50)


if __name__ == "__main__":
    run_in_browser()
