// Decodes one block and shows its trace: each field that is read, each stage's values, the cost.
//   decode_block FILE ROW COL BX BY
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include <hmlfc/decoder.hpp>

#include "mapped_file.hpp"

namespace {

// Prints what it receives.
class Printer final : public hmlfc::TraceSink {
 public:
  void on_field(const hmlfc::FieldRecord& field) override {
    std::printf("level %d  byte %" PRIu64 "  %.*s = %" PRId64 "\n", field.site.level, field.bit / 8,
                static_cast<int>(field.name.size()), field.name.data(), field.value);
  }

  void on_stage(const hmlfc::StageRecord& stage) override {
    std::printf("level %d  %.*s:", stage.site.level, static_cast<int>(stage.stage.size()),
                stage.stage.data());
    for (const int32_t value : stage.values) std::printf(" %d", value);
    std::printf("\n");
  }
};

uint32_t number(const char* text) { return static_cast<uint32_t>(std::strtoul(text, nullptr, 10)); }

}  // namespace

int main(int count, char** arguments) {
  if (count != 6) {
    std::fprintf(stderr, "usage: decode_block FILE ROW COL BX BY\n");
    return 2;
  }
  const MappedFile file(arguments[1]);  // outlives the decoder
  const auto decoder = hmlfc::Decoder::open(file.bytes());
  if (!decoder) {
    std::fprintf(stderr, "%s\n", to_string(decoder.error()).c_str());
    return 1;
  }
  Printer printer;
  hmlfc::AccessCounts cost;
  const hmlfc::BlockAddress block{{number(arguments[2]), number(arguments[3])},
                                  hmlfc::Plane::kY,
                                  number(arguments[4]),
                                  number(arguments[5])};
  const auto samples = decoder->decode_block(block, {.trace = &printer, .counts = &cost});
  if (!samples) {
    std::fprintf(stderr, "%s\n", to_string(samples.error()).c_str());
    return 1;
  }
  std::printf("samples:");
  for (const int32_t sample : *samples) std::printf(" %d", sample);
  std::printf("\ncost: %" PRIu64 " fields, %" PRIu64 " bits\n", cost.fields, cost.bits);
  return 0;
}
