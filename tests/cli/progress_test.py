"""The progress bar: only on a terminal, only for what takes more than a second."""

import os
import pty
import subprocess

from program import PROGRAM, CliTest, main

LONG = "synth --scene knights --grid 4x4 --size 640x480 --threads 1 -o views".split()
SHORT = "synth --scene flat --grid 1x1 --size 8x8 -o short".split()


class Progress(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*LONG)  # standard error stays empty

    def on_terminal(self, arguments):
        """What standard error, a terminal, receives, and standard output, a pipe."""
        try:
            leader, follower = pty.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal here: {error}")
        child = subprocess.Popen(
            [PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=follower
        )
        os.close(follower)
        received = b""
        try:
            while part := os.read(leader, 65536):
                received += part
        except OSError:  # the other end is closed
            pass
        finally:
            os.close(leader)
        output = child.communicate(timeout=240)[0]
        self.assertEqual(child.returncode, 0)
        return received.decode(), output.decode()

    def test_long_work_on_a_terminal(self):
        shown, output = self.on_terminal(LONG)
        self.assertRegex(
            shown,
            r"\r\x1b\[KRendering  \[#*\.*\] +\d+ %  \d+/16 views  \d+\.\d/s  \d+:\d\d left",
        )
        self.assertTrue(shown.endswith("\r\x1b[K"), "the line is wiped at the end")
        self.assertNotIn("\n", shown)
        self.assertNotIn("\r", output)
        self.assertIn("4 x 4 views", output)

    def test_short_work_on_a_terminal(self):
        shown, output = self.on_terminal(SHORT)
        self.assertEqual(shown, "")
        self.assertIn("1 x 1 views", output)


if __name__ == "__main__":
    main()
