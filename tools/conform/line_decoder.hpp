// A decoder under test that speaks the line protocol (docs/line_protocol.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>

#include "conform/process.hpp"
#include "conform/result.hpp"

namespace hmlfc::conform {

/// The protocol's version, which `hello` names.
inline constexpr int kLineProtocol = 1;

/// Bytes of the longest line, its end included, but for answers with the samples of a view.
inline constexpr size_t kLineBytes = 4096;

/// Lines of the longest trace: the five stages of 16 levels, and the block itself.
inline constexpr size_t kTraceLines = 81;

/// Thrown where a decoder does not answer as the protocol says; it cannot be asked any more.
struct LineFailure {
  Status status = Status::kError;
  std::string reason;      ///< names the request
  std::string messages{};  ///< the end of standard error of a process that ended
};

/// An answer, or the name of the error that the decoder gave.
template <class T>
using LineAnswer = tl::expected<T, std::string>;

/// One process, for one stream after the other. All functions that ask throw LineFailure.
class LineDecoder {
 public:
  /// Starts `command` and greets it.
  LineDecoder(const std::vector<std::string>& command, const ProcessLimits& limits);
  LineDecoder(const LineDecoder&) = delete;
  LineDecoder& operator=(const LineDecoder&) = delete;
  /// Ends its input, and kills it if it does not end then.
  ~LineDecoder();

  /// From now on `seconds` remain for all that is asked.
  void allow(double seconds);

  // What it can do.
  bool views() const { return can("view"); }
  bool blocks() const { return can("block"); }
  bool traces() const { return can("trace"); }
  bool levels() const { return can("levels"); }  ///< stop levels other than 0

  /// Opens a stream, which answers of the other functions are about; none is open.
  LineAnswer<hmlfc_dut_geometry> open(const std::filesystem::path& file);
  LineAnswer<RgbImage> view(ViewPos view);
  /// B * B samples.
  LineAnswer<std::vector<int32_t>> block(const BlockAddress& block, int stop_level);
  /// The stages of a block, a JSON object a line.
  LineAnswer<std::string> trace(const BlockAddress& block, int stop_level);
  void close();

  /// The end of what it wrote on standard error since the last call.
  std::string take_messages() { return process_.take_messages(); }

 private:
  bool can(std::string_view ability) const;
  void greet();
  std::string line(const std::string& request, std::string_view sent, size_t bytes);
  LineAnswer<std::string> ask(const std::string& request, size_t bytes = kLineBytes);
  LineAnswer<std::vector<int32_t>> samples(const std::string& request, size_t count);
  [[noreturn]] void fail_to_answer(const std::string& request, bool timed_out);

  Process process_;
  Process::Time deadline_;
  uint64_t asked_ = 0;  // requests, and so the number of the next
  std::string abilities_;
  hmlfc_dut_geometry geometry_{};
};

/// The processes of one decoder that wait for a stream, and what its failures are worth.
/// Thread-safe.
class LineDecoders {
 public:
  /// One that waits, or null.
  std::unique_ptr<LineDecoder> take();
  void give_back(std::unique_ptr<LineDecoder> decoder);

  /// Whether a vector that failed in a process that has served others is to be run again in a new
  /// one: always, until kEnough in a row have failed there again; then ever more rarely.
  bool is_run_again();
  /// What came of that.
  void was_run_again(bool failed);

 private:
  static constexpr uint64_t kEnough = 8;

  std::mutex mutex_;
  uint64_t failures_ = 0;
  uint64_t failed_again_ = 0;  // in a row
  std::vector<std::unique_ptr<LineDecoder>> waiting_;
};

}  // namespace hmlfc::conform
