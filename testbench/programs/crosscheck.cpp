// crosscheck: every implementation that this build has, on the same blocks.
#include <functional>

#include "bits/crc32c.hpp"
#include "gpu/gpu_answers.hpp"
#include "gpu/stream_check.hpp"
#include "programs/commands.hpp"
#include "stimulus/sequences.hpp"
#include "systemc/stream_image.hpp"
#include "tlm/tlm_platform.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kNameWidth = 28;  // of the table's first column

/// One row of the table.
struct Row {
  std::string name;
  std::vector<Answer> answers = {};
  double seconds = 0;
  std::string missing = {};   ///< why there is nothing to compare
  bool broken = false;        ///< it should have had something
  uint64_t levels = 0;        ///< blocks of a level whose stages were compared with the model's
  std::string in_stage = {};  ///< the first stage that differs, with its place
};

// Everything the implementations share.
struct Subject {
  StreamImage& image;
  std::vector<Request> requests;
};

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Row timed(const std::string& name, const std::function<std::vector<Answer>()>& run) {
  const double begin = now();
  Row row{.name = name, .answers = run()};
  row.seconds = now() - begin;
  return row;
}

std::vector<Answer> run_model(const Subject& subject, const HeldReferences* held) {
  Oracle oracle(*subject.image.golden(), held);
  std::vector<Answer> answers;
  for (const Request& request : subject.requests) {
    answers.push_back(oracle.evaluate(request).answer);
  }
  return answers;
}

std::vector<Answer> run_tlm(TlmPlatform& platform, const Subject& subject) {
  std::vector<Answer> answers;
  platform.scoreboard().log_answers(&answers);
  platform.run(subject.image.memory(), subject.image.load_error(),
               listed_requests(subject.requests), subject.image.oracle());
  return answers;
}

// One run in a fresh unit; the finding that ended it, if any.
std::string run_unit(Bench& bench, const UnitMaker& maker, const Subject& subject, bool stages,
                     Row& row) {
  row.answers.clear();
  bench.attach(maker.make(maker.parameters, nullptr));
  if (!stages) bench.compare_answers_only();
  bench.scoreboard().log_answers(&row.answers);
  subject.image.load_into(bench);
  if (!bench.findings().first()) {
    bench.run(listed_requests(subject.requests), subject.image.oracle(), Conditions{}, 0);
  }
  bench.scoreboard().log_answers(nullptr);
  row.levels = bench.scoreboard().counts().records_compared;
  const auto finding = bench.findings().first();
  return finding ? to_string(*finding) : std::string();
}

// A run that compares stages ends at the first difference; then another shows all answers.
Row run_rtl(Bench& bench, const UnitMaker& maker, const Subject& subject) {
  Row row{.name = "RTL, Verilated"};
  const double begin = now();
  row.in_stage = run_unit(bench, maker, subject, true, row);
  if (!row.in_stage.empty()) run_unit(bench, maker, subject, false, row);
  row.seconds = now() - begin;
  return row;
}

// The GPU decoder on the device that `name` chooses; the reason where it cannot run.
Row run_gpu(const std::string& name, const Subject& subject) {
  gpu::DeviceOptions options;
  options.device = name;
  auto device = gpu::Device::open(options);
  if (!device) return {.name = "GPU", .missing = "skipped: " + device.error().message};
  Row row{.name = "GPU, " + device->info().name.substr(0, kNameWidth - 5)};
  row.broken = true;
  const GoldenStream& stream = *subject.image.golden();
  auto decoder = gpu::GpuDecoder::open(*device, stream.view());
  if (!decoder) {
    row.missing = "failed: " + decoder.error().message;
    return row;
  }
  const double begin = now();
  auto answers = gpu::gpu_answers(*decoder, stream.geometry().block_size(), subject.requests);
  row.seconds = now() - begin;
  const auto stages = gpu::check_stream(*decoder, stream, listed_requests(subject.requests), {});
  if (!answers || !stages) {
    row.missing = "failed: " + (answers ? stages.error() : answers.error()).message;
    return row;
  }
  row.broken = false;
  row.answers = std::move(*answers);
  row.levels = stages->counts.levels;
  if (stages->mismatch) row.in_stage = to_string(*stages->mismatch);
  return row;
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

// Prints one row; whether it equals the first, at all stages that were compared.
bool print_row(const Row& row, const Row& first, const Subject& subject) {
  if (!row.missing.empty()) {
    fmt::print("{:<{}} {}\n", row.name, kNameWidth, row.missing);
    return !row.broken;
  }
  uint64_t different = 0;
  std::string where = row.in_stage;
  uint32_t crc = 0;
  for (size_t i = 0; i < row.answers.size() && i < subject.requests.size(); ++i) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(row.answers[i].samples.data());
    crc = crc32c({bytes, sizeof(row.answers[i].samples)}, crc);
    crc = crc32c({&row.answers[i].status, 1}, crc);
    if (same(row.answers[i], first.answers[i])) continue;
    if (different++ == 0 && where.empty()) where = to_string(subject.requests[i]);
  }
  const bool complete = row.answers.size() == subject.requests.size();
  fmt::print("{:<{}} {:>8} {:>10} {:>8} {:>10.3f} {:08X} {}\n", row.name, kNameWidth,
             row.answers.size(), different, row.levels == 0 ? "-" : std::to_string(row.levels),
             row.seconds, crc, complete ? where : where + " incomplete");
  return different == 0 && complete && row.in_stage.empty();
}

void print_head() {
  fmt::print("{:<{}} {:>8} {:>10} {:>8} {:>10} {:>8} first difference\n", "implementation",
             kNameWidth, "blocks", "different", "stages", "seconds", "crc");
}

struct Options {
  std::string file;
  uint64_t blocks = 2000;
  uint64_t seed = 0;
  std::string device;
};

int compare(const Options& o, std::span<const uint8_t> file) {
  const auto header = Decoder::open(file);
  if (!header) throw Stop{o.file + ": " + to_string(header.error())};
  const UnitParameters any{header->header().block_log2, 12, 16, 16};
  StreamImage image(file, any);
  if (image.golden() == nullptr) throw Stop{o.file + " is beyond the unit's limits"};
  Subject subject{image, {}};
  const auto source =
      mixed_requests(image.golden()->geometry(), image.golden()->header(), o.blocks, o.seed, 20);
  while (const auto request = source()) subject.requests.push_back(*request);

  Bench bench;
  TlmPlatform platform("platform", any);
  std::vector<Row> rows;
  rows.push_back(timed("model, block by block", [&] { return run_model(subject, nullptr); }));
  rows.push_back(timed("model, references held", [&] {
    return run_model(subject, &subject.image.golden()->fast_references());
  }));
  rows.push_back(timed("TLM", [&] { return run_tlm(platform, subject); }));
  const auto makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, header->header().block_log2, header->header().depth);
  if (maker != nullptr) {
    rows.push_back(run_rtl(bench, *maker, subject));
  } else {
    rows.push_back({.name = "RTL, Verilated", .missing = "skipped: not in this build"});
  }
  rows.push_back(run_gpu(o.device, subject));
  print_head();
  bool equal = true;
  for (Row& row : rows) {
    mask(row, subject);
    equal &= print_row(row, rows.front(), subject);
  }
  return equal ? 0 : kExitDifferent;
}

int run(const Options& o) {
  const MappedFile file = read_file(o.file);
  const std::string replay =
      fmt::format("./run crosscheck {} --seed {} --blocks {}", o.file, o.seed, o.blocks);
  return with_replay(o.seed, replay, [&] { return compare(o, file.bytes()); });
}

}  // namespace

Command add_crosscheck(CLI::App& app) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  app.add_option("file", o.file, "The stream")->required();
  app.add_option("--blocks", o.blocks, "How many requests of all kinds")->capture_default_str();
  app.add_option("--seed", o.seed, "Of the requests")->capture_default_str();
  app.add_option("--device", o.device, "Number or part of the name of a Vulkan device");
  return [options] { return run(*options); };
}

}  // namespace hmlfc::tb
