"""The modules that are mutated, as the mutated units have them."""

import dataclasses
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

RTL = pathlib.Path(__file__).resolve().parents[3] / "rtl"
sys.path.insert(0, str(RTL / "kit"))
import file_list  # noqa: E402

# Of the decode unit; mutated_unit.cpp has the first four as well. Blocks of 4 x 4 are those of most vectors.
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
    # The mutants of a module are spread over so many variants.
    shared_by: int = 1
    # Proofs take the modules in it for black boxes, whose outputs may be anything.
    closed: bool = False

    def mutants(self, of_module: int) -> int:
        return max(LEAST, -(-of_module // self.shared_by))


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


LEAST = 4  # mutants of a variant

BLOCK = {"BLOCK_LOG2": 2}
SAMPLES = {"BLOCK_LOG2": 2, "MAX_DEPTH": 12}
DEPTH = between("depth", 8, 12)

# The datapath, of which proofs know what inputs are legal. A module that has instances of several kinds is there once for each, with
# mutants of its own.
DATAPATH = [
    Variant("bise_unpack", {"COUNT": 16, "VALUE_BITS": 14, "WINDOW_BITS": 224}, legal=at_most("level_code", 39), latency=3),
    element(10, 27),
    element(4, 6),  # the choice among at most 8 entries of a palette
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


def decode_unit(modules: str) -> tuple[str, dict[str, int], tuple[str, ...]]:
    return "decode_unit", UNIT, tuple(modules.split())


# Modules that are mutated in one Verilated unit: name to the top module, its parameters, and the modules. More in one group would make
# the unit too slow to compile.
GROUPS = {
    "datapath": decode_unit(" ".join(dict.fromkeys(variant.module for variant in DATAPATH))),
    "loading": decode_unit("activity aligned_read control decode_unit divide geometry group_axis header images loader multiply_add plane_size "
                           "read_port registers requests skid_buffer view"),
    "tiles": decode_unit("disparity_ask disparity_parser disparity_store element_reader motion_parser motion_store motion_tile residual_blocks "
                         "residual_parser residual_store tile_ask tile_contexts tile_fetch tile_loader tile_number tile_stores tile_walk"),
    "references": decode_unit("reference_ask reference_cache reference_lines reference_lookup references strip_fill"),
    "memories": decode_unit("fifo ram record_ram"),
    # With the parameters of its tests.
    "dma": ("view_dma", {"BLOCK_LOG2": 1, "AXI_DATA_BITS": 64},
            ("strip_collect", "strip_pack", "strip_scan", "strip_writer", "view_dma", "view_fetch", "view_place", "view_queue", "view_registers",
             "view_rows", "view_scan", "view_writer", "write_port")),
    "view": ("view_unit", UNIT, ("axil_split", "view_unit")),
}
WITHOUT_LOGIC = ("widths",)


def number(constant: str) -> int:
    """Of a parameter as Verilator writes it, such as 32'sh10."""
    return int(constant.split("h")[1], 16)


def instances(top: str, parameters: dict[str, int]) -> list[tuple[str, dict[str, int]]]:
    """Each module of a top with the parameters of each kind of instances, by name, as Verilator elaborates them."""
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as folder:
        command = ["verilator", "--xml-only", "--xml-output", f"{folder}/top.xml", "--Mdir", folder, "-Wno-lint", "--top-module", f"hmlfc_{top}"]
        subprocess.run([*command, *(f"-G{key}={value}" for key, value in parameters.items()), "-F", str(RTL / file_list.NAME)], check=True)
        tree = xml.etree.ElementTree.parse(f"{folder}/top.xml")
    found = []
    for module in tree.iter("module"):
        own = {var.get("name"): number(var.find("const").get("name")) for var in module.findall("var") if var.get("param") == "true"}
        found.append((module.get("origName").removeprefix("hmlfc_"), own))
    return sorted(found, key=lambda instance: (instance[0], *instance[1].values()))


def variants(group: str) -> list[Variant]:
    """Those of a group. Raises RuntimeError where a module is in no group, or in two."""
    listed = [*WITHOUT_LOGIC, *(module for _, _, modules in GROUPS.values() for module in modules)]
    if sorted(listed) != sorted(path.stem.removeprefix("hmlfc_") for path in file_list.modules(RTL)):
        raise RuntimeError("units.py: GROUPS has not each module of the file list once")
    if group == "datapath":
        return DATAPATH
    top, parameters, modules = GROUPS[group]
    found = [(module, own) for module, own in instances(top, parameters) if module in modules]
    names = [module for module, _ in found]
    return [Variant(module, own, shared_by=names.count(module), closed=True) for module, own in found]


def inner_modules(variant: Variant) -> list[str]:
    """The files of the modules that a variant has in it, directly."""
    return modules_in(f"hmlfc_{variant.module}")


def all_inner_modules(variant: Variant) -> list[str]:
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


def read_commands(variant: Variant) -> str:
    """The commands of Yosys that read a variant as module `top`; the modules in it stay closed."""
    name = f"hmlfc_{variant.module}"
    commands = ["design -reset", "read_verilog -sv hmlfc_pkg.sv"]
    commands += [f"read_verilog -sv -lib {file}" for file in inner_modules(variant)]
    commands += [f"read_verilog -sv {name}.sv"]
    commands += [f"chparam -set {key} {value} {name}" for key, value in variant.parameters.items()]
    # Without wreduce most mutants would be of the upper bits that 32-bit integers of the source bring.
    commands += [f"hierarchy -top {name}", "proc", "opt_expr -full", "opt_merge", "wreduce", "opt_expr -full", "opt_clean"]
    if variant.closed:
        commands.append("memory -nomap")  # one port for the bytes of a word
    commands.append(f"rename {name} top")
    return "\n".join(commands) + "\n"


def yosys(script: pathlib.Path, timeout: float | None = None, quiet: bool = True) -> str:
    """What Yosys says to a script. Raises subprocess.TimeoutExpired, or RuntimeError with its last words."""
    done = subprocess.run(["yosys", *(["-q"] if quiet else []), "-s", str(script)], cwd=RTL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=timeout, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"yosys {script}: {done.stdout[-2000:]}")
    return done.stdout
