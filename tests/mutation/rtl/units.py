"""The modules of the datapath that are mutated, as the mutated unit has them."""

import dataclasses
import pathlib
import subprocess
import sys

RTL = pathlib.Path(__file__).resolve().parents[3] / "rtl"
sys.path.insert(0, str(RTL / "kit"))
import file_list  # noqa: E402

# Of the unit; rtl_mutants.cpp has the first four as well. Blocks of 4 x 4 are those of most vectors.
UNIT = {"BLOCK_LOG2": 2, "MAX_DEPTH": 12, "AXI_DATA_BITS": 64, "OUTSTANDING": 4, "TILE_CONTEXTS": 2, "CACHE_STRIPS": 64}


@dataclasses.dataclass(frozen=True)
class Variant:
    """A module with the parameters of one of its instances in that unit."""

    module: str
    parameters: dict[str, int]
    traced: tuple[str, ...] = ()  # outputs that only the trace port shows
    # What the module's comment says of its inputs, or the unit around it (records begin with a byte of a beat of 64 bits), as Verilog
    # that makes a legal value of any: for a port an expression of the ports; legal_NAME is a port's legal value.
    legal: dict[str, str] = dataclasses.field(default_factory=dict)
    # Clocks with advance from inputs to outputs of a pipeline without feedback.
    latency: int | None = None


def at_most(port: str, bound: int) -> dict[str, str]:
    return {port: f"{port} > {bound} ? {bound} : {port}"}


def between(port: str, least: int, largest: int) -> dict[str, str]:
    return {port: f"{port} < {least} ? {least} : {port} > {largest} ? {largest} : {port}"}


SLOT = {"slot": "hmlfc_digit_kind(legal_level_code) == HMLFC_DIGIT_TRIT ? (slot > 4 ? 4 : slot) : "
                "hmlfc_digit_kind(legal_level_code) == HMLFC_DIGIT_QUINT ? (slot > 2 ? 2 : slot) : 0"}


# The bits of a group up to the last that the value in the slot has a share of.
HELD = ("((legal_slot + 1) * hmlfc_plain_bits(legal_level_code) + "
        "(hmlfc_digit_kind(legal_level_code) == HMLFC_DIGIT_TRIT ? (8 * (legal_slot + 1) + 4) / 5 : "
        "hmlfc_digit_kind(legal_level_code) == HMLFC_DIGIT_QUINT ? (7 * (legal_slot + 1) + 2) / 3 : 0))")


def element(value_bits: int, largest_code: int) -> Variant:
    legal = {"bits_left": f"bits_left < {HELD} ? {HELD} : bits_left > 64 ? 64 : bits_left"}
    return Variant("bise_element", {"VALUE_BITS": value_bits}, legal=legal | at_most("level_code", largest_code) | SLOT)


BLOCK = {"BLOCK_LOG2": 2}
SAMPLES = {"BLOCK_LOG2": 2, "MAX_DEPTH": 12}
DEPTH = between("depth", 8, 12)

# A module that has instances of several kinds is there once for each, with mutants of its own.
VARIANTS = [
    Variant("bise_unpack", {"COUNT": 16, "VALUE_BITS": 14, "WINDOW_BITS": 224}, legal=at_most("level_code", 39), latency=3),
    element(10, 27),
    element(4, 5),  # the choice among at most 8 entries of a palette
    # Vectors, disparities and indices: the levels of residuals, up to code 39, do not come to these two.
    Variant("bise_place", {}, legal=at_most("level_code", 27)),
    Variant("bise_bits", {}, legal=at_most("count", 1024) | at_most("level_code", 27)),
    Variant("trits", {}),
    Variant("quints", {}),
    Variant("residual", SAMPLES, legal=DEPTH | {"level_code": "level_code > 3 * legal_depth + 3 ? 3 * legal_depth + 3 : level_code"}, latency=4),
    Variant("vector", {}, latency=6),
    Variant("vector_axis", {"COEFFICIENT_BITS": 12}, legal=at_most("shift", 9), latency=5),
    Variant("vector_axis", {"COEFFICIENT_BITS": 18}, legal=at_most("shift", 9), latency=5),
    Variant("interpolate", {"BLOCK_LOG2": 2, "SAMPLE_BITS": 14}, latency=3),
    Variant("reconstruct", SAMPLES, ("prediction",), legal=DEPTH),
    Variant("colour", SAMPLES, legal=DEPTH, latency=2),
    Variant("compose", SAMPLES, ("out_residual", "out_reference", "out_prediction"), legal=DEPTH),
    Variant("answer", SAMPLES, legal=DEPTH),
    Variant("reference_window", BLOCK, latency=2),
    Variant("tile_mask", {}, legal=between("columns", 1, 8) | between("rows", 1, 8)),
    Variant("tile_headers", {"BLOCK_LOG2": 2, "SKEW_BITS": 6}, legal=DEPTH | between("count", 1, 64) | {"skew": "skew & 'h38"}),
    Variant("tile_vectors", {"WORD_BITS": 10, "PLACE_BITS": 15, "WINDOW_BITS": 512}, legal=between("count", 1, 64) | at_most("position", 256) | {"skew": "skew & 'h38"}),
    Variant("vector_bounds", {}, legal=between("position", 4, 164)),
    Variant("motion_place", BLOCK, legal=at_most("bx", 4095) | at_most("by", 4095)),
    Variant("motion_blocks", {"BLOCK_LOG2": 2, "CONTEXTS": 4, "CONTEXT_WORDS": 64, "WINDOW_BITS": 128}, legal=at_most("head_position", 328)),
    Variant("disparity_place", BLOCK, latency=4),
    Variant("disparity_blocks", {"CONTEXTS": 4, "CONTEXT_WORDS": 256, "WINDOW_BITS": 128}, legal=at_most("head_position", 81)),
    element(8, 21),
]


def inner_modules(variant: int) -> list[str]:
    """The files of the modules that a variant has in it, directly."""
    return modules_in(f"hmlfc_{VARIANTS[variant].module}")


def all_inner_modules(variant: int) -> list[str]:
    """The files of all modules below a variant."""
    found, left = set(), inner_modules(variant)
    while left:
        file = left.pop()
        if file not in found:
            found.add(file)
            left += modules_in(file.removesuffix(".sv"))
    return sorted(found)


def modules_in(name: str) -> list[str]:
    text = (RTL / f"{name}.sv").read_text(encoding="utf-8")
    return [path.name for path in sorted(file_list.modules(RTL)) if path.stem != name and f"  {path.stem} " in text]


def read_commands(variant: int) -> str:
    """The commands of Yosys that read a variant as module `top`; the modules in it stay closed."""
    name = f"hmlfc_{VARIANTS[variant].module}"
    commands = ["design -reset", "read_verilog -sv hmlfc_pkg.sv"]
    commands += [f"read_verilog -sv -lib {file}" for file in inner_modules(variant)]
    commands += [f"read_verilog -sv {name}.sv"]
    commands += [f"chparam -set {key} {value} {name}" for key, value in VARIANTS[variant].parameters.items()]
    # Without wreduce most mutants would be of the upper bits that 32-bit integers of the source bring.
    commands += [f"hierarchy -top {name}", "proc", "opt_expr -full", "opt_merge", "wreduce", "opt_expr -full", "opt_clean",
                 f"rename {name} top"]
    return "\n".join(commands) + "\n"


def yosys(script: pathlib.Path, timeout: float | None = None, quiet: bool = True) -> str:
    """What Yosys says to a script. Raises subprocess.TimeoutExpired, or RuntimeError with its last words."""
    done = subprocess.run(["yosys", *(["-q"] if quiet else []), "-s", str(script)], cwd=RTL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=timeout, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"yosys {script}: {done.stdout[-2000:]}")
    return done.stdout
