#include "unit_vector.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "bits/crc32c.hpp"
#include "oracle/golden_stream.hpp"
#include "oracle/level_record.hpp"
#include "oracle/oracle.hpp"
#include "syntax/header.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::tb {
namespace {

io::MappedFile map(const std::filesystem::path& path) {
  auto file = io::MappedFile::open(path);
  if (!file) throw std::runtime_error(file.error().message);
  return std::move(*file);
}

// All blocks of a plane of `shape`; of `plane` kRgb, of plane Y.
std::vector<Request> view_requests(const PlaneShape& shape, ViewPos view, unsigned plane) {
  std::vector<Request> requests;
  for (uint32_t by = 0; by < shape.blocks_y; ++by) {
    for (uint32_t bx = 0; bx < shape.blocks_x; ++bx) {
      requests.push_back({.row = view.row, .col = view.col, .bx = bx, .by = by, .plane = plane});
    }
  }
  return requests;
}

std::string place_of(const Request& request) {
  return fmt::format("view {},{} block {},{}: ", request.row, request.col, request.bx, request.by);
}

// The block's pixels that lie in the view.
RgbImage pixels(const Request& request, const Answer& answer, const StreamHeader& header) {
  const uint32_t b = header.block_size();
  RgbImage image{std::min(b, header.width - request.bx * b),
                 std::min(b, header.height - request.by * b),
                 header.depth,
                 {}};
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      for (size_t lane = 0; lane < kLanes; ++lane) {
        const auto sample = answer.samples[(lane * b + y) * b + x];
        image.samples.push_back(static_cast<uint16_t>(sample));
      }
    }
  }
  return image;
}

}  // namespace

UnitVector::UnitVector(const std::filesystem::path& folder, const vectors::Vector& vector,
                       const UnitParameters& unit)
    : vector_(vector), file_(map(folder / vector.input.file)), image_(file_.bytes(), unit) {
  if (const auto opened = Decoder::open(file_.bytes()); !opened) {
    software_error_ = static_cast<unsigned>(opened.error().code);
  }
  if (vector.blocks && image_.golden() != nullptr) read_blocks(folder / vector.blocks->file);
}

// Lines in pairs: the view, then a checksum for each block.
void UnitVector::read_blocks(const std::filesystem::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line) && std::getline(in, line);) {
    std::istringstream words(line);
    BlockSums& sums = views_.emplace_back();
    for (std::string word; words >> word;) {
      sums.push_back(word[0] == '-'
                         ? std::nullopt
                         : std::optional(static_cast<uint32_t>(std::stoul(word, nullptr, 16))));
    }
  }
  const StreamHeader& header = image_.golden()->header();
  const PlaneShape& luma = image_.golden()->geometry().plane(Plane::kY);
  bool whole = views_.size() == size_t{header.rows} * header.cols;
  for (const BlockSums& sums : views_) {
    whole = whole && sums.size() == size_t{luma.blocks_x} * luma.blocks_y;
  }
  if (!whole) throw std::runtime_error(file.string() + ": not the blocks of all views");
}

bool UnitVector::is_for(const UnitParameters& unit, std::span<const uint8_t> stream) {
  const auto header = parse_header(stream);
  return !header || !exceeds_limits(*header, unit);
}

// What is wrong with an error of the whole stream, 0 for none.
std::string UnitVector::wrong_error(unsigned error) const {
  const vectors::Expectation& expect = vector_.expect;
  const auto expected = static_cast<unsigned>(expect.error);
  const bool at_open = expect.operation == vectors::Operation::kOpen;
  if (error == 0) {
    const bool must = expect.outcome == vectors::Outcome::kReject && at_open;
    return must ? "accepted, must be refused with " + status_name(expected) : "";
  }
  const bool may = expect.outcome != vectors::Outcome::kOk && at_open;
  if (may && error == expected) return {};
  return fmt::format("refused with {}", status_name(error));
}

// Whether the manifest names the block of plane Y: other blocks may fail with other errors.
bool UnitVector::is_named(const Request& request) const {
  const BlockAddress block{{request.row, request.col}, Plane::kY, request.bx, request.by};
  return std::ranges::any_of(vector_.expect.blocks, [&](const BlockAddress& named) {
    return named.view.row == block.view.row && named.view.col == block.view.col &&
           named.plane == block.plane && named.bx == block.bx && named.by == block.by;
  });
}

std::string UnitVector::wrong_block(const Request& request, const Answer& answer,
                                    const BlockSums& sums) const {
  const StreamHeader& header = image_.golden()->header();
  const PlaneShape& luma = image_.golden()->geometry().plane(Plane::kY);
  const auto& sum = sums[size_t{request.by} * luma.blocks_x + request.bx];
  const std::string place = place_of(request);
  const auto expected = static_cast<unsigned>(vector_.expect.error);
  const bool right = sum ? answer.status == 0
                         : answer.status != 0 && (!is_named(request) || answer.status == expected);
  if (!right) return place + fmt::format("status {}", answer.status);
  if (!sum) return {};
  const auto actual = crc32c(vectors::picture_bytes(pixels(request, answer, header)));
  return actual == *sum ? "" : place + "wrong samples";
}

std::string UnitVector::wrong_plane(UnitHost& host, ViewPos view, Plane plane) const {
  const Geometry& geometry = image_.golden()->geometry();
  const auto requests = view_requests(geometry.plane(plane), view, static_cast<unsigned>(plane));
  const auto answers = host.answers(requests);
  Oracle oracle(*image_.golden());
  for (size_t i = 0; i < requests.size(); ++i) {
    const std::string place = place_of(requests[i]) + fmt::format("plane {}: ", requests[i].plane);
    const ExpectedAnswer expected = oracle.evaluate(requests[i]);
    if (answers[i].status != expected.answer.status) {
      return place + fmt::format("status {}", answers[i].status);
    }
    const auto difference = first_difference(
        expected.answer.samples.data(), answers[i].samples.data(), "sample",
        image_.golden()->header().block_size(), expected.inside_x, expected.inside_y);
    if (difference) return place + "wrong " + difference->field;
  }
  return {};
}

std::string UnitVector::wrong_last_view(UnitHost& host) const {
  const StreamHeader& header = image_.golden()->header();
  std::string wrong;
  for (const Plane plane : kPlanes) {
    if (wrong.empty()) wrong = wrong_plane(host, {header.rows - 1, header.cols - 1}, plane);
  }
  return wrong;
}

Verdict UnitVector::try_on(std::unique_ptr<DecodeUnit> unit, uint64_t patience,
                           uint64_t& clocks) const {
  Verdict verdict;
  UnitHost host(std::move(unit), file_.bytes(), image_.area().bytes);
  host.set_patience(patience);
  host.set_pauses(1);
  try {
    unsigned error = host.load();
    if (error == 0) error = software_error_;
    verdict.difference = wrong_error(error);
    const size_t views = error == 0 ? views_.size() : 0;
    for (size_t view = 0; view < views && verdict.pass(); ++view) {
      const uint32_t cols = image_.golden()->header().cols;
      const ViewPos at{static_cast<uint32_t>(view) / cols, static_cast<uint32_t>(view) % cols};
      const auto requests = view_requests(image_.golden()->geometry().plane(Plane::kY), at, kRgb);
      const auto answers = host.answers(requests);
      for (size_t i = 0; i < requests.size() && verdict.pass(); ++i) {
        verdict.difference = wrong_block(requests[i], answers[i], views_[view]);
      }
    }
    const bool decodes = vector_.expect.outcome == vectors::Outcome::kOk;
    if (views != 0 && decodes && verdict.pass()) verdict.difference = wrong_last_view(host);
  } catch (const UnitHangs& hang) {
    verdict = {true, hang.what()};
  }
  clocks = host.clocks();
  return verdict;
}

}  // namespace hmlfc::tb
