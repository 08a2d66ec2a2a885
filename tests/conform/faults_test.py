"""`hmlfc conform` on faulty decoders: what the report says of wrong views, errors, files and processes."""

import json
import shlex
import sys

from conform_case import COARSE, ROOT, SUITE, ConformTest, main

DECODE = '"$HMLFC" decode "$1" -o "$2"'
NAIVE = f"{shlex.quote(sys.executable)} -B {ROOT / 'tests/naive_decoder/decode.py'}"

# What a decoder does with stream $1 and folder $2, and what must come of it on a vector that decodes.
PROCESSES = {
    f'{DECODE}; rm "$(ls "$2"/* | tail -1)"': ("fail", "wrong output"),
    "true": ("fail", "wrong output"),
    f'{DECODE}; truncate -s -40 "$(ls "$2"/* | tail -1)"': ("fail", "wrong output"),
    'printf %17s > "$2/views.raw"': ("fail", "17 bytes"),
    f"{DECODE}; exit 1": ("fail", "exit status 1"),
    f"{DECODE}; kill -SEGV $$": ("error", "signal 11"),
    f"{DECODE}; sleep 1000": ("timeout", "timed out after"),
    f"sleep 1000 & {DECODE}": ("pass", ""),  # the child, which holds the output open, is killed
    "yes >&2": ("timeout", "timed out after"),
    "exec python3 -c 'bytearray(1 << 40)'": ("fail", "exit status 1"),
}

# The same on a vector of 10 bits: raw samples with the high byte first, pictures that do not tell their depth.
STORED = {
    f'{NAIVE} "$1" -o "$2"; mv "$2/views.raw" "$2/raw"; dd if="$2/raw" of="$2/views.raw" conv=swab': ("fail", "more than 10 bits"),
    f'{DECODE}; sed -i s/sBIT/sBIx/ "$2"/*.png': ("fail", "of 12 bits instead of"),
}


def shell(script):
    """The command line of a decoder in a shell."""
    return f"sh -c {shlex.quote(script)} sh {{input}} {{output}}"


class Faults(ConformTest):
    def run_on(self, dut, vector, *arguments):
        status, report = self.conform(dut, "--filter", vector, *arguments, suite=SUITE)
        result = self.results(report)[vector]
        self.assertEqual(status, 1 if result["status"] not in ("pass", "skipped") else 5)
        return result

    def test_wrong_views(self):
        result = self.run_on(COARSE, "syntax/blocks-4-420")
        self.assertEqual(result["status"], "fail", result)
        difference = result["difference"]
        self.assertGreater(difference["wrong_blocks"], 0)
        self.assertNotEqual(difference["expected"], difference["actual"])
        self.assertTrue(difference["planes"])
        pictures = self.folder / "report" / result["pictures"]
        self.assertEqual(
            sorted(path.name for path in pictures.iterdir()),
            ["actual.png", "difference.png", "expected.png"],
        )

    def test_sections_are_checked_where_claimed(self):
        dut = self.folder / "unchecked.json"
        # The stream differs from its base in a crc alone.
        command = shell(f'"$HMLFC" decode {SUITE}/syntax/base-main.hmlfc -o "$2"')
        for claim, status in ((True, "fail"), (False, "pass")):
            dut.write_text(json.dumps({"name": "unchecked", "command": command, "checks_sections": claim}))
            result = self.run_on(dut, "error/section-crc-tile")
            self.assertEqual(result["status"], status, result)

    def check(self, cases, vector):
        for script, (status, reason) in cases.items():
            with self.subTest(script=script):
                seconds = "5" if status == "timeout" else "60"
                result = self.run_on(shell(script), vector, "--timeout", seconds, "--memory", "4096")
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result.get("reason", ""))

    def test_process(self):
        self.check(PROCESSES, "real/cards-main")

    def test_stored_samples(self):
        self.check(STORED, "real/glass-depth10")

    def test_accepting_what_must_be_refused(self):
        for vector in ("error/magic", "error/sign-mode-3", "error/trailing-byte"):
            with self.subTest(vector=vector):
                result = self.run_on(shell(f"{DECODE}; true"), vector)
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
