"""`hmlfc conform` on faulty decoders: what the report says of wrong views, errors, files and processes."""

import json

from conform_case import SUITE, ConformTest, faulty, main
from faulty_decoder import FAULTS

# How samples of more than 8 bits are stored, on a vector of 10 bits.
STORED = {
    "big_endian_raw": ("fail", "more than 10 bits"),
    "low_bits_of_png": ("fail", "instead of"),
    "png_without_depth": ("fail", "of 12 bits instead of"),
    "high_bits_of_png": ("pass", ""),
}

# Each fault of the process, and what must come of it on any vector that decodes.
PROCESS_RESULTS = {
    "missing_output": ("fail", "wrong output"),
    "no_output": ("fail", "wrong output"),
    "truncated_picture": ("fail", "wrong output"),
    "short_raw": ("fail", "17 bytes"),
    "wrong_exit_code": ("fail", "exit status 1"),
    "crash": ("error", "signal 11"),
    "hang": ("timeout", "timed out after"),
    "hanging_child": ("pass", ""),  # no fault of the views: the child is killed
    "endless_messages": ("timeout", "timed out after"),
    "memory_hog": ("fail", "exit status 1"),
}


class Faults(ConformTest):
    def run_on(self, fault, vector, *arguments, dut=None):
        status, report = self.conform(
            dut or faulty(fault), "--filter", vector, *arguments, suite=SUITE, output=fault
        )
        result = self.results(report)[vector]
        self.assertEqual(status, 1 if result["status"] not in ("pass", "skipped") else 5)
        return result

    def test_every_fault_is_run(self):
        others = {"chroma_shifted", "sections_unchecked", "accepts_everything"}
        self.assertEqual({*STORED, *PROCESS_RESULTS, *others}, set(FAULTS))

    def test_wrong_views(self):
        result = self.run_on("chroma_shifted", "syntax/blocks-4-420")
        self.assertEqual(result["status"], "fail", result)
        difference = result["difference"]
        self.assertGreater(difference["wrong_blocks"], 0)
        self.assertNotEqual(difference["expected"], difference["actual"])
        self.assertTrue(difference["planes"])
        pictures = self.folder / "chroma_shifted" / result["pictures"]
        self.assertEqual(
            sorted(path.name for path in pictures.iterdir()),
            ["actual.png", "difference.png", "expected.png"],
        )

    def declaration(self, fault, **claims):
        file = self.folder / f"{fault}.json"
        file.write_text(json.dumps({"name": fault, "command": faulty(fault), "error_names": True, **claims}))
        return file

    def test_sections_are_checked_where_claimed(self):
        for claim, status in ((True, "fail"), (False, "pass")):
            dut = self.declaration("sections_unchecked", checks_sections=claim)
            result = self.run_on("sections_unchecked", "error/section-crc-tile", dut=dut)
            self.assertEqual(result["status"], status, result)

    def test_stored_samples(self):
        for fault, (status, reason) in STORED.items():
            with self.subTest(fault=fault):
                result = self.run_on(fault, "real/glass-depth10")
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result.get("reason", ""))

    def test_process(self):
        for fault, (status, reason) in PROCESS_RESULTS.items():
            with self.subTest(fault=fault):
                seconds = "5" if status == "timeout" else "60"
                limits = ("--timeout", seconds, "--memory", "4096")
                result = self.run_on(fault, "real/cards-main", *limits)
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result.get("reason", ""))

    def test_accepting_what_must_be_refused(self):
        for vector in ("error/magic", "error/sign-mode-3", "error/trailing-byte"):
            with self.subTest(vector=vector):
                result = self.run_on("accepts_everything", vector)
                self.assertEqual(result["status"], "fail")
                self.assertIn("must be refused with", result["reason"])

    def test_refusing_with_another_error(self):
        dut = self.folder / "other_error.json"
        command = "sh -c 'echo bad_mode_x bad_levels >&2; exit 4' {input} {output}"
        dut.write_text(json.dumps({"name": "other", "command": command, "error_names": True}))
        _, report = self.conform(dut, "--filter", "error/*")
        result = self.results(report)["error/sign-mode-3"]
        self.assertEqual(result["status"], "fail")
        self.assertIn("another error than bad_mode: bad_levels", result["reason"])


if __name__ == "__main__":
    main()
