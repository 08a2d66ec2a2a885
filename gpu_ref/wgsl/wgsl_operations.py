"""What instructions of SPIR-V are in WGSL, by their names without Op."""

# The operator or function, and the kind of integers that it takes: none for that of the result, in a comparison for
# that of the first operand.
BINARY = {
    "IAdd": "+", "ISub": "-", "IMul": "*", "UDiv": "/ u32", "UMod": "% u32", "SDiv": "/ i32", "SMod": "% i32",
    "BitwiseAnd": "&", "BitwiseOr": "|",
    "LogicalAnd": "&", "LogicalOr": "|", "ShiftLeftLogical": "<<", "ShiftRightLogical": ">> u32",
    "ShiftRightArithmetic": ">> i32",
}
COMPARISONS = {
    "IEqual": "==", "INotEqual": "!=", "ULessThan": "< u32", "ULessThanEqual": "<= u32", "UGreaterThan": "> u32",
    "UGreaterThanEqual": ">= u32", "SLessThan": "< i32", "SLessThanEqual": "<= i32", "SGreaterThan": "> i32",
    "SGreaterThanEqual": ">= i32",
}
CALLS = {
    "UMin": "min u32", "UMax": "max u32", "UClamp": "clamp u32", "SMin": "min i32", "SMax": "max i32",
    "SClamp": "clamp i32", "SAbs": "abs i32", "FindILsb": "firstTrailingBit", "BitCount": "countOneBits",
    "FindSMsb": "firstLeadingBit i32", "Not": "~", "SNegate": "-",
}
ATOMICS = {
    "AtomicIAdd": "atomicAdd", "AtomicOr": "atomicOr", "AtomicUMin": "atomicMin", "AtomicUMax": "atomicMax",
    "AtomicSMin": "atomicMin", "AtomicSMax": "atomicMax",
}
# Calls whose operands stay as they are; the last four are PAIRS of wgsl_of_spirv.py.
PLAIN = {
    "LogicalNot": "!", "Any": "any", "All": "all",
    "UMulExtended": "product", "SMulExtended": "signed_product", "IAddCarry": "sum", "ISubBorrow": "difference",
}
KNOWN = {
    *BINARY, *COMPARISONS, *CALLS, *PLAIN, *ATOMICS, "FunctionCall", "AtomicLoad", "CompositeConstruct", "VectorShuffle",
    "Select", "CopyLogical", "Bitcast", "BitFieldInsert", "BitFieldSExtract",
    "BitFieldUExtract",
}
WRITES = ("OpStore", "OpFunctionCall", "OpControlBarrier", *(f"Op{name}" for name in ATOMICS))
STATEMENTS = (
    *WRITES, "OpLoopMerge", "OpSelectionMerge", "OpBranch", "OpBranchConditional", "OpReturn", "OpReturnValue",
    "OpUnreachable", "OpPhi", "OpCompositeInsert",
)
