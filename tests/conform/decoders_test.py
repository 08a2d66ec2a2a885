"""Decoders under test that do harm: it ends with their run, which is one result. Who runs one holds the folder."""

import json
import os
import shutil
import subprocess
import time

from conform_case import COARSE, GOLDEN, PROGRAM, SUITE, ConformTest, main, make_suite
from program import DONE, USAGE

ONE = "syntax/base-main"


class Decoders(ConformTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.one = cls.folder / "one"
        make_suite(cls.one, (ONE,))

    def script(self, text):
        """The command line of a shell script with the arguments INPUT and OUTPUT."""
        file = self.folder / "decoder.sh"
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)
        return f"{file} {{input}} {{output}}"

    def result_of(self, dut, *arguments, vector=ONE):
        _, report = self.conform(dut, "--filter", vector, *arguments, suite=SUITE)
        return self.results(report)[vector]

    def test_input_is_its_own(self):
        """A decoder that destroys its input harms neither the suite nor what runs after it."""
        ids = (ONE, "real/cards-main")
        folder = self.folder / "copied"
        make_suite(folder, ids)
        for group in ("syntax", "real"):
            (folder / group).unlink()
            (folder / group).mkdir()
        for name in ids:
            for file in SUITE.glob(f"{name}.*"):
                shutil.copy(file, folder / name.split("/")[0])
        before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        trace = 'rm "$1"; mkdir "$1"'
        places = "{view_row} {view_col} {plane} {block_x} {block_y}"
        dut = self.folder / "writes.json"
        command = self.script('"$HMLFC" decode "$1" --levels 1 -o "$2"; echo junk > "$1"; ln -sf /etc/hostname "$1"')
        trace = f"sh -c 'cmp \"$1\" \"$0\"; {trace}' {folder}/real/cards-main.hmlfc {{input}} {places}"
        dut.write_text(json.dumps({"name": "writes", "command": command, "trace": trace}))
        lines = self.folder / "lines.py"
        _, report = self.conform(dut, suite=folder)
        self.assertEqual(self.results(report)["real/cards-main"]["stage"].count("no trace: exit status 0"), 3)
        lines.write_text(
            "import sys\n"
            "for line in sys.stdin:\n"
            "    number, word, *rest = line.split()\n"
            "    if word == 'open': open(rest[0], 'w').write('junk')\n"
            "    print(number, 'ok 1 view' if word == 'hello' else 'error bad_magic', flush=True)\n"
        )
        self.conform(f"lines: python3 {lines}", suite=folder)
        self.assertEqual({path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}, before)
        _, report = self.conform(GOLDEN, suite=folder)
        self.assertEqual({result["status"] for result in self.results(report).values()}, {"pass"})
        stream = self.folder / "mine.hmlfc"
        shutil.copy(SUITE / "boundary/view-1x1.hmlfc", stream)
        self.hmlfc("minimise", stream, "--dut", self.script('echo junk > "$1"; exit 1'), "--trials", "3", "-o", "least")
        self.assertEqual(stream.read_bytes(), (SUITE / "boundary/view-1x1.hmlfc").read_bytes())

    def test_outputs_that_are_no_files(self):
        """What cannot be read as views fails that vector, at once and without much memory."""
        for text, says in (
            ('mkfifo "$2/views.raw"', "not a regular file"),
            ('ln -s /dev/zero "$2/views.raw"', "not a regular file"),
            ('truncate -s 3G "$2/views.raw"', "instead of"),
            ('mkfifo "$2/00_00.png" "$2/00_01.png"', "not a regular file"),
            ('mkdir "$2/00_00.png"', "no PNG"),
            ('printf "P6 60000 11000 255\\n" | tee "$2/00_01.ppm" > "$2/00_00.ppm"; truncate -s 2G "$2"/*', "over the limit"),
        ):
            with self.subTest(text=text):
                result = self.result_of(self.script(text))
                self.assertEqual(result["status"], "fail", result)
                self.assertIn(says, result["reason"])

    def test_wrong_traces(self):
        """Lines of a trace that are no stages are passed over, whatever they are."""
        stage = '{"record": "stage", "stage": "parent", "plane": "Y", "image": [0, 0], "block": [0, 0], '
        for line in (
            '{"record": 1}', '{"record": "stage", "plane": 3}', '{"record": "stage", "plane": "Y", "image": 1}',
            stage + '"values": [1e300], "level": 0}', stage + '"values": [1], "level": ' + "[" * 20_000,
        ):  # fmt: skip
            dut = self.folder / "traced.json"
            places = "{input} {view_row} {view_col} {plane} {block_x} {block_y}"
            trace = f"sh -c 'echo \"$0\"' '{line}' {places}"
            dut.write_text(json.dumps({"name": "traced", "command": COARSE, "trace": trace}))
            result = self.result_of(dut, vector="syntax/base-reference")
            self.assertEqual(result["status"], "fail", result)
            self.assertIn("no trace", result["stage"])

    def test_terminal_gets_no_control_characters(self):
        dut = self.script("printf 'a\\033]0;b\\007\\302\\233c\\n' >&2; exit 3")
        text = self.run_hmlfc("conform", "--suite", self.one, "--dut", dut, "-o", "shown").stdout
        self.assertIn(b"a\\u001b]0;b\\u0007\\u009bc", text)
        self.assertNotIn(b"\x1b", text)
        self.assertNotIn(b"\xc2\x9b", text)

    def left_over(self, mark):
        """Whether a process has `mark` in its environment, a moment after it was to end."""
        for _ in range(50):
            found = []
            for entry in os.listdir("/proc"):
                try:
                    with open(f"/proc/{entry}/environ", "rb") as file:
                        found += [entry] if mark.encode() in file.read() else []
                except OSError:
                    pass
            if not found:
                return False
            time.sleep(0.1)
        return True

    def test_children_in_sessions_of_their_own(self):
        """They end with the run, however it ends; those of another run do not."""
        mark = f"HMLFC_TEST_MARK={os.getpid()}-{time.monotonic_ns()}"
        nested = "setsid sh -c 'setsid sleep 1000 & setsid sleep 1000' >/dev/null 2>&1 &"
        leave = f"export {mark}; setsid sleep 1000 >/dev/null 2>&1 & {nested} sleep 0.2; "
        for end, status, arguments in (
            ('exec "$HMLFC" decode "$1" -o "$2"', "pass", ()),
            ("kill -SEGV $$", "error", ()),
            ("sleep 1000", "timeout", ("--timeout", "2")),
            ("kill -STOP $PPID; sleep 1000", "timeout", ("--timeout", "2")),
        ):
            with self.subTest(end=end):
                self.assertEqual(self.result_of(self.script(leave + end), *arguments)["status"], status)
                self.assertFalse(self.left_over(mark))
        run = subprocess.Popen(
            [PROGRAM, "conform", "--suite", self.one, "--dut", self.script(leave + f"touch {self.folder}/begun; sleep 1000"), "-o", "killed"],
            cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        while not (self.folder / "begun").exists():
            time.sleep(0.05)
        run.kill()
        run.wait()
        self.assertFalse(self.left_over(mark))

    def test_a_command_that_is_not_utf8(self):
        dut = self.script('exec "$HMLFC" decode "$1" -o "$2"') + os.fsdecode(b" \xff")
        status, _ = self.conform(dut, "--claim", "latin1.json", suite=self.one, output="latin1")
        self.assertEqual(status, DONE)
        status, _ = self.conform(dut, "--resume", suite=self.one, output="latin1")
        self.assertEqual(status, DONE)
        self.assertIn("\N{REPLACEMENT CHARACTER}", json.loads((self.folder / "latin1.json").read_text())["claim"]["decoder"]["dut"])

    def test_folders_without_end_are_removed(self):
        deep = "cd $2; i=0; while [ $i -lt 3000 ]; do mkdir d; cd d; i=$((i + 1)); done"
        self.conform(self.script(deep), suite=self.one, output="deep")
        self.assertEqual(list((self.folder / "deep").glob("*/work-*")), [])

    def test_children_of_another_run_go_on(self):
        """A run that ends does not end a child, in a session of its own, of another run."""
        child = 'setsid sh -c "sleep 1; touch $2/../child" & while [ ! -e "$2/../child" ]; do sleep 0.1; done'
        dut = self.script(f'case $1 in *cards*) {child};; esac; exec "$HMLFC" decode "$1" -o "$2"')
        _, report = self.conform(dut, "--jobs", "2", "--timeout", "60")
        self.assertEqual(self.results(report)["real/cards-main"]["status"], "pass")

    def test_two_runs_into_one_folder(self):
        command = [PROGRAM, "conform", "--suite", self.one, "--dut", "sh -c 'touch held; sleep 1000' {input} {output}", "-o", "shared"]
        first = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(first.wait)
        self.addCleanup(first.kill)
        while not (self.folder / "held").exists():
            time.sleep(0.05)
        says = f"in use by process {first.pid}"
        self.refused(USAGE, "conform", "--suite", self.one, "--dut", GOLDEN, "-o", "shared", says=says)
        self.refused(USAGE, "fuzz-dut", "--dut", GOLDEN, "--count", "1", "-o", "shared", says=says)
        first.kill()
        first.wait()
        status, _ = self.conform(GOLDEN, suite=self.one, output="shared")
        self.assertEqual(status, DONE)
        self.assertEqual([path.name for path in (self.folder / "shared").glob(".*")], [])


if __name__ == "__main__":
    main()
