#include "cli/encode_shards.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <hmlfc/version.hpp>

#include "bits/crc32c.hpp"
#include "cli/divided_encode.hpp"
#include "cli/encode_forecast.hpp"
#include "cli/encode_plan.hpp"
#include "io/files.hpp"
#include "io/json_text.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::cli {
namespace {

namespace fs = std::filesystem;

constexpr io::JsonLimits kShardLimits{"a shard", size_t{1} << 26, 4};

// The parts [first, second) of shard `shard`.
std::pair<size_t, size_t> parts_of(const ShardNumber& shard, size_t parts) {
  return {(shard.index - 1) * parts / shard.count, shard.index * parts / shard.count};
}

[[noreturn]] void refuse_shard(const fs::path& file, const std::string& what) {
  throw Failure(ExitCode::kInput, file.string() + ": " + what);
}

// The plan, ready to be worked on with the options given here.
struct Job {
  EncodePlan plan;
  DividedInput input;

  explicit Job(const EncodeOptions& options) : plan(read_plan(options.input)) {
    plan.options.output = options.output;
    plan.options.target = options.target;
    plan.options.json = options.json;
    plan.params.threads = options.coding.params.threads;
    input = open_input(plan.options);
  }

  DividedEncoder encoder(StorageFile& storage) const {
    return divided_encoder(plan.options, input, plan.params, {.memory = {}, .parts = plan.parts},
                           storage);
  }
};

Json error_json(const ErrorSums& error) {
  return {error.rgb_squares, error.y_squares, error.max_abs};
}

ErrorSums error_of(const Json& json) {
  return {io::integer_at<uint64_t>(json, 0U), io::integer_at<uint64_t>(json, 1U),
          io::integer_at<uint32_t>(json, 2U)};
}

// The sum of a part's bytes.
Json sum_json(const DividedEncoder& encoder, size_t part) {
  uint64_t size = 0;
  uint32_t crc = 0;
  encoder.save_part(part, [&](std::span<const uint8_t> bytes) {
    crc = crc32c(bytes, crc);
    size += bytes.size();
  });
  return {{"part", part}, {"bytes", size}, {"crc", crc}};
}

// A shard that was read: intact, of this version.
struct Shard {
  fs::path file;
  MappedFile mapped;
  Json head;
  size_t data = 0;  // where the first part begins

  explicit Shard(const fs::path& path)
      : file(path), mapped(value_or_throw(io::map_file(path), ExitCode::kInput)) {
    const auto bytes = mapped.bytes();
    if (!std::ranges::equal(bytes.first(std::min(bytes.size(), kShardSign.size())), kShardSign)) {
      refuse_shard(file, "not a shard; `hmlfc encode PLAN -o FILE --shard I/N` writes one");
    }
    const auto text = bytes.subspan(kShardSign.size());
    const auto end = std::ranges::find(text, uint8_t{'\n'});
    const auto length = static_cast<size_t>(end - text.begin());
    head = io::parse_json<Json>(text.first(length), kShardLimits).value_or(Json());
    if (!head.is_object()) damaged();
    data = kShardSign.size() + length + 1;
  }

  [[noreturn]] void damaged() const { refuse_shard(file, "a damaged shard; run it again"); }

  // Fails unless it was made for `plan` by this version.
  void check(const EncodePlan& plan) const {
    const Json version = head.value("version", Json(""));
    if (version != library_version()) {
      refuse_shard(file, fmt::format("a shard of version {}, and this is {}; run it again",
                                     io::shown_json(version), library_version()));
    }
    if (head.value("plan", Json()) != plan.id) refuse_shard(file, "a shard of another plan");
  }

  // I and N of --shard I/N.
  ShardNumber number() const {
    const ShardNumber number{io::integer_at<uint32_t>(head, "shard"),
                             io::integer_at<uint32_t>(head, "of")};
    if (number.index < 1 || number.index > number.count || number.count > kMostShards) damaged();
    return number;
  }
};

// Hands the parts of `shard` to `encoder`, and adds them to `there`.
void load_shard(const Shard& shard, DividedEncoder& encoder, std::set<size_t>& there) {
  size_t at = shard.data;
  const auto bytes = shard.mapped.bytes();
  for (const Json& entry : shard.head.at("parts")) {
    const auto part = io::integer_at<size_t>(entry, "part");
    const auto size = io::integer_at<uint64_t>(entry, "bytes");
    if (at > bytes.size() || size > bytes.size() - at || part >= encoder.parts().count()) {
      shard.damaged();
    }
    const auto data = bytes.subspan(at, static_cast<size_t>(size));
    at += data.size();
    if (crc32c(data) != io::integer_at<uint32_t>(entry, "crc")) shard.damaged();
    if (!there.insert(part).second) {
      refuse_shard(shard.file, "its parts are also in a shard before; name each shard once");
    }
    if (!encoder.load_part(part, data, error_of(entry.at("error")))) shard.damaged();
  }
  if (at != bytes.size()) shard.damaged();
}

// "2/8, 5/8": the shards of `count` whose parts are not all there.
std::string missing_shards(const std::set<size_t>& there, size_t parts, uint32_t count) {
  std::string names;
  for (uint32_t index = 1; index <= count; ++index) {
    const auto [first, last] = parts_of({index, count}, parts);
    for (size_t part = first; part < last; ++part) {
      if (there.contains(part)) continue;
      names += fmt::format("{}{}/{}", names.empty() ? "" : ", ", index, count);
      break;
    }
  }
  return names;
}

}  // namespace

ExitCode write_plan(const EncodeOptions& options) {
  const DividedInput input = open_input(options);
  StorageFile storage(options.target);
  const DividedEncoder encoder = divided_encoder(options, input, options.coding.params,
                                                 {.memory = options.memory, .parts = {}}, storage);
  const std::string text = plan_text(options, encoder.params(), encoder.parts(), input.list);
  value_or_throw(
      io::write_file(options.target, {reinterpret_cast<const uint8_t*>(text.data()), text.size()}),
      ExitCode::kOutput);
  const size_t parts = encoder.parts().count();
  print_result(options.json, {{"parts", parts}},
               fmt::format("{}: {} part{}, for at most as many shards\n", options.output.string(),
                           parts, parts == 1 ? "" : "s"));
  return ExitCode::kDone;
}

ExitCode encode_shard(const EncodeOptions& options) {
  const Job job(options);
  StorageFile storage(options.target);
  const Clock clock;
  DividedEncoder encoder = job.encoder(storage);
  const size_t parts = encoder.parts().count();
  const auto [first, last] = parts_of(*options.shard, parts);
  Json head{{"version", library_version()},
            {"plan", job.plan.id},
            {"shard", options.shard->index},
            {"of", options.shard->count},
            {"parts", Json::array()}};
  const Clock loop;
  for (size_t part = first; part < last; ++part) {
    const ErrorSums before = encoder.error();
    encode_parts(encoder, options, part, part + 1);
    note_forecast(part + 1 - first, last - first, loop.wall_seconds(), "parts");
    const ErrorSums& error = encoder.error();
    Json entry = sum_json(encoder, part);
    entry["error"] = error_json({error.rgb_squares - before.rgb_squares,
                                 error.y_squares - before.y_squares, error.max_abs});
    head["parts"].push_back(std::move(entry));
  }
  auto file = value_or_throw(io::AtomicFile::create(options.target), ExitCode::kOutput);
  const auto write = [&](std::span<const uint8_t> bytes) {
    value_or_throw(file.write(bytes), ExitCode::kOutput);
  };
  const std::string text = std::string(kShardSign) + head.dump() + "\n";
  write({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  for (size_t part = first; part < last; ++part) encoder.save_part(part, write);
  value_or_throw(file.commit(), ExitCode::kOutput);
  const double seconds = clock.cpu_seconds();
  print_result(options.json, {{"parts", last - first}, {"of", parts}, {"cpu_seconds", seconds}},
               fmt::format("{}: {} of {} parts, CPU {:.2f} s\n", options.output.string(),
                           last - first, parts, seconds));
  return ExitCode::kDone;
}

EncodeOutcome assemble_shards(const EncodeOptions& options) {
  const Job job(options);
  StorageFile storage(options.target);
  const Clock clock;
  DividedEncoder encoder = job.encoder(storage);
  std::set<size_t> there;
  uint32_t count = 1;
  for (const fs::path& file : options.shards) {
    const Shard shard(file);
    shard.check(job.plan);
    try {
      count = std::max(count, shard.number().count);
      load_shard(shard, encoder, there);
    } catch (const Json::exception&) {
      shard.damaged();
    }
  }
  const size_t parts = encoder.parts().count();
  if (there.size() < parts) {
    refuse_shard(options.input, fmt::format("shards are missing: {}; run them, then assemble again",
                                            missing_shards(there, parts, count)));
  }
  return finish_encoding(job.plan.options, job.input, encoder, clock);
}

}  // namespace hmlfc::cli
