#include "oracle/trace_text.hpp"

#include "oracle/oracle.hpp"

namespace hmlfc::tb {
namespace {

template <class Values>
void write_values(std::FILE* out, const char* name, const Values& values, size_t count) {
  std::fprintf(out, "  %s:", name);
  for (size_t i = 0; i < count; ++i) std::fprintf(out, " %d", static_cast<int>(values[i]));
  std::fputc('\n', out);
}

class TextSink final : public TraceSink {
 public:
  explicit TextSink(std::FILE* out) : out_(out) {}

  void on_field(const FieldRecord& r) override {
    show(r.site);
    std::fprintf(out_, "  %s %s (%s) bit %llu, %u bits: %lld\n",
                 std::string(section_name(r.section)).c_str(), std::string(r.name).c_str(),
                 std::string(r.clause).c_str(), static_cast<unsigned long long>(r.bit), r.bits,
                 static_cast<long long>(r.value));
  }

  void on_stage(const StageRecord& r) override {
    show(r.site);
    write_values(out_, std::string(r.stage).c_str(), r.values, r.values.size());
  }

 private:
  void show(const BlockSite& site) {
    if (site == site_ && shown_) return;
    site_ = site;
    shown_ = true;
    std::fprintf(out_, "%s, %s\n", to_string(site).c_str(),
                 std::string(tile_kind_name(site.tile)).c_str());
  }

  std::FILE* out_;
  BlockSite site_;
  bool shown_ = false;
};

}  // namespace

void write_model_trace(std::FILE* out, const GoldenStream& stream, const Request& request) {
  const ExpectedAnswer expected = Oracle(stream).evaluate(request);
  for (const auto& plane : expected.planes) {
    if (!plane) continue;
    const BlockSite& site = plane->levels.back().site;
    TextSink sink(out);
    const DecodeSources sources{stream.view(), stream.keys()};
    const auto block = decode_block(sources, site, Probe{&sink, nullptr, site});
    if (!block) std::fprintf(out, "%s\n", to_string(block.error()).c_str());
  }
  write_answer(out, expected.answer, stream.geometry().block_size());
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
    write_values(out, "reference", record.reference, count);
  }
  if (!record.key) write_values(out, "prediction", record.prediction, count);
  if (record.has_residual) write_values(out, "residual", record.residual, count);
  write_values(out, "sample", record.sample, count);
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
