"""The programs that benchmarks in Python run."""

from bench_error import BenchError
from sources import ROOT

BUILT = ROOT / "build" / "release"
HMLFC = BUILT / "tools" / "hmlfc"


def built(name):
    """The path of a program of bench/ in the build of ./run."""
    return BUILT / "bench" / name


def require(bench, *programs):
    """Raises BenchError where one of the programs is not there."""
    for program in programs:
        if not program.is_file():
            raise BenchError(f"no program {program}: ./run bench {bench} builds it")
