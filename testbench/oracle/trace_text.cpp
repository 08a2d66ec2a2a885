#include "oracle/trace_text.hpp"

namespace hmlfc::tb {
namespace {

void write_values(std::FILE* out, const char* name, const int16_t* values, size_t count) {
  std::fprintf(out, "  %s:", name);
  for (size_t i = 0; i < count; ++i) std::fprintf(out, " %d", values[i]);
  std::fputc('\n', out);
}

}  // namespace

void write_expected(std::FILE* out, const ExpectedAnswer& expected, unsigned block_size) {
  for (const auto& plane : expected.planes) {
    if (!plane) continue;
    for (const LevelRecord& record : plane->levels) {
      write_record(out, record, block_size);
      if (record.error != 0) break;
    }
  }
  write_answer(out, expected.answer, block_size);
}

void write_record(std::FILE* out, const LevelRecord& record, unsigned block_size) {
  const size_t count = size_t{block_size} * block_size;
  std::fprintf(out, "%s, %s, error %u\n", to_string(record.site).c_str(),
               record.key ? "key image" : std::string(state_name(record.state())).c_str(),
               record.error);
  if (record.error != 0) return;
  if (record.motion) {
    std::fprintf(out, "  sign %c\n", record.negative ? '-' : '+');
    for (unsigned i = 0; i < record.references; ++i) {
      const SubpelVector& v = record.vectors[i];
      std::fprintf(out, "  reference %u: ix %d fx %d iy %d fy %d\n", i, v.ix, v.fx, v.iy, v.fy);
    }
    write_values(out, "reference", record.reference.data(), count);
  }
  if (!record.key) write_values(out, "prediction", record.prediction.data(), count);
  if (record.has_residual) write_values(out, "residual", record.residual.data(), count);
  write_values(out, "sample", record.sample.data(), count);
}

void write_answer(std::FILE* out, const Answer& answer, unsigned block_size) {
  std::fprintf(out, "answer: status %s, tlast %d\n", status_name(answer.status).c_str(),
               answer.last ? 1 : 0);
  const size_t lane = size_t{block_size} * block_size;
  for (size_t c = 0; c < kLanes; ++c) {
    const std::string name = "lane " + std::to_string(c);
    write_values(out, name.c_str(), answer.samples.data() + c * lane, lane);
  }
}

}  // namespace hmlfc::tb
