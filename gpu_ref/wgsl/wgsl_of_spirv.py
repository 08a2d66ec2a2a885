#!/usr/bin/env python3
"""Translates a compute shader from SPIR-V to WGSL.

usage: wgsl_of_spirv.py SHADER.spv OUT.wgsl [ID:VALUE ...]

A member of the push constants that is a device address, or two words that become one, is a buffer of its name, bound
to the number of the member; the other members are the uniform buffer `arguments`, bound to the number of the first of
them. The addresses in such a buffer are buffers too, bound to the numbers after these. ID:VALUE sets specialisation constants, which have no place in the result. What has no translation is refused.

Exit: 0 done, 1 refused, with the reason.
"""

import re
import sys
from pathlib import Path

from spirv_module import Refused, disassembled, parse
from wgsl_function import translate
from wgsl_types import Types, safe

# What a member of a buffer with addresses is that is one.
ADDRESSES = ("OpTypePointer", "OpTypeVector")
BUILT_IN = {"WorkgroupId": ("workgroup_id", "vec3<u32>"), "NumWorkgroups": ("num_workgroups", "vec3<u32>"),
            "LocalInvocationIndex": ("local_invocation_index", "u32")}
# What instructions return that have two words as result: low and high, or the carry or borrow.
PAIRS = {
    "OpIAddCarry": "fn sum(a: u32, b: u32) -> Pair { return Pair(a + b, select(0u, 1u, a + b < a)); }",
    "OpISubBorrow": "fn difference(a: u32, b: u32) -> Pair { return Pair(a - b, select(0u, 1u, a < b)); }",
    "OpUMulExtended": "fn product(a: u32, b: u32) -> Pair { return Pair(a * b, high_word(a, b)); }",
    "OpSMulExtended": """fn signed_product(a: i32, b: i32) -> Pair {
  return Pair(a * b, i32(high_word(u32(a), u32(b))) - select(0, b, a < 0) - select(0, a, b < 0));
}""",
}
HIGH_WORD = """
fn high_word(a: u32, b: u32) -> u32 {
  let low = (a & 0xFFFFu) * (b & 0xFFFFu);
  let left = (a >> 16u) * (b & 0xFFFFu) + (low >> 16u);
  let right = (a & 0xFFFFu) * (b >> 16u) + (left & 0xFFFFu);
  return (a >> 16u) * (b >> 16u) + (left >> 16u) + (right >> 16u);
}
"""


class Shader:
    def __init__(self, module):
        self.module, self.all, self.types = module, module.all, Types(module)
        variables = (one for one in self.all.values() if one.op == "OpVariable")
        self.arguments = next(one for one in variables if one.operands[1] == "PushConstant")
        self.argument_types = self.all[self.pointee(self.arguments.result)].operands
        self.buffers, self.tables, self.inputs = {}, {}, {}  # name to: type; text; kind
        self.bindings = {}  # of a buffer's name
        self.has_arguments = False  # whether a number of them is used
        self.functions = {}  # id to name
        holders = [one for one in self.all.values() if one.op == "OpTypeStruct" and self.has_addresses(one)]
        taken = {"sum", "difference", "product", "signed_product", "high_word", "arguments",
                 *map(self.argument_name, range(len(self.argument_types))),
                 *(self.types.member(one.result, i) for one in holders for i in range(len(one.operands)))}
        self.shared = {one.result: safe(one.result[1:], taken) for one in self.all.values()
                       if one.op == "OpVariable" and one.operands[1] == "Workgroup"}
        taken.update(self.shared.values())
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
        if one and one.op == "OpAccessChain":
            base, number = one.operands[1], self.number(one.operands[2])
            if base == self.arguments.result:
                plain = self.all[self.argument_types[number]].op == "OpTypeInt"
                return None if plain else self.bound(self.argument_name(number), number)
            if not self.address(base):
                return None
            holder = self.all[self.pointee(base)]
            if not self.has_addresses(holder) or self.all[holder.operands[number]].op not in ADDRESSES:
                return None
            return self.bound(self.types.member(holder.result, number), len(self.argument_types) + number)
        return self.address(one.operands[1]) if one and one.op in ("OpLoad", "OpBitcast") else None

    def has_addresses(self, structure):
        return any(map(self.types.is_pointer, structure.operands))

    def bound(self, name, number):
        self.bindings[name] = number
        return name

    def is_atomic(self, pointer):
        base = self.base(pointer)
        return base in self.atomic or self.address(base) in self.atomic - {None}

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
                    elif one.op.startswith("OpAtomic"):
                        pointers = one.operands[1:2]
                        base = self.base(pointers[0])
                        self.atomic.add(base if base in self.shared else self.address(base))
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
            case "OpConstant" if found.operands[1] == "-2147483648":
                return "(-2147483647i - 1i)"
            case "OpConstant":
                return f"{found.operands[1]}{self.types.text(kind)[0]}"
            case "OpConstantTrue" | "OpConstantFalse":
                return found.op[10:].lower()
            case "OpConstantComposite":
                return f"{self.types.text(kind)}({', '.join(map(self.value, found.operands[1:]))})"
            case "OpConstantNull" | "OpUndef":
                return f"{self.types.text(kind)}()"
            case "OpVariable" if one == self.arguments.result:
                self.has_arguments = True
                return "arguments"
            case "OpVariable" if one in self.shared:
                return self.shared[one]
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
        for name, kind in sorted(self.buffers.items(), key=lambda one: self.bindings[one[0]]):
            binding = self.bindings[name]
            self.types.layout(kind)
            title = self.types.text(kind)
            if name in self.atomic:
                title = f"Atomic{title}"
                self.types.structures[title] = self.types.structures[title[6:]].replace("<u32>", "<atomic<u32>>")
            space = "uniform" if self.types.is_uniform(kind) else "storage, read"
            space = "storage, read_write" if name in self.written else space
            yield f"@group(0) @binding({binding}) var<{space}> {name}: {title};"
        numbers = [i for i, kind in enumerate(self.argument_types) if self.all[kind].op == "OpTypeInt"]
        if self.has_arguments:
            members = "".join(f"  {self.argument_name(i)}: {self.types.text(self.argument_types[i])},\n" for i in numbers)
            self.types.structures["Arguments"] = members
            yield f"@group(0) @binding({numbers[0]}) var<uniform> arguments: Arguments;"
        for name, built_in in self.inputs.items():
            yield f"var<private> {name}: {BUILT_IN[built_in][1]};"
        for one, name in self.shared.items():
            kind = self.types.text(self.pointee(one))
            if one in self.atomic:
                kind = re.sub("([iu]32)", r"atomic<\1>", kind, count=1)
            yield f"var<workgroup> {name}: {kind};"
        for name, table in self.tables.items():
            yield f"const {name} = {table};"

    def pairs(self):
        """Those of PAIRS that are used."""
        made = {one.op: self.types.text(one.operands[0]) for one in self.all.values() if one.op in PAIRS}
        functions = [PAIRS[op].replace("Pair", pair) for op, pair in made.items()]
        return "\n\n".join([HIGH_WORD, *functions, ""]) if functions else ""

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
