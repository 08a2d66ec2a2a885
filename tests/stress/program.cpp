#include "program.hpp"

#include <cstdint>
#include <iostream>
#include <string>

#include "arithmetic/widths.hpp"
#include "width_record.hpp"

namespace hmlfc::stress {
namespace {

// Plants a fault for the tests to find.
void plant(const std::string& what) {
  if (what.empty()) return;
  if (what == "lossy") {
    volatile int beyond = 40000;
    static_cast<void>(narrow<int16_t>(static_cast<int>(beyond)));
  } else if (what == "overflow") {
    volatile int32_t most = INT32_MAX;
    const int32_t one_more = most + 1;  // ends a program built with overflow checks
    std::cerr << one_more << '\n';
  } else if (!plant_narrow(what)) {
    throw CLI::ValidationError("--plant", what + " is no quantity of a width table");
  }
}

}  // namespace

int run_program(CLI::App& app, int argc, char** argv, const std::function<vectors::Json()>& run) {
  std::string planted;
  app.add_option("--plant", planted,
                 "a fault to find: lossy, overflow, or the quantity whose interval is narrowed");
  try {
    app.parse(argc, argv);
    plant(planted);
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
