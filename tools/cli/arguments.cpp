#include "cli/arguments.hpp"

#include <algorithm>
#include <cmath>

#include "io/view_name.hpp"

namespace hmlfc::cli {

std::optional<std::vector<double>> parse_decimals(std::string_view text, size_t least,
                                                  size_t most) {
  std::vector<double> numbers;
  while (true) {
    const size_t comma = std::min(text.find(','), text.size());
    double number = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + comma, number);
    if (error != std::errc{} || last != text.data() + comma || !std::isfinite(number)) {
      return std::nullopt;
    }
    numbers.push_back(number);
    if (comma == text.size()) break;
    text.remove_prefix(comma + 1);
  }
  if (numbers.size() < least || numbers.size() > most) return std::nullopt;
  return numbers;
}

CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type_name,
                       const std::string& description, Reader reader) {
  const auto callback = [name, reader = std::move(reader)](const CLI::results_t& results) {
    const auto expected = reader(results.at(0));
    if (expected) {
      throw CLI::ValidationError(name, "'" + results[0] + "' is not " + *expected);
    }
    return true;
  };
  return app.add_option(name, callback, description)->type_name(type_name);
}

CLI::Option* add_decimal(CLI::App& app, const std::string& name, const std::string& type_name,
                         std::optional<double>& target, double lo, double hi,
                         const std::string& description) {
  const auto reader = [&target, lo, hi](const std::string& text) -> std::optional<std::string> {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || last != end || !(value >= lo && value <= hi)) {
      return fmt::format("a number in [{}, {}]", lo, hi);
    }
    target = value;
    return std::nullopt;
  };
  return add_value(app, name, type_name, description, reader);
}

CLI::Option* add_rows_by_cols(CLI::App& app, const std::string& name, uint32_t& rows,
                              uint32_t& cols, uint32_t max, const std::string& description) {
  const auto reader = [&rows, &cols, max](const std::string& text) -> std::optional<std::string> {
    const auto numbers = parse_numbers<2>(text, 'x');
    if (!numbers || (*numbers)[0] < 1 || (*numbers)[0] > max || (*numbers)[1] < 1 ||
        (*numbers)[1] > max) {
      return fmt::format("rows x columns in [1, {}], as 4x4", max);
    }
    rows = (*numbers)[0];
    cols = (*numbers)[1];
    return std::nullopt;
  };
  return add_value(app, name, "RxC", description, reader)
      ->default_str(fmt::format("{}x{}", rows, cols));
}

CLI::Option* add_grid(CLI::App& app, std::optional<io::GridShape>& target) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    const auto numbers = parse_numbers<2>(text, 'x');
    if (!numbers || (*numbers)[0] < 1 || (*numbers)[0] > io::kMaxGridSide || (*numbers)[1] < 1 ||
        (*numbers)[1] > io::kMaxGridSide) {
      return fmt::format("rows x columns in [1, {}], as 9x9", io::kMaxGridSide);
    }
    target = io::GridShape{(*numbers)[0], (*numbers)[1]};
    return std::nullopt;
  };
  return add_value(app, "--grid", "RxC", "Views as rows x columns, for file names that do not tell",
                   reader);
}

CLI::Option* add_view(CLI::App& app, std::optional<ViewPos>& target,
                      const std::string& description) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    const auto numbers = parse_numbers<2>(text, ',');
    if (!numbers) return "row,column, as 3,5";
    target = ViewPos{(*numbers)[0], (*numbers)[1]};
    return std::nullopt;
  };
  return add_value(app, "--view", "R,C", description, reader);
}

CLI::Option* add_levels(CLI::App& app, std::optional<int>& target) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    target = parse_integer<int>(text);
    if (!target || *target < 1 || *target > 16) return "an integer in [1, 16]";
    return std::nullopt;
  };
  return add_value(app, "--levels", "N", "Levels of the tree to use, from the top", reader)
      ->default_str("all");
}

CLI::Option* add_threads(CLI::App& app, int& target) {
  return add_integer(app, "--threads", target, 0, 1024,
                     "Threads, 0 for all cores; never changes the result");
}

CLI::Option* add_output(CLI::App& app, std::filesystem::path& target, const std::string& type_name,
                        const std::string& description) {
  return add_path(app, "-o,--output", target, description)->type_name(type_name);
}

CLI::Option* add_path(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      const std::string& description) {
  const auto reader = [&target](const std::string& text) -> std::optional<std::string> {
    if (text.empty()) return "a path";
    target = text;
    return std::nullopt;
  };
  return add_value(app, name, "", description, reader)->required();
}

}  // namespace hmlfc::cli
