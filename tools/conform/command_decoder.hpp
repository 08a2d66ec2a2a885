// A decoder under test that is a command line: each run decodes all views of one stream.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <hmlfc/light_field.hpp>

#include "conform/running_dut.hpp"

namespace hmlfc::conform {

/// Opening a stream is one run of the command; views are then read from its output, and a trace is
/// a run of the declaration's command `trace`. Another exit status than 0 refuses the stream: the
/// error is the first name of annex A that the messages have, or the exit status and the last line
/// of the messages where the declaration's error_names is false or there is no name.
class CommandDecoder final : public RunningDut {
 public:
  /// `dut` must outlive it; the command writes into `output`.
  CommandDecoder(const Dut& dut, const ProcessLimits& limits, std::filesystem::path output);

  const Abilities& can() const override { return abilities_; }
  void allow(double seconds) override { limits_.seconds = seconds; }
  DutAnswer<hmlfc_dut_geometry> open(const std::filesystem::path& file) override;
  DutAnswer<RgbImage> view(ViewPos view) override;
  DutAnswer<std::vector<int32_t>> block(const BlockAddress& block, int stop_level) override;
  DutAnswer<std::string> trace(const BlockAddress& block, int stop_level) override;
  void close() override {}
  std::string take_messages() override;

 private:
  const Dut& dut_;
  ProcessLimits limits_;
  std::filesystem::path output_;
  Abilities abilities_;
  std::filesystem::path file_;
  LightFieldShape shape_;
  std::vector<RgbImage> views_;  // empty until one is asked for
  std::string messages_;
};

}  // namespace hmlfc::conform
