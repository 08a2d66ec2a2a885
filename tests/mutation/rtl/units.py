"""The modules of the datapath that are mutated, as the mutated unit has them."""

import pathlib
import subprocess

RTL = pathlib.Path(__file__).resolve().parents[3] / "rtl"

# Of the unit: the values that CMakeLists.txt gives to Verilator as well. Blocks of 4 x 4 are those of most vectors.
UNIT = {"BLOCK_LOG2": 2, "MAX_DEPTH": 12, "AXI_DATA_BITS": 64, "OUTSTANDING": 4, "TILE_CONTEXTS": 2, "CACHE_STRIPS": 64}

# Module, parameters of one of its instances in that unit, outputs that only the trace port shows. A module that has
# instances of several kinds is there once for each, with mutants of its own.
VARIANTS = [
    ("bise_unpack", {"COUNT": 16, "VALUE_BITS": 14, "WINDOW_BITS": 224}, []),
    ("bise_element", {"VALUE_BITS": 10}, []),
    ("bise_element", {"VALUE_BITS": 4}, []),
    ("bise_place", {}, []),
    ("bise_bits", {}, []),
    ("trits", {}, []),
    ("quints", {}, []),
    ("residual", {"BLOCK_LOG2": 2, "MAX_DEPTH": 12}, []),
    ("vector", {}, []),
    ("vector_axis", {"COEFFICIENT_BITS": 12}, []),
    ("vector_axis", {"COEFFICIENT_BITS": 18}, []),
    ("interpolate", {"BLOCK_LOG2": 2, "SAMPLE_BITS": 14}, []),
    ("reconstruct", {"BLOCK_LOG2": 2, "MAX_DEPTH": 12}, ["prediction"]),
    ("colour", {"BLOCK_LOG2": 2, "MAX_DEPTH": 12}, []),
    ("compose", {"BLOCK_LOG2": 2, "MAX_DEPTH": 12}, ["out_residual", "out_reference", "out_prediction"]),
    ("answer", {"BLOCK_LOG2": 2, "MAX_DEPTH": 12}, []),
    ("reference_window", {"BLOCK_LOG2": 2}, []),
    ("tile_mask", {}, []),
    ("tile_headers", {"BLOCK_LOG2": 2, "SKEW_BITS": 6}, []),
    ("tile_vectors", {"WORD_BITS": 10, "PLACE_BITS": 15, "WINDOW_BITS": 512}, []),
    ("vector_bounds", {}, []),
    ("motion_place", {"BLOCK_LOG2": 2}, []),
    ("motion_blocks", {"BLOCK_LOG2": 2, "CONTEXTS": 4, "CONTEXT_WORDS": 64, "WINDOW_BITS": 128}, []),
    ("disparity_place", {"BLOCK_LOG2": 2}, []),
    ("disparity_blocks", {"CONTEXTS": 4, "CONTEXT_WORDS": 256, "WINDOW_BITS": 128}, []),
    ("bise_element", {"VALUE_BITS": 8}, []),
]


def inner_modules(variant: int) -> list[str]:
    """The files of the modules that a variant has in it."""
    name = f"hmlfc_{VARIANTS[variant][0]}"
    text = (RTL / f"{name}.sv").read_text(encoding="utf-8")
    return [path.name for path in sorted(RTL.glob("hmlfc_*.sv")) if path.stem not in (name, "hmlfc_pkg") and f"  {path.stem} " in text]


def read_commands(variant: int) -> str:
    """The commands of Yosys that read a variant as module `top`; the modules in it stay closed."""
    module, parameters, _ = VARIANTS[variant]
    name = f"hmlfc_{module}"
    commands = ["design -reset", "read_verilog -sv hmlfc_pkg.sv"]
    commands += [f"read_verilog -sv -lib {file}" for file in inner_modules(variant)]
    commands += [f"read_verilog -sv {name}.sv"]
    commands += [f"chparam -set {key} {value} {name}" for key, value in parameters.items()]
    commands += [f"hierarchy -top {name}", "proc", "opt_expr", "opt_clean", f"rename {name} top"]
    return "\n".join(commands) + "\n"


def yosys(script: pathlib.Path, timeout: float | None = None, quiet: bool = True) -> str:
    """What Yosys says to a script. Raises subprocess.TimeoutExpired, or RuntimeError with its last words."""
    done = subprocess.run(["yosys", *(["-q"] if quiet else []), "-s", str(script)], cwd=RTL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=timeout, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"yosys {script}: {done.stdout[-2000:]}")
    return done.stdout
