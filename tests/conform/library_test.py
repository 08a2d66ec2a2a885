"""hmlfc_dut.h: the header is C99, and libraries that are wrong in one way are caught without harm."""

import shutil
import subprocess

from conform_case import INCOMPLETE, ROOT, SUITE, ConformTest, main
from program import INPUT

INCLUDE = ROOT / "model" / "include"
COMPILER = shutil.which("cc") or shutil.which("gcc")
STRICT = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-I", str(INCLUDE), "-I", str(ROOT / "tools")]

# A decoder of grey views in the shape of real/cards-main, whatever it is given.
LIBRARY = r"""
#include <hmlfc/hmlfc_dut.h>
#include <stdio.h>
#include <stdlib.h>

struct hmlfc_dut { int nothing; };
static struct hmlfc_dut the_stream;

uint32_t hmlfc_dut_abi(void) { return ABI; }
const char *hmlfc_dut_name(void) { return "grey"; }
int hmlfc_dut_open(const uint8_t *bytes, size_t size, hmlfc_dut **dut) {
  (void)bytes;
  *dut = &the_stream;
  return size == 0 ? 1 : OPEN_STATUS;
}
int hmlfc_dut_get_geometry(const hmlfc_dut *dut, hmlfc_dut_geometry *geometry) {
  (void)dut;
  geometry->rows = geometry->cols = 4;
  geometry->width = WIDTH;
  geometry->height = 32;
  geometry->depth = 8;
  geometry->chroma_format = 0;
  geometry->block_log2 = 2;
  geometry->tree_height = 1;
  return 0;
}
int hmlfc_dut_decode_view(hmlfc_dut *dut, uint32_t row, uint32_t col, uint16_t *rgb) {
  (void)dut; (void)row; (void)col;
  BODY
  for (int i = 0; i < 40 * 32 * 3; ++i) rgb[i] = 128;
  return 0;
}
#ifndef WITHOUT_BLOCKS
int hmlfc_dut_decode_block(hmlfc_dut *dut, uint32_t row, uint32_t col, uint32_t plane,
                           uint32_t block_x, uint32_t block_y, uint32_t stop_level,
                           int32_t *samples) {
  (void)dut; (void)row; (void)col; (void)block_x; (void)block_y; (void)stop_level;
  for (int i = 0; i < 16; ++i) samples[i] = plane == 0 ? 128 : 0;
  return 0;
}
#endif
void hmlfc_dut_close(hmlfc_dut *dut) { (void)dut; }
"""

DEFAULTS = {"ABI": "HMLFC_DUT_ABI", "OPEN_STATUS": "0", "WIDTH": "40", "BODY": ";"}


class Library(ConformTest):
    def setUp(self):
        if COMPILER is None:
            self.skipTest("no C compiler")

    def library(self, name, **settings):
        source = self.folder / f"{name}.c"
        source.write_text(LIBRARY)
        target = self.folder / f"lib{name}.so"
        macros = [f"-D{key}={value}" for key, value in {**DEFAULTS, **settings}.items()]
        command = [COMPILER, *STRICT, *macros, "-shared", "-fPIC", "-o", target, source]
        subprocess.run(command, check=True)
        return target

    def test_headers_are_c99(self):
        for header in ("hmlfc/hmlfc_dut.h", "dut/hmlfc_checker.h"):
            source = self.folder / "one.c"
            source.write_text(f"#include <{header}>\nint main(void) {{ return 0; }}\n")
            subprocess.run([COMPILER, *STRICT, "-fsyntax-only", source], check=True)

    def test_views_and_blocks(self):
        library = self.library("grey")
        (self.folder / "any").write_bytes(b"any")
        requests = "0 hello 1\n1 open any\n2 view 0 0\n3 block 0 0 0 1 1 0\n4 trace 0 0 0 1 1 0\n5 close\n6 view 0 0\n"
        result = self.run_hmlfc("serve", library, input=requests.encode())
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(
            result.stdout.decode().splitlines(),
            [
                "0 ok 1 view block levels",
                "1 ok 4 4 40 32 8 0 2 1",
                "2 ok " + 40 * 32 * 3 * "0080",
                "3 ok " + 16 * "0080",
                "4 error bad_request",
                "5 ok",
                "6 error bad_request",
            ],
        )

    def test_what_a_library_prints_is_no_answer(self):
        library = self.library("prints", BODY='puts("decoding");')
        (self.folder / "any").write_bytes(b"any")
        result = self.run_hmlfc("serve", library, input=b"1 open any\n2 view 0 0\n")
        self.assertEqual(result.stdout.decode().splitlines()[1], "2 ok " + 40 * 32 * 3 * "0080")
        self.assertIn("decoding", result.stderr.decode())

    def test_streams_that_cannot_be_read(self):
        result = self.run_hmlfc("serve", self.library("grey"), input=b"1 open nowhere\n")
        self.assertEqual(result.returncode, INPUT)
        self.assertIn("nowhere", result.stderr.decode())

    def test_wrong_libraries(self):
        cases = (
            ("other_abi", {"ABI": "7"}, "error", "version 7 of hmlfc_dut.h"),
            ("no_blocks", {"WITHOUT_BLOCKS": ""}, "error", "no function hmlfc_dut_decode_block"),
            ("wide", {"WIDTH": "70000"}, "fail", "width 70000 instead of 40"),
            ("refuses", {"OPEN_STATUS": "22"}, "fail", "bad_levels"),
            ("unknown_status", {"OPEN_STATUS": "99"}, "fail", "status 99"),
            ("absent", {"OPEN_STATUS": "HMLFC_DUT_CANNOT_RUN"}, "skipped", "cannot run here"),
            ("crashes", {"BODY": "abort();"}, "error", "signal 6"),
            ("grey", {}, "fail", "128 instead of"),
        )
        for name, settings, status, reason in cases:
            with self.subTest(library=name):
                _, report = self.conform(
                    self.library(name, **settings), "--filter", "real/cards-main", output=name
                )
                result = self.results(report)["real/cards-main"]
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result["reason"])

    def test_gpu_decoder(self):
        """The small suite: gpu.vectors decodes all vectors without a process for each."""
        status, report = self.conform(SUITE / "duts" / "gpu.json")
        if status == INCOMPLETE:
            self.skipTest("no Vulkan device here")
        self.assertEqual(status, 0, report)
        self.assertEqual({result["status"] for result in self.results(report).values()}, {"pass"})


if __name__ == "__main__":
    main()
