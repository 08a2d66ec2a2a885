"""hmlfc disparity and info against the maps that docs/rendering.md, section 8, gives in Python."""

import paths  # noqa: F401
import json

from disparity_map import block_of_map
from opening import Stream
from pictures import read_png
from program import ROOT, CliTest, main

MOST_BLOCKS = 600  # of all views of a stream
STREAMS = 60


def streams():
    """Valid vectors of the suite, small and of all kinds: files."""
    manifest = json.loads((ROOT / "vectors/manifest.json").read_text())
    valid = [v for v in manifest["vectors"] if v["expect"]["outcome"] == "ok"]
    valid.sort(key=lambda vector: (vector["input"]["bytes"], vector["id"]))
    return [ROOT / "vectors" / v["input"]["file"] for v in valid]


class Depth(CliTest):
    def test_maps_of_vectors(self):
        done, levels, confidences = 0, set(), set()
        for file in streams():
            stream = Stream(file.read_bytes())
            header, (cols, rows) = stream.header, stream.geometry.blocks(0)
            views = [(r, c) for r in range(header.rows) for c in range(header.cols)]
            moves = any(stream.geometry.reference_of(image) != image for image in stream.geometry.images())
            if not moves or len(views) * rows * cols > MOST_BLOCKS:
                continue
            maps = {v: [[block_of_map(stream, *v, x, y) for x in range(cols)] for y in range(rows)] for v in views}
            self.compare(file, header, maps)
            told = [block for found in maps.values() for row in found for block in row]
            confidences |= {confidence for _, confidence in told}
            levels.add((header.tree_height, header.profile))
            done += 1
            if done == STREAMS:
                break
        self.assertEqual(done, STREAMS)
        self.assertEqual(confidences, {0, 1, 2, 3})
        self.assertGreater(len(levels), 3)

    def compare(self, file, header, maps):
        side = 2**header.block_log2
        blocks = [block for found in maps.values() for row in found for block in row]
        said = self.hmlfc_json("info", file)["disparity"]
        self.assertEqual(said["blocks"], len(blocks), file)
        self.assertEqual(said["known"], sum(confidence > 0 for _, confidence in blocks), file)
        known = [D / 256 for D, confidence in blocks if confidence > 0]
        if known:
            self.assertEqual((said["least"], said["greatest"]), (min(known), max(known)), file)
        for (row, col) in list(maps)[:: max(1, len(maps) // 3)]:
            self.hmlfc("disparity", file, "--view", f"{row},{col}", "-o", "map.16.png")
            picture = read_png(self.folder / "map.16.png")
            self.assertEqual((picture.width, picture.height), (header.width, header.height))
            found = maps[row, col]
            expected = [32768 + found[y // side][x // side][0] for y in range(header.height) for x in range(header.width)]
            self.assertEqual(picture.samples[::3], expected, f"{file} view {row},{col}")


if __name__ == "__main__":
    main()
