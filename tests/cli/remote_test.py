"""Streams at an http:// address: the answers of the file, few requests, and errors in place of wrong answers."""

import json
import os
import subprocess
import sys
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / name) for name in ("tests/support", "bench/common", "tests/view")]

import sparse
from page_server import PageServer
from program import CORRUPT, INPUT, PROGRAM, CliTest, main
from range_server import RangeServer

VECTORS = ("boundary/disparities-many", "boundary/balanced-uneven", "boundary/block8-motion-block8", "syntax/base-palettes")
GIB = 1 << 30

FAULTS = {
    "no_ranges": "does not send parts of files",
    "other_length": "the file has changed",
    "other_range": "other bytes than those asked for",
    "other_bytes": "the file has changed",
    "compressed": "(Content-Encoding: gzip)",
    "multipart": "multipart/byteranges",
    "short": "bytes in place of",
    "truncated": "bytes in place of",
    "gone": "is the server there?",
    "redirect": "is the server there?",
    "redirect_elsewhere": "is the server there?",
    "endless_headers": "more than 65536 bytes of headers",
    "endless_trailers": "more than 65536 bytes of headers",
    "redirect_inside": "redirects to an address of this machine",
    404: "there is no such file (status 404)",
    403: "refuses it",
    416: "shorter",
    500: "status 500",
}
PASSING = {"short", "truncated", "gone", "redirect", "redirect_elsewhere", 500}  # asked for again, which takes time
AT_OPENING = {"other_length", "other_bytes", 416}  # faults that only a file that is open can have


class Remote(CliTest):
    @classmethod
    def prepare(cls):
        os.environ["no_proxy"] = "127.0.0.1"
        cls.hmlfc(*"synth --scene cards --grid 4x5 --size 72x56 -o views".split())
        cls.hmlfc(*"encode views -o main.hmlfc --profile main".split())
        cls.hmlfc(*"encode views -o extended.hmlfc --preset fast".split())

    def path(self, name):
        vector = ROOT / "vectors" / f"{name}.hmlfc"
        return vector if vector.exists() else self.folder / f"{name}.hmlfc"

    def answers(self, source, kind):
        """What the five commands say and write about a stream."""
        run = lambda *arguments: self.hmlfc(*arguments).replace(str(source), "FILE")
        block = ["--view", "0,0", "--plane", "Y", "--block", "0,0"]
        said = [run("info", source), run("info", source, "--json"), run("inspect", source, *block),
                run("inspect", source, *block, "--json")]
        self.hmlfc("decode", source, "-o", f"{kind}/all")
        self.hmlfc("decode", source, "-o", f"{kind}/one", "--view", "0,0", "--rect", "0,0,5,3")
        self.hmlfc("render", source, "-o", f"{kind}/frames", "--frames", "3", "--path", "orbit", "--size", "40x32")
        self.hmlfc("disparity", source, "-o", f"{kind}/disparity.pfm")
        files = sorted((self.folder / kind).rglob("*.p*"))
        return said, {str(file.relative_to(self.folder / kind)): file.read_bytes() for file in files}

    def test_the_answers_are_those_of_the_file(self):
        for name in ("main", "extended", *VECTORS):
            with self.subTest(stream=name), RangeServer(self.path(name)) as server:
                kind = name.replace("/", "-")
                expected = self.answers(self.path(name), f"{kind}-file")
                found = self.answers(server.address, f"{kind}-address")
                self.assertEqual(found, expected)
                self.assertGreater(len(expected[1]), 5)

    def test_an_address_beside_files(self):
        with RangeServer(self.path("main")) as server:
            self.assertIn("Identical", self.hmlfc("compare", server.address, "main.hmlfc"))

    def test_nothing_is_fetched_twice_and_what_was_is_reported(self):
        for name in ("main", "extended"):
            with self.subTest(stream=name), RangeServer(self.path(name)) as server:
                made = self.hmlfc_json("render", server.address, "-o", "counted", "--frames", "4", "--path", "orbit", "--size", "32x32")
                fetched = [frame["fetched"] for frame in made["frames"]]
                self.assertEqual(sum(f["requests"] for f in fetched), len(server.requests))
                self.assertEqual(sum(f["bytes"] for f in fetched), server.sent)
                self.assertGreater(fetched[0]["rounds"], 1)
                self.assertLessEqual(fetched[0]["rounds"], 20)
                fetched = set()  # a gap between ranges may have been; a range is not
                for first, last in server.requests:
                    self.assertFalse(fetched >= {first, last})
                    fetched.update(range(first, last + 1))
        local = self.hmlfc_json("render", "main.hmlfc", "-o", "counted.png", "--size", "32x32")
        self.assertNotIn("fetched", local["frames"][0])

    def test_a_frame_of_a_stream_of_64_gib(self):
        large = self.folder / "large.hmlfc"
        sparse.write_with_hole(self.path("main"), large, 64 * GIB)
        self.assertGreater(large.stat().st_size, 64 * GIB)
        self.assertLess(large.stat().st_blocks * 512, 1 << 22)
        self.hmlfc("render", "main.hmlfc", "-o", "small.png", "--size", "64x64")
        with RangeServer(large) as server:
            self.hmlfc("render", server.address, "-o", "large.png", "--size", "64x64")
            self.assertGreater(max(last for _, last in server.requests), 64 * GIB)
            self.assertLess(server.sent, 1_000_000)
        self.assertEqual(*((self.folder / name).read_bytes() for name in ("small.png", "large.png")))

    def test_faults_from_the_first_request_on(self):
        for fault, says in FAULTS.items():
            if fault in AT_OPENING:
                continue
            with self.subTest(fault=fault), RangeServer(self.path("main"), fault=fault) as server:
                self.refused(INPUT, "info", server.address, says=(server.address, says))

    def test_faults_in_the_middle(self):
        outputs = {
            "decode": ("-o", "broken", "--view", "1,1"),
            "render": ("-o", "broken/frame.png", "--size", "32x32"),
            "info": (), "inspect": ("--view", "1,1", "--plane", "Y", "--block", "2,2"),
            "disparity": ("-o", "broken/map.pfm"),
        }  # fmt: skip
        for number, (command, arguments) in enumerate(outputs.items()):
            name = ("main", "extended")[number % 2 or command == "disparity"]
            (self.folder / "broken").mkdir(exist_ok=True)
            with RangeServer(self.path(name)) as server:
                self.hmlfc(command, server.address, *arguments)
                last = len(server.requests) - 1
            self.assertGreaterEqual(last, 1, command)
            for file in (self.folder / "broken").iterdir():
                file.unlink()
            for fault, says in FAULTS.items():
                if fault in PASSING and command not in ("decode", "render"):
                    continue
                with self.subTest(fault=fault, command=command), RangeServer(self.path(name), fault=fault, after=last) as server:
                    self.refused(INPUT, command, server.address, *arguments, says=(server.address, says))
                    self.assertEqual(os.listdir(self.folder / "broken"), [])

    def test_geometry_that_cannot_be_read_is_no_frame(self):
        """Disparities that a frame does not know are allowed; those that it could not fetch are not."""
        with RangeServer(self.path("extended")) as server:
            self.hmlfc("render", server.address, "-o", "whole.png", "--size", "32x32")
            requests = len(server.requests)
        for after in range(1, requests):
            with RangeServer(self.path("extended"), fault=404, after=after) as server:
                self.refused(INPUT, "render", server.address, "-o", "part.png", "--size", "32x32")
                self.assertFalse((self.folder / "part.png").exists())

    def test_what_passes_is_asked_for_again(self):
        expected = self.hmlfc("info", "main.hmlfc", "--json")
        for fault in ("truncated", "short", 503):
            with self.subTest(fault=fault), RangeServer(self.path("main"), fault=fault, after=1, times=2) as server:
                self.assertEqual(self.hmlfc("info", server.address, "--json"), expected)

    def test_whatever_rfc_9110_allows(self):
        for way in (None, "unknown_total", "unknown_end", "in_pieces", "weak_tags"):
            with self.subTest(way=way), RangeServer(self.path("main"), fault=way) as server:
                self.hmlfc("decode", server.address, "-o", f"way-{way}", "--view", "1,2")
                found, expected = (self.folder / f"way-{name}/01_02.png" for name in (way, None))
                self.assertEqual(found.read_bytes(), expected.read_bytes())
                self.assertEqual(server.encodings, "identity")

    def test_a_server_that_does_not_say_the_version(self):
        with RangeServer(self.path("main")) as server:
            server.tag = None
            self.assertEqual(self.hmlfc("info", server.address, "--json"), self.hmlfc("info", "main.hmlfc", "--json"))

    def test_addresses_that_are_none(self):
        self.refused(INPUT, "info", "ftp://127.0.0.1/a.hmlfc", says="No such file")
        self.refused(INPUT, "info", "http://127.0.0.1:1/a.hmlfc", says=("http://127.0.0.1:1/a.hmlfc", "is the server there?"))
        self.refused(INPUT, "info", "http://", says="http://")
        empty = self.folder / "empty.hmlfc"
        empty.touch()
        with RangeServer(empty, fault=416) as server:
            self.refused(INPUT, "info", server.address, says="the file is empty")

    def test_a_stream_that_is_none(self):
        other = self.folder / "other.hmlfc"
        other.write_bytes(b"no stream" * 2000)
        with RangeServer(other) as server:
            self.refused(CORRUPT, "info", server.address, says="bad_magic")
        cut = self.folder / "cut.hmlfc"
        cut.write_bytes(self.path("main").read_bytes()[:-1])
        with RangeServer(cut) as server:
            self.refused(CORRUPT, "render", server.address, "-o", "cut.png", says="truncated")
            self.assertEqual(len(server.requests), 1)

    def test_the_benchmark(self):
        """In its small form."""
        command = [sys.executable, ROOT / "bench" / "remote", "--quick", "--json", "-o", self.folder / "remote"]
        environment = {**os.environ, "HMLFC_BUILD": str(Path(PROGRAM).resolve().parents[1])}
        done = subprocess.run(command, capture_output=True, check=False, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        rows = json.loads(done.stdout)["streams"]
        self.assertEqual([row["delay"] for row in rows], [0, 20, 80, 0, 20, 80, 80])
        for row in rows:
            self.assertGreater(row["first_requests"], 1)
            self.assertGreaterEqual(row["first_ms"], row["delay"] * row["first_rounds"])

    def test_the_page(self):
        questions = [("frame", {"size": "48x40"}), ("frame", {"size": "48x40", "camera": "1.5,2.25,0"}),
                     ("picture", {"view": "2,3"}), ("totals", {}),
                     ("blocks", {"view": "1,2", "plane": "Y"}),
                     ("block", {"view": "1,2", "plane": "Co", "block": "3,1"})]  # fmt: skip
        for name in ("main", "extended"):
            with self.subTest(stream=name), RangeServer(self.path(name)) as server:
                with PageServer(self.folder, self.path(name)) as file, PageServer(self.folder, server.address) as address:
                    self.assertEqual(address.json("stream")["bytes"], self.path(name).stat().st_size)
                    for path, query in questions:
                        (status, _, expected), (other, _, found) = file.ask(path, query), address.ask(path, query)
                        self.assertEqual((status, other), (200, 200), found)
                        plain = found.replace(server.address.encode(), str(self.path(name)).encode())
                        self.assertEqual(plain, expected, path)

    def test_a_decoder_under_test_gets_a_copy(self):
        dut = f"{PROGRAM} decode {{input}} -o {{output}}"
        scratch = self.folder / "scratch"
        scratch.mkdir()
        self.enterContext(mock.patch.dict(os.environ, TMPDIR=str(scratch)))
        with RangeServer(self.path("main")) as server, PageServer(self.folder, server.address, "--dut", dut) as page:
            self.assertLess(server.sent, self.path("main").stat().st_size)
            self.assertEqual(page.ask("dut-picture", {"view": "1,2"})[2], page.ask("picture", {"view": "1,2"})[2])
            (copy,) = scratch.iterdir()
            self.assertEqual((copy / "stream.hmlfc").read_bytes(), self.path("main").read_bytes())
            requests = len(server.requests)
            page.ask("dut-picture", {"view": "0,3"})
            self.assertEqual(len(server.requests), requests)
            status, message = page.end()
            self.assertEqual(status, 0)
            self.assertRegex(message, "--dut reads a file: all .* bytes of " + server.address)
        self.assertEqual(os.listdir(scratch), [])
        with RangeServer(self.path("main")) as server, PageServer(self.folder, server.address, "--dut", dut) as page:
            server.fault = "gone"
            status, _, body = page.ask("dut-picture", {"view": "1,2"})
            self.assertEqual(status, 400)
            self.assertIn(f"{server.address}: ", json.loads(body)["error"])
        self.assertEqual(os.listdir(scratch), [])

    def test_the_page_says_that_the_server_is_gone(self):
        with RangeServer(self.path("main")) as server, PageServer(self.folder, server.address) as page:
            page.json("stream")
            server.fault = "gone"
            for path, query in [("frame", {"size": "48x40"}), ("blocks", {"view": "1,2", "plane": "Y"}),
                                ("block", {"view": "3,4", "plane": "Y", "block": "5,5"}), ("stream", {})]:  # fmt: skip
                status, _, body = page.ask(path, query)
                self.assertEqual(status, 400, path)
                self.assertIn("is the server there?", json.loads(body)["error"])


if __name__ == "__main__":
    main()
