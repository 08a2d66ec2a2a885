"""The form of each --help, and its example, which works as it stands."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess

from program import PROGRAM, ROOT, CliTest, main

class Help(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 9x9 --size 136x72 -o views".split())
        cls.hmlfc("encode", "views", "-o", "chess.hmlfc")
        for name in ("map.pfm", "gt_disp_lowres.pfm"):
            cls.hmlfc("disparity", "chess.hmlfc", "-o", name)
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

    def commands(self, command=""):
        """`command` and all that --help lists below it."""
        listed = re.findall(r"(?ms)^(?:Start|Your [a-z ]+|More|Subcommands):\n(.*?)^$", self.help_of(command))
        names = re.findall(r"(?m)^  (\S+)", "".join(listed))
        below = [self.commands(f"{command} {name}".strip()) for name in names]
        return [command, *(name for some in below for name in some)]

    def test_forms(self):
        commands = self.commands()
        self.assertGreater(len(commands), 25)
        for command in commands:
            with self.subTest(command=command):
                text = self.help_of(command)
                usage = re.search(r"^Usage: (.*)$", text, re.MULTILINE).group(1)
                self.assertTrue(usage.startswith(f"hmlfc {command}".rstrip()), usage)
                self.assertEqual(text, self.hmlfc(*command.split(), "-h"))
                self.assertEqual(text, self.hmlfc("help", *command.split()))
                self.assertLessEqual(max(map(len, text.splitlines())), 104)
        for code in (0, 1, 2, 3, 4, 5, 77):
            self.assertRegex(self.help_of(""), rf"(?s)Exit status: .*\b{code} [a-z]")

    def serve_until_interrupted(self, arguments):
        with subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE) as server:
            self.assertTrue(server.stdout.readline().startswith(b"http://127.0.0.1:"))
            server.send_signal(signal.SIGINT)
            self.assertEqual(server.wait(timeout=60), 0)

    def test_examples_work(self):
        for command in self.commands():
            # These need the whole suite, or views of another aspect.
            if command.startswith(("vectors", "convert")):
                continue
            text = self.help_of(command)
            examples = re.findall(r"(?m)^  (hmlfc .*)$", text[text.index("Example") :])
            self.assertTrue(examples, command)
            for example in examples:
                # The rendering in the example is as it stands, but for its size.
                arguments = shlex.split(example.replace("512x384", "136x72").replace("482,482", "106,42"))
                self.assertEqual(arguments[: 1 + len(command.split())], ["hmlfc", *command.split()])
                with self.subTest(example=example):
                    if arguments[1] == "view":
                        self.serve_until_interrupted(arguments[1:])
                        continue
                    end = arguments.index("<") if "<" in arguments else len(arguments)
                    source = arguments[-1] if "<" in arguments else os.devnull
                    with open(self.folder / source, "rb") as stdin:
                        result = self.run_hmlfc(*arguments[1:end], stdin=stdin)
                    self.assertIn(result.returncode, (0, 1) if "compare" in example else (0,))


if __name__ == "__main__":
    main()
