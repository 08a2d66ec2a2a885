// What is kept of a failure: a folder with the message, both traces and a wave of the block alone.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "systemc/stream_image.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {

/// Everything needed to repeat the block in which a run failed.
struct Failure {
  Mismatch mismatch;
  std::vector<Request> history;  ///< requests before and around the failing one, oldest first
  std::string replay;            ///< the command that repeats the whole run
  std::string id;                ///< name of the folder
};

/// Keeps the last requests of a source.
class RecordedSource {
 public:
  explicit RecordedSource(size_t kept) : kept_(kept) {}

  /// `source`, recorded. This object must outlive it.
  RequestSource record(RequestSource source);

  /// The last requests that were asked for, oldest first.
  std::vector<Request> history() const { return {last_.begin(), last_.end()}; }

 private:
  size_t kept_;
  std::deque<Request> last_;
};

/// Repeats the failing block alone in a fresh unit of `maker`, or, if it does not fail alone, with
/// its history, and writes into `root`/failure/`id`: message.txt, model.txt, unit.txt, and wave.fst
/// from units that have waves.
/// `bench` is left with that unit. Returns the folder.
std::filesystem::path keep_failure(Bench& bench, const UnitMaker& maker, StreamImage& image,
                                   const Failure& failure, const std::filesystem::path& root);

}  // namespace hmlfc::tb
