#include "unit_vector.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "bits/crc32c.hpp"
#include "fields/header.hpp"
#include "golden_stream.hpp"
#include "vectors/picture_bytes.hpp"

namespace hmlfc::tb {
namespace {

io::MappedFile map(const std::filesystem::path& path) {
  auto file = io::MappedFile::open(path);
  if (!file) throw std::runtime_error(file.error().message);
  return std::move(*file);
}

std::vector<Request> view_requests(const PlaneShape& luma, ViewPos view) {
  std::vector<Request> requests;
  for (uint32_t by = 0; by < luma.blocks_y; ++by) {
    for (uint32_t bx = 0; bx < luma.blocks_x; ++bx) {
      requests.push_back({.row = view.row, .col = view.col, .bx = bx, .by = by, .plane = kRgb});
    }
  }
  return requests;
}

std::vector<Request> plane_requests(const Geometry& geometry, ViewPos view) {
  std::vector<Request> requests;
  for (const Plane plane : kPlanes) {
    const PlaneShape& shape = geometry.plane(plane);
    for (uint32_t by = 0; by < shape.blocks_y; ++by) {
      for (uint32_t bx = 0; bx < shape.blocks_x; ++bx) {
        requests.push_back({.row = view.row,
                            .col = view.col,
                            .bx = bx,
                            .by = by,
                            .plane = static_cast<unsigned>(plane)});
      }
    }
  }
  return requests;
}

std::string place_of(const Request& request) {
  return fmt::format("view {},{} block {},{}: ", request.row, request.col, request.bx, request.by);
}

// Whether samples are the same that lie in the plane; the others have no meaning (DEC-2).
bool equal_inside(const Request& request, const PlaneShape& shape, uint32_t b,
                  std::span<const int32_t> samples, const Answer& answer) {
  const uint32_t width = std::min(b, shape.width - request.bx * b);
  const uint32_t height = std::min(b, shape.height - request.by * b);
  for (uint32_t y = 0; y < height; ++y) {
    const auto row = samples.subspan(size_t{y} * b, width);
    if (!std::ranges::equal(row, std::span(answer.samples).subspan(size_t{y} * b, width))) {
      return false;
    }
  }
  return true;
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
  if (auto opened = Decoder::open(file_.bytes()); opened) {
    if (vector.expect.outcome == vectors::Outcome::kOk) decoder_.emplace(std::move(*opened));
  } else {
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

std::string UnitVector::wrong_plane(UnitHost& host, ViewPos view) const {
  const auto requests = plane_requests(image_.golden()->geometry(), view);
  const auto answers = host.answers(requests);
  for (size_t i = 0; i < requests.size(); ++i) {
    const Request& request = requests[i];
    const auto plane = static_cast<Plane>(request.plane);
    const auto samples = decoder_->decode_block({view, plane, request.bx, request.by}, 0);
    if (!samples) throw std::runtime_error(vector_.id + ": " + to_string(samples.error()));
    const PlaneShape& shape = image_.golden()->geometry().plane(plane);
    const bool same =
        answers[i].status == 0 &&
        equal_inside(request, shape, image_.golden()->header().block_size(), *samples, answers[i]);
    if (!same) return place_of(request) + fmt::format("wrong in plane {}", request.plane);
  }
  return {};
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
      const auto requests = view_requests(image_.golden()->geometry().plane(Plane::kY), at);
      const auto answers = host.answers(requests);
      for (size_t i = 0; i < requests.size() && verdict.pass(); ++i) {
        verdict.difference = wrong_block(requests[i], answers[i], views_[view]);
      }
      if (decoder_ && view + 1 == views && verdict.pass()) {
        verdict.difference = wrong_plane(host, at);
      }
    }
  } catch (const UnitHangs& hang) {
    verdict = {true, hang.what()};
  }
  clocks = host.clocks();
  return verdict;
}

}  // namespace hmlfc::tb
