"""Types of a shader in WGSL, and whether its records lie in memory as those of SPIR-V do."""

from spirv_module import Refused

# What WGSL keeps for itself, and names of functions that a translation uses.
RESERVED = set("""
alias break case const const_assert continue continuing default diagnostic discard else enable false fn for if let
loop override requires return struct switch true var while NULL Self abstract active alignas alignof as asm
asm_fragment async attribute auto await become cast catch class co_await co_return co_yield coherent column_major
common compile compile_fragment concept const_cast consteval constexpr constinit crate debugger decltype delete
demote demote_to_helper do dynamic_cast enum explicit export extends extern external fallthrough filter final
finally friend from fxgroup get goto groupshared highp impl implements import inline instanceof interface layout
lowp macro macro_rules match mediump meta mod module move mut mutable namespace new nil noexcept noinline
nointerpolation non_coherent noncoherent noperspective null nullptr of operator package packoffset partial pass
patch pixelfragment precise precision premerge priv protected pub public readonly ref regardless register
reinterpret_cast require resource restrict self set shared sizeof smooth snorm static static_assert static_cast std
subroutine super target template this thread_local throw trait try type typedef typeid typename typeof union unless
unorm unsafe unsized use using varying virtual volatile wgsl where with writeonly yield
abs all any array atomic bool clamp i32 main max min ptr select u32 vec2 vec3 vec4
""".split())


def safe(name, taken=frozenset()):
    """`name`, or one like it that WGSL allows and that is not taken."""
    return f"{name}_" if name in RESERVED or name in taken else name


class Types:
    def __init__(self, module):
        self.module = module
        self.structures = {}  # name to members as text; two structures of one name and text are the same
        self.titles = {}  # of a structure's id

    def count(self, name):
        """Elements of an array."""
        return int(self.module.all[self.module.all[name].operands[1]].operands[1])

    def part(self, name, number):
        """The type of a part of a value, and what selects it."""
        one = self.module.all[name]
        if one.op == "OpTypeStruct":
            return one.operands[number], f".{self.member(name, number)}"
        return one.operands[0], f".{'xyzw'[number]}" if one.op == "OpTypeVector" else f"[{number}]"

    def is_pointer(self, name):
        return self.module.all[name].op == "OpTypePointer"

    def member(self, name, number):
        return safe(self.module.names.get((name, number), f"m{number}"))

    def text(self, name):
        one = self.module.all[name]
        match one.op, one.operands:
            case "OpTypeVoid", _:
                return ""
            case "OpTypeBool", _:
                return "bool"
            case "OpTypeInt", ["32", sign]:
                return "i32" if sign == "1" else "u32"
            case "OpTypeVector", [part, count]:
                return f"vec{count}<{self.text(part)}>"
            case "OpTypeArray", [part, _]:
                return f"array<{self.text(part)}, {self.count(name)}>"
            case "OpTypeRuntimeArray", [part]:
                return f"array<{self.text(part)}>"
            case "OpTypeStruct", parts:
                members = "".join(f"  {self.member(name, i)}: {self.text(part)},\n" for i, part in enumerate(parts)
                                  if not self.is_pointer(part))
                title = self.titles.get(name) or safe(self.module.names[name])
                while self.structures.setdefault(title, members) != members:
                    title += "_"
                self.titles[name] = title
                return title
        raise Refused(f"type {one.op} {one.operands}")

    def is_uniform(self, name):
        """Whether a uniform buffer may hold the type: its arrays have elements of whole 16 bytes."""
        one = self.module.all[name]
        match one.op:
            case "OpTypeRuntimeArray":
                return False
            case "OpTypeArray":
                return int(self.module.decorations[name, "ArrayStride"][0]) % 16 == 0 and self.is_uniform(one.operands[0])
            case "OpTypeStruct":
                return all(self.is_pointer(part) or self.is_uniform(part) for part in one.operands)
        return True

    def layout(self, name):
        """Alignment and size in bytes by the rules of WGSL. Refused: SPIR-V says otherwise. Pointers at the beginning of
        a structure are left out."""
        one, decorations = self.module.all[name], self.module.decorations
        match one.op, one.operands:
            case "OpTypeInt", _:
                return 4, 4
            case "OpTypeVector", [_, count]:
                return (8 if count == "2" else 16), 4 * int(count)
            case ("OpTypeArray" | "OpTypeRuntimeArray"), [part, *_]:
                alignment, size = self.layout(part)
                stride = -(-size // alignment) * alignment
                if decorations[name, "ArrayStride"] != [str(stride)]:
                    raise Refused(f"the stride of {name}")
                return alignment, stride * (self.count(name) if one.op == "OpTypeArray" else 1)
            case "OpTypeStruct", parts:
                end, most, pointers = 0, 4, 0
                for number, part in enumerate(parts):
                    if self.is_pointer(part):
                        pointers += 8
                        continue
                    alignment, size = self.layout(part)
                    begin = -(-end // alignment) * alignment
                    if decorations[name, number, "Offset"] != [str(pointers + begin)]:
                        raise Refused(f"the place of member {number} of {name}")
                    end, most = begin + size, max(most, alignment)
                return most, -(-end // most) * most
        raise Refused(f"{one.op} in memory")
