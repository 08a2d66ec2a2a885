#include "cli/dut_options.hpp"

#include <algorithm>
#include <filesystem>

#include "cli/arguments.hpp"
#include "conform/report_folder.hpp"

namespace hmlfc::cli {

void DutOptions::add_to(CLI::App& app, bool several) {
  CLI::Option* option =
      app.add_option("--dut", names,
                     several ? "A decoder: command line, *.so or *.json; may be repeated"
                             : "A decoder: command line, *.so or *.json");
  option->type_name("DUT")->allow_extra_args(false);
  if (!several) option->expected(1);
  add_integer(app, "--timeout", timeout_seconds, 1, 86400, "Seconds until the decoder is killed")
      ->needs(option);
  add_integer(app, "--memory", memory_mib, 0, 1u << 24,
              "Address space of the decoder in MiB; 0: no limit")
      ->needs(option);
}

conform::ProcessLimits DutOptions::limits() const {
  return {static_cast<double>(timeout_seconds), uint64_t{memory_mib} << 20};
}

std::vector<conform::Dut> DutOptions::read() const {
  if (names.empty()) throw Failure(ExitCode::kUsage, "--dut is required");
  std::error_code ignored;
  const auto hmlfc = std::filesystem::read_symlink("/proc/self/exe", ignored);
  std::vector<conform::Dut> duts;
  for (const std::string& name : names) {
    duts.push_back(value_or_throw(conform::read_dut(name, hmlfc), ExitCode::kUsage));
    const auto same_folder = [&](const conform::Dut& other) {
      return conform::folder_name(other.name) == conform::folder_name(duts.back().name);
    };
    if (std::ranges::count_if(duts, same_folder) > 1) {
      throw Failure(ExitCode::kUsage, "two decoders are named " + duts.back().name);
    }
  }
  return duts;
}

}  // namespace hmlfc::cli
