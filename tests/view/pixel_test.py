"""hmlfc view: how a pixel of the frame comes about, compared with `hmlfc render --trace`."""

from page_case import HEIGHT, WIDTH, PageCase, run_in_browser


class Pixel(PageCase):
    def click(self, x, y, *held):
        """Clicks pixel (x, y) of the frame while keys are held."""
        canvas = self.browser.element("frame")
        width, height = canvas.size["width"], canvas.size["height"]
        actions = self.browser.actions()
        for key in held:
            actions.key_down(key)
        actions.move_to_element_with_offset(
            canvas, round((x + 0.5) * width / WIDTH - width / 2), round((y + 0.5) * height / HEIGHT - height / 2)).click()
        for key in held:
            actions.key_up(key)
        actions.perform()

    def command(self, x, y):
        """The command of the panel once it shows this pixel of the frame that is drawn."""
        self.browser.frame()
        return self.browser.until("the pixel", lambda: next(iter(
            text for text in [self.browser.text("pixel-command")] if text.endswith(f" --trace {x},{y}")), None))

    def tables(self):
        return self.browser.script(
            "return [...document.querySelectorAll('#pixel table')].map((table) => ["
            "  table.caption.textContent, ...[...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent))])")

    def shows(self, x, y, file="a.hmlfc"):
        """The panel shows what --trace prints, both of the page's options and of its own command."""
        command = self.command(x, y)
        options = [word for name, value in self.browser.frame().items() for word in (f"--{name}", value)]
        trace = self.hmlfc_json("render", file, *options, "--trace", f"{x},{y}")
        self.assertEqual(self.hmlfc_json(*command.split()[1:]), trace)
        expected = []
        for stage in trace["stages"]:
            view = stage.get("view")
            table = [f"{stage['stage']} {view['row']},{view['col']}" if view else stage["stage"]]
            clause = ""
            for value in stage["values"]:
                table.append(["" if value["clause"] == clause else value["clause"], value["name"], str(value["value"])])
                clause = value["clause"]
            expected.append(table)
        self.assertEqual(self.tables(), expected)
        return trace

    def test_alt_and_a_click_show_what_render_traces(self):
        from selenium.webdriver.common.keys import Keys

        for link in ("#camera=1.3,2.2,0", "#camera=1.3,2.2,-0.5&look-at=1.5,2,15.5&fov=30&filter=views&geometry=plane",
                     "#focus=0.5&aperture=1&geometry=plane&levels=1", "#camera=0,0,-9&fov=90"):
            self.open(link, "tree.hmlfc")
            self.browser.frame()
            self.click(40, 30, Keys.ALT)
            self.shows(40, 30, "tree.hmlfc")

    def test_clicks_keys_and_links_choose_the_pixel(self):
        from selenium.webdriver.common.keys import Keys

        self.open("#camera=1.3,2.2,0")
        self.browser.frame()
        self.browser.element("frame").send_keys("p")
        self.command(WIDTH // 2, HEIGHT // 2)
        self.click(60, 40)
        self.command(60, 40)
        self.browser.element("pixel-x").send_keys(Keys.CONTROL + "a", Keys.NULL, "7", Keys.TAB)
        self.shows(7, 40)
        self.browser.element("frame").send_keys(Keys.ARROW_RIGHT)
        self.browser.until("a move", lambda: self.browser.frame()["camera"] == "1.55,2.2,0")
        self.browser.until("its pixel", lambda: "pu=1.55," in self.browser.text("pixel-command"))
        self.browser.page.refresh()
        self.shows(7, 40)
        self.browser.element("pixel-close").click()
        self.assertFalse(self.browser.element("pixel").is_displayed())
        self.assertNotIn("trace", self.browser.script("return location.hash"))

    def test_a_view_and_a_clause_open_on_a_narrow_screen(self):
        self.browser.narrow(360, 640)
        self.addCleanup(self.browser.wide)
        self.open("#camera=1.3,2.2,0&trace=40,30")
        self.command(40, 30)
        self.assertLessEqual(self.browser.script("return document.scrollingElement.scrollWidth"), 360)
        self.browser.page.find_element("xpath", "//*[@id='pixel']//button[.='SRF-3']").click()
        self.browser.until("the clause", lambda: self.browser.text("clause-text").startswith("[SRF-3] Displacement of a cell"))
        self.browser.page.find_element("css selector", "#clause button").click()
        self.browser.page.find_element("xpath", "//*[@id='pixel']//caption[starts-with(., 'view')]/a").click()
        self.browser.until("its block", lambda: "Block x 10, y 7 of plane Y of view row 2, column 1" in self.browser.text("block"))


if __name__ == "__main__":
    run_in_browser()
