"""disparity: the same numbers in each format, near those that synth knows; what info says of them; compare of maps."""

import json
import struct

from pictures import chunks_of, read_png
from program import CORRUPT, DIFFERENT, INPUT, USAGE, CliTest, main


def read_pfm(path):
    """(width, height, numbers row by row from the top) of a grey little-endian PFM."""
    kind, sides, scale, numbers = path.read_bytes().split(b"\n", 3)
    assert (kind, scale) == (b"Pf", b"-1.0")
    width, height = map(int, sides.split())
    rows = [struct.unpack_from(f"<{width}f", numbers, 4 * width * y) for y in range(height)]
    assert len(numbers) == 4 * width * height
    return width, height, [number for row in reversed(rows) for number in row]


class Disparity(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 3x5 --size 96x64 --baseline 4 -o views --disparity truth".split())
        cls.hmlfc(*"encode views -o a.hmlfc --references 3x5 --quality 80".split())
        cls.hmlfc(*"encode views -o main.hmlfc --profile main --method mc --references 3x5 --quality 60".split())

    def numbers(self, *arguments, name="map.pfm"):
        text = self.hmlfc("disparity", *arguments, "-o", name, "--force")
        self.assertTrue(text.startswith(f"{name}: view "), text)
        width, height, numbers = read_pfm(self.folder / name)
        self.assertEqual((width, height), (96, 64))
        return numbers

    def truth(self, name):
        return read_pfm(self.folder / "truth" / name)[2]

    def test_near_the_truth(self):
        for view in ("0,0", "1,2", "2,4"):
            with self.subTest(view=view):
                row, col = view.split(",")
                true = self.truth(f"0{row}_0{col}.pfm")
                found = self.numbers("a.hmlfc", "--view", view)
                self.assertGreater(max(true) - min(true), 1.5)
                near = sum(abs(a - b) < 0.3 for a, b in zip(found, true))
                self.assertGreater(near / len(true), 0.7)

    def test_the_other_sign(self):
        numbers = self.numbers("a.hmlfc")
        self.assertEqual(self.numbers("a.hmlfc", "--positive", "near", name="hci.pfm"), [-number for number in numbers])
        self.hmlfc(*"disparity a.hmlfc --positive near -o hci.16.png".split())
        wide = read_png(self.folder / "hci.16.png").samples[::3]
        self.assertEqual(wide, [round(32768 - 256 * number) for number in numbers])
        result = self.run_hmlfc("compare", "hci.pfm", "truth/01_02.pfm")
        self.assertIn("opposite signs", result.stderr.decode())

    def write_pfm(self, name, rows, order="<"):
        head = f"Pf\n{len(rows[0])} {len(rows)}\n{'-1.0' if order == '<' else '1'}\n".encode()
        numbers = b"".join(struct.pack(f"{order}{len(row)}f", *row) for row in reversed(rows))
        (self.folder / name).write_bytes(head + numbers)

    def test_maps_are_compared_as_by_hci(self):
        self.write_pfm("truth.pfm", [[1, 2, 3], [4, 5, float("inf")]])
        self.write_pfm("found.pfm", [[1, 2.02, 3.05], [4.5, 5, 6]], ">")
        result = self.run_hmlfc("compare", "found.pfm", "truth.pfm", "--json")
        self.assertEqual((result.returncode, result.stderr), (DIFFERENT, b""))
        error = json.loads(result.stdout)
        self.assertEqual((error["pixels"], error["unknown"], error["identical"]), (5, 1, False))
        self.assertEqual(error["badpix"], {"0.07": 20, "0.03": 40, "0.01": 60})
        self.assertAlmostEqual(error["mean_abs_error"], (0.02 + 0.05 + 0.5) / 5, places=6)
        self.assertAlmostEqual(error["mse_x100"], 100 * (0.02**2 + 0.05**2 + 0.5**2) / 5, places=5)
        self.assertIn("Identical", self.hmlfc(*"compare found.pfm truth.pfm --rect 0,0,1,1".split()))
        self.write_pfm("wide.pfm", [[1, 2, 3, 4]])
        (self.folder / "colour.pfm").write_bytes(b"PF\n1 1\n-1.0\n" + bytes(12))
        (self.folder / "short.pfm").write_bytes((self.folder / "truth.pfm").read_bytes()[:-1])
        for other, says in [("wide.pfm", "3 x 2 versus 4 x 1"), ("colour.pfm", "three channels"), ("short.pfm", "23 bytes")]:
            self.refused(INPUT, "compare", "truth.pfm", other, says=says)
        self.refused(USAGE, "compare", "truth.pfm", "a.hmlfc", says="hmlfc disparity")

    def test_the_middle_view_is_the_default(self):
        self.assertEqual(self.numbers("a.hmlfc"), self.numbers("a.hmlfc", "--view", "1,2"))

    def test_formats(self):
        numbers = self.numbers("a.hmlfc")
        self.hmlfc("disparity", "a.hmlfc", "-o", "map.16.PNG")
        wide = read_png(self.folder / "map.16.PNG").samples
        self.assertEqual(wide[::3], [round(32768 + 256 * number) for number in numbers])
        self.assertEqual(dict(chunks_of((self.folder / "map.16.PNG").read_bytes()))["IHDR"][8:10], bytes([16, 0]))
        self.hmlfc("disparity", "a.hmlfc", "-o", "map.png")
        self.assertEqual(dict(chunks_of((self.folder / "map.png").read_bytes()))["IHDR"][8:10], bytes([8, 0]))
        grey = read_png(self.folder / "map.png").samples
        nearest, farthest = min(numbers), max(numbers)
        for value, number in zip(grey[::3], numbers):
            self.assertAlmostEqual(value, 255 * (farthest - number) / (farthest - nearest), delta=0.51)
        self.assertEqual((min(grey), max(grey)), (0, 255))

    def test_profile_main_knows_some(self):
        self.assertEqual(set(self.numbers("main.hmlfc", "--view", "1,2")), {0})  # the key image
        self.assertIn("unknown", self.hmlfc("disparity", "main.hmlfc", "--view", "1,2", "-o", "none.png"))
        self.assertEqual(set(read_png(self.folder / "none.png").samples), {0})
        self.assertGreater(len(set(self.numbers("main.hmlfc", "--view", "1,3"))), 3)

    def test_info(self):
        numbers = [n for r in range(3) for c in range(5) for n in self.numbers("a.hmlfc", "--view", f"{r},{c}")]
        range_ = self.hmlfc_json("info", "a.hmlfc")["disparity"]
        self.assertEqual((range_["least"], range_["greatest"]), (min(numbers), max(numbers)))
        self.assertEqual(range_["known"], range_["blocks"])
        self.assertEqual(range_["blocks"], 15 * 96 * 64 // 16)
        text = self.hmlfc("info", "a.hmlfc")
        self.assertIn(f"disparity {min(numbers):.2f} to {max(numbers):.2f} pixels a column, known for 100.0 %", text)
        partly = self.hmlfc_json("info", "main.hmlfc")["disparity"]
        self.assertLess(partly["known"], partly["blocks"])

    def test_refused(self):
        self.refused(USAGE, "disparity", "a.hmlfc", "-o", "map.txt", says=["map.txt", "*.pfm"])
        self.refused(USAGE, "disparity", "a.hmlfc", "-o", "unmade.pfm", "--view", "3,0", says="3,0")
        self.refused(USAGE, "disparity", "a.hmlfc", "-o", "nowhere/map.pfm", says="nowhere")
        damaged = bytearray((self.folder / "a.hmlfc").read_bytes())
        damaged[-1] ^= 1
        (self.folder / "bad.hmlfc").write_bytes(damaged)
        self.refused(CORRUPT, "disparity", "bad.hmlfc", "-o", "unmade.pfm", says="bad_section_crc")


if __name__ == "__main__":
    main()
