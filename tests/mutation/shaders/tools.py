"""The shader compiler and the programs that run kernels, as the campaign runs them."""

import os
import re
import resource
import shutil
import subprocess

from session import Broken, Unusable, tried

# CPU seconds that a program may take before it hangs, for each that it should.
HANG_FACTOR = 4
HANG_LEAST = 20
# The passes that make the code of one variant: its constants set, what they switch off removed.
FOLD = """--freeze-spec-const --fold-spec-const-op-composite --ccp --simplify-instructions
    --eliminate-dead-branches --merge-blocks --eliminate-dead-code-aggressive --strip-debug
    --unify-const --eliminate-dead-const --compact-ids""".split()


class Compiler:
    """Compiles kernels as gpu_ref/CMakeLists.txt does. `constants`: those of each variant that is run."""

    def __init__(self, root, constants):
        self.constants = constants
        self.tool = shutil.which("glslc")
        if not self.tool or not shutil.which("spirv-opt"):
            raise Unusable("glslc or spirv-opt is missing (Debian: glslc spirv-tools)")
        text = (root / "gpu_ref" / "CMakeLists.txt").read_text()
        self.options = re.search(r'COMMAND "\$\{HMLFC_GLSLC\}" (.*)', text).group(1).split()

    def compile(self, folder, kernel, out):
        """Whether the kernel of a folder of shaders compiles; its SPIR-V is in `out`."""
        command = [self.tool, *self.options, folder / f"{kernel}.comp", "-o", out]
        return subprocess.run(command, capture_output=True).returncode == 0

    def variants(self, spirv):
        """The code of a kernel in every variant that is run."""
        return [self.variant(spirv, constants) for constants in self.constants]

    def variant(self, spirv, constants):
        out = spirv.with_suffix(".variant")
        subprocess.run(
            ["spirv-opt", f"--set-spec-const-default-value={constants}", *FOLD, spirv, "-o", out],
            check=True,
        )
        return out.read_bytes()


class Program:
    """A program that runs kernels and checks what they make, in a process of its own."""

    def __init__(self, program, *arguments):
        self.command = [program, *arguments]
        self.cpu_limit = None

    def run(self, kernels, options=()):
        """The verdict on a set of kernels, a dictionary of SPIR-V files by name."""
        command = [*self.command, *options]
        for name, path in kernels.items():
            command += ["--kernel", f"{name}={path}"]
        return tried(command, self.cpu_limit)

    def measure(self, options):
        """Runs the library's own kernels, and sets the limit by the time it took."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        known, self.cpu_limit = self.cpu_limit, None
        verdict = self.run({}, options)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if verdict.result != "survived":
            raise Broken(f"the shaders as they are fail: {verdict.result} {verdict.detail}")
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.cpu_limit = max(known or 0, HANG_LEAST, int(HANG_FACTOR * seconds))


def prepare_device(work):
    """Settings of Mesa's device without a GPU, for the processes to come: one thread each, compiled
    code kept from one process to the next, and no optimisation of it, which would take most of the
    time."""
    os.environ.setdefault("LP_NUM_THREADS", "1")
    os.environ.setdefault("GALLIVM_PERF", "nopt")
    os.environ["MESA_SHADER_CACHE_DIR"] = str(work)
