#include "view/query.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/arguments.hpp"

namespace hmlfc::view {

using cli::ExitCode;
using cli::Failure;

void read_query(const Query& query, const std::function<void(CLI::App&)>& add) {
  CLI::App app;
  app.set_help_flag();
  add(app);
  std::vector<std::string> arguments;
  for (const auto& [name, value] : query) {
    const bool known =
        std::ranges::all_of(name, [](char c) { return c == '-' || (c >= 'a' && c <= 'z'); });
    if (!known || app.get_option_no_throw("--" + name) == nullptr) {
      throw Failure(ExitCode::kUsage, "'" + name + "' is not a name that this address takes");
    }
    if (value.empty()) throw Failure(ExitCode::kUsage, "'" + name + "' has no value");
    arguments.push_back(fmt::format("--{}={}", name, value));
  }
  std::ranges::reverse(arguments);  // as CLI11 takes them
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    throw Failure(ExitCode::kUsage, error.what());
  }
}

LookQuery read_look_query(const Query& query, const std::function<void(CLI::App&)>& add) {
  LookQuery look;
  read_query(query, [&](CLI::App& app) {
    add_camera_options(app, look.cameras);
    for (const char* name : {"--path", "--frames"}) app.remove_option(app.get_option(name));
    cli::add_levels(app, look.levels);
    add(app);
  });
  return look;
}

}  // namespace hmlfc::view
