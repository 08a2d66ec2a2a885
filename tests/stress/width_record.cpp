#include "width_record.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string_view>
#include <utility>

namespace hmlfc {
namespace stress {
namespace {

// One place of the table, filled by several threads.
struct Slot {
  std::atomic<int64_t> min{INT64_MAX};
  std::atomic<int64_t> max{INT64_MIN};
};

struct Record {
  std::array<std::array<std::array<Slot, 2>, kDepths>, kRows> slots;
  std::mutex lock;
  std::optional<std::string> violation;

  void report(std::string text) {
    const std::lock_guard guard(lock);
    if (!violation) violation = std::move(text);
  }
};

Record& record() {
  static Record instance;
  return instance;
}

void lower(std::atomic<int64_t>& min, int64_t value) {
  int64_t now = min.load(std::memory_order_relaxed);
  while (value < now && !min.compare_exchange_weak(now, value, std::memory_order_relaxed)) {
  }
}

void raise(std::atomic<int64_t>& max, int64_t value) {
  int64_t now = max.load(std::memory_order_relaxed);
  while (value > now && !max.compare_exchange_weak(now, value, std::memory_order_relaxed)) {
  }
}

// "model/arithmetic/reconstruct.hpp:34": the path within the project.
std::string line_of(const std::source_location& where) {
  const std::string_view file = where.file_name();
  const size_t at = file.rfind("model/");
  return std::string(at == std::string_view::npos ? file : file.substr(at)) + ":" +
         std::to_string(where.line());
}

}  // namespace

void Reached::add(const Reached& other) {
  min = std::min(min, other.min);
  max = std::max(max, other.max);
}

std::vector<Place> places(WidthTable table) {
  std::vector<Place> all;
  for (size_t row = 0; row < kRows; ++row) {
    if (kWidthRows[row].table != table) continue;
    for (size_t depth = 0; depth < (kWidthRows[row].by_depth ? kDepths : 1); ++depth) {
      for (size_t plane = 0; plane < (kWidthRows[row].by_plane ? 2u : 1u); ++plane) {
        all.push_back({row, depth, plane});
      }
    }
  }
  return all;
}

WidthInterval limits_of(const Place& place) {
  return kWidthRows[place.row].limits[place.depth][place.plane];
}

Ranges take_ranges() {
  Ranges ranges;
  for (const WidthTable table : {WidthTable::kStreams, WidthTable::kFrames}) {
    for (const Place& place : places(table)) {
      Slot& slot = record().slots[place.row][place.depth][place.plane];
      ranges.at(place) = {slot.min.exchange(INT64_MAX), slot.max.exchange(INT64_MIN)};
    }
  }
  return ranges;
}

std::optional<std::string> take_violation() {
  const std::lock_guard guard(record().lock);
  return std::exchange(record().violation, std::nullopt);
}

void WidthReport::add(const std::string& name, const Ranges& ranges) {
  for (size_t i = 0; i < places_.size(); ++i) {
    const Reached& reached = ranges.at(places_[i]);
    Record& record = records_[i];
    if (reached.min < record.reached.min) record.min_by = name;
    if (reached.max > record.reached.max) record.max_by = name;
    record.reached.add(reached);
  }
}

vectors::Json WidthReport::rows() const {
  using vectors::Json;
  Json rows = Json::array();
  for (size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const Record& record = records_[i];
    const WidthRow& row = kWidthRows[place.row];
    const WidthInterval limits = limits_of(place);
    Json json{{"quantity", row.quantity},
              {"clause", row.clause},
              {"depth", row.by_depth ? Json(place.depth + kMinDepth) : Json()},
              {"plane", row.by_plane ? Json(place.plane == 0 ? "Y" : "Co, Cg") : Json()},
              {"proved", {row.one_value ? limits.hi : limits.lo, limits.hi}}};
    if (record.reached.any()) {
      json["reached"] = {record.reached.min, record.reached.max};
      json["by"] = {record.min_by, record.max_by};
    }
    rows.push_back(std::move(json));
  }
  return rows;
}

}  // namespace stress

void note_value(const WatchedValue& watched) {
  using namespace stress;
  const WidthRow& row = kWidthRows[watched.row];
  const size_t depth = row.by_depth ? static_cast<size_t>(watched.depth - kMinDepth) : 0;
  const size_t plane = row.by_plane && watched.chroma ? 1 : 0;
  Slot& slot = record().slots[watched.row][depth][plane];
  lower(slot.min, watched.value);
  raise(slot.max, watched.value);
  const WidthInterval limits = row.limits[depth][plane];
  if (watched.value >= limits.lo && watched.value <= limits.hi) return;
  record().report(std::string(row.quantity) + " is " + std::to_string(watched.value) +
                  ", outside [" + std::to_string(limits.lo) + ", " + std::to_string(limits.hi) +
                  "]" + (row.by_depth ? " at depth " + std::to_string(watched.depth) : "") +
                  ", at " + line_of(watched.where));
}

void note_lossy(const std::source_location& where) {
  stress::record().report("a conversion loses its value at " + stress::line_of(where));
}

}  // namespace hmlfc
