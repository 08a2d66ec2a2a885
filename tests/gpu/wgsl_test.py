#!/usr/bin/env python3
"""The decoder in WGSL, in Chromium on its own software device, against the conformance vectors and the golden model.

usage: wgsl_test.py REFERENCE_AREAS KERNELS SUITE

Every stream of the suite that opens: the pixels of all views have the checksums of the suite, blocks that must fail
fail with their error, and blocks of three planes, at every stop level, are those of the golden model. The compiler has
no message for a kernel.

Exit: 0 good, 1 not, 77 skipped: no browser, no WebGPU, or no WGSL was built.
"""

import http.server
import json
import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/view"), str(ROOT / "gpu_ref/wgsl")]

from browser import WEBGPU, Browser, missing
from wgsl_of_spirv import HIGH_WORD, PAIRS

SKIPPED = 77
AT_ONCE = 50  # vectors of a call
EDGES = (0, 1, 2, 3, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x10001, 0x7FFFFFFF, 0x80000000, 0x80000001, 0x89ABCDEF,
         0xFFFEFFFF, 0xFFFF0000, 0xFFFF0001, 0xFFFFFFFE, 0xFFFFFFFF)


class Handler(http.server.SimpleHTTPRequestHandler):
    """The folders of `roots`, by the first part of the path."""

    roots = {}

    def translate_path(self, path):
        first, _, rest = path.split("?")[0].lstrip("/").partition("/")
        return str(self.roots[first] / rest) if first in self.roots else "/nothing"

    def do_GET(self):
        if self.path == "/":
            return self.answer(b"<!doctype html>", "text/html")
        return super().do_GET()

    def answer(self, body, kind):
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


class Page:
    module = "wgsl_page.js"

    def __init__(self, browser, address):
        self.page = browser.page
        self.page.set_script_timeout(500)
        self.page.get(address)

    def call(self, function, *arguments, module=None):
        """The result of a function of `module`."""
        result, error = self.page.execute_async_script(
            "const [module, name, values, done] = arguments;"
            "import(`/page/${module}`).then(page => page[name](...values))"
            ".then(result => done([result, '']), error => done([null, String(error)]));",
            module or self.module, function, arguments)
        if error:
            raise AssertionError(f"{function}: {error}")
        return result


def error_numbers():
    found = re.findall(r"ERROR_(\w+) = (\d+)u", (ROOT / "gpu_ref/shaders" / "hmlfc_tables.glsl").read_text())
    return {name.lower(): int(number) for name, number in found}


def vectors_that_open(suite, areas):
    numbers = error_numbers()
    vectors = []
    for number, vector in enumerate(json.loads((suite / "manifest.json").read_text())["vectors"]):
        if not (areas / f"{number}.area").exists():
            continue
        expect = vector["expect"]
        vectors.append({"number": number, "id": vector["id"], "file": vector["input"]["file"],
                        "sha256": vector["blocks"]["sha256"], "blocks": expect.get("blocks", []),
                        "error": numbers.get(expect.get("error"), 0)})
    return vectors


def signed(word):
    return word - ((word & 0x80000000) << 1)


def wrong_pairs(page):
    """The first difference of the functions of two words."""
    functions = [text.replace("Pair", "IntPair") if "i32" in text else text for text in PAIRS.values()]
    results = iter(page.call("pairResults", "\n".join([HIGH_WORD, *functions]), EDGES))
    for a in EDGES:
        for b in EDGES:
            carry, borrow = a + b, a - b
            wanted = [*divmod(a * b, 1 << 32)[::-1], carry % 2**32, carry >> 32, borrow % 2**32, int(borrow < 0),
                      *divmod(signed(a) * signed(b) % 2**64, 1 << 32)[::-1]]
            found = [next(results) for _ in wanted]
            if found != wanted:
                return [f"{a:#x} and {b:#x}: {found} instead of {wanted}"]
    return []


def check(page, vectors, kernels):
    found = page.call("messages", "/wgsl/", [path.stem for path in sorted(kernels.glob("*.wgsl"))])
    found += wrong_pairs(page)
    for begin in range(0, len(vectors), AT_ONCE):
        found += page.call("checkAll", "/wgsl/", vectors[begin : begin + AT_ONCE], 5)
    first, second = vectors[0], vectors[-1]
    ends = page.call("refusals", first["number"], first["file"], second["number"])
    wanted = ("the reference area belongs to another stream", "this is no file of hmlfc reference-area",
              "the reference area belongs to another stream", "limit_exceeded: stream takes")
    found += [f"{end!r} instead of {want!r}" for end, want in zip(ends, wanted) if want not in end]
    print(f"{len(vectors)} streams, {len(found)} differences")
    return found


def checked(make_page, roots, check, **device):
    """The exit status of check(page) with folders served at `roots`; `device`: arguments of openDevice."""
    Handler.roots = {**roots, "page": Path(__file__).parent}
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory() as cache:
        browser = Browser(cache, WEBGPU)
        try:
            page = make_page(browser, f"http://127.0.0.1:{server.server_port}/")
            why = page.call("openDevice", **device)
            if why:
                print(f"skipped: {why}")
                return SKIPPED
            found = check(page)
            print("\n".join(found))
            return 1 if found else 0
        finally:
            browser.end()
            server.shutdown()


def main():
    program, kernels, suite = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    if missing() or not (kernels / "walk.wgsl").exists():
        print(f"skipped: {missing() or 'no WGSL was built'}")
        return SKIPPED
    with tempfile.TemporaryDirectory() as temporary:
        areas = Path(temporary) / "areas"
        areas.mkdir()
        made = subprocess.run([program, str(suite), str(areas)], check=False)
        if made.returncode != 0:
            return made.returncode
        files = vectors_that_open(suite, areas)
        return checked(Page, dict(wgsl=kernels, suite=suite, areas=areas), lambda page: check(page, files, kernels))


if __name__ == "__main__":
    sys.exit(main())
