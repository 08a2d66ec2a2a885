#include "suite.hpp"

#include "bits/crc32c.hpp"
#include "failure_folder.hpp"
#include "fields/header.hpp"
#include "sequences.hpp"
#include "support/test_light_fields.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kRequests = 400;
constexpr unsigned kBadPermille = 50;
constexpr size_t kCrcBytes = 4;
constexpr size_t kHistory = 128;

// Changes bytes of [begin, end) of `bytes`, about one in `spacing`, at least one.
void change_bytes(std::vector<uint8_t>& bytes, uint64_t begin, uint64_t end, uint64_t spacing,
                  Random& random) {
  if (begin >= end) return;
  const uint64_t count = 1 + (end - begin) / spacing;
  for (uint64_t i = 0; i < count; ++i) {
    bytes[static_cast<size_t>(begin + random.below(end - begin))] ^=
        static_cast<uint8_t>(1u << random.below(8));
  }
}

void repair_header_crc(std::vector<uint8_t>& bytes, size_t header_bytes) {
  const uint32_t crc = crc32c(std::span(bytes).first(header_bytes - kCrcBytes));
  for (size_t i = 0; i < kCrcBytes; ++i) {
    bytes[header_bytes - kCrcBytes + i] = static_cast<uint8_t>(crc >> (8 * i));
  }
}

// The steps of one case.
class CaseRun {
 public:
  CaseRun(Bench& bench, StreamImage& image, uint64_t seed)
      : bench_(bench), image_(image), random_(seed) {}

  void run() {
    const bool steps_passed = load() && directed() && mixed(0) && reset_in_flight() && load() &&
                              mixed(0) && faulty_memory() && mixed(0) && counters();
    static_cast<void>(steps_passed);
    total_ += bench_.scoreboard().counts();
  }

  /// Of all steps.
  const ScoreCounts& total() const { return total_; }
  std::vector<Request> history() const { return recorded_.history(); }

 private:
  bool good() { return !bench_.findings().first(); }

  bool load() {
    bench_.memory().set_faults({});
    bench_.scoreboard().allow_bus_errors(false);
    image_.load_into(bench_);
    total_ += bench_.scoreboard().counts();
    bench_.begin_counting();
    return good();
  }

  void send(RequestSource source, uint64_t stop_after) {
    bench_.run(recorded_.record(std::move(source)), image_.oracle(),
               random_conditions(random_.next()), random_.next(), stop_after);
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
      send(mixed_requests(image_.golden()->geometry(), image_.golden()->header(), kRequests,
                          random_.next(), kBadPermille),
           stop_after);
    }
    return good();
  }

  bool reset_in_flight() {
    mixed(64 + random_.below(300));
    if (bench_.scoreboard().in_flight() != 0) bench_.coverage().hit(Point::kResetInFlight);
    bench_.reset(1 + random_.below(8));
    return good();
  }

  // Errors on a part of the memory, then none: what was asked for in between may be bus_error, what
  // is asked for afterwards may not.
  bool faulty_memory() {
    const uint64_t base = bench_.image().stream_base;
    const uint64_t end = bench_.image().reference_base + bench_.image().reference_area.size();
    const uint64_t begin = base + random_.below(end - base);
    bench_.memory().set_faults(
        {{begin, begin + 16 + random_.below(4096), static_cast<uint8_t>(random_.within(2, 3))}});
    bench_.scoreboard().allow_bus_errors(true);
    mixed(0);
    bench_.memory().set_faults({});
    bench_.scoreboard().allow_bus_errors(false);
    return good();
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

std::vector<uint8_t> suite_stream(uint32_t seed, unsigned block_size) {
  auto made = test::random_case_of_any_profile(seed);
  made.params.block_size = block_size;
  made.params.threads = 1;
  return encode(test::textured_light_field(made.shape, seed, made.noise), made.params)->bytes;
}

Damage suite_damage(uint32_t seed) {
  constexpr std::array kDamages{Damage::kNone,      Damage::kIndexAndTiles, Damage::kNone,
                                Damage::kKeyImages, Damage::kNone,          Damage::kHeaderField,
                                Damage::kNone,      Damage::kIndexAndTiles, Damage::kNone,
                                Damage::kCut,       Damage::kNone,          Damage::kHeaderByte};
  // Seeds alternate between the profiles; so do the damages of each profile.
  return kDamages[(seed / 2 + seed % 2) % kDamages.size()];
}

void spoil(std::vector<uint8_t>& stream, Damage damage, uint64_t seed) {
  Random random(seed);
  const auto header = parse_header(stream);
  if (!header) return;
  const size_t header_bytes = header_size(header->tree_height);
  const auto& top = header->sections[0];
  switch (damage) {
    case Damage::kNone:
      return;
    case Damage::kIndexAndTiles:
      change_bytes(stream, top.offset + top.size, stream.size(), 300, random);
      return;
    case Damage::kKeyImages: {
      const uint64_t table = Geometry(*header).key_count() * kPlaneCount * kTopEntryBytes;
      change_bytes(stream, top.offset + table, top.offset + top.size, 3000, random);
      return;
    }
    case Damage::kHeaderField:
      change_bytes(stream, 12, header_bytes - kCrcBytes, 1000, random);
      repair_header_crc(stream, header_bytes);
      return;
    case Damage::kHeaderByte:
      change_bytes(stream, 0, header_bytes, 1000, random);
      return;
    case Damage::kCut:
      stream.resize(random.below(stream.size()));
  }
}

SuiteResult run_case(Bench& bench, const UnitMaker& maker, StreamImage& image, uint64_t seed) {
  bench.attach(maker.make(maker.parameters));
  CaseRun run(bench, image, seed);
  run.run();
  return {run.total(), bench.findings().first(), run.history()};
}

}  // namespace hmlfc::tb
