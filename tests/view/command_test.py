"""hmlfc view: the server by HTTP; what it gives is what the other commands give."""

import http.client
import json
import math
import re
import signal
import socket
import struct
import time
from urllib.parse import urlsplit

from page_server import PageServer
from pictures import read_png, without_sign
from program import DONE, INPUT, USAGE, CliTest, main

import bise
from residual import step_of


class View(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 3x4 --size 72x48 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc".split())
        cls.hmlfc(*"encode views -o tree.hmlfc --profile main --height 1 --quality 60".split())
        cls.stream = (cls.folder / "a.hmlfc").read_bytes()

    def serve(self, *arguments):
        server = PageServer(self.folder, *arguments)
        self.addCleanup(server.end)
        return server

    def test_the_address_is_of_this_machine_and_secret(self):
        first, second = self.serve("a.hmlfc"), self.serve("a.hmlfc")
        for server in first, second:
            self.assertRegex(server.address, r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/$")
        self.assertNotEqual(first.path, second.path)
        self.assertEqual(first.ask("")[0], 200)
        self.assertEqual(first.ask_path("/")[0], 404)
        self.assertEqual(first.ask_path(second.path)[0], 404)
        self.assertEqual(first.ask("", Host="evil.example")[0], 404)
        self.assertEqual(first.ask("", Origin="http://evil.example")[0], 404)
        self.assertEqual(first.ask_path(first.path + "%2e%2e/%2e%2e/etc/passwd")[0], 404)
        with self.assertRaises(OSError):  # not on the other addresses of this machine
            socket.create_connection(("127.0.0.2", urlsplit(first.address).port), timeout=5)

    def test_ctrl_c_ends_it(self):
        for number in signal.SIGINT, signal.SIGTERM:
            server = self.serve("a.hmlfc")
            server.ask("frame")
            begin = time.monotonic()
            self.assertEqual(server.end(number), (DONE, "Ctrl-C ends it\n"))
            self.assertLess(time.monotonic() - begin, 10)

    def test_once_ends_with_the_page(self):
        server = self.serve("a.hmlfc", "--once")
        self.assertEqual(server.ask("arrived", method="POST")[0], 200)
        page = http.client.HTTPConnection(server.host, timeout=60)
        page.request("GET", server.path + "open")
        answer = page.getresponse()
        self.assertEqual(answer.status, 200)
        time.sleep(3)
        self.assertIsNone(server.process.poll())
        answer.close()
        self.assertEqual(server.process.wait(timeout=20), DONE)

    def test_a_port_that_is_taken(self):
        port = urlsplit(self.serve("a.hmlfc").address).port
        self.refused(USAGE, "view", "a.hmlfc", "--no-browser", "--port", port, says="taken")

    def test_frames_are_those_of_render(self):
        server = self.serve("a.hmlfc")
        cameras = [
            {"camera": "1.25,0.75", "size": "72x48"},
            {"camera": "1,1,-0.5", "look-at": "1.5,1,16", "focus": "0.5", "aperture": 1, "size": "40x30"},
            {"geometry": "plane", "filter": "views", "fov": 30},
        ]
        for camera in cameras:
            options = [word for name, value in camera.items() for word in (f"--{name}", value)]
            self.hmlfc("render", "a.hmlfc", *options, "-o", "frame.png")
            status, headers, body = server.ask("frame.png", camera)
            self.assertEqual((status, headers["Content-Type"]), (200, "image/png"))
            self.assertEqual(without_sign(body), without_sign((self.folder / "frame.png").read_bytes()))

    def test_blocks_are_those_of_inspect(self):
        for file, levels in ("a.hmlfc", []), ("tree.hmlfc", [1, 2]):
            server = self.serve(file)
            for row, col, plane, block in (0, 0, "Y", "3,4"), (2, 1, "Co", "0,5"):
                for level in levels or [None]:
                    query = {"view": f"{row},{col}", "plane": plane, "block": block}
                    query |= {"levels": level} if level else {}
                    options = [word for name, value in query.items() for word in (f"--{name}", value)]
                    expected = self.hmlfc_json("inspect", file, *options)
                    self.assertEqual(server.json("block", query)["report"], expected)

    def test_the_arrays_are_those_of_inspect(self):
        steps = set()
        for file in "a.hmlfc", "tree.hmlfc":
            server = self.serve(file)
            arrays = server.json("blocks", {"view": "0,3", "plane": "Y"})
            self.assertEqual((arrays["columns"], arrays["rows"]), (18, 12))
            names = ["zero", "motion only", "motion and residual", "residual only"]
            vectors = {}
            for block, *vector in arrays["vectors"]:
                vectors.setdefault(block, []).append(vector)
            for x, y in (0, 0), (3, 4), (17, 11), (9, 2), (10, 7), (4, 9):
                at = 18 * y + x
                inspect = self.hmlfc_json("inspect", file, "--view", "0,3", "--plane", "Y", "--block", f"{x},{y}")
                level = inspect["levels"][-1]
                self.assertEqual(names[arrays["states"][at]], level["state"])
                found = [[v["image"]["row"], v["image"]["col"], v["x"], v["y"]] for v in level["vectors"]]
                self.assertEqual(vectors.get(at, []), found)
                own = {field["name"]: field for field in level["fields"]}
                bits = sum(field["bits"] for field in own.values() if field["name"] in ("sign", "dx", "dy"))
                coded = "residual" in level["stages"]
                self.assertEqual(arrays["level_counts"][at] > 0, coded)
                if coded:
                    count = bise.levels_of(own["level_base"]["value"] + own.get("level_delta", {"value": 0})["value"])
                    self.assertEqual(arrays["level_counts"][at], count)
                    header = [own[name]["bits"] for name in ("level_delta", "step_delta", "bias") if name in own]
                    bits += sum(header) + bise.sequence_bits(16, count)
                    steps.add(arrays["steps"][at])
                    if "step_base" in own:
                        code = own["step_base"]["value"] + own.get("step_delta", {"value": 0})["value"]
                        self.assertEqual(arrays["steps"][at], step_of(code))
                else:
                    self.assertEqual(arrays["steps"][at], 0)
                motion = [field for field in level.get("motion_fields", []) if field["name"] == "index"]
                self.assertEqual(arrays["bits"][at], bits + sum(field["bits"] for field in motion[-1:]))
                read = level["fields"] + level.get("motion_fields", []) + level.get("disparity", {"fields": []})["fields"]
                self.assertEqual(arrays["read"][at], sum(field["bits"] for field in read))
        self.assertGreater(len(steps), 1)

    def test_disparities_are_those_of_the_command(self):
        shares = set()
        for file in "a.hmlfc", "tree.hmlfc":
            said = self.hmlfc("disparity", file, "--view", "2,0", "-o", "map.pfm", "--force")
            numbers = struct.unpack(f"<{72 * 48}f", (self.folder / "map.pfm").read_bytes()[-4 * 72 * 48 :])
            found = self.serve(file).json("blocks", {"view": "2,0", "plane": "Y"})["disparities"]
            expected = [numbers[72 * (47 - 4 * y) + 4 * x] for y in range(12) for x in range(18)]
            self.assertEqual([number or 0 for number in found], expected)
            share = 100 * sum(number is not None for number in found) / len(found)
            known = re.search(r"known for (\S+) %|disparity unknown", said)
            self.assertEqual(f"{share:.1f}", known[1] or "0.0")
            shares.add(share)
        self.assertEqual(len(shares), 2)

    def test_differences_from_the_original(self):
        server = self.serve("a.hmlfc", "--original", "views")
        self.hmlfc("decode", "a.hmlfc", "-o", "decoded")
        status, headers, pixels = server.ask("difference", {"view": "1,2", "gain": 4})
        self.assertEqual((status, headers["Picture-Size"]), (200, "72,48"))
        a, b = (read_png(self.folder / name / "01_02.png").samples for name in ("views", "decoded"))
        expected = [max(0, min(255, 128 + 4 * (x - y))) for x, y in zip(a, b)]
        self.assertEqual([value for at, value in enumerate(pixels) if at % 4 < 3], expected)
        psnr = server.json("blocks", {"view": "1,2", "plane": "Y"})["psnr"]
        block = [3 * (72 * y + x) + k for y in range(8, 12) for x in range(4, 8) for k in range(3)]
        squares = sum((a[at] - b[at]) ** 2 for at in block)
        if squares:
            self.assertAlmostEqual(psnr[2 * 18 + 1], 10 * math.log10(255**2 * len(block) / squares), delta=0.01)

    def test_originals_that_do_not_fit(self):
        self.hmlfc(*"synth --scene cards --grid 3x4 --size 40x48 -o narrow".split())
        self.refused(INPUT, "view", "a.hmlfc", "--no-browser", "--original", "narrow", says="narrow has")
        self.refused(INPUT, "view", "nosuch.hmlfc", "--no-browser", says="nosuch.hmlfc")

    def test_corrupt_streams_are_shown_as_far_as_they_go(self):
        (self.folder / "head.hmlfc").write_bytes(b"x" + self.stream[1:])
        server = self.serve("head.hmlfc")
        self.assertIn("bad_magic", server.json("stream")["error"])
        status, _, body = server.ask("frame")
        self.assertEqual(status, 422)
        self.assertIn("bad_magic", json.loads(body)["error"])
        self.assertEqual(server.ask("")[0], 200)

    def test_a_damaged_section_is_named_and_blocks_have_their_errors(self):
        tiles = self.hmlfc_json("info", "a.hmlfc")["sections"]
        damaged = bytearray(self.stream)
        for at in range(len(damaged) - tiles["residual"], len(damaged)):
            damaged[at] ^= 0xFF
        (self.folder / "tiles.hmlfc").write_bytes(damaged)
        server = self.serve("tiles.hmlfc")
        facts = server.json("stream")
        self.assertEqual(facts["error"], "")
        self.assertIn("bad_section_crc", facts["warning"])
        blocks = server.json("blocks", {"view": "0,3", "plane": "Y"})
        self.assertTrue(blocks["errors"])
        for block, text in blocks["errors"][:3]:
            self.assertEqual(blocks["states"][block], 5)
            self.assertRegex(text, r"^\w+ in \w+ at byte \d+")
            place = {"view": "0,3", "plane": "Y", "block": f"{block % 18},{block // 18}"}
            self.assertEqual(server.json("block", place)["error"], text)


if __name__ == "__main__":
    main()
