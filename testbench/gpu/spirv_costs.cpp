#include "gpu/spirv_costs.hpp"

#include <algorithm>
#include <stdexcept>

namespace hmlfc::gpu {
namespace {

constexpr uint32_t kDivision = 20;           // instructions of a division
constexpr uint32_t kDivisionByConstant = 3;  // a product, a shift, a correction

// Words of an instruction that are a result's type and id: types, labels and stores have no type.
bool has_type_and_result(const SpirvInstruction& i) {
  const uint32_t op = i.opcode();
  if (op == kOpUndef || op == kOpExtInst || (op >= 54 && op <= 61 && op != 56)) return true;
  if (op >= 65 && op <= 70) return true;
  if (op >= 77 && op <= 215) return true;
  if (op >= 41 && op <= 52) return true;
  return op == kOpAtomicLoad || (op >= 229 && op <= kOpAtomicXor) || op == kOpPhi ||
         op == kOpCopyLogical;
}

// Without an instruction of their own on a machine.
bool is_free(uint32_t op) {
  return op == kOpUndef || op == kOpVariable || op == kOpCompositeConstruct ||
         op == kOpCompositeExtract || op == kOpCompositeInsert || op == kOpVectorShuffle ||
         op == kOpCopyObject || op == kOpBitcast || op == kOpCopyLogical || op == kOpPhi ||
         op == kOpLabel || op == kOpBranch || op == kOpLoopMerge || op == kOpSelectionMerge ||
         op == kOpReturn || op == kOpUnreachable;
}

bool is_chain(uint32_t op) { return op == kOpAccessChain || op == kOpInBoundsAccessChain; }
bool is_atomic(uint32_t op) { return op >= kOpAtomicLoad && op <= kOpAtomicXor; }

}  // namespace

SpirvCosts::SpirvCosts(const SpirvModule& module) {
  for (const auto& i : module.instructions) {
    declare(i);
    find_uses(i);
  }
  while (spread(module)) {
  }
  BlockCost cost{};
  for (const auto& i : module.instructions) {
    if (i.opcode() == kOpFunctionCall) throw std::logic_error("a kernel calls a function");
    if (i.opcode() == kOpLabel) cost = {};
    add(i, cost);
    if (ends_block(i)) blocks_.push_back(cost);
  }
}

void SpirvCosts::declare(const SpirvInstruction& i) {
  const uint32_t op = i.opcode();
  if (op >= 19 && op <= 39) types_[i[1]] = i;
  if (op == kOpTypeInt && i[2] == 32 && i[3] == 0) uint_ = i[1];
  if (op == kOpTypeVector && i[2] == uint_ && i[3] == 2) uint_pair_ = i[1];
  if (has_type_and_result(i)) type_of_[i[2]] = i[1];
  if (op >= kOpConstantTrue && op <= kOpSpecConstantOp) constants_.insert(i[2]);
  if (op == kOpConstant) numbers_[i[2]] = i[3];
  if (op == kOpDecorate && i[2] == kBuiltIn && i[3] >= kLocalInvocationId &&
      i[3] <= kLocalInvocationIndex) {
    lane_inputs_.insert(i[1]);
    if (i[3] == kLocalInvocationIndex) local_index_ = i[1];
  }
}

void SpirvCosts::find_uses(const SpirvInstruction& i) {
  if (i.opcode() == kOpCompositeExtract) extracted_[i[3]].insert(i[4]);
  if (is_chain(i.opcode())) chains_.insert(i[2]);
}

uint32_t SpirvCosts::storage_of(uint32_t pointer) const {
  const auto type = types_.find(type_of_.at(pointer));
  return type == types_.end() || type->second.opcode() != kOpTypePointer ? 0 : type->second[2];
}

// Whether the value of `i` may differ between the invocations of a workgroup, but for branches.
bool SpirvCosts::differs(const SpirvInstruction& i) const {
  const uint32_t op = i.opcode();
  if (op == kOpLoad) {
    const uint32_t storage = storage_of(i[3]);
    return varies(i[3]) || lane_inputs_.contains(i[3]) ||
           (storage == kFunction && chains_.contains(i[3]));
  }
  if (is_atomic(op)) return true;
  if (op == kOpFunction || op == kOpVariable || !has_type_and_result(i)) return false;
  for (size_t k = 3; k < i.words.size(); ++k) {
    if (op == kOpExtInst && k < 5) continue;
    if (op == kOpPhi && k % 2 == 0) continue;
    if (varies(i[k])) return true;
  }
  return false;
}

// One pass that finds more values that may differ; false where there are none. At the merge behind
// a branch that invocations take differently, what comes from its sides differs.
bool SpirvCosts::spread(const SpirvModule& module) {
  const size_t before = varying_.size();
  std::map<uint32_t, bool> merges;  // by label: whether its phis differ; opened at the header
  uint32_t label = 0;
  for (const auto& i : module.instructions) {
    const uint32_t op = i.opcode();
    if (op == kOpLabel) label = i[1];
    if (op == kOpPhi && (differs(i) || (merges.contains(label) && merges[label]))) {
      varying_.insert(i[2]);
    } else if (op != kOpPhi && differs(i)) {
      varying_.insert(i[2]);
    }
    if (is_merge(i)) merges.emplace(i[1], false);
    if (op == kOpLoopMerge) merges.emplace(i[2], false);
    if ((op == kOpBranchConditional || op == kOpSwitch) && varies(i[1])) {
      for (auto& [merge, differ] : merges) differ = true;  // all that are open
    }
    if (op == kOpLabel && merges.contains(i[1]) && !merges[i[1]]) merges.erase(i[1]);
  }
  return varying_.size() != before;
}

uint32_t SpirvCosts::words_of(uint32_t type) const {
  const SpirvInstruction& i = types_.at(type);
  switch (i.opcode()) {
    case kOpTypeVector:
      return i[3] * words_of(i[2]);
    case kOpTypeArray:
      return numbers_.at(i[3]) * words_of(i[2]);
    case kOpTypePointer:
      return 2;
    case kOpTypeStruct: {
      uint32_t words = 0;
      for (size_t k = 2; k < i.words.size(); ++k) words += words_of(i[k]);
      return words;
    }
    default:
      return 1;
  }
}

// Of a record or an array whose members are used one by one, those that are used.
uint32_t SpirvCosts::loaded_words(const SpirvInstruction& load) const {
  const SpirvInstruction& type = types_.at(load[1]);
  const auto used = extracted_.find(load[2]);
  if ((type.opcode() == kOpTypeStruct || type.opcode() == kOpTypeArray) &&
      used != extracted_.end()) {
    uint32_t words = 0;
    for (const uint32_t member : used->second) {
      words += words_of(type.opcode() == kOpTypeStruct ? type[2 + member] : type[2]);
    }
    return words;
  }
  return words_of(load[1]);
}

void SpirvCosts::add_access(uint32_t pointer, uint32_t words, bool stores, BlockCost& cost) const {
  constexpr size_t kLoads = 2, kUniformLoads = 3, kStores = 4, kShared = 5;
  const uint32_t storage = storage_of(pointer);
  const uint32_t accesses = (words + 3) / 4;
  if (storage == kPhysicalStorage) {
    cost[0] += accesses;
    cost[stores ? kStores : varies(pointer) ? kLoads : kUniformLoads] += accesses;
  } else if (storage == kWorkgroup) {
    cost[0] += accesses;
    cost[kShared] += accesses;
  } else if (storage == kFunction && chains_.contains(pointer)) {
    cost[0] += words;  // an array of registers
  }
}

uint32_t SpirvCosts::instructions_of(const SpirvInstruction& i) const {
  const uint32_t op = i.opcode();
  if (op == kOpControlBarrier) return 1;
  if (op == kOpBranchConditional || op == kOpSwitch) return constants_.contains(i[1]) ? 0 : 1;
  if (is_chain(op)) {
    uint32_t variable = 0;
    for (size_t k = 4; k < i.words.size(); ++k) variable += constants_.contains(i[k]) ? 0u : 1u;
    return variable;
  }
  if (!has_type_and_result(i)) return 0;
  const auto type = types_.find(i[1]);
  const uint32_t components =
      type != types_.end() && type->second.opcode() == kOpTypeVector ? type->second[3] : 1;
  if (op >= kOpUDiv && op <= kOpSMod) {
    return components * (constants_.contains(i[4]) ? kDivisionByConstant : kDivision);
  }
  return components * (op >= kOpIAddCarry && op <= kOpSMulExtended ? 2 : 1);
}

// Whether all invocations of a workgroup do the same in `i`. Stores and atomic operations never
// are: a machine does each.
bool SpirvCosts::is_uniform(const SpirvInstruction& i) const {
  const uint32_t op = i.opcode();
  if (op == kOpBranchConditional || op == kOpSwitch) return !varies(i[1]);
  return has_type_and_result(i) && !is_atomic(op) && !varies(i[2]);
}

void SpirvCosts::add(const SpirvInstruction& i, BlockCost& cost) const {
  constexpr size_t kUniform = 1, kAtomics = 6;
  const uint32_t op = i.opcode();
  const uint32_t before = cost[0];
  if (op == kOpLoad) {
    add_access(i[3], loaded_words(i), false, cost);
  } else if (op == kOpStore) {
    add_access(i[1], words_of(type_of_.at(i[2])), true, cost);
  } else if (is_atomic(op)) {
    cost[0] += 1;
    if (op != 228 && storage_of(i[3]) == kPhysicalStorage) cost[kAtomics] += 1;
  } else if (!is_free(op)) {
    cost[0] += instructions_of(i);
  }
  if (is_uniform(i)) cost[kUniform] += cost[0] - before;
}

}  // namespace hmlfc::gpu
