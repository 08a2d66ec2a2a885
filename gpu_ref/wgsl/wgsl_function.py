"""One function of a shader in WGSL."""

import re

from spirv_module import Refused
from wgsl_operations import ATOMICS, BINARY, CALLS, COMPARISONS, KNOWN, PLAIN, STATEMENTS, WRITES
from wgsl_types import safe


def bare(expression):
    """Without parentheses around the whole."""
    inner = expression[1:-1]
    depth = 0
    for character in inner:
        depth += (character == "(") - (character == ")")
        if depth < 0:
            return expression
    return inner if expression[0] == "(" else expression


def call(name, *values):
    return f"{name}({', '.join(map(bare, values))})"


class Body:
    """The lines of one function. A value that is used once, and near, stands where it is used."""

    def __init__(self, shader, function):
        self.shader, self.types, self.all, self.function = shader, shader.types, shader.module.all, function
        self.lines, self.depth, self.variables, self.values = [], 1, {}, {}
        self.fixed = set()  # parameters that nothing writes to
        self.uses = {}  # of an id: label, number of the instruction
        for label, block in function.blocks.items():
            for number, operand in ((n, operand) for n, one in enumerate(block) for operand in one.operands):
                self.uses.setdefault(operand, []).append((label, number))
        self.inside = {one for block in function.blocks.values() for one in self.near(block)}
        for number, parameter in enumerate(function.parameters):
            by_value = (function.name, number) not in shader.written
            self.values[parameter] = self.name(parameter) if by_value else f"(*{self.name(parameter)})"
            if by_value:
                self.fixed.add(self.values[parameter])
        for one in map(self.all.get, function.variables):
            if len(one.operands) == 3:
                self.values[one.result] = shader.table(one.operands[2])
            elif not self.is_passed_on(one.result):
                self.variable(one.result, shader.pointee(one.result))

    def users(self, one):
        return [self.function.blocks[label][number] for label, number in self.uses.get(one, [])]

    def near(self, block):
        """The results of a block that stand where they are used: a load with no write between."""
        ends = {}
        for number, one in reversed(list(enumerate(block))):
            uses = self.uses.get(one.result, [])
            if one.op in STATEMENTS or len(uses) != 1 or self.users(one.result)[0] not in block:
                continue
            user = block[uses[0][1]]
            end = ends.get(user.result, None if user.op == "OpAccessChain" else uses[0][1])
            if user.op == "OpStore" and self.is_passed_on(user.operands[0]):
                end = self.uses[user.operands[0]][-1][1]
            if one.op == "OpLoad" and (end is None or any(other.op in WRITES for other in block[number + 1:end])):
                continue
            ends[one.result] = uses[0][1] if end is None else end
        return ends

    def is_passed_on(self, variable):
        """Whether the variable only takes a value to functions that do not write to it, in one block."""
        store, *calls = variable in self.function.variables and self.users(variable) or [None]
        return (store and store.op == "OpStore" and len({label for label, _ in self.uses[variable]}) == 1 and
                all(one.op == "OpFunctionCall" and (one.operands[1], one.operands.index(variable) - 2) not in
                    self.shader.written for one in calls))

    def reach(self, one):
        """The blocks where a value may be needed."""
        labels = {label for label, _ in self.uses.get(one, [])}
        return labels.union(*(self.reach(user.result) for user in self.users(one)
                              if user.op in ("OpCompositeExtract", "OpAccessChain")))

    def name(self, one):
        return f"v{one[1:]}" if one[1].isdigit() else safe(one[1:], self.shader.globals)

    def variable(self, one, kind):
        self.values[one] = self.name(one)
        self.variables[self.values[one]] = self.types.text(kind)
        return self.values[one]

    def value(self, one):
        """A value, or the variable that a pointer points to."""
        return self.values[one] if one in self.values else self.shader.value(one)

    def typed(self, one, kind):
        own, number = self.types.text(self.all[one].operands[0]), self.shader.number(one)
        if number is not None and number >= 0:
            return f"{number}{kind[0]}"
        return self.value(one) if own == kind else call(kind, self.value(one))

    def is_fixed(self, place):
        """Whether nothing writes to the variable that a place is part of."""
        root = re.match(r"\W*\w+", place)[0]
        return root in self.fixed or self.shader.is_constant(root)

    def put(self, line):
        self.lines.append("  " * self.depth + line)

    def define(self, label, one, expression):
        if one.result in self.inside:
            self.values[one.result] = expression
        elif self.reach(one.result) == {label}:
            self.values[one.result] = self.name(one.result)
            self.put(f"let {self.values[one.result]} = {bare(expression)};")
        elif self.uses.get(one.result):
            self.put(f"{self.variable(one.result, one.operands[0])} = {bare(expression)};")
        elif one.op in WRITES:
            self.put(f"{expression};")

    def instruction(self, label, one):
        match one.op, one.operands:
            case "OpStore", [target, value, *_]:
                if target in self.function.variables and target not in self.values:
                    self.values[target] = self.value(value)
                elif self.shader.is_atomic(target):
                    self.put(f"atomicStore(&{self.value(target)}, {bare(self.value(value))});")
                else:
                    self.put(f"{self.value(target)} = {bare(self.value(value))};")
            case "OpPhi", [kind, *_]:
                self.variable(one.result, kind)
            case "OpCompositeInsert", [kind, part, whole, *path]:
                name = self.variable(one.result, kind)
                self.put(f"{name} = {bare(self.value(whole))};")
                self.put(f"{self.select(name, kind, path)} = {bare(self.value(part))};")
            case "OpCompositeExtract", [_, whole, *path]:
                selected = self.select(self.value(whole), self.all[whole].operands[0], path)
                if re.fullmatch(r"[\w.]+", selected) and (whole not in self.inside or self.is_fixed(selected)):
                    self.values[one.result] = selected
                else:
                    self.define(label, one, selected)
            case "OpAccessChain", [_, base, *indices]:
                if not self.shader.address(one.result):
                    self.values[one.result] = self.select(self.value(base), self.shader.pointee(base), indices)
            case ("OpLoad" | "OpBitcast"), _ if self.shader.address(one.result):
                pass
            case "OpControlBarrier", _:
                self.put("workgroupBarrier();")
            case "OpLoad", [_, pointer, *_] if self.shader.is_atomic(pointer):
                self.define(label, one, f"atomicLoad(&{self.value(pointer)})")
            case "OpLoad", [_, pointer, *_] if pointer in self.shader.shared:
                self.define(label, one, f"workgroupUniformLoad(&{self.value(pointer)})")
            case "OpLoad", [_, pointer, *_]:
                if self.is_fixed(self.value(pointer)):
                    self.values[one.result] = self.value(pointer)
                else:
                    self.define(label, one, self.value(pointer))
            case _:
                self.define(label, one, self.expression(one))

    def select(self, whole, kind, path):
        """Part of a value or variable of type `kind`; `path`: numbers, or ids of them."""
        for index in path:
            number = int(index) if index.isdigit() else self.shader.number(index)
            kind, selector = self.types.part(kind, number or 0)
            whole += f"[{bare(self.value(index))}]" if number is None else selector
        return whole

    def expression(self, one):
        name, (kind, *operands) = one.op[2:], one.operands or [""]
        if name == "ExtInst":
            name, *operands = operands[1:]
        if name not in KNOWN:
            raise Refused(f"{name} {operands}")
        result = self.types.text(kind)
        match name:
            case "FunctionCall":
                callee, *arguments = operands
                passed = [("&" if (callee, i) in self.shader.written else "") + self.value(argument)
                          for i, argument in enumerate(arguments)]
                return call(self.shader.functions[callee], *passed)
            case "AtomicLoad":
                return call("atomicLoad", f"&{self.value(operands[0])}")
            case _ if name in ATOMICS:
                return call(ATOMICS[name], f"&{self.value(operands[0])}", self.value(operands[3]))
        first = self.types.text(self.all[operands[0]].operands[0])
        match name:
            case "CompositeConstruct":
                return call(result, *map(self.value, operands))
            case "VectorShuffle" if operands[0] == operands[1]:
                return f"{self.value(operands[0])}.{''.join('xyzw'[int(i) % int(first[3])] for i in operands[2:])}"
            case "VectorShuffle":
                parts = [(one, i) for one in operands[:2] for i in range(int(self.types.text(self.all[one].operands[0])[3]))]
                return call(result, *(f"{self.value(one)}.{'xyzw'[i]}" for one, i in (parts[int(k)] for k in operands[2:])))
            case "Select":
                return call("select", *map(self.value, reversed(operands[1:])), self.value(operands[0]))
            case "CopyLogical" | "Bitcast":
                return self.typed(operands[0], result)
            case "BitFieldInsert" if first == result:
                return call("insertBits", *map(self.value, operands[:2]), *(self.typed(one, "u32") for one in operands[2:]))
            case "BitFieldSExtract" | "BitFieldUExtract" if ("i32" if "S" in name else "u32") in first:
                return call("extractBits", self.value(operands[0]), *(self.typed(one, "u32") for one in operands[1:]))
            case _ if name in PLAIN:
                return call(PLAIN[name], *map(self.value, operands))
        if name not in {**BINARY, **COMPARISONS, **CALLS}:
            raise Refused(f"{name} {operands} of {first}")
        sign, _, integers = {**BINARY, **COMPARISONS, **CALLS}[name].partition(" ")
        own = first if name in COMPARISONS else result
        own = re.sub("[iu]32", integers, own) if integers else own
        right = re.sub("i32", "u32", own) if name.startswith("Shift") else own
        values = [self.typed(operands[0], own), *(self.typed(operand, right) for operand in operands[1:])]
        expression = call(sign, *values) if name in CALLS else f"({values[0]} {sign} {values[1]})"
        return expression if own == result or name in COMPARISONS else call(result, expression)

    def enter(self, label, target):
        """Gives the phis of block `target` their values from block `label`."""
        phis = [one for one in self.function.blocks[target] if one.op == "OpPhi"]
        for one in phis:
            value = one.operands[one.operands.index(label) - 1]
            if value in [other.result for other in phis]:
                raise Refused("a phi of a phi")
            self.put(f"{self.name(one.result)} = {bare(self.value(value))};")

    def region(self, label, exits, open_loop=None):
        """The blocks from `label` on, until one of `exits`: labels, and what to write there."""
        while label and label not in exits:
            block = self.function.blocks[label]
            merge = next((one for one in block if one.op.endswith("Merge")), None)
            if merge and merge.op == "OpLoopMerge" and label != open_loop:
                label = self.loop(label, *merge.operands[:2])
                continue
            for one in block[:-2] if merge else block[:-1]:
                self.instruction(label, one)
            label = self.leave(label, block[-1], merge and merge.op == "OpSelectionMerge" and merge.operands[0], exits)
        if label and exits[label]:
            self.put(exits[label])

    def nested(self, head, label, exits, open_loop=None):
        self.put(head)
        self.depth += 1
        self.region(label, exits, open_loop)
        self.depth -= 1

    def loop(self, header, after, again):
        self.nested("loop {", header, {after: "break;", again: "continue;"}, header)
        if self.lines[-1].strip() == "continue;":
            self.lines.pop()
        self.depth += 1
        self.nested("continuing {", again, {header: ""})
        self.put("}")
        self.depth -= 1
        self.put("}")
        return after

    def leave(self, label, last, after, exits):
        """The end of a block. The block that follows, if one does."""
        match last.op, last.operands:
            case "OpBranch", [target]:
                self.enter(label, target)
                return target
            case "OpReturnValue", [value]:
                self.put(f"return {bare(self.value(value))};")
            case "OpReturn", _:
                self.put("return;")
            case "OpUnreachable", _:
                pass
            case "OpBranchConditional", [condition, yes, no, *_]:
                self.enter(label, yes)
                self.enter(label, no)
                condition = bare(self.value(condition))
                if yes == after or exits.get(no):
                    condition, yes, no = f"!({condition})", no, yes
                if after:
                    self.selection(condition, yes, no, after, exits)
                    return after
                if not exits.get(yes):
                    raise Refused("a branch without a merge")
                self.put(f"if ({condition}) {{ {exits[yes]} }}")
                return no
            case _:
                raise Refused(f"{last.op} {last.operands}")
        return None

    def selection(self, condition, yes, no, after, exits):
        inner = {**{target: line for target, line in exits.items() if line}, after: ""}
        self.nested(f"if ({condition}) {{", yes, inner)
        if no != after:
            self.nested("} else {", no, inner)
        self.put("}")


def translate(shader, function):
    body = Body(shader, function)
    body.region(next(iter(function.blocks)), {})
    parameters = []
    for number, parameter in enumerate(function.parameters):
        kind = body.types.text(shader.pointee(parameter))
        written = (function.name, number) in shader.written
        parameters.append(f"{body.name(parameter)}: {f'ptr<function, {kind}>' if written else kind}")
    kind = body.types.text(shader.module.all[function.name].operands[0])
    head = f"fn {shader.functions[function.name]}({', '.join(parameters)}){f' -> {kind}' if kind else ''} {{"
    variables = [f"  var {name}: {kind};" for name, kind in body.variables.items()]
    return "\n".join([head, *variables, *body.lines, "}\n"])
