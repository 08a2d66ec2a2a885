// testbench: compares the units, and every other implementation, with the golden model.
#include <cstdlib>
#include <utility>
#include <vector>

#include <systemc>

#include "programs/commands.hpp"
#include "unit/unit_host.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitInternal = 70;

struct Entry {
  const char* name;
  const char* description;
  Command (*add)(CLI::App& app);
};

constexpr Entry kCommands[] = {
    {"bench", "Measures throughput and latency of the decode unit", &add_bench},
    {"check", "Checks blocks of a stream against the golden model", &add_check},
    {"clocks", "Measures how many clocks the decode unit takes for blocks of each state",
     &add_clocks},
    {"crosscheck", "Runs every implementation on the same blocks", &add_crosscheck},
    {"decode", "Decodes views in the view unit, or requests for blocks in the decode unit",
     &add_decode},
    {"random", "Checks the decode unit on random streams", &add_random},
    {"view", "Decodes a view to memory in the view unit and compares every byte with the model",
     &add_view}};

int run(int argc, char** argv) {
  CLI::App app{"Compares the units, and every other implementation, with the golden model"};
  app.require_subcommand(1);
  std::vector<std::pair<CLI::App*, Command>> commands;
  for (const Entry& entry : kCommands) {
    CLI::App* command = app.add_subcommand(entry.name, entry.description);
    commands.emplace_back(command, entry.add(*command));
  }
  CLI11_PARSE(app, argc, argv);
  const std::string name = app.get_subcommands().front()->get_name();
  try {
    for (const auto& [command, act] : commands) {
      if (*command) return act();
    }
  } catch (const Stop& stop) {
    fmt::print(stderr, "testbench {}: {}\n", name, stop.message);
    return stop.exit_code;
  } catch (const UnitHangs& hang) {
    fmt::print(stderr, "testbench {}: {}\n", name, hang.what());
  }
  return kExitInternal;
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::run(argc, argv); }

int main(int argc, char** argv) {
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 0);
  return sc_core::sc_elab_and_sim(argc, argv);
}
