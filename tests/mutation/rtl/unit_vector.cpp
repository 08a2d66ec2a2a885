#include "unit_vector.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "mutated_unit.hpp"
#include "oracle/golden_stream.hpp"
#include "oracle/level_record.hpp"
#include "syntax/header.hpp"

namespace hmlfc::tb {
namespace {

MappedFile map(const std::filesystem::path& path) {
  auto file = io::map_file(path);
  if (!file) throw std::runtime_error(file.error().message);
  return std::move(*file);
}

class AssertionFails : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

}  // namespace

UnitVector::UnitVector(const std::filesystem::path& folder, const vectors::Vector& vector,
                       const UnitParameters& unit)
    : vector_(vector), file_(map(folder / vector.input.file)), image_(file_.bytes(), unit) {
  if (const auto opened = Decoder::open(file_.bytes()); !opened) {
    software_error_ = static_cast<unsigned>(opened.error().code);
  }
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

std::string UnitVector::wrong_plane(UnitHost& host, Oracle& oracle, ViewPos view,
                                    unsigned plane) const {
  const Geometry& geometry = image_.golden()->geometry();
  const unsigned side = geometry.block_size();
  const auto requests = view_requests(
      geometry.plane(plane == kRgb ? Plane::kY : static_cast<Plane>(plane)), view, plane);
  const auto answers = host.answers(requests);
  for (size_t i = 0; i < requests.size(); ++i) {
    const ExpectedAnswer expected = oracle.evaluate(requests[i]);
    const Answer& wanted = expected.answer;
    if (answers[i].status != wanted.status) {
      return fmt::format("{}: status {}", to_string(requests[i]), answers[i].status);
    }
    if (answers[i].last != (i + 1 == requests.size())) {
      return fmt::format("{}: wrong tlast", to_string(requests[i]));
    }
    for (size_t at = 0; at < (plane == kRgb ? kLanes : 1) * side * side; at += side * side) {
      const auto difference =
          first_difference(&wanted.samples[at], &answers[i].samples[at], "sample", side,
                           expected.inside_x, expected.inside_y);
      if (wanted.status == 0 && difference) {
        return fmt::format("{}: wrong {}", to_string(requests[i]), difference->field);
      }
    }
  }
  return {};
}

// All pixels, then all planes of the last view where every block decodes.
std::string UnitVector::wrong_views(UnitHost& host) const {
  const StreamHeader& header = image_.golden()->header();
  Oracle oracle(*image_.golden());
  std::string wrong;
  for (uint32_t view = 0; view < header.rows * header.cols && wrong.empty(); ++view) {
    wrong = wrong_plane(host, oracle, {view / header.cols, view % header.cols}, kRgb);
  }
  const bool decodes = vector_.expect.outcome == vectors::Outcome::kOk;
  for (unsigned plane = 0; plane < kRgb && decodes && wrong.empty(); ++plane) {
    wrong = wrong_plane(host, oracle, {header.rows - 1, header.cols - 1}, plane);
  }
  return wrong;
}

Verdict UnitVector::try_on(std::unique_ptr<DecodeUnit> unit, uint64_t patience,
                           uint64_t& clocks) const {
  outlive_assertions();
  clocks = 0;
  const auto on_clock = [&](const UnitInputs&, const UnitOutputs&) {
    ++clocks;
    if (assertion_fails()) throw AssertionFails("an assertion fails");
  };
  Verdict verdict;
  try {
    UnitHost host(std::move(unit), file_.bytes(), image_.area().bytes, on_clock);
    host.set_patience(patience);
    host.set_pauses(1);
    unsigned error = host.load();
    if (error == 0) error = software_error_;
    verdict.difference = wrong_error(error);
    const bool decoded = vector_.blocks && image_.golden() != nullptr;
    if (error == 0 && decoded && verdict.pass()) verdict.difference = wrong_views(host);
  } catch (const UnitHangs& hang) {
    verdict = {true, hang.what()};
  } catch (const AssertionFails& failure) {
    verdict = {false, failure.what()};
  }
  return verdict;
}

}  // namespace hmlfc::tb
