"""Each --help names every option, and its example works as it stands."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess

from program import PROGRAM, ROOT, CliTest, main

COMMANDS = {
    "": ["--help", "--version"],
    "synth": ["--scene", "--grid", "--size", "--baseline", "--seed", "--cameras", "--disparity", "--rig",
              "--output"],
    "encode": ["--grid", "--views", "--profile", "--method", "--cluster", "--height", "--block", "--window",
               "--threshold-ref", "--threshold-pred", "--quality", "--preset", "--target-psnr", "--target-bpp", "--max-bytes", "--chroma", "--lossless",
               "--references", "--rig", "--no-rig", "--threads", "--json", "--output"],
    "decode": ["--view", "--rect", "--levels", "--threads", "--output"],
    "disparity": ["--view", "--output"],
    "info": ["--rig", "--json"],
    "compare": ["--json"],
    "inspect": ["--view", "--plane", "--block", "--json"],
    "bise": ["enc", "dec"],
    "bise enc": ["LEVELS", "V"],
    "bise dec": ["LEVELS", "COUNT", "HEX"],
    "render": ["--camera", "--look-at", "--fov", "--size", "--filter", "--focus", "--focus-at", "--aperture", "--path",
               "--frames", "--focal", "--shear", "--row-pitch", "--levels", "--backend", "--device", "--cache",
               "--preview", "--quality-vs-time", "--threads", "--json", "--output"],
    "reference-area": ["--output"],
    "view": ["--original", "--dut", "--view", "--plane", "--block", "--port", "--no-ahead", "--no-browser", "--once"],
    "picture": ["view", "sheet", "difference"],
    "picture view": ["--view", "--output"],
    "picture sheet": ["--max-width", "--output"],
    "picture difference": ["--view", "--gain", "--output"],
    "conform": ["--suite", "--dut", "--timeout", "--memory", "--filter", "--milestone", "--jobs", "--shard",
                "--merge", "--resume", "--claim", "--verify", "--run-claimed", "--json", "--output"],
    "serve": ["LIBRARY"],
    "minimise": ["--dut", "--timeout", "--memory", "--trials", "--output"],
    "fuzz-dut": ["--dut", "--timeout", "--memory", "--minutes", "--count", "--seed", "--failures", "--output"],
}  # fmt: skip


class Help(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 9x9 --size 136x72 -o views".split())
        cls.hmlfc("encode", "views", "-o", "chess.hmlfc")
        rig = {"schema": 1, "positions": [[col, row, 0] for row in range(9) for col in range(9)]}
        (cls.folder / "rig.json").write_text(json.dumps(rig))
        cls.hmlfc("encode", "views", "-o", "posed.hmlfc", "--rig", "rig.json")
        cls.make_small_suite()
        (cls.folder / "libhmlfc_dut_model.so").symlink_to(PROGRAM.parent / "libhmlfc_dut_model.so")
        (cls.folder / "lytro").mkdir()
        for i, name in enumerate(sorted(os.listdir(cls.folder / "views"))):
            shutil.copy(cls.folder / "views" / name, cls.folder / "lytro" / f"IMG{i}.png")

    @classmethod
    def make_small_suite(cls):
        """The folder `vectors` with a few of the conformance suite, all of which conform.model decodes."""
        shutil.copytree(ROOT / "vectors" / "real", cls.folder / "vectors" / "real")
        manifest = json.loads((ROOT / "vectors" / "manifest.json").read_text())
        manifest["vectors"] = [vector for vector in manifest["vectors"] if vector["group"] == "real"]
        manifest["count"] = len(manifest["vectors"])
        (cls.folder / "vectors" / "manifest.json").write_text(json.dumps(manifest))

    def help_of(self, command):
        return self.hmlfc(*command.split(), "--help")

    def test_options(self):
        for command, options in COMMANDS.items():
            with self.subTest(command=command):
                text = self.help_of(command)
                usage = re.search(r"^Usage: (.*)$", text, re.MULTILINE).group(1)
                self.assertTrue(usage.startswith(f"hmlfc {command}".rstrip()), usage)
                for option in options:
                    self.assertRegex(text, rf"(?m)^  (-\w,)?{option}\b")
                self.assertEqual(text, self.hmlfc(*command.split(), "-h"))
                self.assertLessEqual(max(map(len, text.splitlines())), 104)

    def test_all_commands_are_listed(self):
        for command in COMMANDS:
            if command and " " not in command:
                self.assertRegex(self.help_of(""), rf"(?m)^  {command} ")

    def test_exit_status(self):
        for code in (0, 1, 2, 3, 4, 5, 77):
            self.assertRegex(self.help_of(""), rf"(?m)^  {code} ")

    def serve_until_interrupted(self, arguments):
        with subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE) as server:
            self.assertTrue(server.stdout.readline().startswith(b"http://127.0.0.1:"))
            server.send_signal(signal.SIGINT)
            self.assertEqual(server.wait(timeout=60), 0)

    def test_examples_work(self):
        for command in COMMANDS:
            text = self.help_of(command)
            examples = re.findall(r"(?m)^  (hmlfc .*)$", text[text.index("Example") :])
            self.assertTrue(examples, command)
            for example in examples:
                # The rendering in the example is as it stands, but for its size.
                arguments = shlex.split(example.replace("512x384", "136x72"))
                self.assertEqual(arguments[: 1 + len(command.split())], ["hmlfc", *command.split()])
                with self.subTest(example=example):
                    if command == "view":
                        self.serve_until_interrupted(arguments[1:])
                        continue
                    end = arguments.index("<") if "<" in arguments else len(arguments)
                    source = arguments[-1] if "<" in arguments else os.devnull
                    with open(self.folder / source, "rb") as stdin:
                        result = self.run_hmlfc(*arguments[1:end], stdin=stdin)
                    self.assertIn(result.returncode, (0, 1) if "compare" in example else (0,))


if __name__ == "__main__":
    main()
