#!/usr/bin/env python3
"""Translates a compute shader from SPIR-V to WGSL.

usage: wgsl_of_spirv.py SHADER.spv OUT.wgsl [ID:VALUE ...]

A member of the push constants that is a device address, or two words that become one, is a buffer of its name, bound
to the number of the member; the other members are the uniform buffer `arguments`, bound to the number of the first of
them. ID:VALUE sets specialisation constants, which have no place in the result. What has no translation is refused.

Exit: 0 done, 1 refused, with the reason.
"""

import sys
from pathlib import Path

from spirv_module import Refused, disassembled, parse
from wgsl_function import translate
from wgsl_types import Types, safe

BUILT_IN = {"WorkgroupId": ("workgroup_id", "vec3<u32>"), "NumWorkgroups": ("num_workgroups", "vec3<u32>"),
            "LocalInvocationIndex": ("local_invocation_index", "u32")}
# What instructions return that have two words as result: low and high, or the carry or borrow.
PAIRS = """
fn sum(a: u32, b: u32) -> ResType { return ResType(a + b, select(0u, 1u, a + b < a)); }

fn difference(a: u32, b: u32) -> ResType { return ResType(a - b, select(0u, 1u, a < b)); }

fn product(a: u32, b: u32) -> ResType {
  let low = (a & 0xFFFFu) * (b & 0xFFFFu);
  let left = (a >> 16u) * (b & 0xFFFFu) + (low >> 16u);
  let right = (a & 0xFFFFu) * (b >> 16u) + (left & 0xFFFFu);
  return ResType(a * b, (a >> 16u) * (b >> 16u) + (left >> 16u) + (right >> 16u));
}
"""


class Shader:
    def __init__(self, module):
        self.module, self.all, self.types = module, module.all, Types(module)
        variables = (one for one in self.all.values() if one.op == "OpVariable")
        self.arguments = next(one for one in variables if one.operands[1] == "PushConstant")
        self.argument_types = self.all[self.pointee(self.arguments.result)].operands
        self.buffers, self.tables, self.inputs = {}, {}, {}  # name to: type; text; kind
        self.functions = {}  # id to name
        taken = {"sum", "difference", "product", "arguments", *map(self.argument_name, range(len(self.argument_types)))}
        for name in module.functions:
            self.functions[name] = safe(module.names[name])
            while self.functions[name] in taken:
                self.functions[name] += "_"
            taken.add(self.functions[name])
        self.globals = taken | {name for key, name in module.names.items() if not isinstance(key, tuple) and
                                key in self.all and self.all[key].op == "OpTypeStruct"}
        self.written, self.atomic = set(), set()
        self.find_writes()

    def argument_name(self, number):
        return safe(self.module.names[self.pointee(self.arguments.result), number])

    def pointee(self, pointer):
        """The type of what an id, or of what a type points to."""
        one = self.all[pointer]
        return one.operands[1] if one.op == "OpTypePointer" else self.pointee(one.operands[0])

    def address(self, one):
        """The name of the buffer whose address an id is, or the pointer to it; else None."""
        one = self.all.get(one)
        if one and one.op == "OpAccessChain" and one.operands[1] == self.arguments.result:
            number = self.number(one.operands[2])
            plain = self.all[self.argument_types[number]].op == "OpTypeInt"
            return None if plain else self.argument_name(number)
        return self.address(one.operands[1]) if one and one.op in ("OpLoad", "OpBitcast") else None

    def base(self, pointer):
        one = self.all[pointer]
        return self.base(one.operands[1]) if one.op == "OpAccessChain" else pointer

    def find_writes(self):
        before = None
        while before != len(self.written):
            before = len(self.written)
            for function in self.module.functions.values():
                for one in (one for block in function.blocks.values() for one in block):
                    pointers = []
                    if one.op == "OpStore":
                        pointers = one.operands[:1]
                    elif one.op == "OpAtomicIAdd":
                        pointers = one.operands[1:2]
                        self.atomic.add(self.address(self.base(pointers[0])))
                    elif one.op == "OpFunctionCall":
                        pointers = [argument for number, argument in enumerate(one.operands[2:])
                                    if (one.operands[1], number) in self.written]
                    for pointer in map(self.base, pointers):
                        if pointer in function.parameters:
                            self.written.add((function.name, function.parameters.index(pointer)))
                        elif self.address(pointer):
                            self.written.add(self.address(pointer))

    def number(self, one):
        constant = self.all[one]
        return int(constant.operands[1]) if constant.op == "OpConstant" else None

    def value(self, one):
        if one not in self.all:
            raise Refused(f"operand {one}")
        found = self.all[one]
        kind = found.operands[0]
        match found.op:
            case "OpConstant":
                return f"{found.operands[1]}{self.types.text(kind)[0]}"
            case "OpConstantTrue" | "OpConstantFalse":
                return found.op[10:].lower()
            case "OpConstantComposite":
                return f"{self.types.text(kind)}({', '.join(map(self.value, found.operands[1:]))})"
            case "OpConstantNull" | "OpUndef":
                return f"{self.types.text(kind)}()"
            case "OpVariable" if one == self.arguments.result:
                return "arguments"
            case "OpVariable" if (one, "BuiltIn") in self.module.decorations:
                self.inputs[one[1:]] = self.module.decorations[one, "BuiltIn"][0]
                return one[1:]
            case "OpLoad" | "OpBitcast" if self.address(one) and self.all[kind].op == "OpTypePointer":
                self.buffers[self.address(one)] = self.pointee(kind)
                return self.address(one)
        raise Refused(f"{found.op} {found.operands}")

    def table(self, constant):
        name = f"table{constant[1:]}"
        self.tables[name] = self.value(constant)
        return name

    def is_constant(self, name):
        """Whether nothing writes to the variable of that name."""
        return name in ("arguments", *self.inputs, *self.tables) or name in self.buffers and not self.is_open(name)

    def is_open(self, buffer):
        """Whether it ends with an array of any length: a storage buffer."""
        return self.all[self.all[self.buffers[buffer]].operands[-1]].op == "OpTypeRuntimeArray"

    def declarations(self):
        for binding, name in ((i, self.argument_name(i)) for i in range(len(self.argument_types))):
            if name not in self.buffers:
                continue
            kind = self.buffers[name]
            self.types.layout(kind)
            title = self.types.text(kind)
            if name in self.atomic:
                title = f"Atomic{title}"
                self.types.structures[title] = self.types.structures[title[6:]].replace("<u32>", "<atomic<u32>>")
            space = "storage, read" if self.is_open(name) else "uniform"
            space = "storage, read_write" if name in self.written else space
            yield f"@group(0) @binding({binding}) var<{space}> {name}: {title};"
        numbers = [i for i, kind in enumerate(self.argument_types) if self.all[kind].op == "OpTypeInt"]
        members = "".join(f"  {self.argument_name(i)}: {self.types.text(self.argument_types[i])},\n" for i in numbers)
        self.types.structures["Arguments"] = members
        yield f"@group(0) @binding({numbers[0]}) var<uniform> arguments: Arguments;"
        for name, built_in in self.inputs.items():
            yield f"var<private> {name}: {BUILT_IN[built_in][1]};"
        for name, table in self.tables.items():
            yield f"const {name} = {table};"

    def pairs(self):
        """PAIRS, if they are used. Their type is any structure of two u32: a module has one of each."""
        made = (one for one in self.all.values() if one.op in ("OpUMulExtended", "OpIAddCarry", "OpISubBorrow"))
        pair = next((self.types.text(one.operands[0]) for one in made), None)
        return PAIRS.replace("ResType", pair) if pair else ""

    def text(self):
        functions = [translate(self, function) for function in self.module.functions.values()]
        declarations, pairs = "\n".join(self.declarations()), self.pairs()
        structures = "".join(f"struct {name} {{\n{members}}}\n\n" for name, members in self.types.structures.items())
        built_in = [(name, *BUILT_IN[one]) for name, one in self.inputs.items()]
        parameters = ", ".join(f"@builtin({one}) {one}: {kind}" for _, one, kind in built_in)
        copies = "".join(f"  {name} = {one};\n" for name, one, _ in built_in)
        functions.append(f"@compute @workgroup_size({self.module.local_size})\n"
                         f"fn main({parameters}) {{\n{copies}  main_();\n}}\n")
        return f"{structures}{declarations}\n{pairs}\n" + "\n".join(functions)


def main():
    source, out, *constants = sys.argv[1:]
    try:
        text = Shader(parse(disassembled(source, " ".join(constants)))).text()
    except Refused as reason:
        print(f"{source}: no translation to WGSL: {reason}", file=sys.stderr)
        return 1
    head = f"// {Path(source).stem} of the decoder of HMLFC, made from its GLSL by wgsl_of_spirv.py."
    Path(out).write_text(f"{head}\n\n{text}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
