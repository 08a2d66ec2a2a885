// A behavioural unit at the pins, with the model inside and faults to plant, on which the bench
// itself is tested.
#pragma once

#include <deque>
#include <memory>

#include "oracle/block_reads.hpp"
#include "oracle/oracle.hpp"
#include "stimulus/conditions.hpp"
#include "unit/pins.hpp"
#include "unit/register_file.hpp"

namespace hmlfc::tb {

/// What a stand-in does wrong, once, at the first opportunity from answer 20 on.
enum class Fault : uint8_t {
  kNone,
  kSample,         ///< one sample of the answer
  kStage,          ///< one value of a stage of the trace alone
  kVector,         ///< a vector of the trace alone
  kDropped,        ///< an answer is not given
  kDuplicated,     ///< an answer is given twice
  kSwapped,        ///< two answers change places
  kStatus,         ///< the status
  kLast,           ///< tlast
  kUnstable,       ///< an answer changes while it waits
  kBurst,          ///< a burst crosses 4 KiB
  kRecordMissing,  ///< a level block is not reported
  kCounter,        ///< REQUESTS counts one too many
  kBlocks,         ///< BLOCKS counts while an answer waits
  kNeighbour,      ///< a bus error becomes the answer of the next request, too
};

inline constexpr Fault kFaults[] = {
    Fault::kSample,        Fault::kStage,   Fault::kVector, Fault::kDropped,  Fault::kDuplicated,
    Fault::kSwapped,       Fault::kStatus,  Fault::kLast,   Fault::kUnstable, Fault::kBurst,
    Fault::kRecordMissing, Fault::kCounter, Fault::kBlocks, Fault::kNeighbour};

/// Reads the whole stream over the read master at LOAD, then for each request one of the beats that
/// its answer depends on; answers with the model's decoder and its fast references, so that the
/// bench compares these with the golden ones.
class StandIn final : public DecodeUnit {
 public:
  explicit StandIn(const UnitParameters& parameters, Fault fault = Fault::kNone);

  void clock(const UnitInputs& at_edge, const UnitInputs& after, UnitOutputs& outputs) override;
  bool has_trace() const override { return true; }
  bool traces_errors() const override { return false; }
  UnitParameters parameters() const override { return parameters_; }

  static std::unique_ptr<DecodeUnit> make(const UnitParameters& parameters) {
    return std::make_unique<StandIn>(parameters);
  }

 private:
  // A burst to ask for.
  struct Fetch {
    uint64_t address;
    unsigned beats;
  };

  // A request that is not answered yet.
  struct Job {
    Request request;
    ExpectedAnswer expected;
    std::vector<const LevelRecord*> records = {};  // still to report, from the front
    size_t reported = 0;
    uint64_t blocks = 0;  // that BLOCKS counts for it
    bool fetched = false;
  };

  void reset();
  void take(const UnitInputs& in);
  void take_read(const UnitInputs& in);
  void take_registers(const UnitInputs& in);
  void control(uint32_t bits);
  void begin_load();
  void end_load();
  void add_job(const Request& request);
  void fetch(uint64_t address, uint64_t bytes);
  void answered();
  void show();
  void show_trace();
  void show_answer();
  static void spoil(Job& job);
  void fetch_for(Job& job);
  bool plant(Fault fault);

  UnitParameters parameters_;
  Fault fault_;
  RegisterFile registers_;
  std::vector<uint8_t> stream_;
  std::unique_ptr<GoldenStream> golden_;
  std::unique_ptr<Oracle> oracle_;
  std::unique_ptr<BlockReads> reads_;
  Random random_{1};
  std::optional<uint64_t> chroma_;  // chroma_key of the latest request for RGB
  std::deque<Fetch> fetches_;
  unsigned outstanding_ = 0;  // bursts on their way
  std::deque<Job> jobs_;
  uint64_t answers_ = 0;
  UnitOutputs out_;
  bool address_held_ = false;  // of a register write
  bool data_held_ = false;
  bool wanted_ = false;  ///< no DISABLE has followed the latest LOAD
  uint32_t write_address_ = 0;
  uint32_t write_data_ = 0;
};

}  // namespace hmlfc::tb
