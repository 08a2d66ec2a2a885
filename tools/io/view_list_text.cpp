#include "io/view_list_text.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "io/files.hpp"

namespace hmlfc::io {
namespace {

constexpr size_t kNamed = 3;

std::string_view text_of(const NamedPicture& picture, size_t number) {
  const NameNumber& at = picture.numbers[number];
  return std::string_view(picture.name).substr(at.begin, at.end - at.begin);
}

bool varies(const std::vector<NamedPicture>& views, size_t number) {
  return std::ranges::any_of(views, [&](const NamedPicture& view) {
    return text_of(view, number) != text_of(views.front(), number);
  });
}

// The numbers that vary, counted from 1, in text: "3 to 6, 8".
std::string other_numbers(const std::vector<NamedPicture>& views, const GridReading& reading) {
  std::vector<std::pair<size_t, size_t>> runs;
  for (size_t i = 0; i < views.front().numbers.size(); ++i) {
    if (i == reading.row->number || i == reading.col->number || !varies(views, i)) continue;
    if (runs.empty() || runs.back().second != i) runs.emplace_back(i + 1, i);
    runs.back().second = i + 1;
  }
  std::string text;
  for (const auto& [first, last] : runs) {
    text += text.empty() ? "" : ", ";
    text += first == last       ? fmt::format("{}", first)
            : first + 1 == last ? fmt::format("{} and {}", first, last)
                                : fmt::format("{} to {}", first, last);
  }
  return text;
}

// The pattern that matches all views and takes these numbers: "out_{row}_{col}_*_*".
std::string pattern_of(const NamedPicture& picture, const GridReading& reading,
                       const std::vector<bool>& is_open) {
  std::string pattern;
  size_t at = 0;
  for (size_t i = 0; i < picture.numbers.size(); ++i) {
    const NameNumber& number = picture.numbers[i];
    pattern += picture.name.substr(at, number.begin - at);
    pattern += i == reading.row->number   ? std::string("{row}")
               : i == reading.col->number ? std::string("{col}")
               : is_open[i]               ? std::string("*")
                                          : std::string(text_of(picture, i));
    at = number.end;
  }
  return "'" + pattern + picture.name.substr(at) + "'";
}

// "'a_{row}_{col}_1' or 'a_0_{row}_{col}'": the patterns that take the first two or the last two
// numbers, if they make no more places than there are views; those of one folder come first.
std::string describe_pairs(const std::vector<NamedPicture>& views,
                           const std::vector<NumberColumn>& columns) {
  const NamedPicture& example = views.front();
  std::vector<std::string> patterns;
  for (const size_t at : {size_t{0}, columns.size() - 2}) {
    const GridReading pair{&columns[at], &columns[at + 1]};
    if (pair.rows() * pair.cols() > views.size() || (at == 0 && !patterns.empty())) continue;
    patterns.push_back(pattern_of(example, pair, std::vector<bool>(example.numbers.size())));
    const size_t slash = example.name.find('/', example.numbers[columns.front().number].end);
    if (patterns.size() == 2 && slash < example.numbers[columns[1].number].begin) {
      std::swap(patterns[0], patterns[1]);
    }
  }
  return patterns.empty()       ? ""
         : patterns.size() == 1 ? patterns[0]
                                : patterns[0] + " or " + patterns[1];
}

std::string numbers_of_reading(const GridReading& reading) {
  return fmt::format("{} and {}", reading.row->number + 1, reading.col->number + 1);
}

// Whether the picture is named like those of JPEG Pleno, 000_000.ppm.
bool is_pleno_name(const NamedPicture& picture) {
  return picture.name.size() == 7 && picture.name[3] == '_' && picture.numbers.size() == 2 &&
         lower_case_extension(picture.file) == ".ppm";
}

int64_t value_at(const NumberColumn& column, size_t place, bool gaps) {
  return gaps ? column.values[place]
              : column.values.front() + static_cast<int64_t>(place) * column.step();
}

// The first of the numbers that `wanted` pictures should have.
int64_t first_number(const NumberColumn& counter, int64_t wanted, bool from_0) {
  if (from_0) return 0;
  return counter.values.back() == wanted ? 1 : counter.values.front();
}

// ": row 1, column 1 (a04.png)" for numbers that are missing; "" where that is not known.
std::string describe_gaps(const std::vector<NamedPicture>& pictures, const NumberColumn& counter,
                          GridShape grid, FrameOrder order, bool from_0) {
  const int64_t wanted = int64_t{grid.rows} * grid.cols;
  const int64_t first = first_number(counter, wanted, from_0);
  if (counter.values.front() < first || counter.values.back() >= first + wanted) return "";
  std::string text;
  size_t named = 0;
  auto next = counter.values.begin();
  for (int64_t value = first; value < first + wanted; ++value) {
    if (next != counter.values.end() && *next == value) {
      ++next;
      continue;
    }
    if (++named > 3) return text + " ...";
    const auto at = view_of_frame(static_cast<size_t>(value - first), grid, order);
    text += (named == 1 ? ": " : ", ") + describe_place(at) + " (" +
            name_with(pictures, {{counter.number, value}}) + ")";
  }
  return text;
}

}  // namespace

std::string shown_name(const NamedPicture& picture) {
  return picture.name + picture.file.extension().string();
}

std::string open_pattern(const NamedPicture& picture) {
  const size_t count = picture.numbers.size();
  const NumberColumn row{count >= 2 ? count - 2 : count, {}, {}};
  const NumberColumn col{count >= 2 ? count - 1 : count, {}, {}};
  return pattern_of(picture, {&row, &col}, std::vector<bool>(count, true));
}

std::string name_some(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kNamed) text += fmt::format(" and {} more", names.size() - kNamed);
  return text;
}

std::string describe_place(GridPosition at) {
  return fmt::format("row {}, column {}", at.row, at.col);
}

std::string describe_values(const NumberColumn& column) {
  const int64_t first = column.values.front();
  if (column.values.size() == 1) return fmt::format("{}", first);
  const std::string ends = fmt::format("{} to {}", first, column.values.back());
  if (!column.is_regular()) return ends + " with gaps";
  return column.step() == 1 ? ends : fmt::format("{} in steps of {}", ends, column.step());
}

std::string describe_reading(const std::vector<NamedPicture>& views, const GridReading& reading) {
  const bool turned = reading.row->number > reading.col->number;
  const std::string others = other_numbers(views, reading);
  const auto counts_from_0 = [](const NumberColumn& column) {
    return column.values.front() == 0 && column.is_regular() && column.step() == 1;
  };
  const bool plain = counts_from_0(*reading.row) && counts_from_0(*reading.col);
  if (plain && !turned && views.front().numbers.size() == 2) {
    if (!is_pleno_name(views.front())) return "";
    return "names are read as ROW_COLUMN; where they are COLUMN_ROW, as those of JPEG Pleno, say "
           "--names '{col}_{row}'";
  }
  std::string text = fmt::format("{}x{} views from numbers {} of the names", reading.rows(),
                                 reading.cols(), numbers_of_reading(reading));
  if (turned) text += " (row and column)";
  if (!plain) {
    text += fmt::format("; rows {}, columns {}", describe_values(*reading.row),
                        describe_values(*reading.col));
  }
  if (others.empty()) return text;
  const bool one = others.find_first_not_of("0123456789") == std::string::npos;
  return text + fmt::format("; {} {} with them", others, one ? "varies" : "vary");
}

std::string describe_choice(const std::vector<NamedPicture>& views,
                            const std::vector<GridReading>& readings) {
  std::vector<bool> is_open;
  for (size_t i = 0; i < views.front().numbers.size(); ++i) is_open.push_back(varies(views, i));
  std::string numbers;
  std::string patterns;
  for (const GridReading& reading : readings) {
    const bool first = numbers.empty();
    numbers += (first ? "" : " or ") + numbers_of_reading(reading) +
               fmt::format(" ({}x{})", reading.rows(), reading.cols());
    patterns += (first ? "" : " or ") + pattern_of(views.front(), reading, is_open);
  }
  return fmt::format("numbers {} of the names make a full grid; choose by --names {}", numbers,
                     patterns);
}

std::string describe_no_grid(const std::vector<NamedPicture>& views,
                             const std::vector<NumberColumn>& columns) {
  std::string counts;
  for (const NumberColumn& column : columns) {
    if (column.values.size() == 1) continue;
    counts += fmt::format("{}number {} has {} value{} ({})", counts.empty() ? "" : ", ",
                          column.number + 1, column.values.size(),
                          column.values.size() == 1 ? "" : "s", describe_values(column));
  }
  const NamedPicture& example = views.front();
  std::string text = fmt::format("{} picture{} like {}, whose names do not say row and column",
                                 views.size(), views.size() == 1 ? "" : "s", shown_name(example));
  if (counts.empty())
    return text + "; say it by --names, or give --grid ROWSxCOLS, which takes them in sorted order";
  text += ": " + counts + "; give --grid ROWSxCOLS";
  if (columns.size() < 2) {
    size_t side = 1;
    while (side * side < views.size()) ++side;
    if (side * side == views.size()) text += fmt::format(", such as --grid {0}x{0}", side);
    return text + " for a sequence, with --order unless it goes row by row";
  }
  const std::string choices = describe_pairs(views, columns);
  return text + " for their sorted order" +
         (choices.empty() ? "" : ", or choose by --names, such as --names " + choices);
}

std::string name_with(const std::vector<NamedPicture>& views,
                      const std::vector<std::pair<size_t, int64_t>>& values) {
  const NamedPicture& picture = views.front();
  std::string name;
  size_t at = 0;
  for (size_t i = 0; i < picture.numbers.size(); ++i) {
    name += picture.name.substr(at, picture.numbers[i].begin - at);
    at = picture.numbers[i].end;
    const auto given = std::ranges::find(values, i, &std::pair<size_t, int64_t>::first);
    if (given != values.end()) {
      size_t digits = text_of(picture, i).size();
      for (const NamedPicture& view : views) digits = std::min(digits, text_of(view, i).size());
      name += fmt::format("{:0{}}", given->second, digits);
    } else {
      name += varies(views, i) ? std::string("*") : std::string(text_of(picture, i));
    }
  }
  return name + picture.name.substr(at) + picture.file.extension().string();
}

std::string describe_missing(const std::vector<NamedPicture>& views, const GridReading& reading,
                             bool gaps, bool by_pattern) {
  const uint64_t rows = gaps ? reading.rows() : reading.row->extent();
  const uint64_t cols = gaps ? reading.cols() : reading.col->extent();
  std::vector<bool> there(rows * cols);
  const auto place_of = [&](const NumberColumn& column, size_t picture) {
    const size_t rank = column.ranks[picture];
    if (gaps) return rank;
    return static_cast<size_t>((column.values[rank] - column.values.front()) / column.step());
  };
  for (size_t i = 0; i < views.size(); ++i) {
    there[place_of(*reading.row, i) * cols + place_of(*reading.col, i)] = true;
  }
  const size_t total = there.size() - views.size();
  if (total == 0) return fmt::format("the names make a {}x{} grid", rows, cols);
  std::string missing;
  size_t named = 0;
  for (size_t i = 0; i < there.size() && named < kNamed; ++i) {
    if (there[i]) continue;
    const GridPosition at{static_cast<uint32_t>(i / cols), static_cast<uint32_t>(i % cols)};
    missing += (named++ == 0 ? "" : ", ") + describe_place(at);
    if (by_pattern) continue;
    missing += " (" +
               name_with(views, {{reading.row->number, value_at(*reading.row, at.row, gaps)},
                                 {reading.col->number, value_at(*reading.col, at.col, gaps)}}) +
               ")";
  }
  std::string text = fmt::format(
      "{} of the {} views of a {}x{} grid {} missing: {}{}; rows and columns count from 0", total,
      there.size(), rows, cols, total == 1 ? "is" : "are", missing, total > named ? " ..." : "");
  if (reading.rows() * reading.cols() == views.size()) {
    text +=
        fmt::format("; --grid {}x{} takes those that are there", reading.rows(), reading.cols());
  }
  return text;
}

std::string describe_count(const std::vector<NamedPicture>& pictures,
                           const std::optional<NumberColumn>& counter, GridShape grid,
                           FrameOrder order, bool from_0) {
  const size_t wanted = size_t{grid.rows} * grid.cols;
  std::string text = fmt::format("{} picture{} for a {} grid of {} views", pictures.size(),
                                 pictures.size() == 1 ? "" : "s", describe(grid), wanted);
  if (pictures.size() > wanted) {
    return text + ": " + shown_name(pictures[wanted]) + " is the first one too many";
  }
  const size_t total = wanted - pictures.size();
  text += fmt::format("; {} {} missing", total, total == 1 ? "is" : "are");
  const std::string gaps =
      counter ? describe_gaps(pictures, *counter, grid, order, from_0) : std::string();
  if (!gaps.empty()) return text + gaps;
  return text + ": after " + shown_name(pictures.back()) + " the view of " +
         describe_place(view_of_frame(pictures.size(), grid, order));
}

std::string describe_order(const std::vector<NamedPicture>& sorted,
                           const std::optional<NumberColumn>& counter, GridShape grid,
                           FrameOrder order) {
  const std::string_view word = kFrameOrders[static_cast<size_t>(order)].first;
  std::string text = describe(grid) + " views in the ";
  if (counter) {
    text += fmt::format("order of number {} of the names ({})", counter->number + 1,
                        describe_values(*counter));
  } else {
    text += fmt::format("sorted order of the names, {} to {}", shown_name(sorted.front()),
                        shown_name(sorted.back()));
  }
  return text +
         fmt::format(", {}", order == FrameOrder::kRaster ? std::string_view("row by row") : word);
}

}  // namespace hmlfc::io
