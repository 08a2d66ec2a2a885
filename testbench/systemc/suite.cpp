#include "systemc/suite.hpp"

#include "stimulus/random_stream.hpp"
#include "stimulus/sequences.hpp"
#include "syntax/header.hpp"
#include "systemc/failure_folder.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kRequests = 400;
constexpr unsigned kBadPermille = 50;
constexpr unsigned kResidualsPermille = 80;
constexpr size_t kHistory = 128;
constexpr uint64_t kDisabledClocks = 200;
constexpr unsigned kWrongHeaders = 24;

// The steps of one case.
class CaseRun {
 public:
  CaseRun(Bench& bench, StreamImage& image, uint64_t seed)
      : bench_(bench), image_(image), random_(seed) {}

  void run() {
    const bool steps_passed = load() && !image_.left_to_software() && directed() && mixed(0) &&
                              wrong_headers() && mixed(0) && reset_in_flight() && load() &&
                              mixed(0) && faulty_memory() && mixed(0) && faulty_section() &&
                              mixed(0) && disabled() && other_stream() && mixed(0) && counters();
    static_cast<void>(steps_passed);
    total_ += bench_.scoreboard().counts();
  }

  /// The counts of all steps.
  const ScoreCounts& total() const { return total_; }
  std::vector<Request> history() const { return recorded_.history(); }

 private:
  bool good() { return !bench_.findings().first(); }

  bool load() {
    bench_.end_faults();
    image_.load_into(bench_);
    total_ += bench_.scoreboard().counts();
    bench_.begin_counting();
    bench_.check_settings();
    return good();
  }

  void send(RequestSource source, uint64_t stop_after) {
    bench_.run(recorded_.record(std::move(source)), image_.oracle(),
               random_conditions(random_.next()), random_.next(), stop_after);
    if (stop_after == 0 && good()) bench_.check_blocks();
  }

  bool directed() {
    if (image_.golden() == nullptr) {
      send(listed_requests({{}, {1, 2, 3, 4, kRgb, 0, true}, {0, 0, 0, 0, 1, 15, false}}), 0);
      return good();
    }
    const Geometry& geometry = image_.golden()->geometry();
    const StreamHeader& header = image_.golden()->header();
    send(listed_requests(border_requests(geometry, header)), 0);
    if (good()) send(listed_requests(bad_requests(geometry, header)), 0);
    return good();
  }

  bool mixed(uint64_t stop_after) {
    if (image_.golden() != nullptr) {
      const auto mixed = mixed_requests(image_.golden()->geometry(), image_.golden()->header(),
                                        kRequests, random_.next(), kBadPermille);
      send(with_residuals(mixed, random_.next(), kResidualsPermille), stop_after);
    }
    return good();
  }

  bool reset_in_flight() {
    mixed(64 + random_.below(300));
    if (bench_.scoreboard().in_flight() != 0) bench_.coverage().hit(Point::kResetInFlight);
    bench_.reset(1 + random_.below(8));
    return good();
  }

  // Errors on a part of the memory, then none: what was asked for in between may be bus_error where
  // it met one, what is asked for afterwards may not.
  bool faulty_memory() {
    if (image_.golden() == nullptr) return good();
    const MemoryImage& image = bench_.image();
    const uint64_t at = random_.below(image.stream.size() + image.reference_area.size());
    const uint64_t begin = at < image.stream.size()
                               ? image.stream_base + at
                               : image.reference_base + at - image.stream.size();
    faults({begin, begin + 16 + random_.below(4096), static_cast<uint8_t>(random_.within(2, 3))});
    return good();
  }

  // The same on one section of the index or the records, whole, right after LOAD: the unit holds
  // nothing of it yet, and may keep nothing of what comes with an error.
  bool faulty_section() {
    if (image_.golden() == nullptr) return good();
    if (!load()) return false;
    const auto& section = image_.golden()->header().sections[random_.within(1, 3)];
    const uint64_t begin = bench_.image().stream_base + section.offset;
    faults({begin, begin + section.size, static_cast<uint8_t>(random_.within(2, 3))});
    return good();
  }

  // Random requests while `range` is faulty.
  void faults(FaultyRange range) {
    const BlockReads reads(*image_.golden());
    bench_.begin_faults({range}, reads);
    mixed(0);
    bench_.end_faults();
    // After one request for RGB it is known whether the unit holds chroma. No other request for the
    // same block may follow at once: its records could not be told from those of this one.
    if (good()) send(listed_requests({{0, 0, 0, 0, kRgb, 0, true}}), 0);
  }

  // LOADs of the same stream with a wrong header: each is refused as the model refuses it.
  bool wrong_headers() {
    const auto stream = image_.memory().stream;
    if (!parse_header(stream)) return good();
    for (unsigned i = 0; i < kWrongHeaders && good(); ++i) {
      std::vector<uint8_t> bytes(stream.begin(), stream.end());
      const Damage damage = i == 0                ? Damage::kVersion
                            : i == 1              ? Damage::kProfile
                            : random_.chance(800) ? Damage::kHeaderField
                            : random_.chance(500) ? Damage::kHeaderByte
                                                  : Damage::kCut;
      corrupt(bytes, damage, random_.next());
      StreamImage(bytes, bench_.unit().parameters()).load_into(bench_);
    }
    return good() && load();
  }

  // From DISABLE on requests wait; the next LOAD lets the one that waits in.
  bool disabled() {
    if (image_.golden() == nullptr) return good();
    bench_.disable();
    const uint64_t sent = bench_.scoreboard().counts().sent;
    const RequestSource source =
        recorded_.record(mixed_requests(image_.golden()->geometry(), image_.golden()->header(),
                                        kRequests / 4, random_.next(), kBadPermille));
    const uint64_t seed = random_.next();
    bench_.run(source, image_.oracle(), {}, seed, kDisabledClocks);
    if (bench_.scoreboard().counts().sent != sent) {
      bench_.findings().add({"protocol: request taken after DISABLE", {}, {}, {}, bench_.cycle()});
    }
    bench_.coverage().hit(Point::kDisabled);
    image_.load_into(bench_);
    if (good()) bench_.run(source, image_.oracle(), {}, seed);
    return good();
  }

  // Another stream in the same life of the unit, then this one again: nothing of either is left.
  bool other_stream() {
    const UnitParameters unit = bench_.unit().parameters();
    const auto bytes = suite_stream(random_.below(1000), unit.block_size());
    StreamImage other(bytes, unit);
    if (image_.golden() == nullptr || other.golden() == nullptr) return good();
    other.load_into(bench_);
    const auto mixed = mixed_requests(other.golden()->geometry(), other.golden()->header(),
                                      kRequests, random_.next(), kBadPermille);
    bench_.run(recorded_.record(mixed), other.oracle(), random_conditions(random_.next()),
               random_.next());
    return good() && load();
  }

  bool counters() {
    if (good()) bench_.check_counters();
    return good();
  }

  Bench& bench_;
  StreamImage& image_;
  Random random_;
  ScoreCounts total_;
  RecordedSource recorded_{kHistory};
};

}  // namespace

SuiteResult run_case(Bench& bench, const UnitMaker& maker, StreamImage& image, uint64_t seed) {
  bench.attach(maker.make(maker.parameters.with_state(seed), nullptr));
  bench.draw_places(seed);
  CaseRun run(bench, image, seed);
  run.run();
  return {run.total(), bench.findings().first(), run.history()};
}

}  // namespace hmlfc::tb
