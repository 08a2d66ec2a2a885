// A renderer under test that is a command line: each run draws one frame or makes one map.
#pragma once

#include <string>

#include "conform/running_dut.hpp"

namespace hmlfc::conform {

/// A frame is a run of Dut::frame, which writes frame.raw, frame.png or frame.ppm; a map is one of
/// Dut::disparity, which writes map.raw (vectors/README.md). Another exit status than 0 is an
/// error: the first name of annex A, or of an input of CAM-3 where a camera is to be refused, that
/// the messages have; the exit status and the last line of the messages where the declaration's
/// error_names is false or there is no name.
class CommandRenderer final : public RunningDut {
 public:
  /// `dut` must outlive it; the command writes into `output`.
  CommandRenderer(const Dut& dut, const ProcessLimits& limits, std::filesystem::path output);

  const Abilities& can() const override { return abilities_; }
  void allow(double seconds) override { limits_.seconds = seconds; }
  DutAnswer<hmlfc_dut_geometry> open(const std::filesystem::path& file) override;
  DutAnswer<DutFrame> frame(const vectors::FrameCase& request) override;
  DutAnswer<std::vector<BlockDisparity>> map(ViewPos view, size_t blocks) override;
  void close() override {}
  std::string take_messages() override;

 private:
  DutAnswer<void> run(const std::vector<std::string>& command, const Places& places,
                      bool refused_camera);

  const Dut& dut_;
  ProcessLimits limits_;
  std::filesystem::path output_;
  Abilities abilities_;
  std::filesystem::path file_;
  hmlfc_dut_geometry geometry_{};
  std::string messages_;
};

}  // namespace hmlfc::conform
