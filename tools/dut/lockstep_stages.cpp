// The stages of a device: pairs its records with those that the golden model expects.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "dut/lockstep.hpp"

namespace hmlfc::lockstep {
namespace {

std::string stage_names(unsigned shown) {
  std::string names;
  for (size_t i = 0; i < kStageNames.size(); ++i) {
    if ((shown >> i & 1) != 0) names += (names.empty() ? "" : ", ") + std::string(kStageNames[i]);
  }
  return names.empty() ? "none" : names;
}

}  // namespace

// Records that the device may leave out.
void Lockstep::allow_held_chroma(Pending& pending) {
  const Expectation& expected = pending.expected;
  Request chroma = pending.request;
  bool held = false;
  if (chroma.plane == kRgb && model_->status() == 0) {
    const unsigned shift = model_->header().chroma_format == ChromaFormat::k420 ? 1 : 0;
    chroma.block_x >>= shift;
    chroma.block_y >>= shift;
    held = device_.held_chroma && held_chroma_ == chroma;
    held_chroma_ = chroma;
  }
  for (ExpectedRecord& record : pending.expected.records) {
    record.may_miss =
        expected.status != 0 || !device_.every_stage || (held && record.site.plane != Plane::kY);
  }
}

// The first record of the site that is due; of those that may be left out only where no other is.
std::pair<Lockstep::Pending*, ExpectedRecord*> Lockstep::find_record(const BlockSite& site) {
  for (const bool may_miss : {false, true}) {
    for (Pending& pending : pending_) {
      for (ExpectedRecord& record : pending.expected.records) {
        if (!record.seen && record.may_miss == may_miss && record.site == site) {
          return {&pending, &record};
        }
      }
    }
  }
  return {nullptr, nullptr};
}

void Lockstep::record(int64_t clock, const Record& record) {
  ++records_;
  if (!device_.shows_stages() || !stream_skipped_.empty()) {
    ++skipped_[device_.shows_stages() ? stream_skipped_ : "stage records (no stages)"];
    return;
  }
  if (const auto [pending, expected] = find_record(record.site); expected != nullptr) {
    expected->seen = true;
    if (device_.bus_errors && record.error == kBusError) {
      ++skipped_["stage records of bus_error (bus_errors true)"];
    } else if (const auto difference = compare(*expected, record)) {
      report(clock, pending, *difference);
    }
    return;
  }
  if (of_failed_block(clock, record)) return;
  const auto is_skipped = [](const Pending& pending) { return !pending.skipped.empty(); };
  if (std::ranges::any_of(pending_, is_skipped)) {
    ++skipped_["stage records of no request that is compared"];
    return;
  }
  report(clock, nullptr,
         {"stage: extra",
          "  place      " + to_string(record.site) + "\n" +
              expected_actual("no record, or an earlier one: no request in flight needs it",
                              "error " + status_text(record.error))});
}

std::optional<Lockstep::Difference> Lockstep::compare(const ExpectedRecord& expected,
                                                      const Record& record) {
  ++records_compared_;
  const std::string place = "  place      " + to_string(expected.site);
  if (record.error != 0) {
    return Difference{"stage: error",
                      place + "\n" + expected_actual("no error", status_text(record.error)),
                      &expected.site};
  }
  unsigned has = 0;
  unsigned shows = 0;
  for (size_t i = 0; i < kStageNames.size(); ++i) {
    has |= (expected.stages[i] ? 1u : 0u) << i;
    shows |= (device_.stages[i] ? 1u : 0u) << i;
  }
  if (((has ^ record.shown) & shows) != 0) {
    return Difference{"stage: kind of block",
                      place + " (DEC-3)\n" +
                          expected_actual("stages " + stage_names(has & shows),
                                          "stages " + stage_names(record.shown & shows)),
                      &expected.site};
  }
  for (size_t i = 0; i < kStageNames.size(); ++i) {
    if (!expected.stages[i]) continue;
    if (!device_.stages[i]) {
      ++skipped_[fmt::format("values of stage {} (not in stages)", kStageNames[i])];
      continue;
    }
    ++stages_compared_[i];
    const Stage& stage = *expected.stages[i];
    auto difference = compare_values(stage.values, record.values[i], 0, expected.inside);
    if (!difference) continue;
    difference->rule = fmt::format("stage: {}", kStageNames[i]);
    difference->detail =
        fmt::format("{}, stage {} ({}){}", place, kStageNames[i], stage.clause, difference->detail);
    difference->site = &expected.site;
    return difference;
  }
  return std::nullopt;
}

// Whether the record is of a request that is refused, or of a level at or below an error.
bool Lockstep::of_failed_block(int64_t clock, const Record& record) {
  if (record.error == 0) return false;
  for (const Pending& pending : pending_) {
    const Expectation& expected = pending.expected;
    bool fails = expected.status != 0 && expected.records.empty() && expected.failed.empty();
    int status = expected.status;
    for (const FailedBlock& block : expected.failed) {
      if (block.site.plane != record.site.plane || block.site.bx != record.site.bx ||
          block.site.by != record.site.by) {
        continue;
      }
      fails = true;
      status = block.status;
    }
    if (!fails && !(device_.bus_errors && record.error == kBusError)) continue;
    if (fails && status != record.error && !(device_.bus_errors && record.error == kBusError)) {
      report(clock, &pending,
             {"stage: error", "  place      " + to_string(record.site) + "\n" +
                                  expected_actual(status_text(status), status_text(record.error))});
    } else {
      ++skipped_["stage records of blocks with an error"];
    }
    return true;
  }
  return false;
}

void Lockstep::close_records(int64_t clock, Pending& pending) {
  for (const ExpectedRecord& record : pending.expected.records) {
    if (record.seen) continue;
    if (record.may_miss) {
      ++held_;
      continue;
    }
    report(clock, &pending,
           {"stage: missing",
            "  place      " + to_string(record.site) + "\n" +
                expected_actual("a record before the answer", "none"),
            &record.site});
    return;
  }
}

}  // namespace hmlfc::lockstep
