// Results as they come, so that an interrupted run can be resumed.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "conform/dut.hpp"
#include "conform/result.hpp"
#include "io/file_descriptor.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The file results.jsonl of a decoder's folder: a first line that says of which suite and decoder,
/// then a line for each result. A line that an interruption cut is passed over.
class ResultLog {
 public:
  /// Makes `folder` where it is missing. With `resume` the results of the file that is there are
  /// kept, but for skipped ones; else it begins anew. Errors: cannot write; with `resume`, results
  /// of another suite or decoder.
  static io::IoResult<ResultLog> open(const std::filesystem::path& folder,
                                      const std::string& manifest_sha256, const Dut& dut,
                                      bool resume);

  /// The result of an earlier run, or null.
  const VectorResult* earlier(const std::string& id) const;

  /// Errors: cannot write.
  io::IoResult<void> append(const VectorResult& result);

 private:
  ResultLog() = default;

  std::filesystem::path path_;
  io::FileDescriptor file_;
  std::map<std::string, VectorResult> earlier_;
};

}  // namespace hmlfc::conform
