// A SPIR-V module as instructions, for changes to its functions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hmlfc::gpu {

/// One instruction: its words, the first with opcode and length.
struct SpirvInstruction {
  std::vector<uint32_t> words;

  uint32_t opcode() const { return words[0] & 0xFFFF; }
  uint32_t operator[](size_t i) const { return i < words.size() ? words[i] : 0; }
};

/// An instruction from its opcode and the words behind the first.
inline SpirvInstruction spirv_instruction(uint32_t opcode, std::vector<uint32_t> operands) {
  operands.insert(operands.begin(), static_cast<uint32_t>(operands.size() + 1) << 16 | opcode);
  return {std::move(operands)};
}

struct SpirvModule {
  std::vector<uint32_t> header;  ///< five words; the fourth is the bound of ids
  std::vector<SpirvInstruction> instructions;

  explicit SpirvModule(std::span<const uint32_t> code) : header(code.begin(), code.begin() + 5) {
    for (size_t at = 5; at < code.size(); at += code[at] >> 16) {
      const auto words = code.subspan(at, code[at] >> 16);
      instructions.push_back({{words.begin(), words.end()}});
    }
  }

  uint32_t new_id() { return header[3]++; }

  std::vector<uint32_t> code() const {
    std::vector<uint32_t> words = header;
    for (const auto& instruction : instructions) {
      words.insert(words.end(), instruction.words.begin(), instruction.words.end());
    }
    return words;
  }
};

}  // namespace hmlfc::gpu
