// A decoder under test that speaks the line protocol (docs/line_protocol.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "conform/process.hpp"
#include "conform/running_dut.hpp"

namespace hmlfc::conform {

/// The protocol's version, which `hello` names.
inline constexpr int kLineProtocol = 1;

/// Bytes of the longest line, its end included, but for answers with the samples of a view.
inline constexpr size_t kLineBytes = 4096;

/// Lines of the longest trace of a block: the five stages of 16 levels, and the block itself.
inline constexpr size_t kTraceLines = 81;

/// Lines of the longest trace of a pixel: 256 views of aperture 3, and what leads to them.
inline constexpr size_t kPixelLines = 300;

/// One process, for one stream after the other.
class LineDecoder final : public RunningDut {
 public:
  /// Starts `command` and greets it.
  LineDecoder(const std::vector<std::string>& command, const ProcessLimits& limits);
  /// Ends its input, and kills it if it does not end then.
  ~LineDecoder() override;

  const Abilities& can() const override { return abilities_; }
  void allow(double seconds) override;
  DutAnswer<hmlfc_dut_geometry> open(const std::filesystem::path& file) override;
  DutAnswer<RgbImage> view(ViewPos view) override;
  DutAnswer<std::vector<int32_t>> block(const BlockAddress& block, int stop_level) override;
  DutAnswer<std::string> trace(const BlockAddress& block, int stop_level) override;
  void close() override;
  DutAnswer<std::vector<int32_t>> record(const hmlfc_dut_camera& camera) override;
  DutAnswer<DutFrame> frame(const vectors::FrameCase& request) override;
  DutAnswer<std::vector<BlockDisparity>> map(ViewPos view, size_t blocks) override;
  DutAnswer<std::string> pixel(const vectors::FrameCase& request, uint32_t x, uint32_t y) override;
  std::string take_messages() override { return process_.take_messages(); }

 private:
  void greet();
  std::string line(const std::string& request, std::string_view sent, size_t bytes);
  DutAnswer<std::string> ask(const std::string& request, size_t bytes = kLineBytes);
  DutAnswer<std::string> lines(const std::string& request, size_t most);
  [[noreturn]] void fail_to_answer(const std::string& request, bool timed_out);

  Process process_;
  Process::Time deadline_;
  uint64_t asked_ = 0;  // requests, and so the number of the next
  Abilities abilities_;
  hmlfc_dut_geometry geometry_{};
};

}  // namespace hmlfc::conform
