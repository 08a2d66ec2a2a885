// Sequences of requests, directed and random by seed.
#pragma once

#include <memory>
#include <vector>

#include "oracle/request.hpp"
#include "stimulus/conditions.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc::tb {

/// Blocks (bx, by) of a grid of `columns` x `rows` blocks in view scan order: macro rows 4 tiles of
/// 8 x 8 blocks high; in them squares of 2 x 2 tiles, column by column, top square first; in a
/// square its tiles row by row; in a tile its quads row by row; in a quad its blocks row by row.
class ScanOrder {
 public:
  ScanOrder(uint32_t columns, uint32_t rows) : columns_(columns), rows_(rows) {}

  struct Block {
    uint32_t bx, by;
  };

  /// The next block, or nothing after the last.
  std::optional<Block> next();

 private:
  uint32_t columns_;
  uint32_t rows_;
  uint64_t at_ = 0;  // a place in the order of a grid rounded up to macro rows and squares
};

/// Which blocks of a stream to ask for.
struct ScanPlan {
  uint64_t views = 1;     ///< number of views, drawn by the seed; at most all
  unsigned plane = kRgb;  ///< [0, 3]
  unsigned stop_level = 0;
  double fraction = 1;        ///< share of the blocks, drawn by the seed; (0, 1]
  bool random_order = false;  ///< each request draws a view and a block
  uint64_t seed = 0;
};

/// The requests of `plan`; `geometry` must outlive the source. With random_order as many as the
/// scan would have.
RequestSource scan_requests(const Geometry& geometry, const StreamHeader& header,
                            const ScanPlan& plan);

/// `count` requests of all kinds by `seed`: walks over neighbours, jumps, repeats, every plane and
/// level, and bad requests of `bad` permille.
RequestSource mixed_requests(const Geometry& geometry, const StreamHeader& header, uint64_t count,
                             uint64_t seed, unsigned bad);

/// `source` with `permille` of its requests turned by `seed` into requests for residuals.
RequestSource with_residuals(RequestSource source, uint64_t seed, unsigned permille);

/// Requests that were written down.
RequestSource listed_requests(std::vector<Request> requests);

/// Every corner and border block of the first, middle and last view, on every plane and level.
std::vector<Request> border_requests(const Geometry& geometry, const StreamHeader& header);

/// One request of each kind that must be refused with bad_request.
std::vector<Request> bad_requests(const Geometry& geometry, const StreamHeader& header);

/// Conditions by seed: each kind of stall is on in half of the cases, latency in [0, 200].
Conditions random_conditions(uint64_t seed);

}  // namespace hmlfc::tb
