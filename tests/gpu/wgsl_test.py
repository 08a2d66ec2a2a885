#!/usr/bin/env python3
"""The decoder in WGSL, in Chromium on its own software device, against the conformance vectors and the golden model.

usage: wgsl_test.py REFERENCE_AREAS KERNELS SUITE [--self-test]

Every stream of the suite that opens: the pixels of all views have the checksums of the suite, blocks that must fail
fail with their error, and blocks of three planes, at every stop level, are those of the golden model. The compiler has
no message for a kernel. With --self-test changed kernels must be found.

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
from wgsl_of_spirv import PAIRS

SKIPPED = 77
AT_ONCE = 50  # vectors of a call
EDGES = (0, 1, 2, 3, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x10001, 0x7FFFFFFF, 0x80000000, 0x80000001, 0x89ABCDEF,
         0xFFFEFFFF, 0xFFFF0000, 0xFFFF0001, 0xFFFFFFFE, 0xFFFFFFFF)
# Kernel, text, another: what a translation or the host could get wrong.
FAULTS = (
    ("expand", " % ", " / "),
    ("samples", "16i * (x_0 & 1i)", "16i * (x_0 & 0i)"),
    ("samples", ".yzwx", ".xyzw"),
    ("colour", "<< 16u", "<< 15u"),
    ("residuals", "-32768i", "-32767i"),
    ("walk", "firstTrailingBit", "firstLeadingBit"),
    ("walk", "countOneBits", "countLeadingZeros"),
)
# Statements that have no translation; `word` is a buffer.
REFUSED = {
    "ConvertUToF": "word[0] = uint(float(word[1]) * 0.5);",
    "OpSwitch": "switch (word[0]) { case 1u: word[1] = 2u; break; case 3u: word[1] = 4u; break; }",
    "AtomicXor": "atomicXor(word[0], 1u);",
    "BitReverse": "word[0] = bitfieldReverse(word[1]);",
    "ControlBarrier": "barrier(); word[0] = 1u;",
}
HEAD = """#version 450
#extension GL_EXT_buffer_reference : require
layout(buffer_reference, std430) buffer Words { uint word[]; };
layout(push_constant, std430) uniform Arguments { Words words; uint count; } arguments;
layout(local_size_x = 64) in;
"""
PAIR_FAULTS = (
    ("a + b < a", "a + b <= a"), ("a < b", "a <= b"),
    ("+ (left >> 16u)", ""), ("+ (right >> 16u)", ""), ("+ (low >> 16u)", ""),
)


class Handler(http.server.SimpleHTTPRequestHandler):
    """The folders of `roots`, by the first part of the path; `faults` are kernels that are not files."""

    roots, faults = {}, {}

    def translate_path(self, path):
        first, _, rest = path.split("?")[0].lstrip("/").partition("/")
        return str(self.roots[first] / rest) if first in self.roots else "/nothing"

    def do_GET(self):
        folder, _, name = self.path.lstrip("/").partition("/")
        if not folder:
            return self.answer(b"<!doctype html>", "text/html")
        if folder in self.faults:
            text = self.faults[folder].get(name) or (self.roots["wgsl"] / name).read_text()
            return self.answer(text.encode(), "text/plain")
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
    def __init__(self, browser, address):
        self.page = browser.page
        self.page.set_script_timeout(500)
        self.page.get(address)

    def call(self, function, *arguments):
        """The result of a function of wgsl_page.js."""
        result, error = self.page.execute_async_script(
            "const [name, values, done] = arguments;"
            "import('/page/wgsl_page.js').then(page => page[name](...values))"
            ".then(result => done([result, '']), error => done([null, String(error)]));",
            function, arguments)
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


def wrong_pairs(page, text):
    """The first difference of the functions of two words."""
    results = iter(page.call("pairResults", text, EDGES))
    for a in EDGES:
        for b in EDGES:
            carry, borrow = a + b, a - b
            wanted = [*divmod(a * b, 1 << 32)[::-1], carry % 2**32, carry >> 32, borrow % 2**32, int(borrow < 0)]
            found = [next(results) for _ in wanted]
            if found != wanted:
                return [f"{a:#x} and {b:#x}: {found} instead of {wanted}"]
    return []


def check(page, vectors, kernels):
    found = page.call("messages", "/wgsl/", [path.stem for path in sorted(kernels.glob("*.wgsl"))])
    found += wrong_pairs(page, PAIRS)
    for begin in range(0, len(vectors), AT_ONCE):
        found += page.call("checkAll", "/wgsl/", vectors[begin : begin + AT_ONCE], 5)
    first, second = vectors[0], vectors[-1]
    ends = page.call("refusals", first["number"], first["file"], second["number"])
    wanted = ("the reference area belongs to another stream", "this is no file of hmlfc reference-area",
              "the reference area belongs to another stream", "limit_exceeded: stream takes")
    found += [f"{end!r} instead of {want!r}" for end, want in zip(ends, wanted) if want not in end]
    print(f"{len(vectors)} streams, {len(found)} differences")
    return found


def refusals():
    """What is not refused, or for another reason."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for reason, statement in REFUSED.items():
            module = Path(folder) / "kernel.spv"
            text = HEAD + f"void main() {{ {re.sub('word', 'arguments.words.word', statement)} }}"
            compiled = ["glslc", "--target-env=vulkan1.2", "-fshader-stage=comp", "-", "-o", module]
            subprocess.run(compiled, input=text, text=True, check=True)
            translator = ROOT / "gpu_ref/wgsl/wgsl_of_spirv.py"
            command = [sys.executable, "-B", translator, module, Path(folder) / "kernel.wgsl"]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 1 or reason not in done.stderr:
                found.append(f"{statement} {done.stderr}")
    return found


def self_test(page, vectors, kernels):
    missed = [f"the pairs with {new}" for old, new in PAIR_FAULTS
              if not wrong_pairs(page, PAIRS.replace(old, new)) or old not in PAIRS] + refusals()
    for number, (kernel, old, new) in enumerate(FAULTS):
        text = (kernels / f"{kernel}.wgsl").read_text()
        if old not in text:
            missed.append(f"{kernel}.wgsl has no {old}")
            continue
        Handler.faults[f"fault{number}"] = {f"{kernel}.wgsl": text.replace(old, new)}
        found = page.call("checkAll", f"/fault{number}/", vectors, 1)
        print(f"{kernel}.wgsl, {old} to {new}: {found[0] if found else 'not found'}")
        if not found or "Invalid" in found[0]:
            missed.append(f"{kernel}.wgsl with {new}")
    return missed


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
        Handler.roots = {"wgsl": kernels, "suite": suite, "areas": areas, "page": Path(__file__).parent}
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        browser = Browser(f"{temporary}/cache", WEBGPU)
        try:
            page = Page(browser, f"http://127.0.0.1:{server.server_port}/")
            why = page.call("openDevice")
            if why:
                print(f"skipped: {why}")
                return SKIPPED
            run = self_test if "--self-test" in sys.argv else check
            found = run(page, vectors_that_open(suite, areas), kernels)
            print("\n".join(found))
            return 1 if found else 0
        finally:
            browser.end()
            server.shutdown()


if __name__ == "__main__":
    sys.exit(main())
