"""The self-test of the conformance suite: decoders that must fail, and the vector that catches each."""

import json

from conform_case import SUITE, ConformTest, faulty, main
from faulty_decoder import ARITHMETIC, PROCESS

# Each planted fault of the arithmetic, and a vector that must catch it.
HUNTED_BY = {
    "wrong_rounding": "syntax/subpel-3",
    "disparity_rounded_down": "syntax/disparity-precision-0-5",
    "trit_digits_swapped": "syntax/bise-levels-3",
    "lowest_trit_code": "syntax/bise-every-trit-code",
    "quint_digits_swapped": "syntax/bise-levels-5",
    "neighbours_exchanged": "syntax/references-1",
    "border_off_by_one": "boundary/vector-border-one",
    "sign_ignored": "syntax/signs-minus",
    "stale_cache": "syntax/many-tiles",
    "bias_ignored": "syntax/headers-bias-bits-5",
    "step_doubled": "syntax/steps-all",
    "chroma_shifted": "syntax/blocks-4-420",
    "colour_without_clamp": "boundary/colour-clamps-depth8",
    "eight_bit_samples": "syntax/depth-9",
}

# Each planted fault of the process, and what must come of it on any vector that decodes.
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
    def run_on(self, fault, vector, *arguments):
        status, report = self.conform(
            faulty(fault), "--filter", vector, *arguments, suite=SUITE, output=fault
        )
        result = self.results(report)[vector]
        self.assertEqual(status, 1 if result["status"] not in ("pass", "skipped") else 5)
        return result

    def test_every_fault_is_run(self):
        self.assertEqual(set(HUNTED_BY), set(ARITHMETIC))
        self.assertEqual(set(PROCESS_RESULTS) | {"accepts_everything"}, set(PROCESS))

    def test_without_a_fault(self):
        for vector in sorted(set(HUNTED_BY.values())):
            with self.subTest(vector=vector):
                self.assertEqual(self.run_on("none", vector)["status"], "pass")

    def test_arithmetic(self):
        for fault, vector in HUNTED_BY.items():
            with self.subTest(fault=fault):
                result = self.run_on(fault, vector)
                self.assertEqual(result["status"], "fail", result)
                if "difference" not in result:  # the fault led it to refuse the stream
                    self.assertIn("refused a valid stream", result["reason"])
                    continue
                difference = result["difference"]
                self.assertGreater(difference["wrong_blocks"], 0)
                self.assertNotEqual(difference["expected"], difference["actual"])
                self.assertTrue(difference["planes"])
                pictures = self.folder / fault / result["pictures"]
                self.assertEqual(
                    sorted(path.name for path in pictures.iterdir()),
                    ["actual.png", "difference.png", "expected.png", "heat.png"],
                )

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
        self.assertIn("another error than bad_mode: bad_mode_x bad_levels", result["reason"])


if __name__ == "__main__":
    main()
