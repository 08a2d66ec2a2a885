// crosscheck: every implementation that this build has, on the same blocks.
#include <chrono>
#include <cstdio>
#include <functional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bits/crc32c.hpp"
#include "io/mapped_file.hpp"
#include "sequences.hpp"
#include "stream_image.hpp"
#include "tlm/tlm_platform.hpp"
#include "units.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitDifferent = 1;
constexpr int kExitUsage = 2;

/// One row of the table.
struct Row {
  std::string name;
  std::vector<Answer> answers;
  double seconds = 0;
  std::string missing;  ///< why there is nothing to compare
};

// Everything the implementations share.
struct Subject {
  std::span<const uint8_t> file;
  StreamImage& image;
  std::vector<Request> requests;
};

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Row timed(const std::string& name, const std::function<std::vector<Answer>()>& run) {
  const double begin = now();
  Row row{name, run(), 0, {}};
  row.seconds = now() - begin;
  return row;
}

std::vector<Answer> run_model(const Subject& subject, ReferenceMode mode) {
  Oracle oracle(*subject.image.golden(), mode);
  std::vector<Answer> answers;
  for (const Request& request : subject.requests) {
    answers.push_back(oracle.evaluate(request).answer);
  }
  return answers;
}

// The path that decodes views: rectangles of one block.
Answer rectangle(const Decoder& decoder, const Request& r) {
  Answer answer;
  answer.last = r.last;
  const unsigned b = decoder.header().block_size();
  const Plane plane = r.plane == kRgb ? Plane::kY : static_cast<Plane>(r.plane);
  const PlaneSize size = decoder.plane_size(plane);
  const Rect rect{r.bx * b, r.by * b, std::min(b, size.width - std::min(size.width, r.bx * b)),
                  std::min(b, size.height - std::min(size.height, r.by * b))};
  const auto stop = static_cast<int>(r.stop_level);
  const auto store = [&](size_t lane, uint32_t i, int32_t value) {
    const size_t at = size_t{i / rect.width} * b + i % rect.width;
    answer.samples[lane * b * b + at] = static_cast<int16_t>(value);
  };
  if (r.plane == kRgb) {
    const auto rgb = decoder.decode_rgb({r.row, r.col}, rect, stop);
    answer.status = rgb ? 0 : static_cast<uint8_t>(rgb.error().code);
    for (uint32_t i = 0; rgb && i < rgb->samples.size(); ++i) store(i % 3, i / 3, rgb->samples[i]);
  } else {
    const auto samples = decoder.decode_rect({r.row, r.col}, plane, rect, stop);
    answer.status = samples ? 0 : static_cast<uint8_t>(samples.error().code);
    for (uint32_t i = 0; samples && i < samples->size(); ++i) store(0, i, (*samples)[i]);
  }
  return answer;
}

std::vector<Answer> run_rectangles(const Subject& subject) {
  OpenOptions options;
  options.check_sections = false;
  const auto decoder = Decoder::open(subject.file, options);
  std::vector<Answer> answers;
  for (const Request& request : subject.requests) answers.push_back(rectangle(*decoder, request));
  return answers;
}

std::vector<Answer> run_tlm(TlmPlatform& platform, const Subject& subject) {
  std::vector<Answer> answers;
  platform.scoreboard().log_answers(&answers);
  platform.run(subject.image.memory(), subject.image.load_error(),
               listed_requests(subject.requests), subject.image.oracle());
  return answers;
}

std::vector<Answer> run_rtl(Bench& bench, const UnitMaker& maker, const Subject& subject) {
  std::vector<Answer> answers;
  bench.attach(maker.make(maker.parameters));
  bench.compare_answers_only();
  bench.scoreboard().log_answers(&answers);
  subject.image.load_into(bench);
  if (!bench.findings().first()) {
    bench.run(listed_requests(subject.requests), subject.image.oracle(), Conditions{}, 0);
  }
  bench.scoreboard().log_answers(nullptr);
  return answers;
}

// Samples outside the plane have no meaning (STR-6): made 0.
void mask(Row& row, const Subject& subject) {
  const Geometry& geometry = subject.image.golden()->geometry();
  const unsigned b = geometry.block_size();
  for (size_t i = 0; i < row.answers.size() && i < subject.requests.size(); ++i) {
    const Request& r = subject.requests[i];
    const Plane plane = r.plane == kRgb ? Plane::kY : static_cast<Plane>(r.plane);
    const PlaneShape& shape = geometry.plane(plane);
    for (size_t s = 0; s < kLanes * b * b; ++s) {
      const auto x = static_cast<uint32_t>(r.bx * b + s % b);
      const auto y = static_cast<uint32_t>(r.by * b + s / b % b);
      if (x >= shape.width || y >= shape.height) row.answers[i].samples[s] = 0;
    }
  }
}

bool same(const Answer& a, const Answer& b) {
  return a.status == b.status && a.last == b.last && a.samples == b.samples;
}

// Prints one row; whether it equals the first.
bool print_row(const Row& row, const Row& first, const Subject& subject) {
  if (!row.missing.empty()) {
    fmt::print("{:<28} {}\n", row.name, row.missing);
    return true;
  }
  uint64_t different = 0;
  std::string where;
  uint32_t crc = 0;
  for (size_t i = 0; i < row.answers.size() && i < subject.requests.size(); ++i) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(row.answers[i].samples.data());
    crc = crc32c({bytes, sizeof(row.answers[i].samples)}, crc);
    crc = crc32c({&row.answers[i].status, 1}, crc);
    if (same(row.answers[i], first.answers[i])) continue;
    if (different++ == 0) where = to_string(subject.requests[i]);
  }
  const bool complete = row.answers.size() == subject.requests.size();
  fmt::print("{:<28} {:>8} {:>10} {:>10.3f} {:08X} {}\n", row.name, row.answers.size(), different,
             row.seconds, crc, complete ? where : where + " incomplete");
  return different == 0 && complete;
}

int run(int argc, char** argv) {
  CLI::App app{"Runs every implementation on the same blocks"};
  std::string path;
  uint64_t blocks = 2000;
  uint64_t seed = 0;
  app.add_option("file", path, "The stream")->required();
  app.add_option("--blocks", blocks, "How many requests of all kinds")->capture_default_str();
  app.add_option("--seed", seed, "Of the requests")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const auto file = io::MappedFile::open(path);
  if (!file) {
    fmt::print(stderr, "crosscheck: {}\n", file.error().message);
    return kExitUsage;
  }
  const auto header = Decoder::open(file->bytes());
  if (!header) {
    fmt::print(stderr, "crosscheck: {}: {}\n", path, to_string(header.error()));
    return kExitUsage;
  }
  const std::string replay = fmt::format(
      "seed {}, replay: ./run crosscheck {} --seed {} --blocks {}\n", seed, path, seed, blocks);
  fmt::print(stderr, "{}", replay);
  const UnitParameters any{header->header().block_log2, 12, 16, 16};
  StreamImage image(file->bytes(), any);
  if (image.golden() == nullptr) {
    fmt::print(stderr, "crosscheck: {} is beyond the unit's limits\n", path);
    return kExitUsage;
  }
  Subject subject{file->bytes(), image, {}};
  const auto source =
      mixed_requests(image.golden()->geometry(), image.golden()->header(), blocks, seed, 20);
  while (const auto request = source()) subject.requests.push_back(*request);

  Bench bench;
  TlmPlatform platform("platform", any);
  std::vector<Row> rows;
  rows.push_back(
      timed("model, block by block", [&] { return run_model(subject, ReferenceMode::kOnDemand); }));
  rows.push_back(
      timed("model, references held", [&] { return run_model(subject, ReferenceMode::kSparse); }));
  rows.push_back(timed("model, rectangles", [&] { return run_rectangles(subject); }));
  rows.push_back(timed("TLM", [&] { return run_tlm(platform, subject); }));
  const auto makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, header->header().block_log2, header->header().depth);
  if (maker != nullptr) {
    rows.push_back(timed("RTL, Verilated", [&] { return run_rtl(bench, *maker, subject); }));
  } else {
    rows.push_back({"RTL, Verilated", {}, 0, "skipped: not in this build"});
  }
  fmt::print("{:<28} {:>8} {:>10} {:>10} {:>8} first difference\n", "implementation", "blocks",
             "different", "seconds", "crc");
  bool equal = true;
  for (Row& row : rows) {
    mask(row, subject);
    equal &= print_row(row, rows.front(), subject);
  }
  std::fflush(stdout);
  fmt::print(stderr, "{}", replay);
  return equal ? 0 : kExitDifferent;
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::run(argc, argv); }
