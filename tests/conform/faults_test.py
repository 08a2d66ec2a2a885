"""The self-test of the conformance suite: decoders that must fail, and the vector that catches each."""

from conform_case import ConformTest, faulty, main
from faulty_decoder import ARITHMETIC, PROCESS

# Each planted fault of the arithmetic, and a vector that must catch it.
HUNTED_BY = {
    "wrong_rounding": "real/knights-extended",
    "trit_digits_swapped": "real/cards-main",
    "quint_digits_swapped": "real/cards-main",
    "border_off_by_one": "real/cards-main",
    "sign_ignored": "real/cards-main",
    "bias_ignored": "real/knights-extended",
    "step_doubled": "real/knights-extended",
    "chroma_shifted": "real/cards-main",
    "colour_without_clamp": "real/cards-main",
    "eight_bit_samples": "real/glass-depth10",
}

# Each planted fault of the process, and what must come of it on any vector that decodes.
PROCESS_RESULTS = {
    "missing_output": ("fail", "wrong output"),
    "no_output": ("fail", "wrong output"),
    "truncated_picture": ("fail", "wrong output"),
    "short_raw": ("fail", "17 bytes"),
    "wrong_exit_code": ("fail", "exit status 1"),
    "crash": ("error", "signal 11"),
    "hang": ("timeout", "no end within"),
    "hanging_child": ("pass", ""),  # no fault of the views: the child is killed
    "endless_messages": ("timeout", "no end within"),
    "memory_hog": ("fail", "exit status 1"),
}


class Faults(ConformTest):
    def run_on(self, fault, vector, *arguments):
        status, report = self.conform(faulty(fault), "--filter", vector, *arguments, output=fault)
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
                result = self.run_on(fault, "real/cards-main", "--timeout", "5", "--memory", "4096")
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result.get("reason", ""))


if __name__ == "__main__":
    main()
