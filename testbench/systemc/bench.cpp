#include "systemc/bench.hpp"

#include <algorithm>
#include <utility>

#include "stimulus/address_space.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kChunk = 64;            // clocks between looks at whether a run is over
constexpr uint64_t kHangClocks = 100'000;  // without a request, a record, a beat or an answer
constexpr uint64_t kMaxLoadClocks = 1'000'000;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

uint64_t align(uint64_t address, uint64_t to) { return (address + to - 1) / to * to; }

}  // namespace

Bench::Clock::Clock(const sc_core::sc_module_name& name, Wires& wires, std::unique_ptr<Unit>& unit)
    : sc_core::sc_module(name), wires_(wires), unit_(unit), period_(1, sc_core::SC_NS) {
  SC_HAS_PROCESS(Clock);
  SC_METHOD(tick);
  SC_METHOD(settle);
  sensitive << settled_;
  dont_initialize();
}

void Bench::Clock::tick() {
  wires_.edge.notify();
  settled_.notify(sc_core::SC_ZERO_TIME);
  next_trigger(period_);
}

void Bench::Clock::settle() {
  ++wires_.cycle;
  if (!unit_) return;
  unit_->clock(wires_.next, wires_.out);
  wires_.in = wires_.next;
  if (listener) listener(wires_.out);
}

Bench::Bench(const std::string& prefix)
    : clock_((prefix + "clock").c_str(), wires_, unit_),
      scoreboard_((prefix + "scoreboard").c_str(), findings_, coverage_),
      monitor_((prefix + "stream_monitor").c_str(), wires_, scoreboard_, findings_),
      driver_((prefix + "driver").c_str(), wires_),
      memory_((prefix + "memory").c_str(), wires_, findings_),
      registers_((prefix + "registers").c_str(), wires_, findings_) {}

void Bench::attach(std::unique_ptr<Unit> unit) {
  unit_ = std::move(unit);
  wires_.in = wires_.next = {};
  wires_.out = {};
  memory_.set_unit(unit_->parameters());
  traced_ = true;
  scoreboard_.expect_trace(true);
  scoreboard_.clear();
  findings_.begin(unit_->state_seed());
  reset();
}

void Bench::compare_answers_only() {
  traced_ = false;
  scoreboard_.expect_trace(false);
}

void Bench::set_image(const MemoryImage& image) {
  const MemoryImage before = std::exchange(image_, image);
  const unsigned beat_bytes = unit_->parameters().beat_bytes;
  if (places_) {
    AddressSpace space(places_->next());
    const auto place_of = [&](std::span<const uint8_t> bytes, uint64_t alignment, uint64_t behind) {
      return space.take(std::max<uint64_t>(bytes.size(), 1), alignment, behind);
    };
    image_.stream_base = place_of(image_.stream, AddressSpace::stream_alignment(beat_bytes),
                                  AddressSpace::read_behind(beat_bytes));
    image_.reference_base = place_of(image_.reference_area, kStripBytes, 0);
  } else if (keeps_places_) {
    image_.stream_base = before.stream_base;
    image_.reference_base = before.reference_base;
  } else if (image_.reference_base == 0) {
    const uint64_t stream_end =
        image_.stream_base + image_.stream.size() + AddressSpace::read_behind(beat_bytes);
    image_.reference_base = align(stream_end, 4096);
  }
  memory_.content = {};
  const auto add = [&](uint64_t base, std::span<const uint8_t> bytes) {
    memory_.content.add(base, std::max<size_t>(bytes.size(), 1));
    std::ranges::copy(bytes, memory_.content.at(base).begin());
  };
  add(image_.stream_base, image_.stream);
  add(image_.reference_base, image_.reference_area);
}

void Bench::draw_places(uint64_t seed) { places_.emplace(seed); }

void Bench::keep_places() {
  keeps_places_ = true;
  places_.reset();
}

void Bench::begin_faults(std::vector<FaultyRange> faults, const BlockReads& reads) {
  memory_.set_faults(std::move(faults));
  scoreboard_.allow_bus_errors([this, &reads](const Request& request) {
    return std::ranges::any_of(reads.of(request), [this](const ByteRange& range) {
      const uint64_t base = range.in_area ? image_.reference_base : image_.stream_base;
      return memory_.has_failed(base + range.begin, base + range.end);
    });
  });
}

void Bench::end_faults() {
  memory_.set_faults({});
  scoreboard_.allow_bus_errors(nullptr);
}

void Bench::run_clocks(uint64_t clocks) {
  sc_core::sc_start(static_cast<double>(clocks), sc_core::SC_NS);
}

void Bench::reset(unsigned clocks) {
  driver_.stop();
  wires_.next.rst_n = false;
  run_clocks(clocks);
  scoreboard_.on_reset();
  wires_.next.rst_n = true;
  run_clocks(1);
}

void Bench::write(uint32_t address, uint32_t value) {
  registers_.start_write(address, value);
  for (uint64_t i = 0; !registers_.done() && i < kHangClocks; ++i) run_clocks(1);
  if (!registers_.done()) {
    findings_.add({"registers: no response to a write", {}, std::to_string(address), {}, cycle()});
  }
}

uint32_t Bench::read(uint32_t address) {
  registers_.start_read(address);
  for (uint64_t i = 0; !registers_.done() && i < kHangClocks; ++i) run_clocks(1);
  if (registers_.done()) return registers_.value();
  findings_.add({"registers: no response to a read", {}, std::to_string(address), {}, cycle()});
  return 0;
}

uint64_t Bench::read_pair(uint32_t address) {
  const uint64_t low = read(address);
  return low | uint64_t{read(address + 4)} << 32;
}

std::optional<uint32_t> Bench::load() {
  reg::write_stream([&](uint32_t address, uint32_t word) { write(address, word); },
                    image_.stream_base, image_.stream.size(), image_.reference_base);
  scoreboard_.forget_chroma();
  write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
  const uint64_t begin = cycle();
  while (cycle() - begin < kMaxLoadClocks) {
    const uint32_t status = read(HMLFC_REG_STATUS);
    if (findings_.first()) return std::nullopt;
    if ((status & HMLFC_REG_STATUS_LOADING_MASK) == 0) return status;
  }
  findings_.add({"registers: LOAD does not end", {}, {}, {}, cycle()});
  return std::nullopt;
}

void Bench::start(RequestSource source, Oracle& oracle, const Conditions& conditions,
                  uint64_t seed) {
  scoreboard_.set_oracle(&oracle, unit_->parameters().block_size());
  coverage_.on_conditions(conditions);
  if (oracle.stream() != nullptr) coverage_.on_stream(oracle.stream()->header());
  memory_.start(conditions, seed ^ 1);
  registers_.set_seed(seed ^ 2);
  driver_.start(std::move(source), conditions, seed);
  moved_ = 0;
  moved_at_ = cycle();
}

bool Bench::busy() {
  if (findings_.first() || (driver_.done() && scoreboard_.in_flight() == 0)) return false;
  const ScoreCounts& counts = scoreboard_.counts();
  const uint64_t moves = counts.sent + counts.received + counts.records + memory_.bytes_read;
  if (moves != moved_) moved_at_ = cycle();
  moved_ = moves;
  return cycle() - moved_at_ <= kHangClocks;
}

void Bench::finish() {
  if (!findings_.first()) {
    run_clocks(kChunk);  // an answer too many shows up now
    scoreboard_.finish(cycle());
    if (!driver_.done() && !findings_.first()) {
      findings_.add({"requests: the unit takes no more", {}, {}, {}, cycle()});
    }
  }
  statistics_.clocks = stream_counts().last_answer - stream_counts().first_request;
  statistics_.bytes_read = memory_.bytes_read;
}

void Bench::run(RequestSource source, Oracle& oracle, const Conditions& conditions, uint64_t seed,
                uint64_t stop_after) {
  const double begin = cpu_seconds();
  const uint64_t begin_clock = cycle();
  start(std::move(source), oracle, conditions, seed);
  const auto stopped = [&] { return stop_after != 0 && cycle() - begin_clock >= stop_after; };
  while (!findings_.first()) {
    run_clocks(kChunk);
    if (stopped() || !busy()) break;
  }
  if (stop_after == 0) finish();
  statistics_.seconds += cpu_seconds() - begin;
}

void Bench::begin_counting() {
  write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_CLEAR_MASK);
  scoreboard_.clear();
  monitor_.clear_counts();
  memory_.read_bursts = memory_.bytes_read = 0;
  statistics_ = {};
}

void Bench::expect_counter(const char* name, uint64_t expected, uint64_t actual) {
  if (expected == actual) return;
  findings_.add({std::string("registers: ") + name,
                 {},
                 {},
                 "expected " + std::to_string(expected) + ", actual " + std::to_string(actual),
                 cycle()});
}

void Bench::check_settings() {
  const UnitParameters unit = unit_->parameters();
  expect_counter("ID", HMLFC_REG_ID_RESET, read(HMLFC_REG_ID));
  expect_counter("PARAMETERS", reg::parameters(unit.block_log2, unit.max_depth, unit.beat_bytes),
                 read(HMLFC_REG_PARAMETERS));
  expect_counter("STREAM_BASE", image_.stream_base, read_pair(HMLFC_REG_STREAM_BASE));
  expect_counter("STREAM_BYTES", image_.stream.size(), read_pair(HMLFC_REG_STREAM_BYTES));
  expect_counter("REFERENCE_BASE", image_.reference_base, read_pair(HMLFC_REG_REFERENCE_BASE));
}

void Bench::disable() {
  write(HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_DISABLE_MASK);
  expect_counter(
      "STATUS after DISABLE", 0,
      read(HMLFC_REG_STATUS) & (HMLFC_REG_STATUS_READY_MASK | HMLFC_REG_STATUS_LOADING_MASK));
}

void Bench::check_blocks() {
  const ScoreCounts& counts = scoreboard_.counts();
  const uint64_t most = counts.blocks + counts.blocks_uncertain;
  const uint64_t actual = read_pair(HMLFC_REG_BLOCKS);
  expect_counter("BLOCKS", std::clamp(actual, counts.blocks, most), actual);
  if (traced_) expect_counter("BLOCKS", counts.records, actual);
}

void Bench::check_counters() {
  const ScoreCounts& counts = scoreboard_.counts();
  expect_counter("REQUESTS", counts.received, read_pair(HMLFC_REG_REQUESTS));
  expect_counter("STALLS", stream_counts().answer_stalls, read_pair(HMLFC_REG_STALLS));
  expect_counter("BYTES_READ", memory_.bytes_read, read_pair(HMLFC_REG_BYTES_READ));
  expect_counter("CYCLES", stream_counts().busy, read_pair(HMLFC_REG_CYCLES));
  expect_counter("ERROR", counts.first_error, read(HMLFC_REG_ERROR));
  expect_counter("ERROR_ADDRESS", counts.first_error_request, read_pair(HMLFC_REG_ERROR_ADDRESS));
  check_blocks();
  expect_counter("STATUS idle", HMLFC_REG_STATUS_IDLE_MASK,
                 read(HMLFC_REG_STATUS) & HMLFC_REG_STATUS_IDLE_MASK);
}

}  // namespace hmlfc::tb
