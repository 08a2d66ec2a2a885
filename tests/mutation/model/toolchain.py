"""Compiles one changed source of the decode path and links vector_check with it."""

import json
import shlex
import subprocess
from pathlib import Path

from scope import LAYERS  # mutate.py has made its folder known
from session import tried

MEMORY_BYTES = 8 << 30
# With these glibc aborts when a program frees a block that it wrote beyond.
CHECKED_HEAP = {"LD_PRELOAD": "libc_malloc_debug.so.0", "GLIBC_TUNABLES": "glibc.malloc.check=3"}


class Toolchain:
    """The commands of a configured and built folder."""

    def __init__(self, build, model):
        self.build, self.model = build, model
        self.commands = {}
        for entry in json.loads((build / "compile_commands.json").read_text()):
            path = Path(entry["file"]).resolve()
            if path.is_relative_to(model):
                # One of the targets with this source is built.
                if (build / self._object(entry)).exists():
                    self.commands[path.relative_to(model).as_posix()] = entry
        self.users = self._users()
        self.link_command = self._link_command()

    def _ninja(self, *arguments):
        command = ["ninja", "-C", str(self.build), "-t", *arguments]
        return subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout

    def _users(self):
        """Header to the sources that include it."""
        sources = {
            self._object(entry): name
            for name, entry in self.commands.items()
            if name.split("/")[0] in LAYERS
        }
        users, source = {}, None
        for line in self._ninja("deps").splitlines():
            if line and not line.startswith((" ", "ninja:")):
                source = sources.get(line.split(":")[0])
            elif source and line.strip():
                path = (self.build / line.strip()).resolve()
                if path.is_relative_to(self.model):
                    users.setdefault(path.relative_to(self.model).as_posix(), set()).add(source)
        return users

    @staticmethod
    def _object(entry):
        words = shlex.split(entry["command"])
        return words[words.index("-o") + 1]

    def _link_command(self):
        lines = [
            line
            for line in self._ninja("commands", "vector_check").splitlines()
            if "-o tests/decode_path/vector_check" in line
        ]
        return [word for word in shlex.split(lines[-1]) if word not in (":", "&&")]

    def sources_of(self, file):
        """The sources to compile when `file` changes. KeyError: a header that no source includes."""
        return [file] if file.endswith(".cpp") else sorted(self.users[file])

    def make(self, file, text, folder):
        """vector_check with `text` in place of `file`, built in `folder`; None if it does not compile."""
        changed = folder / "changed" / file
        changed.parent.mkdir(parents=True)
        changed.write_text(text)
        objects = []
        for number, source in enumerate(self.sources_of(file)):
            target = folder / f"{number}.o"
            if not self._compile(source, changed if source == file else None, target, folder):
                return None
            objects.append(str(target))
        program = folder / "vector_check"
        words = list(self.link_command)
        words[words.index("-o") + 1] = str(program)
        # First on the line: the linker takes the first copy of an inline function.
        words[1:1] = objects
        linked = subprocess.run(words, cwd=self.build, capture_output=True, check=False)
        return program if linked.returncode == 0 else None

    def same_objects(self, file, folder):
        """Whether the objects that make() compiled in `folder` equal those of the build, byte by byte:
        then no input can tell the two programs apart."""
        return all(
            (folder / f"{number}.o").read_bytes()
            == (self.build / self._object(self.commands[source])).read_bytes()
            for number, source in enumerate(self.sources_of(file))
        )

    def _compile(self, source, changed, target, folder):
        entry = self.commands[source]
        words = shlex.split(entry["command"])
        words[words.index("-o") + 1] = str(target)
        if changed:
            words[words.index("-c") + 1] = str(changed)
        for option in ("-MF", "-MT"):
            if option in words:
                del words[words.index(option) : words.index(option) + 2]
        words = [word for word in words if word not in ("-MD", "-Werror")]
        # Headers are included by their path below model/, so the changed one is found first.
        words[1:1] = ["-w", f"-I{folder / 'changed'}"]
        compiled = subprocess.run(words, cwd=entry["directory"], capture_output=True, check=False)
        return compiled.returncode == 0

    @staticmethod
    def run(program, suite, first, seconds):
        """The verdict of vector_check, which tries the vectors `first` before the others."""
        command = [program, suite, "--stop", *(word for name in first for word in ("--first", name))]
        return tried(command, seconds, MEMORY_BYTES, CHECKED_HEAP)
