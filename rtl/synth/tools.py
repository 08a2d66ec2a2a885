"""Reads a module of the decode unit with Yosys, and runs the tools of synthesis."""

import os
import pathlib
import signal
import subprocess
import sys

RTL = pathlib.Path(__file__).resolve().parent.parent
TIMEOUT = int(os.environ.get("HMLFC_SYNTH_TIMEOUT", "600"))
LIBERTY = os.environ.get("HMLFC_OSU035", "/usr/share/qflow/tech/osu035/osu035_stdcells.lib")

sys.path.insert(0, str(RTL / "kit"))
import file_list  # noqa: E402


def read(spec: str) -> tuple[str, str]:
    """The commands that read a module with its parameters, and its name. Its own modules are read where they are met, not from the
    file list: the order of reading moves the clock rates by a percent."""
    name, *options = spec.split(",")
    module = f"hmlfc_{name}"
    commands = f"verilog_defaults -add -I{RTL}; read_verilog -sv {RTL}/hmlfc_pkg.sv {file_list.module(RTL, name)}; "
    for option in options:
        if not option.startswith("-"):
            commands += f"chparam -set {option.replace('=', ' ')} {module}; "
    commands += f"hierarchy -check -top {module} {file_list.library(RTL)}; rename -top {module}_top; "
    for option in options:
        if option.startswith("-"):
            commands += f"select -assert-any {module}_top/o:{option[1:]}; delete -output {module}_top/o:{option[1:]}; "
    return commands, f"{module}_top"


def run(command: list[str]) -> str:
    """The text of a tool; empty where it takes too long."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
    try:
        text, _ = process.communicate(timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        return ""
    if process.returncode != 0:
        raise RuntimeError(text[-2000:])
    return text
