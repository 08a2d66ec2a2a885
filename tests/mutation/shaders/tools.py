"""The shader compiler and the GPU decoder, as the campaign runs them."""

import os
import re
import resource
import shutil
import signal
import subprocess
from dataclasses import dataclass

SKIPPED = 77
# CPU seconds that a decoder of all vectors may take before it hangs, for each that it should.
HANG_FACTOR = 4
HANG_LEAST = 20
# The passes that make the code of one variant: its constants set, what they switch off removed.
FOLD = """--freeze-spec-const --fold-spec-const-op-composite --ccp --simplify-instructions
    --eliminate-dead-branches --merge-blocks --eliminate-dead-code-aggressive --strip-debug
    --unify-const --eliminate-dead-const --compact-ids""".split()


class Unusable(Exception):
    """Nothing can be said here: a tool or a device is missing."""


class Broken(Exception):
    """Nothing can be said of mutants: the shaders as they are fail, or the program does."""


@dataclass
class Verdict:
    """What became of a mutant: killed, crash, timeout, equivalent, survived or not_compiled."""

    result: str
    detail: str = ""  # the vector that killed it, or the reason


class Compiler:
    """Compiles kernels as gpu_ref/CMakeLists.txt does."""

    def __init__(self, root):
        self.tool = shutil.which("glslc")
        if not self.tool or not shutil.which("spirv-opt"):
            raise Unusable("glslc or spirv-opt is missing (Debian: glslc spirv-tools)")
        text = (root / "gpu_ref" / "CMakeLists.txt").read_text()
        self.options = re.search(r"set\(options (.*)\)", text).group(1).split()

    def compile(self, folder, kernel, out):
        """Whether the kernel of a folder of shaders compiles; its SPIR-V is in `out`."""
        command = [self.tool, *self.options, folder / f"{kernel}.comp", "-o", out]
        return subprocess.run(command, capture_output=True).returncode == 0

    def variant(self, spirv, constants):
        """The code of a kernel with its specialisation constants set."""
        out = spirv.with_suffix(".variant")
        text = f"{constants} 2:false 3:false"
        subprocess.run(
            ["spirv-opt", f"--set-spec-const-default-value={text}", *FOLD, spirv, "-o", out],
            check=True,
        )
        return out.read_bytes()


class Decoder:
    """The GPU decoder on the vectors, in a process of its own."""

    def __init__(self, program, suite, vectors):
        self.program, self.suite, self.vectors = program, suite, vectors
        self.cpu_limit = None

    def run(self, kernels, *options, limited=True):
        """The verdict on a set of kernels, a dictionary of SPIR-V files by name."""
        command = [self.program, self.suite, *options]
        for name, path in kernels.items():
            command += ["--kernel", f"{name}={path}"]
        for vector in self.vectors:
            command += ["--vector", vector]
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace",
            preexec_fn=self.limit if limited else None,
        )
        if done.returncode == SKIPPED:
            raise Unusable(done.stderr.strip())
        if done.returncode == 2:
            raise Broken(f"{self.program}: {done.stderr.strip()}")
        last = (done.stdout.splitlines() or [""])[-1]
        if done.returncode == 0 and last.startswith("passed"):
            return Verdict("survived")
        if done.returncode == 1 and last.startswith("failed"):
            return Verdict("killed", last.removeprefix("failed "))
        hung = -done.returncode in (signal.SIGXCPU, signal.SIGKILL)
        return Verdict("timeout" if hung else "crash", f"status {done.returncode}")

    def limit(self):
        """In the new process: an end to loops that have none, and no core files."""
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if self.cpu_limit:
            resource.setrlimit(resource.RLIMIT_CPU, (self.cpu_limit, self.cpu_limit + 5))

    def measure(self, options):
        """Decodes with the library's own kernels, and sets the limit by the time it took."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        verdict = self.run({}, *options, limited=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if verdict.result != "survived":
            raise Broken(f"the shaders as they are fail: {verdict.result} {verdict.detail}")
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.cpu_limit = max(self.cpu_limit or 0, HANG_LEAST, int(HANG_FACTOR * seconds))


def prepare_device(work):
    """Settings of Mesa's device without a GPU, for the processes to come: one thread each, compiled
    code kept from one process to the next, and no optimisation of it, which would take most of the
    time."""
    os.environ.setdefault("LP_NUM_THREADS", "1")
    os.environ.setdefault("GALLIVM_PERF", "nopt")
    os.environ["MESA_SHADER_CACHE_DIR"] = str(work)
