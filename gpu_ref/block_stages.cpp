#include "block_stages.hpp"

#include <hmlfc/error.hpp>

#include "arithmetic/rounding.hpp"

namespace hmlfc::gpu {
namespace {

// block_entry.glsl
enum EntryKind : uint32_t { kKindNone = 0, kKindKey = 1 };
// samples.comp
enum Stage : uint32_t { kResidual = 0, kReference = 1, kPrediction = 2, kSample = 3 };

uint32_t bits(uint32_t word, unsigned at, unsigned count) {
  return (word >> at) & ((1u << count) - 1);
}

SubpelVector vector_of(uint32_t word) {
  return {sign_extend(bits(word, 0, 10), 10), sign_extend(bits(word, 10, 10), 10),
          static_cast<int32_t>(bits(word, 20, 3)), static_cast<int32_t>(bits(word, 24, 3))};
}

std::vector<int16_t> unpack(std::span<const uint32_t> words) {
  std::vector<int16_t> samples;
  for (const uint32_t word : words) {
    samples.push_back(static_cast<int16_t>(word));
    samples.push_back(static_cast<int16_t>(word >> 16));
  }
  return samples;
}

LevelStages level_stages(int level, std::span<const uint32_t> entry) {
  const uint32_t head = entry[0];
  LevelStages stages;
  stages.level = level;
  stages.status = static_cast<uint8_t>(head);
  stages.key = bits(head, 8, 2) == kKindKey;
  stages.references = bits(head, 10, 2);
  stages.negative = bits(head, 12, 1) != 0;
  stages.has_residual = bits(head, 13, 1) != 0;
  for (size_t i = 0; i < 2; ++i) stages.vectors[i] = vector_of(entry[4 + 2 * i]);
  return stages;
}

}  // namespace

BlockStages block_stages(uint32_t status, std::span<const uint32_t> entries,
                         std::span<const uint32_t> stages, const BlockSizes& sizes) {
  BlockStages block;
  block.status = static_cast<uint8_t>(status);
  if (status == static_cast<uint32_t>(ErrorCode::kBadRequest)) return block;
  for (uint32_t l = sizes.levels; l-- > 0;) {
    const auto entry = entries.subspan(l * kEntryWords, kEntryWords);
    if (bits(entry[0], 8, 2) == kKindNone) continue;
    LevelStages level = level_stages(static_cast<int>(l), entry);
    const auto values = [&](Stage stage) {
      return unpack(
          stages.subspan((l * kStageCount + stage) * sizes.sample_words, sizes.sample_words));
    };
    const bool failed = level.status != 0;
    if (!failed) {
      if (level.has_residual) level.residual = values(kResidual);
      if (level.references != 0) level.reference = values(kReference);
      if (!level.key) level.prediction = values(kPrediction);
      level.sample = values(kSample);
    }
    block.levels.push_back(std::move(level));
    if (failed) break;
  }
  return block;
}

}  // namespace hmlfc::gpu
