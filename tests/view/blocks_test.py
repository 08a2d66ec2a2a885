"""hmlfc view: the page looks into streams whose numbers are known: from `hmlfc inspect`, or damaged on purpose."""

import re

from page_case import HEIGHT, WIDTH, IntoCase, grey, run_in_browser
from pictures import read_png

COLUMNS, ROWS = WIDTH // 4, HEIGHT // 4
STATE_COLOURS = {
    "zero": (0x5B, 0x64, 0x73),
    "motion only": (0x3F, 0x8F, 0xD6),
    "motion and residual": (0x9A, 0x6F, 0xD0),
    "residual only": (0xE0, 0x9A, 0x3E),
}
OPACITY = 0.62
HEAT = (30, 12, 70), (120, 28, 109), (196, 62, 75), (242, 130, 32), (250, 235, 140)
IMAGES = (0x3F, 0x8F, 0xD6), (0xE0, 0x9A, 0x3E), (0x49, 0xA8, 0x6B), (0xC9, 0x5D, 0x8D), (0x9A, 0x6F, 0xD0), (0xD8, 0xC2, 0x3F), (0x45, 0xB5, 0xB0), (0xB0, 0x66, 0x3C)
VIEW = 1, 3  # a predictive image


def heat(part):
    """The colour of a part in [0, 1] of the way from the least to the greatest number."""
    first = min(3, int(4 * part))
    return tuple(low + (high - low) * (4 * part - first) for low, high in zip(HEAT[first], HEAT[first + 1]))


class Blocks(IntoCase):
    VIEW = VIEW

    @classmethod
    def prepare(cls):
        super().prepare()
        cls.hmlfc(*f"synth --scene cards --grid 3x6 --size {WIDTH}x{HEIGHT} --baseline 3 -o wide".split())
        cls.hmlfc(*"encode wide -o wide.hmlfc --profile main --height 1 --quality 60".split())

    def test_the_picture_is_the_decoded_view(self):
        self.hmlfc("decode", "a.hmlfc", "--view", "1,3", "-o", "decoded")
        decoded = read_png(self.folder / "decoded" / "01_03.png").samples
        self.look()
        for x, y in (0, 0), (50, 30), (95, 63), (17, 40):
            at = 3 * (WIDTH * y + x)
            self.assertEqual(self.at(x, y), tuple(decoded[at : at + 3]))

    def test_stages_are_those_of_inspect(self):
        block = 10, 6
        stages = self.inspect(block)["levels"][-1]["stages"]
        for stage in "sample", "prediction", "reference":
            self.look(stage=stage)
            for x, y in (0, 0), (3, 2):
                grey = stages[stage]["values"][y][x]
                self.assertEqual(self.at(4 * block[0] + x, 4 * block[1] + y), (grey, grey, grey), stage)

    def test_states_are_drawn(self):
        self.look(overlay="state")
        self.hmlfc("decode", "a.hmlfc", "--view", "1,3", "-o", "decoded")
        decoded = read_png(self.folder / "decoded" / "01_03.png").samples
        seen = set()
        for block in [(x, y) for y in range(0, ROWS, 5) for x in range(1, COLUMNS, 5)]:
            state = self.inspect(block)["levels"][-1]["state"]
            seen.add(state)
            x, y = 4 * block[0] + 2, 4 * block[1] + 2
            under = grey(decoded[3 * (WIDTH * y + x) :][:3])
            mixed = [OPACITY * over + (1 - OPACITY) * under for over in STATE_COLOURS[state]]
            self.close_to(self.at(x, y), mixed, f"block {block}, {state}")
        self.assertGreater(len(seen), 1)
        self.assertLessEqual(seen, {line for line in STATE_COLOURS if line in self.browser.text("legend")})

    def test_numbers_of_blocks_are_heat_maps_with_their_ends(self):
        """Those that viewer.command compares with `hmlfc inspect`, and disparities and PSNR."""
        middles = [(4 * x + 2, 4 * y + 2) for y in range(ROWS) for x in range(COLUMNS)]
        original = "--original", "views"
        address = self.look("a.hmlfc", *original, stage="sample")
        arrays, under = self.blocks(address), self.colours(middles)
        units = {"bits": "bits", "read": "bits", "level_counts": "levels", "steps": "", "disparities": "pixels a column", "psnr": "dB"}
        for name, unit in units.items():
            self.look("a.hmlfc", *original, stage="sample", overlay=name)
            numbers = [None if number == 0 and name in ("level_counts", "steps") else number for number in arrays[name]]
            known = [number for number in numbers if number is not None]
            least, most = min(known), max(known)
            self.assertGreater(most, least, name)
            self.assertIn(f"{least:g}{most:g} {unit}", self.browser.text("legend"))
            for place, (number, colour, below) in enumerate(zip(numbers, self.colours(middles), under)):
                over = below if number is None else heat((number - least) / (most - least))
                mixed = [OPACITY * a + (1 - OPACITY) * b for a, b in zip(over, below)]
                self.close_to(colour, mixed, f"{name} of block {place}")

    def blocks(self, address):
        for server in self.servers.values():
            if server.address == address:
                return server.json("blocks", {"view": ",".join(map(str, VIEW)), "plane": "Y"})
        raise AssertionError(address)

    def test_vectors_are_drawn_where_they_point(self):
        address = self.look(stage="parent", show="vectors")
        longest = max(self.blocks(address)["vectors"], key=lambda vector: abs(vector[3]) + abs(vector[4]))
        block, _, _, dx, dy = longest
        self.assertGreater(abs(dx) + abs(dy), 1)
        x, y = 4 * (block % COLUMNS) + 2, 4 * (block // COLUMNS) + 2
        scale, left, top = self.placement()
        along = [self.browser.pixels("picture", int(left + (x + part * dx) * scale) - 1, int(top + (y + part * dy) * scale) - 1, 3, 3)
                 for part in (0.25, 0.5, 0.75)]
        for pixels in along:
            greenest = max(pixels[1::3])
            self.assertGreater(greenest, 90, "no arrow there")

    def test_reference_images_have_colours(self):
        address = self.look(overlay="references")
        images = {f"image {row},{col}" for _, row, col, *_ in self.blocks(address)["vectors"]}
        for image in images:
            self.assertIn(image, self.browser.text("legend"))
        first = {}
        for block, row, col, *_ in self.blocks(address)["vectors"]:
            first.setdefault(block, (row, col))
        order = list(dict.fromkeys((row, col) for _, row, col, *_ in self.blocks(address)["vectors"]))
        middles = [(4 * (block % COLUMNS) + 2, 4 * (block // COLUMNS) + 2) for block in first]
        drawn = self.colours(middles)
        self.look()
        for image, colour, below in zip(first.values(), drawn, self.colours(middles)):
            mixed = [OPACITY * a + (1 - OPACITY) * grey(below) for a in IMAGES[order.index(image) % 8]]
            self.close_to(colour, mixed, f"image {image}")

    def test_hover_shows_the_values(self):
        self.look(stage="sample")
        block = 10, 6
        level = self.inspect(block)["levels"][-1]
        self.move_to(41, 26).perform()
        text = self.browser.until("values", lambda: self.browser.text("hover"))
        self.assertIn("block x 10, y 6 · sample x 41, y 26", text)
        self.assertIn(f"sample {level['stages']['sample']['values'][2][1]}", text)
        self.assertIn(level["state"], text)
        for vector in level["vectors"]:
            image = vector["image"]
            self.assertIn(f"({vector['x']:g}, {vector['y']:g}) to image row {image['row']}, column {image['col']}", text)

    def test_a_click_pins_the_block_with_all_its_fields(self):
        for file in "a.hmlfc", "tree.hmlfc":
            self.look(file)
            self.move_to(41, 26).click().perform()
            self.shown(block="10,6")
            self.browser.until("the block", lambda: self.browser.text("block"))
            printed = self.hmlfc("inspect", file, "--view", "1,3", "--plane", "Y", "--block", "10,6")
            lines = re.findall(r"(?m)^ +(\w+) +(0x\w+\.\d) +(\d+(?: x \d+)?)  (\w+) +([A-Z]+-\d+)  (.*)$", printed)
            rows = self.browser.script(
                "return [...document.querySelectorAll('.fields tbody tr')].map((row) =>"
                "  [...row.cells].map((cell) => cell.textContent))")
            self.assertEqual([(row[0], row[1], row[2], row[3], row[6]) for row in rows], [line[:5] for line in lines])
            for row, line in zip(rows, lines):
                self.assertTrue(row[5].startswith(line[5].strip()), (row, line))
            numbers = [int(number) for number in self.browser.script(
                "return [...document.querySelectorAll('.matrix:last-of-type td')].slice(-16).map((cell) => cell.textContent)")]
            sample = self.inspect((10, 6), file=file)["levels"][-1]["stages"]["sample"]["values"]
            self.assertEqual(numbers, sum(sample, []))

    def test_keys_move_the_pin_and_its_reference_is_a_click_away(self):
        from selenium.webdriver.common.keys import Keys

        self.look(block="10,6")
        for key, view in (".", "1,4"), (".", "2,0"), (",", "1,4"), (",", "1,3"):
            self.browser.element("picture").send_keys(key)
            self.shown(view=view)
        self.browser.element("picture").send_keys(Keys.ARROW_RIGHT)
        self.shown(block="11,6")
        self.browser.until("its panel", lambda: "Block x 11, y 6" in self.browser.text("block"))
        vectors = self.inspect((11, 6))["levels"][-1]["vectors"]
        self.assertTrue(vectors)
        image = f"{vectors[0]['image']['row']},{vectors[0]['image']['col']}"
        button = self.browser.page.find_element("xpath", f"//button[contains(., 'reference image {image}')]")
        button.click()
        self.shown(view=image, block="11,6")

    def test_samples_show_their_values_from_24_pixels_on(self):
        self.look(stage="sample")
        for zoom, written in (("+" * 3, False), ("+" * 16, True)):
            self.browser.element("picture").send_keys(zoom)
            scale, left, top = self.placement()
            x, y = int((500 - left) / scale), int((300 - top) / scale)
            cell = [int(left + x * scale) + 1, int(top + y * scale) + 1, int(scale) - 2, int(scale) - 2]
            self.assertEqual(len(set(self.browser.pixels("picture", *cell)[::3])) > 1, written, f"{scale} pixels a sample")

    def test_levels_show_ancestors(self):
        self.look("tree.hmlfc", levels="1", stage="sample", block="3,4")
        report = self.inspect((3, 4), "--levels", "1", file="tree.hmlfc")
        grey = report["levels"][-1]["stages"]["sample"]["values"][1][2]
        self.assertEqual(self.at(14, 17), (grey, grey, grey))

    def test_chroma_of_half_the_size(self):
        self.look("tree.hmlfc", plane="Co", stage="sample", block="2,3")
        report = self.hmlfc_json("inspect", "tree.hmlfc", "--view", "1,3", "--plane", "Co", "--block", "2,3")
        grey = 128 + report["levels"][-1]["stages"]["sample"]["values"][0][1]
        self.assertEqual(self.at(9, 12), (grey, grey, grey))

    def test_where_the_bytes_go(self):
        self.look("tree.hmlfc")
        self.browser.page.find_element("css selector", "#totals summary").click()
        self.browser.until("the totals", lambda: "Blocks by step" in self.browser.text("totals-body"))
        info = self.hmlfc_json("info", "tree.hmlfc")
        text = re.sub(r"\s", "", self.browser.text("totals-body"))
        for name, size in info["sections"].items():
            self.assertIn(f"{name}{size}bytes", text)
        rows = self.browser.script(
            "return [...document.querySelectorAll('.histogram')].map((table) => [table.caption.textContent,"
            "  [...table.rows].map((row) => [row.cells[0].textContent, Number(row.cells[2].textContent.replace(/\\s/g, ''))])])")
        states = dict(dict(rows)["Blocks by state"])
        self.assertEqual(list(states.values()), list(info["states"].values()))
        residuals = info["states"]["residual"] + info["states"]["motion_residual"]
        self.assertEqual(sum(count for _, count in dict(rows)["Blocks by levels of their values"]), residuals)

    def test_rate_maps_have_the_bytes_of_every_image(self):
        """On a grid that has not as many rows as columns; viewer.ViewImageBytes checks the bytes."""
        self.look("wide.hmlfc")
        self.browser.page.find_element("css selector", "#totals summary").click()
        levels = self.serve("wide.hmlfc").json("totals")["images"]["levels"]
        self.assertEqual([(level["rows"], level["cols"]) for level in levels], [(2, 3), (3, 6)])
        maps = self.browser.until("the maps", lambda: self.browser.page.find_elements("css selector", "canvas.rates"))
        self.assertEqual(len(maps), len(levels))
        for canvas, level in zip(maps, levels):
            rows, cols, images = level["rows"], level["cols"], level["images"]
            self.assertEqual(canvas.size, {"width": 16 * cols, "height": 16 * rows})
            least, most = min(images), max(images)
            self.assertGreater(most, least)
            grouped = lambda number: f"{number:,}".replace(",", " ")
            said = re.sub(r"\s", " ", canvas.accessible_name)
            self.assertEqual(said, f"Level {level['level']}: {grouped(least)} to {grouped(most)} bytes an image")
            colours = self.browser.colours(canvas, [[16 * (at % cols) + 8, 16 * (at // cols) + 8] for at in range(rows * cols)])
            for at, (colour, size) in enumerate(zip(colours, images)):
                self.close_to(colour, heat((size - least) / (most - least)), f"image {at} of level {level['level']}")
            row, col = rows - 1, 1
            self.browser.actions().move_to_element_with_offset(canvas, 16 * col + 8 - 8 * cols, 16 * row + 8 - 8 * rows).perform()
            title = self.browser.until("the bytes", lambda: canvas.get_attribute("title"))
            self.assertEqual(re.sub(r"\s", " ", title), f"image {row},{col}: {grouped(images[cols * row + col])} bytes")

    def test_lines_between_blocks_and_tiles(self):
        self.look(stage="sample")
        scale, left, top = self.placement()
        column = lambda at: [[int(left + at * scale), int(top + (y + 0.5) * scale)] for y in range(1, HEIGHT, 7)]
        plain = {at: self.browser.colours("picture", column(at)) for at in (4, 12, 16, 32, 64)}
        for show, drawn in ("blocks", {4, 12, 16, 32, 64}), ("tiles", {32, 64}):
            self.look(stage="sample", show=show)
            changed = {at for at, before in plain.items() if self.browser.colours("picture", column(at)) != before}
            self.assertEqual(changed, drawn, show)

    def test_stages_are_blended_with_the_picture(self):
        from selenium.webdriver.common.keys import Keys

        places = [(x, y) for y in range(2, HEIGHT, 9) for x in range(1, WIDTH, 13)]
        self.look()
        picture = self.colours(places)
        self.look(stage="residual")
        residual = self.colours(places)
        self.browser.element("blend").send_keys(*[Keys.ARROW_RIGHT] * 5)
        self.browser.until("a blend", lambda: self.browser.text("blend-value") == "25 %" and self.colours(places) != residual)
        for mixed, stage, view in zip(self.colours(places), residual, picture):
            self.close_to(mixed, [0.75 * a + 0.25 * b for a, b in zip(stage, view)], "a blended sample")

    def test_tile_groups_are_those_of_the_tiles_numbers(self):
        """IDX-1 to IDX-3, for a stream without motion tiles."""
        info = self.hmlfc_json("info", "tree.hmlfc")
        half = info["chroma"] == "420"
        tiles = 6 + 2 * (2 * 1 if half else 6)  # 96 x 64 samples are 3 x 2 tiles of Y
        above = sum(level["rows"] * level["cols"] for level in info["levels"][:-1])
        first = (above + 5 * VIEW[0] + VIEW[1]) * tiles
        self.look("tree.hmlfc", overlay="groups")
        groups = {(first + tile) // 64 for tile in range(6)}
        self.assertEqual({int(word) for word in re.findall(r"group (\d+)", self.browser.text("legend"))}, groups)
        self.look("tree.hmlfc", overlay="groups", plane="Cg", stage="sample")
        last = first + tiles - 1
        self.assertIn(f"group {last // 64}", self.browser.text("legend"))

    def test_the_original_is_compared(self):
        self.look("a.hmlfc", "--original", "views", stage="difference")
        self.hmlfc("decode", "a.hmlfc", "--view", "1,3", "-o", "decoded")
        made, original = (read_png(self.folder / folder / "01_03.png").samples for folder in ("decoded", "views"))
        for x, y in (5, 7), (40, 30), (95, 63):
            at = 3 * (WIDTH * y + x)
            expected = tuple(max(0, min(255, 128 + 4 * (original[at + k] - made[at + k]))) for k in range(3))
            self.assertEqual(self.at(x, y), expected)
        self.look("a.hmlfc", "--original", "views", stage="original")
        self.assertEqual(self.at(40, 30), tuple(original[3 * (WIDTH * 30 + 40) :][:3]))
        self.look("a.hmlfc")
        self.assertEqual(self.browser.page.find_elements("css selector", "option[value=difference]"), [])

    def test_a_stream_that_does_not_open(self):
        stream = (self.folder / "a.hmlfc").read_bytes()
        (self.folder / "head.hmlfc").write_bytes(stream[:8] + b"\xff" + stream[9:])
        self.open("", "head.hmlfc")
        text = self.browser.until("the error", lambda: self.browser.text("warning"))
        self.assertRegex(text, r"head\.hmlfc: bad_\w+ in header at byte \d+")

    def test_error_blocks_are_in_the_picture(self):
        stream = bytearray((self.folder / "a.hmlfc").read_bytes())
        for at in range(len(stream) - 600, len(stream)):
            stream[at] ^= 0xFF
        (self.folder / "tiles.hmlfc").write_bytes(stream)
        address = self.open("#mode=into&view=4,4&plane=Y", "tiles.hmlfc")
        self.assertIn("bad_section_crc", self.browser.until("a notice", lambda: self.browser.text("warning")))
        self.shown(view="4,4")
        server = self.servers["tiles.hmlfc",]
        self.assertEqual(server.address, address)
        errors = server.json("blocks", {"view": "4,4", "plane": "Y"})["errors"]
        self.assertTrue(errors)
        block, text = errors[0]
        self.browser.element("picture").send_keys("n")
        self.shown(block=f"{block % COLUMNS},{block // COLUMNS}")
        x, y = 4 * (block % COLUMNS), 4 * (block // COLUMNS)
        self.assertGreater(self.at(x + 1.6, y + 1.5)[0], 200, "no red cross")
        self.move_to(x + 2, y + 2).click().perform()
        self.browser.until("the error", lambda: text in self.browser.text("block"))
        self.open("#mode=look&camera=4,4,0&geometry=plane", "tiles.hmlfc")
        self.browser.until("the error", lambda: re.search(r" in \w+ at byte ", self.browser.text("look-error")))
        self.browser.page.get_log("browser")  # the status 422 of errors


if __name__ == "__main__":
    run_in_browser()
