"""inspect: fields against the bits of the file, stages against the decoder from the specification."""

from program import CliTest, main

from block import BlockDecoder
from opening import Stream
from trace import PLANE_NAMES, trace_block

FIELD_KEYS = ["section", "byte", "bit", "bits", "name", "clause", "value"]
# Fields whose value is not the bits themselves: signed, displaced, or one of a sequence.
INDIRECT = {"min_x", "min_y", "dx", "dy", "bias", "value"}
WINDOW = 6


def stages_of(levels):
    """Level, image, name, clause and values of each stage."""
    return [
        [level["level"], [*level["image"].values()], name, stage["clause"], sum(stage["values"], [])]
        for level in levels
        for name, stage in level["stages"].items()
    ]


def vectors_of(level):
    """Reference image and vector in eighths of a sample, as a BlockDecoder gives them."""
    return [
        ((level["level"], *vector["image"].values()), (8 * vector["x"], 8 * vector["y"]))
        for vector in level["vectors"]
    ]


class Inspect(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 4x4 --size 76x44 -o views".split())
        cls.hmlfc(
            *f"encode views -o a.hmlfc --profile main --window {WINDOW} --references 2x3".split(),
            *"--threshold-ref 60 --threshold-pred 60 --chroma 444".split(),
        )
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

    def test_stages_and_vectors_are_those_of_the_specification(self):
        """Against the decoder in Python, with motion in tile records and in motion tiles."""
        self.hmlfc("encode", "views", "-o", "motion.hmlfc", "--chroma", "444", "--references", "4x4")
        views = [(row, col) for row in range(4) for col in range(4)]
        more = [(view, "Y", block) for view in views for block in ((7, 3), (12, 8))]
        states, kinds, units = set(), set(), set()
        for file, places in (("a.hmlfc", []), ("motion.hmlfc", more)):
            decoder = BlockDecoder(Stream((self.folder / file).read_bytes()))
            for view, plane, block in [*self.places(), *places]:
                levels = self.inspect(view, plane, block, file=file)["levels"]
                number = PLANE_NAMES.index(plane)
                records = trace_block(decoder, *view, number, *block)[1:]
                keys = "level", "image", "stage", "clause", "values"
                self.assertEqual(stages_of(levels), [[record[key] for key in keys] for record in records])
                for level in levels:
                    states.add(level["state"])
                    image = level["level"], *level["image"].values()
                    key = level["kind"] == "key"
                    parts = [] if key else decoder.entry(image, number, *block).parts
                    self.assertEqual(vectors_of(level), parts)
                    kinds |= {(vector["unit"], vector["clause"]) for vector in level["vectors"]}
                    images = [vector["image"] for vector in level["vectors"]]
                    self.assertTrue(all(read["image"] in images for read in level["reference_blocks"]))
                    shared = level.get("disparity", {"fields": []})["fields"]
                    units |= {field["unit"] for field in shared if "unit" in field}
        self.assertEqual(len(states - {None}), 4, states)
        self.assertEqual(kinds, {("samples", "TIL-7"), ("samples", "MOT-8")})
        fine = 1 << decoder.stream.header.disparity_precision
        self.assertEqual(units, {f"1/{fine} sample per column"})
        text = self.hmlfc(*"inspect motion.hmlfc --view 0,0 --plane Y --block 7,3".split())
        self.assertRegex(text, r"vector += \(-?[0-9.]+, -?[0-9.]+\) samples, to image \d+,\d+  MOT-8")

    def test_levels_option(self):
        whole = self.inspect((2, 1), "Y", (3, 3))
        for levels in (1, 2, 3):
            report = self.inspect((2, 1), "Y", (3, 3), "--levels", levels)
            self.assertEqual(report["levels"], whole["levels"][:levels])

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


if __name__ == "__main__":
    main()
