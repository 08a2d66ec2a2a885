"""A folder in which the commands of a document run, on the programs of a build that has everything.

It has a small light field FOLDER, streams of the suite (FILE, FILE.hmlfc and my.hmlfc of profile
extended, bad.hmlfc of profile main), a decoder ./mydec with its declaration mydec.json, a renderer ./myrender, links to the
folders of the repository that commands name, a stand-in for ffmpeg, and a ./run that builds and installs
nothing.
"""

import os
import shutil
import subprocess

LINKS = ("docs", "examples", "vectors", "tests", "CMakeLists.txt", "CMakePresets.json")
CPU_LIMIT = 60  # seconds of CPU time of a program, on a busy machine, too
TIMEOUT = 300  # seconds of a command, on a busy machine

RUN = """#!/usr/bin/env bash
source "{root}/run"
build={build}
install_packages() {{ :; }}
build() {{ :; }}
build_decode_path() {{ :; }}
main "$@"
"""
MYDEC = """#!/usr/bin/env bash
exec hmlfc decode "$1" -o "$3"
"""
MYRENDER = """#!/usr/bin/env bash
exec python3 -B tests/naive_decoder/render.py "$1" "{\\"record\\": [$2], \\"stop_level\\": $3}" -o "$4/frame.raw"
"""
DECLARATION = '{ "name": "mydec", "command": "{dut}/mydec {input} -o {output}" }\n'
FIXTURE = (
    "hmlfc synth --scene knights --grid 4x4 --size 64x48 -o FOLDER",
    "cp vectors/real/knights-extended.hmlfc FILE",
    "cp FILE FILE.hmlfc && cp FILE my.hmlfc && cp vectors/real/cards-main.hmlfc bad.hmlfc",
)


class Sandbox:
    def __init__(self, folder, root, build, program):
        self.folder = folder
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "bin").mkdir(parents=True)
        for name in LINKS:
            (folder / name).symlink_to(root / name)
        self._script("run", RUN.format(root=root, build=build))
        (folder / "bin" / "hmlfc").symlink_to(program)
        (folder / "bin" / "ffmpeg").symlink_to(root / "tests/support/ffmpeg")
        self._script("mydec", MYDEC)
        self._script("myrender", MYRENDER)
        (folder / "mydec.json").write_text(DECLARATION, encoding="utf-8")
        self.environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}", BUILD=str(build))
        for command in FIXTURE:
            result = self.run(command)
            if result.returncode:
                raise RuntimeError(f"{command}: {result.stdout}{result.stderr}")

    def _script(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)

    def run(self, command):
        """The finished process; status 124 where it takes longer than TIMEOUT, 137 than CPU_LIMIT."""
        try:
            return subprocess.run(["bash", "-o", "pipefail", "-c", f"ulimit -t {CPU_LIMIT}; {command}"], cwd=self.folder,
                                  env=self.environment, stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, timeout=TIMEOUT, check=False)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(command, 124, "", f"takes longer than {TIMEOUT} s\n")
