// What each block of a kernel costs, in the counts of kernel_counter.hpp.
#pragma once

#include <array>
#include <map>
#include <set>

#include "gpu/kernel_counter.hpp"
#include "gpu/spirv_module.hpp"

namespace hmlfc::gpu {

// Opcodes and other numbers of SPIR-V.
enum SpirvNumber : uint32_t {
  kOpUndef = 1,
  kOpExtInst = 12,
  kOpTypeInt = 21,
  kOpTypeVector = 23,
  kOpTypeArray = 28,
  kOpTypeRuntimeArray = 29,
  kOpTypeStruct = 30,
  kOpTypePointer = 32,
  kOpConstantTrue = 41,
  kOpConstant = 43,
  kOpConstantComposite = 44,
  kOpSpecConstantOp = 52,
  kOpFunction = 54,
  kOpFunctionCall = 57,
  kOpVariable = 59,
  kOpLoad = 61,
  kOpStore = 62,
  kOpAccessChain = 65,
  kOpInBoundsAccessChain = 66,
  kOpDecorate = 71,
  kOpMemberDecorate = 72,
  kOpVectorShuffle = 79,
  kOpCompositeConstruct = 80,
  kOpCompositeExtract = 81,
  kOpCompositeInsert = 82,
  kOpCopyObject = 83,
  kOpBitcast = 124,
  kOpIAdd = 128,
  kOpIMul = 132,
  kOpUDiv = 134,
  kOpSMod = 139,
  kOpIAddCarry = 149,
  kOpSMulExtended = 152,
  kOpBitwiseAnd = 199,
  kOpControlBarrier = 224,
  kOpAtomicLoad = 227,
  kOpAtomicIAdd = 234,
  kOpAtomicXor = 242,
  kOpPhi = 245,
  kOpLoopMerge = 246,
  kOpSelectionMerge = 247,
  kOpLabel = 248,
  kOpBranch = 249,
  kOpBranchConditional = 250,
  kOpSwitch = 251,
  kOpReturn = 253,
  kOpUnreachable = 255,
  kOpCopyLogical = 400,

  kBlock = 2,
  kArrayStride = 6,
  kBuiltIn = 11,
  kOffset = 35,

  kInput = 1,
  kWorkgroup = 4,
  kFunction = 7,
  kPhysicalStorage = 5349,

  kLocalInvocationId = 27,
  kLocalInvocationIndex = 29,
};

inline bool is_merge(const SpirvInstruction& i) {
  return i.opcode() == kOpLoopMerge || i.opcode() == kOpSelectionMerge;
}
inline bool ends_block(const SpirvInstruction& i) {
  return i.opcode() >= kOpBranch && i.opcode() <= kOpUnreachable;
}

/// Counts by their place in KernelCounts.
using BlockCost = std::array<uint32_t, kCountKinds>;

/// The costs of a module with one function, from its instructions alone.
class SpirvCosts {
 public:
  /// Throws std::logic_error where functions are called: glslc -O leaves none.
  explicit SpirvCosts(const SpirvModule& module);

  /// Of each block, in the module's order.
  const std::vector<BlockCost>& blocks() const { return blocks_; }

  uint32_t uint_type() const { return uint_; }
  uint32_t uint_pair_type() const { return uint_pair_; }
  /// The variable gl_LocalInvocationIndex.
  uint32_t local_index() const { return local_index_; }

 private:
  void declare(const SpirvInstruction& i);
  void find_uses(const SpirvInstruction& i);
  bool spread(const SpirvModule& module);
  bool is_uniform(const SpirvInstruction& i) const;
  bool differs(const SpirvInstruction& i) const;
  void add(const SpirvInstruction& i, BlockCost& cost) const;
  void add_access(uint32_t pointer, uint32_t words, bool stores, BlockCost& cost) const;
  uint32_t words_of(uint32_t type) const;
  uint32_t loaded_words(const SpirvInstruction& load) const;
  uint32_t instructions_of(const SpirvInstruction& i) const;
  uint32_t storage_of(uint32_t pointer) const;
  bool varies(uint32_t id) const { return varying_.contains(id); }

  uint32_t uint_ = 0, uint_pair_ = 0, local_index_ = 0;
  std::map<uint32_t, SpirvInstruction> types_;        // by id
  std::map<uint32_t, uint32_t> type_of_;              // of values, by id
  std::map<uint32_t, uint32_t> numbers_;              // constants of 32 bits, by id
  std::set<uint32_t> constants_;                      // also those of a specialisation
  std::set<uint32_t> lane_inputs_;                    // variables that differ between invocations
  std::map<uint32_t, std::set<uint32_t>> extracted_;  // members of a value that are used, by id
  std::set<uint32_t> chains_;                         // pointers that are no variables
  std::set<uint32_t> varying_;                        // values that may differ between invocations
  std::vector<BlockCost> blocks_;
};

}  // namespace hmlfc::gpu
