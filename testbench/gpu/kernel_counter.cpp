#include "gpu/kernel_counter.hpp"

#include <utility>

#include "gpu/spirv_costs.hpp"
#include "kernel_code.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint32_t kLanes = 64;  // counters of each kind, so that invocations seldom meet

// Positions in the layout of a module (SPIR-V, section 2.4).
bool is_type(const SpirvInstruction& i) { return i.opcode() >= 19 && i.opcode() <= 39; }

// Adds counting to one module. The counters lie at a device address.
class Instrumentation {
 public:
  Instrumentation(std::span<const uint32_t> code, uint64_t address)
      : module_(code), costs_(module_), address_(address) {}

  std::vector<uint32_t> run() {
    declare();
    std::vector<SpirvInstruction> result;
    bool annotated = false;
    size_t block = 0;
    for (const SpirvInstruction& i : module_.instructions) {
      if (!annotated && is_type(i)) {
        result.insert(result.end(), annotations_.begin(), annotations_.end());
        annotated = true;
      }
      if (i.opcode() == kOpFunction) {
        result.insert(result.end(), globals_.begin(), globals_.end());
      }
      // A merge stands before the branch that ends a block.
      const bool merged = !result.empty() && is_merge(result.back());
      if (ends_block(i)) add_block_end(costs_.blocks()[block++], i, merged, result);
      result.push_back(i);
      if (i.opcode() == kOpLabel && block == 0) {
        result.insert(result.end(), variables_.begin(), variables_.end());
      }
    }
    module_.instructions = std::move(result);
    return module_.code();
  }

 private:
  // A declaration with an id of its own.
  uint32_t global(uint32_t opcode, std::vector<uint32_t> operands, bool typed) {
    const uint32_t id = module_.new_id();
    operands.insert(operands.begin() + (typed ? 1 : 0), id);
    globals_.push_back(spirv_instruction(opcode, std::move(operands)));
    return id;
  }

  uint32_t number(uint32_t value) { return global(kOpConstant, {uint_, value}, true); }

  void declare() {
    uint_ = costs_.uint_type();
    const uint32_t pair = costs_.uint_pair_type();
    const uint32_t array = global(kOpTypeRuntimeArray, {uint_}, false);
    const uint32_t record = global(kOpTypeStruct, {array}, false);
    annotations_ = {spirv_instruction(kOpDecorate, {array, kArrayStride, 4}),
                    spirv_instruction(kOpDecorate, {record, kBlock}),
                    spirv_instruction(kOpMemberDecorate, {record, 0, kOffset, 0})};
    record_pointer_ = global(kOpTypePointer, {kPhysicalStorage, record}, false);
    word_pointer_ = global(kOpTypePointer, {kPhysicalStorage, uint_}, false);
    const uint32_t low = number(static_cast<uint32_t>(address_));
    const uint32_t high = number(static_cast<uint32_t>(address_ >> 32));
    counters_ = global(kOpConstantComposite, {pair, low, high}, true);
    zero_ = number(0);
    one_ = number(1);
    last_lane_ = number(kLanes - 1);
    kinds_ = number(kCountKinds);
    const uint32_t sum_pointer = global(kOpTypePointer, {kFunction, uint_}, false);
    for (uint32_t k = 0; k < kCountKinds; ++k) {
      kind_numbers_[k] = number(k);
      sums_[k] = module_.new_id();
      variables_.push_back(
          spirv_instruction(kOpVariable, {sum_pointer, sums_[k], kFunction, zero_}));
    }
    for (const BlockCost& block : costs_.blocks()) {
      for (const uint32_t count : block) {
        if (count != 0 && !amounts_.contains(count)) amounts_[count] = number(count);
      }
    }
  }

  uint32_t value(std::vector<SpirvInstruction>& out, uint32_t opcode,
                 std::vector<uint32_t> operands, uint32_t type) {
    const uint32_t id = module_.new_id();
    operands.insert(operands.begin(), {type, id});
    out.push_back(spirv_instruction(opcode, std::move(operands)));
    return id;
  }

  void add_block_end(const BlockCost& block, const SpirvInstruction& end, bool merged,
                     std::vector<SpirvInstruction>& result) {
    std::vector<SpirvInstruction> added;
    for (uint32_t k = 0; k < kCountKinds; ++k) {
      if (block[k] == 0) continue;
      const uint32_t before = value(added, kOpLoad, {sums_[k]}, uint_);
      const uint32_t after = value(added, kOpIAdd, {before, amounts_[block[k]]}, uint_);
      added.push_back(spirv_instruction(kOpStore, {sums_[k], after}));
    }
    if (end.opcode() == kOpReturn) add_sums(added);
    result.insert(result.end() - (merged ? 1 : 0), added.begin(), added.end());
  }

  // Adds what the invocation has counted to the counters of its lane.
  void add_sums(std::vector<SpirvInstruction>& added) {
    const uint32_t record = value(added, kOpBitcast, {counters_}, record_pointer_);
    const uint32_t index = value(added, kOpLoad, {costs_.local_index()}, uint_);
    const uint32_t lane = value(added, kOpBitwiseAnd, {index, last_lane_}, uint_);
    const uint32_t first = value(added, kOpIMul, {lane, kinds_}, uint_);
    for (uint32_t k = 0; k < kCountKinds; ++k) {
      const uint32_t sum = value(added, kOpLoad, {sums_[k]}, uint_);
      const uint32_t at = value(added, kOpIAdd, {first, kind_numbers_[k]}, uint_);
      const uint32_t word = value(added, kOpAccessChain, {record, zero_, at}, word_pointer_);
      value(added, kOpAtomicIAdd, {word, one_, zero_, sum}, uint_);
    }
  }

  SpirvModule module_;
  SpirvCosts costs_;
  uint64_t address_;
  std::vector<SpirvInstruction> annotations_, globals_, variables_;
  uint32_t uint_ = 0, record_pointer_ = 0, word_pointer_ = 0, counters_ = 0;
  uint32_t zero_ = 0, one_ = 0, last_lane_ = 0, kinds_ = 0;
  std::array<uint32_t, kCountKinds> sums_{}, kind_numbers_{};
  std::map<uint32_t, uint32_t> amounts_;  // constants by value
};

}  // namespace

struct KernelCounter::Counters {
  using Words = std::array<uint32_t, kLanes * kCountKinds>;
  std::map<std::string, Words> of_kernel;
};

KernelCounter::KernelCounter() : counters_(std::make_unique<Counters>()) {}
KernelCounter::~KernelCounter() = default;
KernelCounter::KernelCounter(KernelCounter&&) noexcept = default;
KernelCounter& KernelCounter::operator=(KernelCounter&&) noexcept = default;

std::vector<uint32_t> KernelCounter::counting(const std::string& name,
                                              std::span<const uint32_t> code) {
  auto& words = counters_->of_kernel[name];
  return Instrumentation(code, reinterpret_cast<uint64_t>(words.data())).run();
}

KernelCode KernelCounter::kernels() {
  KernelCode kernels;
  for (const auto& [name, code] : built_kernels()) kernels[name] = counting(name, code);
  return kernels;
}

std::map<std::string, KernelCounts> KernelCounter::take() {
  std::map<std::string, KernelCounts> result;
  for (auto& [name, words] : counters_->of_kernel) {
    std::array<uint64_t, kCountKinds> sums{};
    for (size_t i = 0; i < words.size(); ++i) sums[i % kCountKinds] += words[i];
    words.fill(0);
    if (sums[0] != 0)
      result[name] = {sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6]};
  }
  return result;
}

}  // namespace hmlfc::gpu
