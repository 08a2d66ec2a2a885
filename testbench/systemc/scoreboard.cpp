#include "systemc/scoreboard.hpp"

#include <algorithm>

namespace hmlfc::tb {
namespace {

std::string expected_actual(const std::string& field, int64_t expected, int64_t actual) {
  return field + ": expected " + std::to_string(expected) + ", actual " + std::to_string(actual);
}

std::string status_text(unsigned status) {
  return status_name(status) + " (" + std::to_string(status) + ")";
}

size_t kind_of(const LevelRecord& record) {
  return record.key ? kBlockKinds - 1 : static_cast<size_t>(record.state());
}

}  // namespace

void Scoreboard::set_oracle(Oracle* oracle, unsigned block_size) {
  oracle_ = oracle;
  block_size_ = block_size;
}

void Scoreboard::on_request(const Request& request, uint64_t cycle) {
  ++counts_.sent;
  if (oracle_ == nullptr) {
    findings_.add({"protocol: request taken before LOAD", request, {}, {}, cycle});
    return;
  }
  pending_.push_back(oracle_->evaluate(request));
  coverage_.on_expected(pending_.back(), oracle_->stream());
  const Chroma chroma = chroma_of(pending_.back());
  pending_blocks_.push_back(blocks_of(pending_.back(), chroma));
  if (traced_) add_records(pending_.back(), chroma);
}

// The unit leaves out chroma that it holds: that of the latest request for RGB.
Scoreboard::Chroma Scoreboard::chroma_of(const ExpectedAnswer& expected) {
  const auto key = chroma_key(expected);
  if (!key) return Chroma::kDecoded;
  const bool held = held_chroma_ == key;
  const bool uncertain = chroma_uncertain_;
  held_chroma_ = key;
  chroma_uncertain_ = may_fail_ != nullptr;
  return !held ? Chroma::kDecoded : uncertain ? Chroma::kUncertain : Chroma::kHeld;
}

Scoreboard::Blocks Scoreboard::blocks_of(const ExpectedAnswer& expected, Chroma chroma) {
  if (!expected.planes[0]) return {1, 0};
  Blocks blocks{expected.planes[0]->levels.size(), 0};
  if (expected.request.plane != kRgb || chroma == Chroma::kHeld) return blocks;
  const uint64_t more = expected.planes[1]->levels.size() + expected.planes[2]->levels.size();
  (chroma == Chroma::kDecoded ? blocks.certain : blocks.uncertain) += more;
  return blocks;
}

void Scoreboard::add_records(const ExpectedAnswer& expected, Chroma chroma) {
  const uint64_t number = first_pending_ + pending_.size() - 1;
  const bool failed = expected.answer.status != 0 || may_fail_ != nullptr;
  for (size_t p = 0; p < kPlaneCount; ++p) {
    const auto& plane = expected.planes[p];
    if (!plane) continue;
    bool unknown = false;
    for (size_t l = 0; l < plane->levels.size(); ++l) {
      if (chroma == Chroma::kHeld && p > 0) {
        ++counts_.records_skipped;
      } else {
        records_.push_back(
            {number, plane, l, failed || (chroma == Chroma::kUncertain && p > 0), unknown});
      }
      unknown |= plane->levels[l].error != 0;
    }
  }
}

void Scoreboard::on_record(const LevelRecord& record, uint64_t cycle) {
  if (!traced_) return;
  ++counts_.records;
  if (is_refusal(record)) {
    ++counts_.records_unchecked;
    return;
  }
  ++counts_.kind_records[kind_of(record)];
  while (!records_.empty() && !(records_.front().expected().site == record.site)) {
    if (!records_.front().failed) {
      report(comes_later(record.site) ? "trace: record missing" : "trace: order",
             request_of(records_.front().request), to_string(records_.front().expected().site),
             "actual " + to_string(record.site), cycle);
      return;
    }
    ++counts_.records_missing;
    records_.pop_front();
  }
  skip_to_match(record);
  if (records_.empty()) {
    report("trace: record of no request", nullptr, to_string(record.site), {}, cycle);
    return;
  }
  const PendingRecord pending = std::move(records_.front());
  records_.pop_front();
  compare_record(pending, record, cycle);
}

// If the record at the front may be missing, a record of the same site can belong to a later
// request for residuals instead of samples: then it has the values of that request.
void Scoreboard::skip_to_match(const LevelRecord& record) {
  if (record.error != 0 || oracle_->stream() == nullptr) return;
  const auto reached = std::ranges::find_if_not(records_, &PendingRecord::failed);
  const auto end = reached == records_.end() ? reached : std::next(reached);
  const auto match = std::find_if(records_.begin(), end, [&](const PendingRecord& pending) {
    return pending.expected().site == record.site && !difference_of(pending, record);
  });
  if (match == end) return;
  counts_.records_missing += static_cast<uint64_t>(match - records_.begin());
  records_.erase(records_.begin(), match);
}

std::optional<Difference> Scoreboard::difference_of(const PendingRecord& pending,
                                                    const LevelRecord& record) const {
  const LevelRecord& expected = pending.expected();
  const PlaneShape& shape = oracle_->stream()->geometry().plane(expected.site.plane);
  return first_difference(expected, record, block_size_,
                          inside(shape.width, expected.site.bx, block_size_),
                          inside(shape.height, expected.site.by, block_size_));
}

// Whether it is a bus error that the memory has caused.
bool Scoreboard::is_bus_error(uint8_t status, const Request& request) const {
  return status == kBusError && may_fail_ && may_fail_(request);
}

// Whether a record says that a request was refused: its site has no meaning then.
bool Scoreboard::is_refusal(const LevelRecord& record) const {
  return record.error != 0 && std::ranges::any_of(pending_, [&](const ExpectedAnswer& expected) {
           return !expected.planes[0] && expected.answer.status == record.error;
         });
}

// Whether the request whose record is due has one of `site` still to come.
bool Scoreboard::comes_later(const BlockSite& site) const {
  return std::ranges::any_of(records_, [&](const PendingRecord& record) {
    return record.request == records_.front().request && record.expected().site == site;
  });
}

void Scoreboard::compare_record(const PendingRecord& pending, const LevelRecord& record,
                                uint64_t cycle) {
  const ExpectedAnswer* request = request_of(pending.request);
  const bool bus_error = request != nullptr && is_bus_error(record.error, request->request);
  if (pending.unknown || bus_error || oracle_->stream() == nullptr) {
    ++counts_.records_unchecked;
    return;
  }
  ++counts_.records_compared;
  const auto difference = difference_of(pending, record);
  if (!difference) return;
  report("stage: " + difference->stage, request_of(pending.request),
         to_string(pending.expected().site),
         expected_actual(difference->field, difference->expected, difference->actual), cycle);
}

void Scoreboard::on_answer(const Answer& answer, uint64_t cycle) {
  ++counts_.received;
  if (log_ != nullptr) log_->push_back(answer);
  if (pending_.empty()) {
    report("answer: to no request", nullptr, {}, "status " + status_name(answer.status), cycle);
    return;
  }
  const ExpectedAnswer expected = std::move(pending_.front());
  pending_.pop_front();
  counts_.blocks += pending_blocks_.front().certain;
  counts_.blocks_uncertain += pending_blocks_.front().uncertain;
  pending_blocks_.pop_front();
  if (answer.status != 0 && counts_.first_error == 0) {
    counts_.first_error = answer.status;
    counts_.first_error_request = expected.request.word();
  }
  compare_answer(expected, answer, cycle);
  if (traced_) close_records(expected, cycle);
  ++first_pending_;
}

// Level blocks of an answered request must have been reported before it.
void Scoreboard::close_records(const ExpectedAnswer& expected, uint64_t cycle) {
  while (!records_.empty() && records_.front().request == first_pending_) {
    const PendingRecord& record = records_.front();
    if (!record.failed) {
      report("trace: record missing", &expected, to_string(record.expected().site), {}, cycle);
    }
    ++counts_.records_missing;
    records_.pop_front();
  }
}

// What is wrong with an answer, and under which rule; nothing if it is right.
std::optional<std::string> Scoreboard::compare_values(const ExpectedAnswer& expected,
                                                      const Answer& answer,
                                                      std::string& rule) const {
  if (answer.status != expected.answer.status && !is_bus_error(answer.status, expected.request)) {
    rule = "answer: status";
    return "expected " + status_text(expected.answer.status) + ", actual " +
           status_text(answer.status);
  }
  if (answer.last != expected.answer.last) {
    rule = "answer: tlast";
    return expected_actual("tlast", expected.answer.last, answer.last);
  }
  // With an error, and in lanes that are not used, everything is 0; nothing lies outside then.
  const size_t lane = size_t{block_size_} * block_size_;
  const StageValues zero{};
  for (size_t c = 0; c < kLanes; ++c) {
    const bool used = answer.status == 0 && (c == 0 || expected.request.plane == kRgb);
    const int16_t* values = used ? expected.answer.samples.data() + c * lane : zero.data();
    const auto difference = first_difference(values, answer.samples.data() + c * lane, "sample",
                                             block_size_, used ? expected.inside_x : block_size_,
                                             used ? expected.inside_y : block_size_);
    if (!difference) continue;
    rule = "answer: sample";
    return "lane " + std::to_string(c) + " " +
           expected_actual(difference->field, difference->expected, difference->actual);
  }
  return std::nullopt;
}

// Whether a wrong answer is right for a neighbour in the order of the requests. A bus error is like
// any other.
std::string Scoreboard::order_hint(const Answer& answer) const {
  if (answer.status == kBusError) return {};
  std::string rule;
  if (!pending_.empty() && !compare_values(pending_.front(), answer, rule)) {
    return "; it is the answer to the next request";
  }
  if (counts_.received > 1 && !compare_values(answered_, answer, rule)) {
    return "; it is the answer to the request before";
  }
  return {};
}

void Scoreboard::compare_answer(const ExpectedAnswer& expected, const Answer& answer,
                                uint64_t cycle) {
  coverage_.on_answer(expected, answer);
  ++(is_bus_error(answer.status, expected.request) ? counts_.unchecked : counts_.compared);
  std::string rule;
  const auto difference = compare_values(expected, answer, rule);
  if (difference) {
    const std::string hint = order_hint(answer);
    report(hint.empty() ? rule : "answer: order", &expected, {}, *difference + hint, cycle);
  }
  answered_ = expected;
}

void Scoreboard::on_reset() {
  counts_.dropped += pending_.size();
  first_pending_ += pending_.size();
  pending_.clear();
  pending_blocks_.clear();
  records_.clear();
  oracle_ = nullptr;
  forget_chroma();
}

void Scoreboard::finish(uint64_t cycle) {
  if (!pending_.empty()) {
    report("answer: missing", &pending_.front(), {},
           std::to_string(pending_.size()) + " requests are not answered", cycle);
  }
  for (const PendingRecord& record : records_) {
    if (!pending_.empty()) break;
    if (!record.failed) {
      report("trace: record missing", nullptr, to_string(record.expected().site), {}, cycle);
    }
  }
}

void Scoreboard::clear() {
  pending_.clear();
  pending_blocks_.clear();
  records_.clear();
  first_pending_ = 0;
  counts_ = {};
}

const ExpectedAnswer* Scoreboard::request_of(uint64_t number) const {
  const uint64_t index = number - first_pending_;
  return index < pending_.size() ? &pending_[static_cast<size_t>(index)] : nullptr;
}

void Scoreboard::report(const std::string& rule, const ExpectedAnswer* expected,
                        const std::string& place, const std::string& detail, uint64_t cycle) {
  Mismatch mismatch{rule, {}, place, detail, cycle};
  if (expected != nullptr) mismatch.request = expected->request;
  findings_.add(std::move(mismatch));
}

}  // namespace hmlfc::tb
