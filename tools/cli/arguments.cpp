#include "cli/arguments.hpp"

#include <algorithm>
#include <string_view>

#include "vectors/milestone.hpp"

namespace hmlfc::cli {

namespace {

// "FIRST..LAST:STEP", "FIRST..LAST" or one number.
std::optional<io::IndexRange> parse_range(std::string_view text) {
  const size_t dots = text.find("..");
  const auto first = parse_integer<uint32_t>(text.substr(0, dots));
  if (!first) return std::nullopt;
  if (dots == text.npos) return io::IndexRange{*first, *first};

  text.remove_prefix(dots + 2);
  const size_t colon = text.find(':');
  const auto last = parse_integer<uint32_t>(text.substr(0, colon));
  const auto step = colon == text.npos ? 1 : parse_integer<uint32_t>(text.substr(colon + 1));
  if (!last || *last < *first || !step || *step < 1) return std::nullopt;
  return io::IndexRange{*first, *last, *step};
}

std::filesystem::path default_suite() {
  std::error_code ignored;
  const std::filesystem::path here = "vectors";
  if (std::filesystem::exists(here / "manifest.json", ignored)) return here;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const auto installed = (program.parent_path() / HMLFC_SUITE_FROM_BIN).lexically_normal();
  return std::filesystem::exists(installed / "manifest.json", ignored) ? installed : here;
}

}  // namespace

CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type_name,
                       const std::string& description, const std::string& expected, Reader reader) {
  const auto callback = [name, expected,
                         reader = std::move(reader)](const CLI::results_t& results) {
    if (reader(results.at(0))) return true;
    throw CLI::ValidationError(name, "'" + results[0] + "' is not " + expected);
  };
  return app.add_option(name, callback, description)->type_name(type_name);
}

CLI::Option* add_decimal(CLI::App& app, const std::string& name, const std::string& type_name,
                         double lo, double hi, const std::string& description,
                         const std::string& expected, std::function<void(double)> store) {
  const auto reader = [lo, hi, store = std::move(store)](const std::string& text) {
    const auto value = parse_decimals(text, 1, 1);
    if (!value || (*value)[0] < lo || (*value)[0] > hi) return false;
    store((*value)[0]);
    return true;
  };
  return add_value(app, name, type_name, description, expected, reader);
}

CLI::Option* add_decimal(CLI::App& app, const std::string& name, const std::string& type_name,
                         std::optional<double>& target, double lo, double hi,
                         const std::string& description) {
  return add_decimal(app, name, type_name, lo, hi, description,
                     fmt::format("a number in [{}, {}]", lo, hi),
                     [&target](double value) { target = value; });
}

CLI::Option* add_sides(CLI::App& app, const std::string& name, const std::string& type_name,
                       const std::string& expected, uint32_t max, const std::string& example,
                       const std::string& description,
                       std::function<void(uint32_t a, uint32_t b)> store) {
  const auto checked = [max, store = std::move(store)](const std::array<uint32_t, 2>& sides) {
    const bool good = std::ranges::all_of(sides, [max](uint32_t s) { return s >= 1 && s <= max; });
    if (good) store(sides[0], sides[1]);
    return good;
  };
  return add_numbers<2>(app, name, type_name, 'x',
                        fmt::format("{}, each in [1, {}], such as {}", expected, max, example),
                        description, checked);
}

CLI::Option* add_rows_by_cols(CLI::App& app, const std::string& name, uint32_t& rows,
                              uint32_t& cols, uint32_t max, const std::string& description) {
  return add_sides(app, name, "RxC", "rows x columns", max, "4x4", description,
                   [&rows, &cols](uint32_t r, uint32_t c) { rows = r, cols = c; })
      ->default_str(fmt::format("{}x{}", rows, cols));
}

void add_naming(CLI::App& app, io::ViewNaming& target) {
  add_sides(app, "--grid", "RxC", "rows x columns", io::kMaxGridSide, "9x9",
            "Grid of the views, for names that do not say it or for a subset",
            [&target](uint32_t r, uint32_t c) {
              target.grid = io::GridShape{r, c};
            });
  const auto names = [&target](const std::string& text) {
    const auto pattern = io::NamePattern::parse(text);
    if (!pattern) throw CLI::ValidationError("--names", "'" + text + "': " + pattern.error());
    target.pattern = text;
    return !text.empty();
  };
  add_value(app, "--names", "PATTERN", "Where names say row and column, such as '{row}_{col}'",
            "a pattern of names with {row} and {col}, or {index}, each once, and * for the rest",
            names);
  std::vector<std::pair<std::string, std::optional<io::FrameOrder>>> orders(
      io::kFrameOrders.begin(), io::kFrameOrders.end());
  orders.emplace_back("rows", io::FrameOrder::kRaster);
  add_choice(app, "--order", target.order, std::move(orders),
             "Pictures or frames are a sequence in this order; raster: row by row");
}

void refuse_given(std::initializer_list<std::pair<const char*, bool>> options,
                  const std::string& why) {
  for (const auto& [name, given] : options) {
    if (given) throw Failure(ExitCode::kUsage, fmt::format("{} does not apply: {}", name, why));
  }
}

void refuse_naming(const io::ViewNaming& naming, const std::string& why) {
  refuse_given({{"--grid", naming.grid.has_value()},
                {"--names", !naming.pattern.empty()},
                {"--order", naming.order.has_value()}},
               why);
}

CLI::Option* add_views(CLI::App& app, std::optional<io::ViewPart>& target) {
  const auto reader = [&target](const std::string& text) {
    const size_t comma = text.find(',');
    if (comma == text.npos) return false;
    const auto rows = parse_range(std::string_view(text).substr(0, comma));
    const auto cols = parse_range(std::string_view(text).substr(comma + 1));
    if (rows && cols) target = io::ViewPart{*rows, *cols};
    return rows && cols;
  };
  return add_value(app, "--views", "ROWS,COLS",
                   "Only these rows and columns of the grid, see below",
                   "rows,columns, each FIRST..LAST:STEP, FIRST..LAST or one number, with FIRST <= "
                   "LAST and STEP >= 1, such as 0..8:2,4",
                   reader);
}

CLI::Option* add_view(CLI::App& app, std::optional<ViewPos>& target,
                      const std::string& description) {
  return add_numbers<2>(app, "--view", "ROW,COL", ',', "row,column, such as 3,5", description,
                        [&target](const auto& n) {
                          target = ViewPos{n[0], n[1]};
                        });
}

CLI::Option* add_rect(CLI::App& app, std::optional<Rect>& target) {
  return add_numbers<4>(app, "--rect", "X,Y,W,H", ',', "x,y,width,height, such as 16,8,64,32",
                        "Only these pixels of each view", [&target](const auto& n) {
                          target = Rect{n[0], n[1], n[2], n[3]};
                        });
}

CLI::Option* add_levels(CLI::App& app, std::optional<int>& target) {
  return add_integer(app, "--levels", target, 1, 16, "Levels of the tree to use, from the top")
      ->default_str("all");
}

CLI::Option* add_threads(CLI::App& app, int& target) {
  return add_integer(app, "--threads", target, 0, 1024,
                     "Threads, 0 for all cores; never changes the result");
}

CLI::Option* add_json(CLI::App& app, bool& target) {
  return app.add_flag("--json", target, "Print JSON");
}

CLI::Option* add_output(CLI::App& app, std::filesystem::path& target, bool& force,
                        const std::string& type_name, const std::string& description) {
  add_force(app, force);
  return add_path(app, "-o,--output", target, description)->type_name(type_name);
}

void add_force(CLI::App& app, bool& force) {
  app.add_flag("--force", force, "Also replace files that this command did not write");
}

CLI::Option* add_path(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      const std::string& description) {
  const auto reader = [&target](const std::string& text) {
    target = text;
    return !text.empty();
  };
  return add_value(app, name, "", description, "a path", reader)->required();
}

CLI::Option* add_suite(CLI::App& app, std::filesystem::path& target,
                       const std::string& description) {
  target = default_suite();
  return add_path(app, "--suite", target, description)
      ->required(false)
      ->type_name("DIR")
      ->default_str("vectors, else the installed one");
}

CLI::Option* add_milestone(CLI::App& app, std::string& target) {
  std::string names;
  for (const auto* list : {&vectors::milestones(), &vectors::frame_milestones()}) {
    for (const vectors::MilestoneRow& row : *list) {
      names += (names.empty() ? "one of " : ", ") + std::string(row.name);
    }
  }
  const auto reader = [&target](const std::string& text) {
    const auto number = vectors::milestone_number(text);
    if (number) target = vectors::milestones_with(text)[*number].name;
    return number.has_value();
  };
  return add_value(app, "--milestone", "NAME",
                   "Only the vectors of one milestone; hmlfc vectors milestones lists them", names,
                   reader);
}

CLI::Option* add_stream(CLI::App& app, std::filesystem::path& target) {
  return add_path(app, "FILE", target, "An .hmlfc file, or its http:// address");
}

}  // namespace hmlfc::cli
