// A run of the stress program: streams in, what they reached and what was wrong out.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "vectors/json.hpp"
#include "width_report.hpp"

namespace hmlfc::stress {

/// A stream that does what it must not.
struct Finding {
  std::string stream;            ///< its name
  std::string what;              ///< and where
  std::filesystem::path stored;  ///< where its bytes are; empty where there are none
};

/// Exercises streams one after another. Before each, its bytes are stored in `folder` as
/// current.hmlfc and its name in current.txt, so that they are there even when the program is ended
/// by a check of the compiler.
class Session {
 public:
  Session(std::filesystem::path folder, uint64_t most_blocks)
      : folder_(std::move(folder)), most_blocks_(most_blocks) {}

  /// What the stream reached. A finding is kept.
  Ranges run(const std::string& name, std::span<const uint8_t> file);

  /// Takes in what `name` reached, where that is no stream to decode. A value that left its
  /// interval is a finding without stored bytes.
  void add(const std::string& name, const Ranges& ranges);

  /// Counts, findings, and for each place of the table what was reached and by which stream.
  vectors::Json report() const;

 private:
  void show_progress();

  std::filesystem::path folder_;
  uint64_t most_blocks_;
  uint64_t streams_ = 0;
  uint64_t blocks_ = 0;
  std::vector<Finding> findings_;
  WidthReport widths_{WidthTable::kStreams};
  std::chrono::steady_clock::time_point shown_{};
};

}  // namespace hmlfc::stress
