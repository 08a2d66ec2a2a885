// A run of stress_streams: takes streams, reports what they reached and what was wrong.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "vectors/json.hpp"
#include "width_record.hpp"

namespace hmlfc::stress {

/// Exercises streams one after another. Before each, stores its bytes in `folder` as current.hmlfc
/// and its name in current.txt, so that they survive when a check of the compiler ends the program.
class Session {
 public:
  Session(std::filesystem::path folder, uint64_t max_blocks)
      : folder_(std::move(folder)), max_blocks_(max_blocks) {}

  /// Opens `file` and decodes up to `max_blocks` blocks one by one, spread over views and planes
  /// and at all stop levels, with reference images on demand and kept and as a part of its plane;
  /// then all views. Returns what the stream reached. Findings are values outside their interval
  /// and conversions that lose their value; they are kept with the stream. Errors of opening and
  /// decoding are defined, and no findings.
  Ranges run(const std::string& name, std::span<const uint8_t> file);

  /// Takes in what `name`, which is no stream, reached. A value that left its interval is a finding
  /// without stored bytes.
  void add(const std::string& name, const Ranges& ranges);

  /// Counts, findings, and for each place of the table what was reached and by which stream.
  vectors::Json report() const;

 private:
  std::filesystem::path folder_;
  uint64_t max_blocks_;
  uint64_t streams_ = 0;
  uint64_t blocks_ = 0;
  vectors::Json findings_ = vectors::Json::array();  // {"stream", "what", "stored"}
  WidthReport widths_{WidthTable::kStreams};
};

}  // namespace hmlfc::stress
