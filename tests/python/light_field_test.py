"""hmlfc.open and what a light field gives, against the program."""

import copy
import json
import os
import pickle
import threading
from pathlib import Path

import numpy as np
from python_case import (
    DEEP, STREAM, VECTORS, CliTest, RangeServer, hmlfc, main, needs_addresses, picture, read_pfm
)  # fmt: skip


class LightFieldTest(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc("decode", STREAM, "-o", "views")
        cls.lf = hmlfc.open(STREAM)
        rows, cols = cls.lf.shape[:2]
        cls.views = np.array(
            [[picture(cls.folder / f"views/{r:02}_{c:02}.png") for c in range(cols)] for r in range(rows)]
        )

    def test_what_it_is(self):
        self.assertEqual((self.lf.shape, self.lf.dtype, self.lf.depth), ((5, 5, 40, 40, 3), np.uint8, 8))
        info = json.loads(self.hmlfc("info", STREAM, "--json"))
        self.assertEqual(self.lf.info(), info)
        self.assertEqual((self.lf.profile, self.lf.features), (info["profile"], info["tools"]))
        self.assertEqual((self.lf.ndim, self.lf.size, len(self.lf)), (5, self.views.size, 5))
        shape = "of shape (5, 5, 40, 40, 3), depth 8, profile extended>"
        self.assertEqual(repr(self.lf), f"<hmlfc.LightField '{STREAM}' {shape}")
        self.assertEqual(repr(hmlfc.open(STREAM.read_bytes())), f"<hmlfc.LightField in memory {shape}")

    def test_it_is_an_array_to_numpy(self):
        np.testing.assert_array_equal(np.asarray(self.lf), self.views)
        for row, expected in zip(self.lf, self.views, strict=True):
            np.testing.assert_array_equal(row, expected)
        self.assertEqual(np.array(self.lf, np.float32).dtype, np.float32)
        self.assertEqual(np.mean(self.lf), np.mean(self.views))
        self.assertEqual((self.views.max() in self.lf, 256 in self.lf), (True, False))
        with self.assertRaisesRegex(ValueError, "copy=False"):
            self.lf.__array__(copy=False)

    def test_indices_give_what_numpy_gives(self):
        for key in [
            np.s_[3, 4],
            np.s_[-1, -5],
            np.s_[3, 4, 10:33, 8:39],
            np.s_[2, 1, 7],
            np.s_[2, 1, 7, -3],
            np.s_[0, 0, ::-1, ::-1],
            np.s_[0, 0, 30:3:-4, 5::7],
            np.s_[1:4, ::2, 5:6, 7],
            np.s_[:, 2, 20],
            np.s_[0, 0, 9:9],
            np.s_[4:1, 0],
            np.s_[np.int64(3), np.uint8(1), 39:99],
            np.s_[2],
            np.s_[-1],
            np.s_[1:3],
            np.s_[...],
            np.s_[:, 0],
            np.s_[..., 1],
            np.s_[::-2, 1, ..., 2:0:-1],
            np.s_[..., ::8, ::-8, :],
            np.s_[1, 2, ..., 3, 4, 0],
        ]:
            with self.subTest(key=key):
                found = self.lf[key]
                np.testing.assert_array_equal(found, self.views[key])
                self.assertEqual(found.dtype, np.uint8)

    def test_indices_outside(self):
        for key, says in [
            (np.s_[5, 0], "view 5,0 does not exist: rows 0 to 4, columns 0 to 4"),
            (np.s_[0, -6], "view 0,-6 does not exist"),
            (np.s_[9], "row 9 does not exist: 0 to 4"),
            (np.s_[:, 9], "column 9 does not exist: 0 to 4"),
            (np.s_[0, 0, 40], "row of pixels 40 does not exist: 0 to 39"),
            (np.s_[0, 0, 0, -41], "column of pixels -41"),
            (np.s_[0, 0, 0, 0, 3], "channel 3"),
            (np.s_[0, 0, 0, 0, 0, 0], "up to 5 indices"),
            (np.s_[..., 0, ...], "one ..."),
        ]:
            with self.subTest(key=key), self.assertRaisesRegex(IndexError, says):
                self.lf[key]
        for key in [np.s_[0.5, 0], np.s_[[1, 2]], np.s_[True], np.s_[None, 0], np.array([0, 1])]:
            with self.subTest(key=key), self.assertRaisesRegex(TypeError, "an integer, a slice or"):
                self.lf[key]
        for ask in [self.lf.disparity, self.lf.disparity_map, lambda *view: self.lf.block(*view, "Y", 0, 0)]:
            with self.assertRaisesRegex(IndexError, "view 0,5 does not exist"):
                ask(0, 5)
        for place in [(10, 0), (0, -1)]:
            with self.assertRaisesRegex(IndexError, f"block {place[0]},{place[1]} of plane Y does not exist"):
                self.lf.block(0, 0, "Y", *place)

    def test_closing(self):
        with hmlfc.open(STREAM) as lf:
            self.assertFalse(np.may_share_memory(lf[0, 0], lf[0, 0]))
        lf.close()
        for use in [len, np.asarray, pickle.dumps, lambda lf: lf[0, 0], lambda lf: lf.shape, lambda lf: lf.render()]:
            with self.assertRaisesRegex(ValueError, "is closed"):
                use(lf)
        self.assertEqual(repr(lf), f"<hmlfc.LightField '{STREAM}', closed>")
        data = bytearray(STREAM.read_bytes())
        with hmlfc.open(data), self.assertRaises(BufferError):
            data.clear()
        data.clear()

    @needs_addresses
    def test_pickles_and_copies(self):
        with RangeServer(STREAM) as server:
            (self.folder / "k.hmlfc").symlink_to(STREAM)
            sources = [os.path.relpath(self.folder / "k.hmlfc"), server.address, bytearray(STREAM.read_bytes())]
            for source in sources:
                pickled = pickle.dumps(hmlfc.open(source))
                self.assertEqual(len(pickled) > STREAM.stat().st_size, not isinstance(source, str))
                here = os.getcwd()
                try:
                    os.chdir("/")
                    for again in [pickle.loads(pickled), copy.deepcopy(pickle.loads(pickled))]:
                        np.testing.assert_array_equal(again[1, 2], self.views[1, 2])
                finally:
                    os.chdir(here)

    def test_names_of_any_bytes(self):
        name = os.fsencode(self.folder) + b"/\xff\xe9.hmlfc"
        Path(os.fsdecode(name)).symlink_to(STREAM)

        class Named:
            def __fspath__(self):
                return name

        for path in [os.fsdecode(name), Path(os.fsdecode(name)), Named()]:
            np.testing.assert_array_equal(hmlfc.open(path)[1, 1], self.views[1, 1])
        with self.assertRaises(FileNotFoundError) as raised:
            hmlfc.open(os.fsdecode(name + b"x"))
        self.assertIn(os.fsdecode(name + b"x"), str(raised.exception))
        for use in [hmlfc.open, hmlfc.read_views, hmlfc.encode]:
            with self.assertRaisesRegex(ValueError, "null byte"):
                use(f"{STREAM}\0.png")

    def test_a_part_needs_its_blocks_alone(self):
        lf = hmlfc.open(VECTORS / "error/level-delta-28.hmlfc")  # the first blocks of view 0,1 decode
        self.assertEqual(lf[0, 1, :4, :4].shape, (4, 4, 3))
        with self.assertRaises(hmlfc.Error):
            lf[0, 1]

    @needs_addresses
    def test_rigs(self):
        self.assertIsNone(self.lf.rig)
        positions = [[r, c / 4, 0.5] for r in range(5) for c in range(5)]
        rig = {"schema": 1, "metres_per_unit": 0.5, "positions": positions, "intrinsics": [[40, 41, 19.5, 14.5]]}
        (self.folder / "rig.json").write_text(json.dumps(rig))
        self.hmlfc("encode", "views", "--rig", "rig.json", "-o", "posed.hmlfc")
        found = hmlfc.open(self.folder / "posed.hmlfc").rig
        with RangeServer(self.folder / "posed.hmlfc") as server:
            np.testing.assert_array_equal(hmlfc.open(server.address).rig.positions, found.positions)
        self.assertEqual(found.metres_per_unit, 0.5)
        np.testing.assert_array_equal(found.positions, np.reshape(positions, (5, 5, 3)))
        np.testing.assert_array_equal(found.rotations, np.tile([1, 0, 0, 0], (5, 5, 1)))
        np.testing.assert_array_equal(found.intrinsics[3, 2], [40, 41, 19.5, 14.5])
        stream = bytearray((self.folder / "posed.hmlfc").read_bytes())
        stream[stream.index(b"positions")] = ord("q")
        with self.assertRaisesRegex(ValueError, "qositions"):
            hmlfc.open(stream, check_sections=False).rig

    @needs_addresses
    def test_an_address(self):
        with RangeServer(STREAM) as server:
            lf = hmlfc.open(server.address)
            np.testing.assert_array_equal(lf[3, 4], self.views[3, 4])
            np.testing.assert_array_equal(lf.render(width=24, height=16), self.lf.render(width=24, height=16))
            server.fault = "gone"
            with self.assertRaisesRegex(OSError, "is the server there"):
                lf[:, :]
        with RangeServer(STREAM, fault=404) as server, self.assertRaisesRegex(OSError, "no such file"):
            hmlfc.open(server.address)

    def test_depths_above_8(self):
        lf = hmlfc.open(DEEP)
        self.hmlfc("decode", DEEP, "-o", "deep")
        self.assertEqual((lf.dtype, lf.depth, lf[0, 0].dtype), (np.uint16, 10, np.uint16))
        np.testing.assert_array_equal(lf[0, 1], picture(self.folder / "deep/00_01.png") >> 6)

    def test_stop_levels(self):
        self.hmlfc("decode", STREAM, "--levels", "1", "--view", "0,1", "-o", "top")
        np.testing.assert_array_equal(
            self.lf.read((0, 1), stop_level=self.lf.tree_height), picture(self.folder / "top/00_01.png")
        )
        with self.assertRaisesRegex(ValueError, "stop_level 16 does not exist: 0 to"):
            self.lf.read((0, 1), stop_level=16)

    def test_a_block_and_its_trace(self):
        lines = (VECTORS / "syntax/all-flags.trace.jsonl").read_text().splitlines()
        head, *records = list(map(json.loads, lines))
        end = next((at for at, record in enumerate(records) if record["record"] == "block"), len(records))
        lf, place = hmlfc.open(VECTORS / "syntax/all-flags.hmlfc"), (*head["view"], head["plane"], *head["block"])
        block = lf.trace(*place)
        np.testing.assert_array_equal(block.samples, lf.block(*place))
        for kind, found in ("field", block.fields), ("stage", block.stages):
            told = [{**record, "record": None} for record in records[:end] if record["record"] == kind]
            self.assertEqual([as_json(record) for record in found], told)
        self.assertGreater(len(block.vectors), 0)
        masks = [f["value"] for f in self.lf.trace(0, 1, "Y", 1, 1).fields if f["name"] == "tile_mask"]
        self.assertGreater(max(masks), 2**63)
        self.assertGreater(min(masks), 0)
        with self.assertRaisesRegex(ValueError, "plane is 'Y', 'Co' or 'Cg'"):
            lf.block(0, 0, "Cb", 0, 0)

    def test_disparity(self):
        disparity, confidence = self.lf.disparity(2, 3)
        self.hmlfc("disparity", STREAM, "--view", "2,3", "-o", "map.pfm")
        map_of_pixels = read_pfm(self.folder / "map.pfm")
        size = self.lf.block_size
        found = self.lf.disparity_map(2, 3)
        self.assertEqual((found.shape, found.dtype), ((40, 40), np.float32))
        np.testing.assert_array_equal(np.nan_to_num(found), map_of_pixels)
        np.testing.assert_array_equal(np.isnan(found[::size, ::size]), confidence == 0)
        self.assertEqual(confidence.shape, disparity.shape)
        self.assertTrue(np.isnan(hmlfc.open(VECTORS / "real/cards-main.hmlfc").disparity_map(0, 0)).any())
        self.assertGreater(np.ptp(disparity), 0)

    def test_frames(self):
        self.hmlfc("render", STREAM, *"--camera 1.5,2.25,0 --focus -1 --size 33x21 -o frame.png".split())
        frame = self.lf.render((1.5, 2.25, 0), focus=-1, width=33, height=21)
        np.testing.assert_array_equal(frame, picture(self.folder / "frame.png"))
        self.hmlfc("render", STREAM, *"--camera 1.5,2.25,0 --geometry plane --aperture 1 -o wide.png".split())
        frame = self.lf.render((1.5, 2.25, 0), geometry="plane", aperture=1)
        np.testing.assert_array_equal(frame, picture(self.folder / "wide.png"))
        np.testing.assert_array_equal(self.lf.render(focus=float("inf")), self.lf.render(focus=0))
        for wrong in [{"focus": 999}, {"filter": "sharp"}, {"geometry": "mesh"}, {"width": 0}, {"height": -1}]:
            with self.subTest(wrong=wrong), self.assertRaisesRegex(ValueError, next(iter(wrong))):
                self.lf.render(**wrong)
        with self.assertRaisesRegex(ValueError, r"position cannot be \(1, 2\); it is \(x, y, z\)"):
            self.lf.render((1, 2))
        with self.assertWarnsRegex(hmlfc.Note, "black: .*towards columns 0 to 4 and rows 0 to 4"):
            self.lf.render((40, 2, 0))

    def test_bytes_in_memory(self):
        data = STREAM.read_bytes()
        for source in [data, bytearray(data), memoryview(data)]:
            np.testing.assert_array_equal(hmlfc.open(source)[1, 1], self.views[1, 1])
        with self.assertRaises(TypeError):
            hmlfc.open(memoryview(data)[::2])
        with self.assertRaisesRegex(TypeError, "a path, an address or bytes, not None"):
            hmlfc.open(None)

    def test_bytes_are_kept(self):
        lf = hmlfc.open(bytes(bytearray(STREAM.read_bytes())))
        np.testing.assert_array_equal(lf[0, 0], self.views[0, 0])

    def test_errors_have_names(self):
        manifest = json.loads((VECTORS / "manifest.json").read_text())
        wanted = {vector["id"]: vector for vector in manifest["vectors"]}
        for name in ["error/magic", "error/version-2", "error/top-entry-bit-32"]:
            with self.subTest(vector=name), self.assertRaises(hmlfc.Error) as raised:
                hmlfc.open(VECTORS / f"{name}.hmlfc")
            expect, error = wanted[name]["expect"], raised.exception
            self.assertEqual((error.name, error.offset), (expect["error"], expect["offset"]))
            self.assertIsInstance(error, ValueError)
            again = pickle.loads(pickle.dumps(error))
            self.assertEqual((str(again), again.name, again.section), (str(error), error.name, error.section))
        lf = hmlfc.open(VECTORS / "error/sign-mode-3.hmlfc")
        self.assertEqual(lf[0, 0].shape, (16, 16, 3))
        with self.assertRaises(hmlfc.Error) as raised:
            lf[0, 1]
        self.assertEqual((raised.exception.name, raised.exception.section), ("bad_mode", "TILE"))

    def test_sections(self):
        damaged = VECTORS / "error/section-crc-tile.hmlfc"
        with self.assertRaises(hmlfc.Error):
            hmlfc.open(damaged)
        self.assertEqual(hmlfc.open(damaged, check_sections=False).shape, (1, 2, 16, 16, 3))

    def test_no_such_file(self):
        for use in [hmlfc.open, hmlfc.read_views, hmlfc.encode]:
            with self.assertRaisesRegex(FileNotFoundError, "nowhere.hmlfc") as raised:
                use("nowhere.hmlfc")
            self.assertEqual(raised.exception.errno, 2)

    def test_a_file_that_becomes_shorter(self):
        path = self.folder / "shorter.hmlfc"
        path.write_bytes(STREAM.read_bytes())
        lf = hmlfc.open(path, check_sections=False)
        os.truncate(path, 400)
        with self.assertRaisesRegex(OSError, "shorter.hmlfc: became shorter while it was read"):
            np.asarray(lf)

    def test_threads(self):
        found = {}

        def work(number):
            row, col = divmod(number, 5)
            found[number] = (self.lf[row, col], self.lf.render((row, col, 0), geometry="plane"))

        threads = [threading.Thread(target=work, args=(number,)) for number in range(25)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for number, (view, frame) in found.items():
            np.testing.assert_array_equal(view, self.views[divmod(number, 5)])
            np.testing.assert_array_equal(frame, self.lf.render((*divmod(number, 5), 0), geometry="plane"))
        self.assertEqual(len(found), 25)


def as_json(record):
    """A record of a trace as vectors/README.md has it."""
    listed = {key: list(value) if isinstance(value, tuple) else value for key, value in record.items()}
    if "values" in listed:
        listed["values"] = listed["values"].ravel().tolist()
    return {"record": None, **listed}


if __name__ == "__main__":
    main()
