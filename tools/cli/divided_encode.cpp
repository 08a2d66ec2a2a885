#include "cli/divided_encode.hpp"

#include <malloc.h>

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/measure.hpp>
#include <hmlfc/read_sink.hpp>

#include "cli/encode_forecast.hpp"
#include "cli/for_each_view.hpp"
#include "io/files.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::cli {
namespace {

// Pages of a stream that may stay in memory after they were read.
constexpr uint64_t kKeptBytes = 16u << 20;

// "512M", "2G", "100K" or a number of bytes.
std::optional<uint64_t> parse_size(std::string_view text) {
  uint64_t unit = 1;
  if (!text.empty()) {
    const size_t kind = std::string_view("KMG").find(text.back());
    if (kind != std::string_view::npos) {
      unit = uint64_t{1} << (10 * (kind + 1));
      text.remove_suffix(1);
    }
  }
  const auto number = parse_integer<uint64_t>(text);
  if (!number || *number == 0 || *number > (uint64_t{1} << 62) / unit) return std::nullopt;
  return *number * unit;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

// Forgets the pages of a stream now and then while it is read.
class PageLimit final : public ReadSink {
 public:
  explicit PageLimit(const MappedFile& file) : file_(file) {}

  void on_read(uint64_t, uint64_t bytes) override {
    if ((read_ += bytes) < kKeptBytes) return;
    read_ = 0;
    file_.drop_pages();
  }

 private:
  const MappedFile& file_;
  std::atomic<uint64_t> read_ = 0;
};

// The error of the stream in views [row0, row1) x [col0, col1).
ErrorSums measure_part(const std::filesystem::path& stream, const ViewSource& views,
                       const ViewPos& first, const io::GridShape& shape, int threads) {
  const StreamFile file(stream, {.check_sections = false});
  std::mutex mutex;
  ErrorSums sums;
  for_each_view(shape, threads, {}, [&](ViewPos at) {
    const ViewPos view{first.row + at.row, first.col + at.col};
    const RgbImage decoded = file.value(file.decoder().decode_view(view));
    const ErrorSums error = measure(views.view(view), decoded);
    const std::scoped_lock lock(mutex);
    sums.add(error);
  });
  return sums;
}

ErrorSums measure_in_parts(const std::filesystem::path& stream, const ViewSource& views,
                           const DividedEncoder& encoder) {
  terminal::ProgressBar progress("Checking", "parts");
  const PartGrid& parts = encoder.parts();
  ErrorSums sums;
  uint32_t row = 0;
  size_t done = 0;
  for (const uint32_t row_end : parts.row_ends) {
    uint32_t col = 0;
    for (const uint32_t col_end : parts.col_ends) {
      sums.add(measure_part(stream, views, {row, col}, {row_end - row, col_end - col},
                            encoder.threads()));
      progress.callback()(++done, parts.count());
      col = col_end;
    }
    row = row_end;
  }
  return sums;
}

io::StreamReport report_in_bounds(const std::filesystem::path& stream) {
  const auto mapped = value_or_throw(io::map_file(stream), ExitCode::kInput);
  PageLimit pages(mapped);
  const auto decoder =
      Decoder::open(mapped.bytes(), {.check_sections = false, .limits = {}, .reads = &pages});
  if (!decoder) throw stream_failure(stream, decoder.error());
  const auto statistics = decoder->statistics();
  if (!statistics) throw stream_failure(stream, statistics.error());
  return {mapped.bytes().size(), decoder->header(), *statistics};
}

void write_file(const EncodeOptions& options, const DividedInput& input,
                const DividedEncoder& encoder) {
  auto file = value_or_throw(io::AtomicFile::create(options.target), ExitCode::kOutput);
  const std::string rig = input.rig ? rig_section(encoder.header(), *input.rig) : "";
  encoder.write({reinterpret_cast<const uint8_t*>(rig.data()), rig.size()},
                [&](std::span<const uint8_t> bytes) {
                  value_or_throw(file.write(bytes), ExitCode::kOutput);
                });
  value_or_throw(file.commit(), ExitCode::kOutput);
}

}  // namespace

void add_division_options(CLI::App& app, EncodeOptions& options) {
  add_value(app, "--memory", "SIZE", "Hold at most this many bytes; the result is the same",
            "a number of bytes, with K, M or G for their multiples, such as 512M",
            [&options](const std::string& text) {
              options.memory = parse_size(text);
              return options.memory.has_value();
            });
  app.add_flag("--plan", options.plan, "Write a plan for several machines; see below");
  add_numbers<2>(app, "--shard", "I/N", '/', "I/N with I in [1, N], such as 1/8",
                 "Encode part I of N of the plan INPUT",
                 [&options](const std::array<uint32_t, 2>& numbers) {
                   const auto [index, count] = numbers;
                   options.shard = ShardNumber{index, count};
                   return index >= 1 && index <= count && count <= kMostShards;
                 });
  app.add_option("--assemble", options.shards, "Put the shards of the plan INPUT together")
      ->type_name("SHARD...");
}

void check_division(const EncodeOptions& options) {
  const bool planned = options.shard || !options.shards.empty();
  const int kinds =
      (options.plan ? 1 : 0) + (options.shard ? 1 : 0) + (options.shards.empty() ? 0 : 1);
  const bool target =
      options.coding.target_psnr || options.coding.target_bpp || options.coding.max_bytes;
  if (kinds > 1) {
    throw Failure(ExitCode::kUsage,
                  "hmlfc encode: --plan, --shard and --assemble exclude each other");
  }
  if (target && (options.memory || kinds > 0)) {
    throw Failure(ExitCode::kUsage,
                  "hmlfc encode: a target needs the whole light field in memory, time and again; "
                  "find its quality on a part (--views), then give --quality");
  }
  if (!planned) return;
  static const std::vector<std::string> kOwn{"--shard",   "--assemble", "--output",
                                             "--threads", "--json",     "--force"};
  for (const CLI::Option* option : options.app->get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "INPUT" || std::ranges::count(kOwn, name) > 0) continue;
    throw Failure(ExitCode::kUsage,
                  fmt::format("hmlfc encode: {} is settled by the plan; give it to --plan", name));
  }
}

StorageFile::StorageFile(const std::filesystem::path& output)
    : file_(value_or_throw(io::ScratchFile::create(folder_of(output)), ExitCode::kOutput)) {}

uint64_t StorageFile::append(std::span<const uint8_t> bytes) {
  return value_or_throw(file_.append(bytes), ExitCode::kOutput);
}

void StorageFile::read(uint64_t offset, std::span<uint8_t> out) const {
  value_or_throw(file_.read(offset, out), ExitCode::kOutput);
}

DividedInput open_input(const EncodeOptions& options) {
  // Large blocks go back to the system at once, so that memory is what is in use; planes of usual
  // views do not: half of the time would go to fetching them again.
  ::mallopt(M_MMAP_THRESHOLD, 4 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 4 << 20);
  DividedInput input;
  input.list = listed_views(options);
  input.views = ViewSource::of_files(input.list);
  input.rig = rig_for(options.rig, options.coding.params.profile, input.list, input.views->shape());
  return input;
}

DividedEncoder divided_encoder(const EncodeOptions& options, const DividedInput& input,
                               const EncodeParams& params, const Division& division,
                               StorageFile& storage) {
  auto encoder = DividedEncoder::create(*input.views, params, division, storage);
  if (!encoder) throw encode_failure(options.input, encoder.error());
  return std::move(*encoder);
}

void encode_parts(DividedEncoder& encoder, const EncodeOptions& options, size_t first,
                  size_t last) {
  terminal::ProgressBar progress("Encoding", "images");
  const Clock clock;
  for (size_t part = first; part < last; ++part) {
    const auto coded = encoder.encode_part(part, progress.callback());
    if (!coded) throw encode_failure(options.input, coded.error());
    note_forecast(part + 1 - first, last - first, clock.wall_seconds(), "parts");
  }
}

EncodeOutcome finish_encoding(const EncodeOptions& options, const DividedInput& input,
                              const DividedEncoder& encoder, const Clock& clock) {
  EncodeOutcome outcome;
  outcome.params = encoder.params();
  write_file(options, input, encoder);
  outcome.wall_seconds = clock.wall_seconds();
  outcome.cpu_seconds = clock.cpu_seconds();
  const ErrorSums measured = measure_in_parts(options.target, *input.views, encoder);
  check_promise(encoder.error(), measured, options.output.string());
  outcome.quality = quality_of(measured, input.views->shape());
  outcome.stream = report_in_bounds(options.target);
  outcome.rig = rig_line(StreamFile(options.target, {.check_sections = false}));
  return outcome;
}

EncodeOutcome encode_in_parts(const EncodeOptions& options) {
  const DividedInput input = open_input(options);
  StorageFile storage(options.target);
  const Clock clock;
  DividedEncoder encoder = divided_encoder(options, input, options.coding.params,
                                           {.memory = options.memory, .parts = {}}, storage);
  encode_parts(encoder, options, 0, encoder.parts().count());
  return finish_encoding(options, input, encoder, clock);
}

}  // namespace hmlfc::cli
