#include "dut/hmlfc_dpi.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace {

struct Stream {
  std::vector<uint8_t> bytes;
  hmlfc::Decoder decoder;
};

const hmlfc::Decoder& decoder_of(void* stream) { return static_cast<Stream*>(stream)->decoder; }

hmlfc::BlockAddress address(int row, int col, int plane, int block_x, int block_y) {
  return {{static_cast<uint32_t>(row), static_cast<uint32_t>(col)},
          static_cast<hmlfc::Plane>(plane),
          static_cast<uint32_t>(block_x),
          static_cast<uint32_t>(block_y)};
}

// Keeps the values of one stage of one level.
class StageFinder final : public hmlfc::TraceSink {
 public:
  StageFinder(int level, std::string_view stage) : level_(level), stage_(stage) {}

  void on_field(const hmlfc::FieldRecord&) override {}

  void on_stage(const hmlfc::StageRecord& record) override {
    if (record.site.level != level_ || record.stage != stage_) return;
    values.assign(record.values.begin(), record.values.end());
  }

  std::vector<int32_t> values;

 private:
  int level_;
  std::string_view stage_;
};

}  // namespace

void* hmlfc_dpi_open(const char* path, int* status) {
  std::ifstream file(path, std::ios::binary);
  std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  *status = -1;
  if (!file) return nullptr;
  auto decoder = hmlfc::Decoder::open(bytes);
  *status = decoder ? 0 : static_cast<int>(decoder.error().code);
  if (!decoder) return nullptr;
  // The bytes stay where they are when the vector is moved.
  return new Stream{std::move(bytes), std::move(*decoder)};
}

int hmlfc_dpi_field(void* stream, const char* name) {
  const hmlfc::StreamHeader& header = decoder_of(stream).header();
  const std::pair<std::string_view, int64_t> fields[] = {
      {"rows", header.rows},
      {"cols", header.cols},
      {"width", header.width},
      {"height", header.height},
      {"depth", header.depth},
      {"chroma_format", static_cast<int64_t>(header.chroma_format)},
      {"block_log2", header.block_log2},
      {"tree_height", header.tree_height}};
  for (const auto& [field, value] : fields) {
    if (field == name) return static_cast<int>(value);
  }
  return -1;
}

int hmlfc_dpi_block(void* stream, int row, int col, int plane, int block_x, int block_y,
                    int stop_level, int* samples) {
  const auto block = decoder_of(stream).decode_block(address(row, col, plane, block_x, block_y),
                                                     {.stop_level = stop_level});
  if (!block) return static_cast<int>(block.error().code);
  std::ranges::copy(*block, samples);
  return 0;
}

int hmlfc_dpi_stage(void* stream, int row, int col, int plane, int block_x, int block_y, int level,
                    const char* stage, int* values) {
  StageFinder finder(level, stage);
  const auto block = decoder_of(stream).decode_block(address(row, col, plane, block_x, block_y),
                                                     {.trace = &finder});
  if (!block) return -static_cast<int>(block.error().code);
  std::ranges::copy(finder.values, values);
  return static_cast<int>(finder.values.size());
}

void hmlfc_dpi_close(void* stream) { delete static_cast<Stream*>(stream); }
