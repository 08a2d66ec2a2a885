#include "session.hpp"

#include <fstream>
#include <iostream>

#include "exercise.hpp"

namespace hmlfc::stress {
namespace {

constexpr std::chrono::milliseconds kProgressPeriod{200};

void write_file(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

Ranges Session::run(const std::string& name, std::span<const uint8_t> file) {
  write_file(folder_ / "current.hmlfc", file);
  std::ofstream(folder_ / "current.txt") << name << '\n';
  const Outcome outcome = exercise(file, most_blocks_);
  ++streams_;
  blocks_ += outcome.blocks;
  if (!outcome.failure.empty()) {
    const auto stored = folder_ / ("finding-" + std::to_string(findings_.size()) + ".hmlfc");
    write_file(stored, file);
    findings_.push_back({name, outcome.failure, stored});
  }
  widths_.add(name, outcome.ranges);
  show_progress();
  return outcome.ranges;
}

void Session::add(const std::string& name, const Ranges& ranges) {
  widths_.add(name, ranges);
  if (const auto violation = take_violation()) findings_.push_back({name, *violation, {}});
}

// One line a while, which the driver shows.
void Session::show_progress() {
  const auto now = std::chrono::steady_clock::now();
  if (now - shown_ < kProgressPeriod) return;
  shown_ = now;
  std::cerr << streams_ << " streams, " << blocks_ << " blocks, " << findings_.size() << " findings"
            << std::endl;
}

vectors::Json Session::report() const {
  using vectors::Json;
  Json findings = Json::array();
  for (const Finding& finding : findings_) {
    findings.push_back(
        {{"stream", finding.stream}, {"what", finding.what}, {"stored", finding.stored.string()}});
  }
  return {
      {"streams", streams_}, {"blocks", blocks_}, {"findings", findings}, {"rows", widths_.rows()}};
}

}  // namespace hmlfc::stress
