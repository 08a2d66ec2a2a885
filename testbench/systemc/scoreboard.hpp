// Compares the unit's results with the golden model's, stage by stage and answer by answer.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>

#include <systemc>

#include "oracle/oracle.hpp"
#include "systemc/coverage.hpp"
#include "systemc/mismatch.hpp"

namespace hmlfc::tb {

/// Blocks by state, key images last.
inline constexpr size_t kBlockKinds = 5;

/// Counts of a scoreboard. At the end of a run sent = received + dropped, and received =
/// compared + unchecked.
struct ScoreCounts {
  uint64_t sent = 0;       ///< requests the unit took
  uint64_t received = 0;   ///< answers
  uint64_t compared = 0;   ///< answers that were compared
  uint64_t unchecked = 0;  ///< answers that could not be: bus_error where the memory gave errors
  uint64_t dropped = 0;    ///< requests in flight at a reset, which are not answered
  uint64_t records = 0;    ///< trace records = records_compared + records_unchecked
  uint64_t records_compared = 0;   ///< trace records that were compared
  uint64_t records_unchecked = 0;  ///< of levels below one with an error, or of refusals
  uint64_t records_skipped = 0;    ///< not expected: chroma that the unit still holds
  uint64_t records_missing = 0;    ///< expected, but not made, because of an error or wrongly
  uint64_t blocks = 0;  ///< blocks of levels that the answers took, refusals counting as one
  uint64_t blocks_uncertain = 0;     ///< and at most so many more: chroma after bus errors
  uint64_t first_error = 0;          ///< status of the first answer with one
  uint64_t first_error_request = 0;  ///< the word of its request
  std::array<uint64_t, kBlockKinds> kind_records{};  ///< trace records by kind of block
};

/// Adds the counts of requests, answers and records.
inline ScoreCounts& operator+=(ScoreCounts& total, const ScoreCounts& more) {
  total.sent += more.sent;
  total.received += more.received;
  total.compared += more.compared;
  total.unchecked += more.unchecked;
  total.dropped += more.dropped;
  total.records += more.records;
  total.records_compared += more.records_compared;
  total.records_unchecked += more.records_unchecked;
  total.records_skipped += more.records_skipped;
  total.records_missing += more.records_missing;
  total.blocks += more.blocks;
  total.blocks_uncertain += more.blocks_uncertain;
  return total;
}

/// Sink of the monitors.
class Scoreboard final : public sc_core::sc_module {
 public:
  Scoreboard(const sc_core::sc_module_name& name, Findings& findings, Coverage& coverage)
      : sc_core::sc_module(name), findings_(findings), coverage_(coverage) {}

  /// Expects what `oracle` says from now on; `block_size` is the unit's.
  void set_oracle(Oracle* oracle, unsigned block_size);

  /// Whether the unit has a trace port: then each level block must be reported.
  void expect_trace(bool expected) { traced_ = expected; }

  /// Which requests may be answered with bus_error from now on; null: none.
  using MayFail = std::function<bool(const Request&)>;
  void allow_bus_errors(MayFail may_fail) { may_fail_ = std::move(may_fail); }

  /// Also appends every answer to `log`, if not null.
  void log_answers(std::vector<Answer>* log) { log_ = log; }

  void on_request(const Request& request, uint64_t cycle);
  void on_record(const LevelRecord& record, uint64_t cycle);
  void on_answer(const Answer& answer, uint64_t cycle);

  /// A LOAD: no chroma is held any more.
  void forget_chroma() { held_chroma_.reset(); }

  /// Forgets the requests in flight: a reset drops them.
  void on_reset();

  /// At the end of a run: every request must have been answered.
  void finish(uint64_t cycle);

  uint64_t in_flight() const { return pending_.size(); }
  const ScoreCounts& counts() const { return counts_; }
  void clear();

 private:
  // A level block that a trace record is expected for.
  struct PendingRecord {
    uint64_t request;  // its number
    std::shared_ptr<const ExpectedPlane> plane;
    size_t level;
    bool failed;   // may be missing: this or another block of its request has an error
    bool unknown;  // below a level with an error

    const LevelRecord& expected() const { return plane->levels[level]; }
  };

  // Whether the unit may leave out the chroma of a request.
  enum class Chroma { kDecoded, kHeld, kUncertain };

  // Blocks of levels that a request takes, and how many more it may.
  struct Blocks {
    uint64_t certain = 0;
    uint64_t uncertain = 0;
  };

  Chroma chroma_of(const ExpectedAnswer& expected);
  static Blocks blocks_of(const ExpectedAnswer& expected, Chroma chroma);
  void add_records(const ExpectedAnswer& expected, Chroma chroma);
  bool is_bus_error(uint8_t status, const Request& request) const;
  bool is_refusal(const LevelRecord& record) const;
  bool comes_later(const BlockSite& site) const;
  void skip_to_match(const LevelRecord& record);
  std::optional<Difference> difference_of(const PendingRecord& pending,
                                          const LevelRecord& record) const;
  void compare_record(const PendingRecord& pending, const LevelRecord& record, uint64_t cycle);
  void compare_answer(const ExpectedAnswer& expected, const Answer& answer, uint64_t cycle);
  std::optional<std::string> compare_values(const ExpectedAnswer& expected, const Answer& answer,
                                            std::string& rule) const;
  std::string order_hint(const Answer& answer) const;
  void close_records(const ExpectedAnswer& expected, uint64_t cycle);
  void report(const std::string& rule, const ExpectedAnswer* expected, const std::string& place,
              const std::string& detail, uint64_t cycle);
  const ExpectedAnswer* request_of(uint64_t number) const;

  Findings& findings_;
  Coverage& coverage_;
  Oracle* oracle_ = nullptr;
  unsigned block_size_ = 4;
  bool traced_ = false;
  std::vector<Answer>* log_ = nullptr;
  MayFail may_fail_;
  std::deque<ExpectedAnswer> pending_;
  std::deque<Blocks> pending_blocks_;  // of each
  std::deque<PendingRecord> records_;
  uint64_t first_pending_ = 0;           // number of pending_[0]
  ExpectedAnswer answered_;              // the request answered last, for hints
  std::optional<uint64_t> held_chroma_;  // chroma_key of the latest request for RGB
  // It may have met a bus error, and then the unit does not hold it.
  bool chroma_uncertain_ = false;
  ScoreCounts counts_;
};

}  // namespace hmlfc::tb
