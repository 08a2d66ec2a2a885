"""hmlfc view: the page in a browser, with real input events.
Frames are compared byte for byte with those of `hmlfc render`, blocks with `hmlfc inspect`.
"""

import json
import re
import urllib.request

from page_case import HEIGHT, WIDTH, PageCase, run_in_browser
from page_server import PageServer
from pictures import read_png, without_sign
from program import DONE

class Look(PageCase):
    def place(self, query):
        return [float(number) for number in query["camera"].split(",")]

    def drag(self, dx, dy, **keys):
        from selenium.webdriver.common.keys import Keys

        canvas = self.browser.element("frame")
        actions = self.browser.actions()
        if keys.get("shift"):
            actions.key_down(Keys.SHIFT)
        actions.move_to_element(canvas).click_and_hold().move_by_offset(dx // 2, dy // 2)
        actions.move_by_offset(dx - dx // 2, dy - dy // 2).release()
        if keys.get("shift"):
            actions.key_up(Keys.SHIFT)
        actions.perform()

    def box(self, name="frame"):
        return self.browser.script(
            "const box = document.getElementById(arguments[0]).getBoundingClientRect();"
            "return [box.left, box.top, box.width, box.height]", name)

    def press(self, name, *keys):
        self.browser.element(name).send_keys(*keys)

    def test_a_drag_moves_the_camera_and_the_frame_is_exact(self):
        self.open()
        before = self.frame_is_that_of_render()
        self.assertEqual(self.place(before), [2, 2, 0])
        self.drag(-80, 40)
        after = self.browser.until("a move", lambda: self.place(self.browser.frame()) != [2, 2, 0] and self.browser.frame())
        _, _, width, height = self.box()
        u, v, z = self.place(after)
        self.assertAlmostEqual(u, 2 + 4 * 80 / width, delta=0.02)
        self.assertAlmostEqual(v, 2 - 4 * 40 / height, delta=0.02)
        self.assertEqual(z, 0)
        self.frame_is_that_of_render()

    def test_wheel_shift_and_keys(self):
        from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
        from selenium.webdriver.common.keys import Keys

        self.open()
        focus = float(self.browser.frame()["focus"])
        origin = ScrollOrigin.from_element(self.browser.element("frame"))
        self.browser.actions().scroll_from_origin(origin, 0, -80).perform()
        query = self.browser.until("in", lambda: self.place(self.browser.frame())[2] > 0 and self.browser.frame())
        self.assertNotIn("look-at", query)
        self.drag(60, 0, shift=True)
        query = self.browser.until("a turn", lambda: "look-at" in self.browser.frame() and self.browser.frame())
        self.assertLess(float(query["look-at"].split(",")[0]), 2)
        self.frame_is_that_of_render()
        self.press("frame", "0", Keys.ARROW_RIGHT, Keys.ARROW_UP, "a", "]", "g")
        query = self.browser.until("keys", lambda: self.browser.frame()["aperture"] == "2" and self.browser.frame())
        self.assertEqual((self.place(query), query["geometry"]), ([2.25, 1.75, 0], "plane"))
        self.assertAlmostEqual(float(query["focus"]), focus + 0.05, delta=1e-4)
        self.frame_is_that_of_render()

    def test_a_finger_moves_it(self):
        self.open()
        self.browser.frame()
        left, top, width, height = self.box()
        x, y = left + width / 2, top + height / 2
        self.browser.touch((x, y), (x - 30, y), (x - 60, y))
        query = self.browser.until("a move", lambda: self.place(self.browser.frame())[0] > 2 and self.browser.frame())
        self.assertAlmostEqual(self.place(query)[0], 2 + 4 * 60 / width, delta=0.02)

    def test_controls_by_keyboard(self):
        from selenium.webdriver.common.keys import Keys

        self.open("#details=1")
        self.browser.frame()
        self.press("blur", Keys.END)
        self.press("focus", Keys.END)
        self.press("camera-u", Keys.CONTROL + "a", Keys.NULL, "1.5", Keys.TAB)
        self.press("filter", "v")
        query = self.browser.until("controls", lambda: self.browser.frame()["filter"] == "views" and self.browser.frame())
        self.assertEqual(self.place(query), [1.5, 2, 0])
        self.assertEqual(query["aperture"], "3")
        self.assertEqual(query["focus"], self.browser.element("focus").get_attribute("max"))
        self.frame_is_that_of_render()
        self.browser.script("const blur = document.getElementById('blur'); blur.value = 1.4; blur.dispatchEvent(new Event('input'))")
        self.browser.until("a link", lambda: "aperture=1.4&geometry=stream" in self.browser.page.current_url)

    def test_a_click_sets_the_focus_there(self):
        self.open("#aperture=1&geometry=plane")
        self.browser.frame()
        left, top, width, height = self.box()
        for x, y in (60, 40), (30, 22):
            self.browser.actions().move_to_element_with_offset(
                self.browser.element("frame"),
                round((x + 0.5) * width / WIDTH - width / 2), round((y + 0.5) * height / HEIGHT - height / 2),
            ).click().perform()
            found = self.hmlfc("render", "a.hmlfc", "--focus-at", f"{x},{y}", "-o", "focus.png")
            focus = float(re.search(rf"\nfocus (\S+) at {x},{y}\n", found)[1])
            self.browser.until("its focus", lambda: abs(float(self.browser.frame()["focus"]) - focus) < 1e-4)
            self.frame_is_that_of_render()

    def test_a_link_gives_the_same_frame(self):
        self.open("#mode=look&camera=0.75,3.1,-0.5&look-at=1.2,3,15.5&focus=0.4&aperture=1&geometry=plane&filter=nearest")
        query = self.frame_is_that_of_render()
        pixels = self.browser.pixels("frame")
        address = self.browser.until("the link", lambda: self.browser.script("return location.href") if "camera=" in self.browser.script("return location.hash") else None)
        for again in (lambda: self.browser.open(address), self.browser.page.refresh):
            again()
            self.assertEqual(self.browser.frame(), query)
            self.assertEqual(self.browser.pixels("frame"), pixels)

    def test_only_the_newest_frame_is_asked_for_and_moving_ones_are_coarse(self):
        """With a server that takes 60 ms for a frame."""
        self.open()
        self.browser.frame()
        self.browser.script(
            "const ask = window.fetch; window.asked = []; window.pending = window.most = 0;"
            "window.fetch = async (address) => {"
            "  if (!address.startsWith('frame?')) return ask(address);"
            "  window.asked.push(address); window.most = Math.max(window.most, ++window.pending);"
            "  await new Promise((done) => setTimeout(done, 60));"
            "  return ask(address).finally(() => --window.pending);"
            "}")
        canvas = self.browser.element("frame")
        actions = self.browser.actions().move_to_element(canvas).click_and_hold()
        for _ in range(60):
            actions.move_by_offset(2, 0)
        actions.release().perform()
        query = self.browser.until("the last", lambda: self.place(self.browser.frame())[0] < 1.5 and self.browser.frame())
        asked, most = self.browser.script("return [window.asked, window.most]")
        self.assertEqual(most, 1)
        self.assertLess(len(asked), 50)  # of 60 movements
        sizes = [re.search(r"size=(\w+)", address)[1] for address in asked]
        self.assertIn(f"{WIDTH // 2}x{HEIGHT // 2}", sizes)
        self.assertEqual(sizes[-1], f"{WIDTH}x{HEIGHT}")
        self.assertAlmostEqual(self.place(query)[0], 2 - 4 * 120 / self.box()[2], delta=0.03)
        self.frame_is_that_of_render()

    def test_a_recorded_path_renders_the_same_frames(self):
        self.browser.page.execute_cdp_cmd(
            "Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(self.folder)})
        self.open("#camera=1,1,0&focus=0.5&geometry=plane&aperture=1&details=1")
        self.browser.frame()
        self.browser.element("record").click()
        self.drag(-40, 20)
        self.drag(30, 0, shift=True)
        self.browser.until("a turn", lambda: "look-at" in self.browser.frame())
        self.browser.element("record").click()
        path = self.folder / "path.json"
        self.browser.until("the file", path.exists)
        command = re.search(r"hmlfc (render .*)$", self.browser.text("look-status"))[1]
        self.hmlfc(*command.split())
        frames = sorted((self.folder / "frames").glob("*.png"))
        self.assertEqual(len(frames), len(json.loads(path.read_text())))
        self.assertGreater(len(frames), 2)
        self.assertEqual(self.browser.pixels("frame"), bytes(read_png(frames[-1]).samples))

    def test_levels_of_the_tree(self):
        self.open("#levels=1", "tree.hmlfc")
        self.assertEqual(self.frame_is_that_of_render("tree.hmlfc")["levels"], "1")

    def test_the_png_is_that_of_render(self):
        self.open("#camera=1,1.5,0")
        query = self.browser.frame()
        self.render(query)
        href = self.browser.element("save").get_attribute("href")
        self.assertEqual(self.browser.element("save").get_attribute("download"), "frame.png")
        saved = urllib.request.urlopen(href).read()
        self.assertEqual(without_sign(saved), without_sign((self.folder / "frame.png").read_bytes()))

    def test_look_into_begins_with_the_nearest_view(self):
        self.open("#camera=3.3,0.8,0")
        self.browser.frame()
        self.browser.element("mode-into").click()
        self.browser.until("the view", lambda: "view=1,3" in self.browser.script("return location.hash"))
        self.browser.until("its picture", lambda: "1,3" in (self.browser.element("picture").get_attribute("data-shown") or ""))
        self.browser.element("mode-look").click()
        self.assertEqual(self.place(self.browser.frame()), [3.3, 0.8, 0])

    def test_it_circles_until_touched_and_a_phone_tilts_it(self):
        cdp = self.browser.page.execute_cdp_cmd
        cdp("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "no-preference"}]})
        cdp("Emulation.setTouchEmulationEnabled", {"enabled": True})
        self.addCleanup(cdp, "Emulation.setEmulatedMedia", {"features": []})
        self.addCleanup(cdp, "Emulation.setTouchEmulationEnabled", {"enabled": False})
        self.open()
        past = "return /camera=([^,]+)/.exec(document.getElementById('frame').dataset.query)?.[1] > 2.1"  # whole or not
        self.browser.until("a circle", lambda: self.browser.script(past))
        self.browser.element("tilt").click()
        before = self.place(self.frame_is_that_of_render())[0]
        self.browser.script("for (const gamma of [5, -5]) dispatchEvent(new DeviceOrientationEvent('deviceorientation', {beta: 40, gamma}))")
        self.browser.until("a tilt", lambda: abs(self.place(self.browser.frame())[0] - before + 0.64) < 0.001)

    def test_numbers_of_the_frame(self):
        self.open("#camera=1,1,-9&geometry=plane&focus=0.25&fov=60")
        query = self.browser.frame()
        options = [word for name, value in query.items() for word in (f"--{name}", value)]
        frame = self.hmlfc_json("render", "a.hmlfc", *options, "-o", "frame.png")["frames"][0]
        self.assertEqual(int(re.sub(r"\s", "", self.browser.text("needed"))), frame["blocks_needed"])
        self.assertIn(f"{100 * frame['outside']:.1f} % of the frame sees nothing", self.browser.text("look-outside"))

    def test_the_map_has_the_views_in_use_and_the_key_images(self):
        step = 22  # pixels of a view
        keys = [tuple(key) for key in self.serve("a.hmlfc").json("stream")["levels"][-1]["keys"]]
        self.assertTrue(0 < len(keys) < 25)
        views = [(row, col) for row in range(5) for col in range(5)]
        for aperture, rows, cols in (0, (1, 2), (3, 4)), (1, (0, 1, 2, 3), (2, 3, 4)):
            self.open(f"#camera=3.4,1.2,0&geometry=plane&focus=0.5&aperture={aperture}")
            self.browser.frame()
            inside = self.browser.colours("look-map", [[step * col + 5, step * row + 5] for row, col in views])
            for (row, col), colour in zip(views, inside):
                used = row in rows and col in cols
                self.assertEqual(colour, (0x4F, 0x79, 0xB3) if used else (0x2B, 0x2E, 0x35), (row, col))
            outline = self.browser.colours("look-map", [[step * col + 1, step * row + 11] for row, col in views])
            self.assertEqual([view for view, colour in zip(views, outline) if colour == (0xE0, 0xB4, 0x5C)], keys)

    def test_full_screen(self):
        self.open()
        self.browser.frame()
        self.browser.element("full").click()
        self.browser.until("it", lambda: self.browser.script("return document.fullscreenElement?.id") == "look")
        self.frame_is_that_of_render()
        self.browser.script("return document.exitFullscreen()")

    def test_nothing_comes_from_elsewhere(self):
        address = self.open("#mode=into&block=3,4")
        self.browser.until("a block", lambda: self.browser.text("block"))
        names = self.browser.script("return performance.getEntriesByType('resource').map((entry) => entry.name)")
        self.assertGreater(len(names), 10)
        for name in names:
            self.assertTrue(name.startswith((address, "data:")), name)


class Window(PageCase):
    def test_every_control_has_a_name(self):
        for link in "#mode=look&details=1", "#mode=into&block=3,4":
            self.open(link, "tree.hmlfc")
            self.browser.until("the page", lambda: self.browser.text("look-command") or self.browser.text("block"))
            controls = self.browser.page.find_elements(
                "css selector", "input, select, button, a, summary, canvas, dialog")
            shown = [control for control in controls if self.browser.script("return arguments[0].checkVisibility()", control)]
            named = [(control.get_attribute("id"), control.accessible_name) for control in shown]
            self.assertGreater(len(named), 10)
            self.assertEqual([identifier for identifier, name in named if not name], [])

    def test_windows_of_any_width(self):
        self.addCleanup(self.browser.wide)
        for width in 360, 480, 760, 761, 1024, 1920:
            self.browser.narrow(width, 700)
            for link in "#mode=look&details=1", "#mode=into&block=3,4&beside=sample":
                self.open(link)
                names = ("frame", "more", "save") if "look" in link else ("picture", "picture-beside", "overlay", "view-row")
                boxes = self.browser.until("the page", lambda: self.browser.script(
                    "const boxes = arguments[0].map(name => document.getElementById(name).getBoundingClientRect());"
                    "return boxes.every(box => box.width > 0) && boxes.map(box => [box.left, box.right])", names))
                for left, right in [*boxes, [0, self.browser.script("return document.scrollingElement.scrollWidth")]]:
                    self.assertTrue(0 <= left < right <= width, (width, link, boxes))
                if "beside" in link:
                    self.assertLessEqual(boxes[0][1], boxes[1][0])

    def test_once_ends_with_the_tab_also_where_its_page_loads_slowly(self):
        """A page that is loaded again over a line that takes 1.5 s for each of several requests."""
        with PageServer(self.folder, "a.hmlfc", "--once") as server:
            first = self.browser.page.current_window_handle
            self.browser.page.switch_to.new_window("tab")
            self.browser.open(server.address)
            self.browser.frame()
            self.browser.delay(1500)
            self.browser.page.refresh()
            self.browser.frame()
            self.browser.delay(0)
            self.browser.page.close()
            self.browser.page.switch_to.window(first)
            self.assertEqual(server.process.wait(timeout=120), DONE)

    def test_what_is_not_there_is_told(self):
        self.open("#mode=into&view=1,9&block=2,1")
        self.browser.until("why", lambda: self.browser.text("into-error") == "This stream has no view 1,9.")
        self.browser.element("picture").send_keys("n")
        self.assertEqual(self.browser.text("into-error"), "This plane has no block with an error.")
        self.open("#mode=into&block=900,1")
        self.browser.until("why", lambda: self.browser.text("into-error") == "Not in plane Y: block 900,1.")


if __name__ == "__main__":
    run_in_browser()
