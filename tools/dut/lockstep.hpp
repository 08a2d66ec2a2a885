// A device in lock-step with the golden model: pairs answers and stages with requests, compares
// them, and says what differs.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dut/device_file.hpp"
#include "dut/expectation.hpp"

namespace hmlfc::lockstep {

inline constexpr int kBusError = static_cast<int>(ErrorCode::kBusError);

/// A value at the pins; nothing where a bit of it is unknown.
using PinValue = std::optional<int32_t>;

/// Up to three lanes of B * B samples.
struct Answer {
  int tag = 0;
  int status = 0;
  std::vector<PinValue> samples;
};

/// Stages in the order of kStageNames, B * B values each.
struct Record {
  BlockSite site;
  int error = 0;
  unsigned shown = 0;  ///< a bit for each stage that the block has
  std::array<std::vector<PinValue>, 4> values;
};

/// Everything that is not compared is counted with its reason.
class Lockstep {
 public:
  /// `stream` is the path of the file, for messages.
  Lockstep(std::unique_ptr<Model> model, Device device, std::string stream, unsigned block_log2);

  // Each takes what the device did at a clock, and says with take_text() what differs.
  void request(int64_t clock, const Request& request, int tag);
  void answer(int64_t clock, const Answer& answer);
  void record(int64_t clock, const Record& record);
  void unknown(int64_t clock, const std::string& where);
  void reset();

  /// The end: statistics. Requests without an answer are a difference in a `complete` run.
  /// A second call does nothing and returns false.
  bool end(int64_t clock, bool complete);

  std::string take_text() { return std::exchange(text_, {}); }
  int64_t differences() const { return differences_; }
  bool compared_something() const { return compared_ != 0; }
  const Model& model() const { return *model_; }
  size_t lane() const { return size_t{1} << (2 * block_log2_); }

 private:
  struct Pending {
    uint64_t number;
    Request request;
    int tag;
    int64_t clock;
    std::string skipped;  // why it is not compared
    Expectation expected;
  };
  // The first thing that differs.
  struct Difference {
    std::string rule;
    std::string detail;  // lines
    const BlockSite* site = nullptr;
  };

  std::string why_skipped(const Request& request) const;
  void allow_held_chroma(Pending& pending);
  std::optional<Difference> compare(const Pending& pending, const Answer& answer) const;
  std::optional<Difference> compare(const ExpectedRecord& expected, const Record& record);
  std::optional<Difference> compare_values(const std::vector<int32_t>& expected,
                                           const std::vector<PinValue>& actual, size_t first,
                                           Inside inside) const;
  std::string order_hint(const Pending& pending, const Answer& answer) const;
  std::pair<Pending*, ExpectedRecord*> find_record(const BlockSite& site);
  void close_records(int64_t clock, Pending& pending);
  bool of_failed_block(int64_t clock, const Record& record);
  void report(int64_t clock, const Pending* pending, const Difference& difference);
  std::string origin(const Pending& pending, const BlockSite* site) const;
  std::string statistics() const;

  std::unique_ptr<Model> model_;
  Device device_;
  std::string stream_;
  unsigned block_log2_;
  std::string stream_skipped_;  // why nothing of the stream is compared
  std::deque<Pending> pending_;
  std::optional<Pending> answered_;     // the latest request that was compared
  std::optional<Request> held_chroma_;  // the latest request for RGB, by its chroma block
  std::string text_;
  bool ended_ = false;
  int64_t differences_ = 0;
  uint64_t requests_ = 0, answers_ = 0, compared_ = 0, records_ = 0, records_compared_ = 0;
  uint64_t dropped_ = 0, held_ = 0;
  std::array<uint64_t, 4> stages_compared_{};
  std::map<int, uint64_t> statuses_;
  std::map<std::string, uint64_t> skipped_, rules_;
};

/// "27 (bus_error)".
std::string status_text(int status);

/// Two lines of a message.
std::string expected_actual(const std::string& expected, const std::string& actual);

}  // namespace hmlfc::lockstep
