#include "program.hpp"

#include <iostream>

namespace hmlfc::stress {

int run_program(CLI::App& app, int argc, char** argv, const std::function<vectors::Json()>& run) {
  try {
    app.parse(argc, argv);
    const vectors::Json report = run();
    std::cout << report.dump(1) << '\n';
    return report.at("findings").empty() ? 0 : 1;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << app.get_name() << ": " << error.what() << '\n';
    return 2;
  }
}

}  // namespace hmlfc::stress
