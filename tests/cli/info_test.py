"""info: its JSON against the header that the decoder from the specification reads."""

import resource
import struct

from program import CliTest, main

from crc32c import crc32c
from header import MAGIC, read_header

KEYS = [
    "bytes", "bpp", "ratio", "rows", "cols", "width", "height", "profile", "method", "sections",
    "depth", "chroma", "block", "window", "cluster", "tree_height", "tools", "levels", "states", "disparity",
    "rig",
]  # fmt: skip
SECTIONS = ["header", "index", "motion", "residual", "top", "other"]


class Info(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 3x5 --size 44x28 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc --profile main --references 2x4 --cluster 1x2".split())
        cls.stream = (cls.folder / "a.hmlfc").read_bytes()
        cls.header = read_header(cls.stream)
        cls.info = cls.hmlfc_json("info", "a.hmlfc")

    def test_keys(self):
        self.assertEqual(list(self.info), KEYS)
        self.assertEqual(list(self.info["sections"]), SECTIONS)

    def test_header(self):
        header, info = self.header, self.info
        for key in ("rows", "cols", "width", "height", "depth", "window", "tree_height"):
            self.assertEqual(info[key], getattr(header, key), key)
        self.assertEqual(info["cluster"], [header.cluster_rows, header.cluster_cols])
        self.assertEqual((header.rows, header.cols, header.width, header.height), (3, 5, 44, 28))
        self.assertEqual(info["block"], 1 << header.block_log2)
        self.assertEqual(info["chroma"], ["420", "444"][header.chroma_format])
        self.assertEqual((info["profile"], info["method"]), ("main", "hmlfc"))

    def test_levels(self):
        header = self.header
        rows, cols, expected = header.rows, header.cols, []
        for level in range(header.tree_height + 1):
            references = header.levels[level]
            shape = {"level": level, "rows": rows, "cols": cols}
            top = level == header.tree_height  # its images are the key images (STR-5)
            keys = [[row, col] for row in range(rows) for col in range(cols)] if top else []
            groups = {"ref_rows": references[0], "ref_cols": references[1]}
            expected.insert(0, {**shape, **groups, "key_images": len(keys), "keys": keys})
            rows, cols = -(-rows // header.cluster_rows), -(-cols // header.cluster_cols)
        self.assertEqual(self.info["levels"], expected)
        self.assertEqual(len(expected), 4)

    def test_sizes(self):
        info, size = self.info, len(self.stream)
        sections = info["sections"]
        self.assertEqual(info["bytes"], size)
        self.assertEqual(sum(sections.values()), size)
        self.assertEqual(sections["header"], self.header.header_bytes)
        self.assertEqual(sections["top"], self.header.sections[0][3])
        self.assertEqual(sections["other"], 0)
        tile = self.header.sections[3][3]
        self.assertLess(sections["motion"] + sections["residual"], tile)
        self.assertAlmostEqual(info["bpp"], 8 * size / (15 * 44 * 28), places=12)
        self.assertAlmostEqual(info["ratio"], 15 * 44 * 28 * 3 / size, places=12)

    def test_text(self):
        text = self.hmlfc("info", "a.hmlfc")
        self.assertIn("3 x 5 views of 44 x 28 pixels, 8 bits", text)
        for part in ("bpp", "residual", "level 3", "zero", "2 x 4"):
            self.assertIn(part, text)

    def test_extended(self):
        self.hmlfc(*"encode views -o e.hmlfc --references 2x3 --chroma 420".split())
        info = self.hmlfc_json("info", "e.hmlfc")
        self.assertEqual(list(info), KEYS)
        self.assertEqual((info["profile"], info["method"]), ("extended", "mc"))
        flags = struct.unpack_from("<I", (self.folder / "e.hmlfc").read_bytes(), 12)[0]
        self.assertEqual(len(info["tools"]), bin(flags).count("1"))
        self.assertIn("shared_disparity", info["tools"])
        self.assertEqual(self.info["tools"], [])
        # 2 x 2 groups, each with a key image; the other views are coded in blocks of 4 x 4.
        self.assertEqual(sum(info["states"].values()), (15 - 4) * (11 * 7 + 2 * 6 * 4))
        text = self.hmlfc("info", "e.hmlfc")
        for part in ("extended", "two_references", "4 key images"):
            self.assertIn(part, text)

    def test_encode_says_the_same(self):
        options = "--profile main --references 2x4 --cluster 1x2"
        json = self.hmlfc_json("encode", "views", "-o", "b.hmlfc", *options.split())
        for key in KEYS[:10]:
            self.assertEqual(json[key], self.info[key], key)


def stream_of(rows, cols, sections):
    """A stream of rows x cols views of one pixel, with one level and reference groups of 255x255."""
    head = MAGIC + bytes([1, 0]) + struct.pack("<HIHHII", 148, 0, rows, cols, 1, 1)
    head += bytes([8, 0, 2, 0, 1, 1, 0, 0, 0, 0, 0, 0]) + bytes(4) + bytes([255, 255, 0, 0])
    offset = 148
    for number, section in enumerate(sections, 1):
        head += struct.pack("<IIQQ", number, crc32c(section), offset, len(section))
        offset += len(section)
    return head + struct.pack("<I", crc32c(head)) + b"".join(sections)


class LargeGrid(CliTest):
    """210 KB that say they are 4096 x 4096 views, which takes minutes to walk through."""

    def limited(self, *arguments):
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
        result = self.run_hmlfc(*arguments, preexec_fn=limit)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.decode()

    def test_time_follows_the_bytes(self):
        keys, groups = 17 * 17 * 3, 4096 * 4096 * 3 // 64
        top = struct.pack("<QII", 16 * keys, 0, 0) * keys
        tables = {
            "empty.hmlfc": (bytes(groups // 64 * 16), b""),
            "records.hmlfc": (struct.pack("<QQ", 2**64 - 1, 0) * (groups // 64), struct.pack("<QQ", 0, 1 << 48) * 64),
        }
        for name, (root, records) in tables.items():
            (self.folder / name).write_bytes(stream_of(4096, 4096, [top, root, records, b""]))
            self.assertIn("disparity not counted", self.limited("info", name))
            states = self.hmlfc_json("info", name)["states"]
            self.assertEqual(states, {"zero": (4096 * 4096 - 17 * 17) * 3, "motion": 0, "motion_residual": 0, "residual": 0})


if __name__ == "__main__":
    main()
