// A decoder under test that is a command line: each run decodes all views of one stream.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/light_field.hpp>

#include "conform/process.hpp"
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

/// Runs `command`, whose places are filled in. Throws DutFailure where it times out, crashes, does
/// not exist or says that it cannot run here.
ProcessOutcome run_command(const std::vector<std::string>& command, const ProcessLimits& limits);

/// The first word of `messages` that is one of `names`; empty if there is none. A word has no
/// letter, digit or underscore next to it.
std::string first_name(std::string_view messages, std::span<const std::string_view> names);

/// The names of all errors of annex A.
std::vector<std::string_view> all_error_names();

/// Throws DutFailure: what is wrong with the output of a run in the folder `output`.
[[noreturn]] void wrong_output(const std::filesystem::path& output, std::string what);

/// The header of `file` as a decoder reports it; zeros where it cannot be read.
hmlfc_dut_geometry geometry_of(const std::filesystem::path& file);

}  // namespace hmlfc::conform
