"""A compute shader in SPIR-V as Python objects, from the text of spirv-dis."""

import re
import subprocess
from dataclasses import dataclass, field

# Specialisation constants become constants, what they switch off goes, and values go straight from where they
# are made to where they are used. Structured control flow and functions stay.
PASSES = [f"--{name}" for name in """
freeze-spec-const fold-spec-const-op-composite ccp eliminate-dead-branches eliminate-dead-functions
eliminate-local-single-store eliminate-local-single-block
eliminate-local-single-store simplify-instructions eliminate-dead-code-aggressive eliminate-dead-const
""".split()]


class Refused(Exception):
    """The shader has something that has no translation."""


@dataclass
class Instruction:
    op: str
    result: str
    operands: list  # with the type of the result first


@dataclass
class Function:
    name: str
    parameters: list = field(default_factory=list)
    variables: list = field(default_factory=list)
    blocks: dict = field(default_factory=dict)  # label to instructions, the first block first


@dataclass
class Module:
    all: dict = field(default_factory=dict)  # id to instruction
    names: dict = field(default_factory=dict)  # of functions, structures and (structure, member)
    decorations: dict = field(default_factory=dict)  # (id, decoration) or (structure, member, decoration) to operands
    local_size: str = ""
    functions: dict = field(default_factory=dict)


def disassembled(path, constants):
    """The text of the module at `path` with specialisation constants `constants`, ID:VALUE separated by blanks."""
    chosen = [f"--set-spec-const-default-value={constants}"] if constants else []
    module = subprocess.run(["spirv-opt", *chosen, *PASSES, path, "-o", "-"], stdout=subprocess.PIPE, check=True)
    text = subprocess.run(["spirv-dis", "--no-color", "-"], input=module.stdout, stdout=subprocess.PIPE, check=True)
    return text.stdout.decode()


def parse(text):
    module, function = Module(), None
    for line in text.splitlines():
        tokens = re.findall(r'"[^"]*"|[^\s"]+', line.partition(";")[0])
        if not tokens:
            continue
        named = tokens[1:2] == ["="]
        one = Instruction(tokens[2], tokens[0], tokens[3:]) if named else Instruction(tokens[0], "", tokens[1:])
        if named:
            module.all[one.result] = one
        match one.op, one.operands:
            case "OpName", [target, name]:
                module.names[target] = name.strip('"').partition("(")[0]
            case "OpMemberName", [target, number, name]:
                module.names[target, int(number)] = name.strip('"')
            case "OpDecorate", [target, decoration, *rest]:
                module.decorations[target, decoration] = rest
            case "OpMemberDecorate", [target, number, decoration, *rest]:
                module.decorations[target, int(number), decoration] = rest
            case "OpExecutionMode", [_, "LocalSize", size, "1", "1"]:
                module.local_size = size
            case "OpFunction", _:
                function = module.functions[one.result] = Function(one.result)
            case "OpFunctionParameter", _:
                function.parameters.append(one.result)
            case "OpVariable", _ if function:
                function.variables.append(one.result)
            case "OpLabel", _:
                function.blocks[one.result] = []
            case "OpFunctionEnd", _:
                function = None
            case _ if function:
                function.blocks[next(reversed(function.blocks))].append(one)
    return module
