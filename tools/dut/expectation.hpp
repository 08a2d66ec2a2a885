// What the golden model says of a request: status, samples, stages.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "io/files.hpp"

namespace hmlfc::lockstep {

inline constexpr int kRgb = 3;  ///< a request for all planes
inline constexpr size_t kLanes = 3;

/// As the device took it.
struct Request {
  int row = 0;
  int col = 0;
  int plane = 0;  ///< 0 Y, 1 Co, 2 Cg, 3 RGB
  int block_x = 0;
  int block_y = 0;
  int stop_level = 0;  ///< the level s of DEC-1

  friend bool operator==(const Request&, const Request&) = default;
};

/// Columns and rows of a block that lie in its plane, [1, B]: others have no meaning (STR-6).
struct Inside {
  unsigned x = 0;
  unsigned y = 0;
};

/// The values of a stage, row by row.
struct Stage {
  std::string_view clause;
  std::vector<int32_t> values;
};

/// A block at a level that has decoded; stages in the order of kStageNames, where it has them.
struct ExpectedRecord {
  BlockSite site;
  Inside inside;
  std::array<std::optional<Stage>, 4> stages;
  bool may_miss = false;
  bool seen = false;
};

/// A block of one plane with an error: its records from the failed level on are not known.
struct FailedBlock {
  BlockSite site;  ///< only plane and block
  int status = 0;
};

struct Expectation {
  int status = 0;
  Inside inside;
  std::vector<int32_t> samples;  ///< lanes of B * B, as many as the request has; none with an error
  std::vector<ExpectedRecord> records;
  std::vector<FailedBlock> failed;
};

/// The golden model with one stream, which may be refused: every request is answered with its error
/// then.
class Model {
 public:
  /// Error: the file cannot be read.
  static io::IoResult<std::unique_ptr<Model>> open(const std::string& path, bool checks_sections);

  /// The error of the whole stream, or 0.
  int status() const { return status_; }

  /// Of a stream that was not refused.
  const StreamHeader& header() const { return decoder_->header(); }

  /// With `records`, those of all stages.
  Expectation expect(const Request& request, bool records) const;

 private:
  Expectation plane_block(const Request& request, const BlockAddress& block, bool records) const;
  std::vector<BlockAddress> blocks(const Request& request) const;
  void fill_rgb(const Request& request, Expectation& expected) const;

  std::optional<MappedFile> file_;
  std::optional<Decoder> decoder_;
  int status_ = 0;
};

/// "level 2 image 3,4 plane Y block 1,2".
std::string to_string(const BlockSite& site);

}  // namespace hmlfc::lockstep
