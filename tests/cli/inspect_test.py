"""inspect: fields against the bits of the file, stages against the specification's arithmetic."""

import json

from pictures import read_png, ycocg
from program import CliTest, main

FIELD_KEYS = ["section", "byte", "bit", "bits", "name", "clause", "value"]
# Fields whose value is not the bits themselves: signed, displaced, or one of a sequence.
INDIRECT = {"min_x", "min_y", "dx", "dy", "bias", "value"}
WINDOW = 6
RANGES = {"Y": (0, 255), "Co": (-255, 255), "Cg": (-255, 255)}


def clamp(value, low, high):
    return max(low, min(high, value))


def flat(rows):
    return [value for row in rows for value in row]


class Inspect(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 4x4 --size 76x44 -o views".split())
        cls.hmlfc(
            *f"encode views -o a.hmlfc --profile main --window {WINDOW} --references 2x3".split(),
            *"--threshold-ref 60 --threshold-pred 60 --chroma 444".split(),
        )
        cls.hmlfc(*"encode views -o exact.hmlfc --profile main --lossless --window 6".split())
        cls.stream = (cls.folder / "a.hmlfc").read_bytes()
        cls.bits = int.from_bytes(cls.stream, "little")

    def inspect(self, view, plane, block, *options, file="a.hmlfc"):
        view, block = (",".join(map(str, pair)) for pair in (view, block))
        place = ["--view", view, "--plane", plane, "--block", block]
        return self.hmlfc_json("inspect", file, *place, *options)

    def places(self):
        """Blocks of all planes, in the middle and at the borders."""
        for i, plane in enumerate(("Y", "Co", "Cg")):
            for j, block in enumerate([(0, 0), (18, 10), (7, 3), (12, 8), (18, 0), (5, 6)]):
                yield ((i + j) % 4, j % 4), plane, block

    def test_keys(self):
        report = self.inspect((1, 2), "Y", (3, 4))
        self.assertEqual(list(report), ["view", "plane", "block", "levels", "cost"])
        self.assertEqual(report["view"], {"row": 1, "col": 2})
        self.assertEqual((report["plane"], report["block"]), ("Y", [3, 4]))
        self.assertEqual(list(report["cost"]), ["walks", "fields", "bits", "bytes", "steps"])
        for level in report["levels"]:
            keys = "level image kind state fields vectors reference_blocks stages".split()
            self.assertEqual(list(level), keys)

    def test_levels_run_down_the_tree(self):
        report = self.inspect((3, 1), "Y", (2, 2))
        got = [(level["level"], tuple(level["image"].values())) for level in report["levels"]]
        self.assertEqual(got, [(2, (0, 0)), (1, (1, 0)), (0, (3, 1))])
        # Groups of 2 x 3 in a grid of 4 x 4 have their references in rows 0, 2 and columns 1, 3.
        kinds = {
            view: self.inspect(view, "Y", (0, 0))["levels"][2]["kind"]
            for view in [(0, 1), (2, 3), (1, 1), (0, 0)]
        }
        self.assertEqual(list(kinds.values()), ["reference", "reference", "predictive", "predictive"])
        self.assertEqual(report["levels"][0]["kind"], "key")

    def test_every_address_holds_its_value(self):
        names = set()
        for place in self.places():
            for level in self.inspect(*place)["levels"]:
                walks = [level["fields"], *(b["fields"] for b in level["reference_blocks"])]
                for field in (field for walk in walks for field in walk):
                    in_samples = field["name"] in ("min_x", "min_y", "dx", "dy")
                    unit = ["unit"] if in_samples else []
                    self.assertEqual(list(field), FIELD_KEYS + unit)
                    names.add(field["name"])
                    if field["name"] in INDIRECT - {"min_x", "min_y"}:
                        continue
                    at = field["byte"] * 8 + field["bit"]
                    value = self.bits >> at & (1 << field["bits"]) - 1
                    value -= WINDOW if field["name"] in ("min_x", "min_y") else 0
                    self.assertEqual(field["value"], value, field)
        tile = {"motion_mode", "residual_mode", "sign_mode", "codes_x", "level_base", "level_delta"}
        self.assertLessEqual(tile | INDIRECT | {"mask", "first", "tile_mask", "end"}, names)

    def test_stages_follow_the_arithmetic(self):
        states = set()
        for view, plane, block in self.places():
            low, high = RANGES[plane]
            parent = None
            for level in self.inspect(view, plane, block)["levels"]:
                stages = {name: flat(stage["values"]) for name, stage in level["stages"].items()}
                if level["kind"] == "key":
                    self.assertEqual(list(stages), ["sample"])
                    parent = stages["sample"]
                    continue
                states.add(level["state"])
                self.assertEqual(stages["parent"], parent)
                self.check_prediction(level, stages, low, high)
                self.check_residual(level, stages, low, high)
                parent = stages["sample"]
        self.assertEqual(len(states), 4, states)

    def check_prediction(self, level, stages, low, high):
        motion = level["state"].startswith("motion")
        self.assertEqual("reference" in stages, motion)
        expected = stages["parent"]
        if motion:
            fields = {field["name"]: field["value"] for field in level["fields"]}
            minus = fields["sign_mode"] == 1 or fields.get("sign") == 1
            sign = -1 if minus else 1
            expected = [
                clamp(p + sign * r, low, high) for p, r in zip(expected, stages["reference"])
            ]
        self.assertEqual(stages["prediction"], expected)

    def check_residual(self, level, stages, low, high):
        residual = level["state"] in ("motion and residual", "residual only")
        self.assertEqual("residual" in stages, residual)
        expected = stages["prediction"]
        if residual:
            named = {field["name"]: field["value"] for field in level["fields"]}
            values = [f["value"] for f in level["fields"] if f["name"] == "value"]
            code = named["level_base"] + named["level_delta"]
            counts = [1, 2, 3] + [k << e for e in range(13) for k in (4, 5, 6)]
            bound = high - low
            self.assertEqual(
                stages["residual"],
                [clamp(v - (counts[code] >> 1) + named["bias"], -bound, bound) for v in values],
            )
            expected = [
                clamp(p + r, low, high) for p, r in zip(expected, stages["residual"])
            ]
        self.assertEqual(stages["sample"], expected)

    def test_vectors_of_tile_records(self):
        """TIL-7: the vector is that of the record, in whole samples, to the group's reference."""
        for view, plane, block in self.places():
            for level in self.inspect(view, plane, block)["levels"]:
                fields = {field["name"]: field["value"] for field in level["fields"]}
                if "dx" not in fields:
                    self.assertEqual(level["vectors"], [])
                    continue
                (vector,) = level["vectors"]
                self.assertEqual((vector["x"], vector["y"]), (fields["dx"], fields["dy"]))
                self.assertEqual((vector["unit"], vector["clause"]), ("samples", "TIL-7"))
                images = [block["image"] for block in level["reference_blocks"]]
                self.assertTrue(all(image == vector["image"] for image in images))

    def test_vectors_of_motion_tiles(self):
        """MOT-8, computed here from the fields; units are those of the header's precisions."""
        self.hmlfc("encode", "views", "-o", "motion.hmlfc", "--chroma", "444", "--references", "4x4")
        header = (self.folder / "motion.hmlfc").read_bytes()[:44]
        window, precision, fine = header[31], header[35], header[36]
        row_scale = int.from_bytes(header[39:40], "little", signed=True)
        bound, shift = window << precision, fine - precision
        seen = set()
        views = [(row, col) for row in range(4) for col in range(4)]
        more = [(view, "Y", block) for view in views for block in ((7, 3), (12, 8))]
        for view, plane, block in [*self.places(), *more]:
            for level in self.inspect(view, plane, block, file="motion.hmlfc")["levels"]:
                choice, disparity, units = self.motion(level)
                if len(level["vectors"]) != 1 or choice is None:
                    continue
                (vector,) = level["vectors"]
                rows, cols = (vector["image"][key] - level["image"][key] for key in ("row", "col"))
                x, y = disparity * cols, disparity * row_scale * rows
                x, y = (x + (1 << shift >> 1)) >> shift, (y + (1 << shift + 3)) >> shift + 4
                expected = [clamp(v, -bound, bound) / (1 << precision) for v in (x, y)]
                self.assertEqual([vector["x"], vector["y"]], expected, level)
                self.assertEqual((vector["unit"], vector["clause"]), ("samples", "MOT-8"))
                self.assertLessEqual(units, {f"1/{1 << fine} sample per column"})
                seen.add((vector["x"], vector["y"]))
        self.assertGreater(len(seen), 3)
        text = self.hmlfc(*"inspect motion.hmlfc --view 0,0 --plane Y --block 7,3".split())
        self.assertRegex(text, r"vector += \(-?[0-9.]+, -?[0-9.]+\) samples, to image \d+,\d+  MOT-8")

    def motion(self, level):
        """The choice of the block's palette entry, its disparity and the units; None: none shared."""
        entries, index = [], 0
        for field in level.get("motion_fields", []):
            if field["name"] in ("choice", "index"):
                index = field["value"]
            if field["name"] == "choice":
                entries.append([field["value"], 0])
            if field["name"] == "explicit_x":
                entries[-1][1] = field["value"]
        if not entries:
            return None, 0, set()
        choice, explicit = entries[index]
        if choice == 10:
            return choice, explicit, set()
        if not 1 <= choice <= 9:
            return None, 0, set()
        fields = level.get("disparity", {"fields": []})["fields"]
        units = {field["unit"] for field in fields if "unit" in field}
        return choice, sum(f["value"] for f in fields if f["name"] == "disparity"), units

    def test_last_samples_are_the_pixels(self):
        for i, plane in enumerate(("Y", "Co", "Cg")):
            for view, block in [((0, 0), (0, 0)), ((3, 2), (18, 10)), ((1, 3), (7, 5))]:
                report = self.inspect(view, plane, block, file="exact.hmlfc")
                picture = read_png(self.folder / "views" / f"{view[0]:02}_{view[1]:02}.png")
                for y, row in enumerate(report["levels"][-1]["stages"]["sample"]["values"]):
                    for x, value in enumerate(row):
                        pixel = picture.pixel(block[0] * 4 + x, block[1] * 4 + y)
                        self.assertEqual(value, ycocg(pixel)[i])

    def test_levels_option(self):
        whole = self.inspect((2, 1), "Y", (3, 3))
        for levels in (1, 2, 3):
            report = self.inspect((2, 1), "Y", (3, 3), "--levels", levels)
            self.assertEqual(report["levels"], whole["levels"][:levels])

    def test_cost(self):
        for place in self.places():
            report = self.inspect(*place)
            walks = [
                walk
                for level in report["levels"]
                for walk in [level["fields"], *(b["fields"] for b in level["reference_blocks"])]
                if walk
            ]
            fields = [field for walk in walks for field in walk]
            cost = report["cost"]
            self.assertEqual(cost["walks"], len(walks))
            self.assertLessEqual(cost["walks"], 5 * 2 + 1)
            self.assertEqual(cost["fields"], len(fields))
            self.assertEqual(cost["bits"], sum(field["bits"] for field in fields))
            self.assertEqual(cost["bytes"], -(-cost["bits"] // 8))
            self.assertLessEqual(cost["steps"], 63 * len(walks))

    def test_text_tells_what_json_tells(self):
        for view, plane, block in self.places():
            report = self.inspect(view, plane, block)
            place = f"--view {view[0]},{view[1]} --plane {plane} --block {block[0]},{block[1]}"
            text = self.hmlfc("inspect", "a.hmlfc", *place.split())
            self.assertIn(f"Block {block[0]},{block[1]} of plane {plane}", text)
            self.assertIn(f"{report['cost']['walks']} walks", text)
            for level in report["levels"]:
                self.assertIn(f"Level {level['level']}, image", text)
                repeated = "quad_blocks", "level_delta", "value"
                for before, field in zip([None, *level["fields"]], level["fields"]):
                    if before and before["name"] == field["name"] and field["name"] in repeated:
                        continue
                    self.assertIn(f"0x{field['byte']:06x}.{field['bit']}", text)
                for name, stage in level["stages"].items():
                    self.assertIn(f"{name} {stage['clause']}", text)
                    for row in stage["values"]:
                        self.assertRegex(text, r"(^|\s)" + r"\s+".join(map(str, row)) + r"(\s|$)")

    def test_json_is_json(self):
        place = "--view 0,0 --plane Cg --block 1,1 --json".split()
        json.loads(self.hmlfc("inspect", "a.hmlfc", *place))


if __name__ == "__main__":
    main()
