// Measurements inside a process: ./run bench render, and what the reports in Python take as JSON.
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "common/measuring.hpp"
#include "subcommands.hpp"

namespace {

using namespace hmlfc::bench;

template <Json (*subcommand)(Arguments)>
void print_json(Arguments arguments) {
  fmt::print("{}\n", subcommand(arguments).dump());
}

struct Subcommand {
  std::string_view name;
  size_t least;  // arguments that it needs
  void (*run)(Arguments);
};

constexpr std::array kSubcommands = {
    Subcommand{"render", 0, render},
    Subcommand{"decode", 2, print_json<decode>},
    Subcommand{"frames", 5, print_json<frames>},
    Subcommand{"path", 6, print_json<path>},
    Subcommand{"block", 2, print_json<block>},
    Subcommand{"requests", 1, print_json<requests>},
};

void run(Arguments arguments) {
  const auto found = arguments.empty()
                         ? kSubcommands.end()
                         : std::ranges::find(kSubcommands, arguments[0], &Subcommand::name);
  if (found == kSubcommands.end() || arguments.size() <= found->least) {
    throw std::invalid_argument("subcommands and their arguments: bench/subcommands.hpp");
  }
  found->run(arguments.subspan(1));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return run_program("hmlfc_measure", [&] { run(arguments); });
}
