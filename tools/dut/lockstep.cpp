#include "dut/lockstep.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <hmlfc/stream_info.hpp>

namespace hmlfc::lockstep {

Lockstep::Lockstep(std::unique_ptr<Model> model, Device device, std::string stream,
                   unsigned block_log2)
    : model_(std::move(model)),
      device_(std::move(device)),
      stream_(std::move(stream)),
      block_log2_(block_log2) {
  if (model_->status() != 0) {
    text_ = fmt::format("{} is refused: every request must be answered with status {}\n", stream_,
                        status_text(model_->status()));
    return;
  }
  const StreamHeader& header = model_->header();
  stream_skipped_ =
      beyond(device_.claims, header.profile, conformance_level(header), &header).value_or("");
  if (stream_skipped_.empty() && model_->header().block_log2 != block_log2) {
    stream_skipped_ = fmt::format("the stream has blocks of {}, hmlfc_checker is for {}",
                                  header.block_size(), 1 << block_log2);
  }
  if (!stream_skipped_.empty()) {
    text_ = "nothing of " + stream_ + " is compared: " + stream_skipped_ + "\n";
  }
}

std::string Lockstep::why_skipped(const Request& request) const {
  if (!stream_skipped_.empty()) return stream_skipped_;
  if (request.plane == kRgb && !device_.rgb) return "requests for RGB (rgb false)";
  if (request.stop_level != 0 && !device_.stop_levels) return "stop levels (stop_levels false)";
  return {};
}

void Lockstep::request(int64_t clock, const Request& request, int tag) {
  Pending pending{requests_++, request, tag, clock, why_skipped(request), {}};
  if (pending.skipped.empty()) {
    pending.expected = model_->expect(request, device_.shows_stages());
    allow_held_chroma(pending);
  }
  pending_.push_back(std::move(pending));
}

void Lockstep::answer(int64_t clock, const Answer& answer) {
  ++answers_;
  ++statuses_[answer.status];
  const auto found =
      !device_.tagged ? pending_.begin() : std::ranges::find(pending_, answer.tag, &Pending::tag);
  if (found == pending_.end()) {
    const std::string tag = device_.tagged ? fmt::format(" with tag {}", answer.tag) : "";
    report(clock, nullptr,
           {"answer: extra", expected_actual("no answer: no request" + tag + " is in flight",
                                             "status " + status_text(answer.status))});
    return;
  }
  Pending pending = std::move(*found);
  pending_.erase(found);
  if (!pending.skipped.empty()) {
    ++skipped_[pending.skipped];
    return;
  }
  if (device_.bus_errors && answer.status == kBusError) {
    ++skipped_["answers of bus_error (bus_errors true)"];
    return;
  }
  ++compared_;
  if (auto difference = compare(pending, answer)) {
    if (const std::string hint = order_hint(pending, answer); !hint.empty()) {
      difference->rule = "answer: order";
      difference->detail += "  hint       " + hint + "\n";
    }
    report(clock, &pending, *difference);
  } else {
    close_records(clock, pending);
  }
  answered_ = std::move(pending);
}

std::optional<Lockstep::Difference> Lockstep::compare(const Pending& pending,
                                                      const Answer& answer) const {
  const Expectation& expected = pending.expected;
  if (answer.status != expected.status) {
    return Difference{"answer: status", expected_actual("status " + status_text(expected.status),
                                                        "status " + status_text(answer.status))};
  }
  for (size_t first = 0; first < expected.samples.size(); first += lane()) {
    auto difference = compare_values(expected.samples, answer.samples, first, expected.inside);
    if (!difference) continue;
    const size_t number = first / lane();
    const bool rgb = pending.request.plane == kRgb;
    difference->rule = "answer: sample";
    difference->detail = fmt::format(
        "  place      lane {}{}{}", number,
        rgb ? fmt::format(", {} (COL-2, COL-3)", "RGB"[number]) : " (DEC-1)", difference->detail);
    return difference;
  }
  return std::nullopt;
}

// `expected` from `first` on; its detail begins with the position.
std::optional<Lockstep::Difference> Lockstep::compare_values(const std::vector<int32_t>& expected,
                                                             const std::vector<PinValue>& actual,
                                                             size_t first, Inside inside) const {
  const size_t side = size_t{1} << block_log2_;
  for (size_t y = 0; y < inside.y; ++y) {
    for (size_t x = 0; x < inside.x; ++x) {
      const size_t i = first + y * side + x;
      if (actual[i] == expected[i]) continue;
      const std::string found =
          actual[i] ? std::to_string(*actual[i]) : "unknown (a bit is x or z)";
      return Difference{{},
                        fmt::format(", x {}, y {} in the block\n{}", x, y,
                                    expected_actual(std::to_string(expected[i]), found))};
    }
  }
  return std::nullopt;
}

// Where a wrong answer would be right. A request like this one says nothing.
std::string Lockstep::order_hint(const Pending& pending, const Answer& answer) const {
  const auto fits = [&](const Pending& other) {
    return !(other.request == pending.request) && !compare(other, answer);
  };
  if (answered_ && fits(*answered_)) {
    return fmt::format("it is the answer to request {} once more", answered_->number);
  }
  for (const Pending& other : pending_) {
    if (!other.skipped.empty() || !fits(other)) continue;
    return fmt::format("it is the answer to request {}: answers changed places, or one is missing",
                       other.number);
  }
  return {};
}

void Lockstep::unknown(int64_t clock, const std::string& where) {
  report(clock, nullptr,
         {where + ": unknown",
          expected_actual("values of handshake, place and status", "a bit of them is x or z")});
}

void Lockstep::reset() {
  dropped_ += pending_.size();
  pending_.clear();
  answered_.reset();
  held_chroma_.reset();
}

bool Lockstep::end(int64_t clock, bool complete) {
  if (std::exchange(ended_, true)) return false;
  if (complete && !pending_.empty()) {
    report(
        clock, &pending_.front(),
        {"answer: missing", expected_actual("an answer to each request",
                                            fmt::format("{} without an answer", pending_.size()))});
  }
  text_ += statistics();
  return true;
}

}  // namespace hmlfc::lockstep
