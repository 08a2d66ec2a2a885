#include "vector_check.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <vector>

#include "io/files.hpp"
#include "request_check.hpp"
#include "syntax/geometry.hpp"
#include "vectors/digest.hpp"
#include "vectors/expected.hpp"
#include "vectors/json.hpp"

namespace hmlfc::vectors {
namespace {

// Blocks of one vector that are decoded one by one, at most.
constexpr uint64_t kMaxBlocks = 1500;

std::string sum_of(const std::string& text) {
  return sha256({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

bool same_error(const Error& a, const Error& b) {
  return a.code == b.code && a.section == b.section && a.offset == b.offset;
}

bool is_expected(const Expectation& expect, const Error& error) {
  return error.code == expect.error && error.offset == expect.offset;
}

// The blocks that the trace in `file` was made of.
std::vector<BlockAddress> traced_blocks(const std::filesystem::path& file) {
  std::vector<BlockAddress> blocks;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const Json json = Json::parse(line);
    if (json.at("record") != "block") continue;
    const auto name = json.at("plane").get<std::string>();
    const auto plane = std::find_if(kPlanes.begin(), kPlanes.end(),
                                    [&](Plane p) { return plane_name(p) == name; });
    blocks.push_back({{json["view"][0], json["view"][1]},
                      plane == kPlanes.end() ? Plane::kY : *plane,
                      json["block"][0],
                      json["block"][1]});
  }
  return blocks;
}

// One stream that opens.
class StreamCheck {
 public:
  StreamCheck(const std::filesystem::path& folder, const Vector& vector, const Decoder& decoder)
      : folder_(folder), vector_(vector), decoder_(decoder), header_(decoder.header()) {}

  void run() {
    check_expected_blocks();
    check_views();
    if (vector_.trace) check_trace(*vector_.trace);
    check_requests(decoder_);
    for (int level = 0; level <= header_.tree_height; ++level) check_all_at_once(level);
    run_planes();
  }

  // The part that depends on which reference images are decoded already.
  void run_planes() {
    for (const Plane plane : kPlanes) check_plane(plane);
  }

 private:
  void check_expected_blocks() {
    for (const BlockAddress& block : vector_.expect.blocks) {
      for (const ReferenceMode mode : {ReferenceMode::kOnDemand, ReferenceMode::kSparse}) {
        const auto samples = decoder_.decode_block(block, {.references = mode});
        demand(!samples.has_value(), "a block decodes that must not");
        demand(is_expected(vector_.expect, samples.error()), to_string(samples.error()));
      }
    }
  }

  void check_views() {
    const ExpectedViews views = expected_views(decoder_);
    demand(vector_.blocks && sum_of(views.blocks) == vector_.blocks->sha256, "blocks differ");
    demand(views.raw.has_value() == vector_.output.has_value(), "views decode, or do not");
    if (!vector_.output) return;
    const ViewSum& output = *vector_.output;
    demand(sha256(*views.raw) == output.sha256, "views differ");
    demand(header_.rows == output.rows && header_.cols == output.cols &&
               header_.width == output.width && header_.height == output.height &&
               header_.depth == output.depth && header_.chroma_format == output.chroma,
           "the shape differs");
  }

  void check_trace(const TraceFiles& files) {
    const TraceText text = trace_text(decoder_, traced_blocks(folder_ / files.lines.file));
    demand(sum_of(text.lines) == files.lines.sha256, "the trace differs");
    demand(sum_of(text.hex) == files.hex.sha256, "the hexadecimal trace differs");
  }

  // Views that are decoded together are those that are decoded one by one, or fail as one does.
  void check_all_at_once(int level) {
    std::map<std::pair<uint32_t, uint32_t>, RgbImage> views;
    const auto put = [&](ViewPos view, RgbImage&& image) {
      const bool first = views.emplace(std::pair(view.row, view.col), std::move(image)).second;
      demand(first, "decode_all gives a view twice");
    };
    const auto decoded = decoder_.decode_all(put, {.stop_level = level, .threads = 1});
    bool all = true;
    bool named = false;
    for (const auto& [row, col] : ImageRange{0, header_.rows, 0, header_.cols}) {
      const auto view = decoder_.decode_view({row, col}, level);
      all = all && view.has_value();
      named = named || (!decoded && !view && same_error(decoded.error(), view.error()));
      if (!decoded || !view) continue;
      demand(picture_bytes(views[{row, col}]) == picture_bytes(*view),
             "decode_all gives another view");
    }
    demand(decoded ? all : named, "decode_all or a view of it fails, or not for the same reason");
  }

  void check_plane(Plane plane) {
    const PlaneSize size = decoder_.plane_size(plane);
    for (const auto& [row, col] : ImageRange{0, header_.rows, 0, header_.cols}) {
      std::optional<std::vector<int16_t>> above;
      for (int level = header_.tree_height; level >= 0; --level) {
        above = check_level({row, col}, plane, size, level, std::move(above));
      }
    }
  }

  // The samples of a plane at one stop level, if they decode; `above` are those of the next.
  std::optional<std::vector<int16_t>> check_level(ViewPos view, Plane plane, PlaneSize size,
                                                  int level,
                                                  std::optional<std::vector<int16_t>> above) {
    const auto samples = decoder_.decode_plane(view, plane, level);
    demand(samples || level > 0 || !vector_.output, "a plane of a view that decodes does not");
    const uint32_t side = header_.block_size();
    if (above && samples && size.width > side) {
      const Rect rest{side, 0, size.width - side, std::min(side, size.height)};
      auto part = part_of(*above, size.width, rest);
      demand(decoder_.refine_rect(view, plane, rest, level, part) &&
                 part == part_of(*samples, size.width, rest),
             "a level put on a part of the one above it differs");
    }
    if (above) {
      const Rect whole{0, 0, size.width, size.height};
      const auto refined = decoder_.refine_rect(view, plane, whole, level, *above);
      demand(refined.has_value() == samples.has_value() && (!refined || *above == *samples),
             "a level put on the one above it differs");
    }
    if (!samples) return std::nullopt;
    for (uint32_t y = 0; y < size.height; y += side) {
      for (uint32_t x = 0; x < size.width; x += side) {
        if (blocks_++ >= kMaxBlocks) return *samples;
        const BlockAddress block{view, plane, x / side, y / side};
        check_block(block, level, size, *samples, ReferenceMode::kOnDemand);
        check_block(block, level, size, *samples, ReferenceMode::kSparse);
      }
    }
    return *samples;
  }

  void check_block(const BlockAddress& block, int level, PlaneSize size,
                   const std::vector<int16_t>& plane, ReferenceMode mode) {
    AccessCounts counts;
    const auto samples =
        decoder_.decode_block(block, {.stop_level = level, .counts = &counts, .references = mode});
    demand(samples.has_value(), "a single block does not decode");
    const uint32_t side = header_.block_size();
    const Rect place{block.bx * side, block.by * side, std::min(side, size.width - block.bx * side),
                     std::min(side, size.height - block.by * side)};
    demand(std::ranges::equal(part_of(*samples, side, {0, 0, place.width, place.height}),
                              part_of(plane, size.width, place)),
           "a single block differs from its plane");
  }

  const std::filesystem::path& folder_;
  const Vector& vector_;
  const Decoder& decoder_;
  const StreamHeader& header_;
  uint64_t blocks_ = 0;
};

uint64_t view_samples(const StreamHeader& header) { return uint64_t{header.width} * header.height; }

// A decoder that accepts one sample less than a view has refuses it (FIL-7).
void check_limit(std::span<const uint8_t> file, const StreamHeader& header) {
  OpenOptions options;
  options.limits.max_plane_samples = view_samples(header) - 1;
  const auto refused = Decoder::open(file, options);
  demand(!refused && refused.error().code == ErrorCode::kLimitExceeded, "the limit is not kept");
}

// Each stream twice: reference images are decoded when they are needed, or all of them beforehand,
// then by a decoder whose limit is just what the stream has.
void check_opened(const std::filesystem::path& folder, const Vector& vector,
                  std::span<const uint8_t> file, OpenOptions options) {
  const auto decoder = Decoder::open(file, options);
  StreamCheck(folder, vector, *decoder).run();
  check_limit(file, decoder->header());
  options.limits.max_plane_samples = view_samples(decoder->header());
  const auto loaded = Decoder::open(file, options);
  demand(loaded.has_value(), "a stream at the limit is refused");
  const bool loads = loaded->load_references(1).has_value();
  demand(loads || !vector.output, "reference images do not load");
  StreamCheck(folder, vector, *loaded).run_planes();
}

void check(const std::filesystem::path& folder, const Vector& vector) {
  const auto file = io::map_file(folder / vector.input.file);
  demand(file.has_value(), "the file cannot be read");
  const Expectation& expect = vector.expect;
  const bool opens = expect.outcome == Outcome::kOk || expect.operation == Operation::kBlock;
  const auto decoder = Decoder::open(file->bytes());
  demand(decoder.has_value() == opens, opens ? "does not open" : "opens");
  if (opens) return check_opened(folder, vector, file->bytes(), {});
  demand(is_expected(expect, decoder.error()), to_string(decoder.error()));
  const OpenOptions lenient{.check_sections = false};
  if (expect.outcome == Outcome::kAcceptable && Decoder::open(file->bytes(), lenient)) {
    check_opened(folder, vector, file->bytes(), lenient);
  }
}

}  // namespace

std::string check_vector(const std::filesystem::path& folder, const Vector& vector) {
  try {
    check(folder, vector);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace hmlfc::vectors
