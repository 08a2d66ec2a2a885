#include "io/name_grid.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

namespace hmlfc::io {
namespace {

constexpr size_t kMostColumns = 16;

// Number `number` of all pictures, if it is an integer in each.
std::optional<NumberColumn> column_of(std::span<const NamedPicture> pictures, size_t number) {
  NumberColumn column{number, {}, {}};
  for (const NamedPicture& picture : pictures) {
    const auto& value = picture.numbers[number].value;
    if (!value) return std::nullopt;
    column.values.push_back(*value);
  }
  const std::vector<int64_t> all = column.values;
  std::ranges::sort(column.values);
  const auto rest = std::ranges::unique(column.values);
  column.values.erase(rest.begin(), rest.end());
  for (const int64_t value : all) {
    const auto found = std::ranges::lower_bound(column.values, value);
    column.ranks.push_back(static_cast<uint32_t>(found - column.values.begin()));
  }
  return column;
}

constexpr int kIrregular = 4;

// How far a number is from one that counts rows or columns: 0 counts from 0 or 1.
int strangeness(const NumberColumn& column) {
  if (!column.is_regular()) return kIrregular;
  if (column.values.front() < 0) return 3;
  if (column.step() != 1) return 2;
  return column.values.front() <= 1 ? 0 : 1;
}

int strangeness(const GridReading& reading) {
  return std::max(strangeness(*reading.row), strangeness(*reading.col));
}

// Whether each value of `a` goes with one of `b`, and the other way round.
bool say_the_same(const NumberColumn& a, const NumberColumn& b) {
  if (a.values.size() != b.values.size()) return false;
  constexpr uint32_t kNone = ~uint32_t{0};
  std::vector<uint32_t> b_of(a.values.size(), kNone);
  std::vector<uint32_t> a_of(a.values.size(), kNone);
  for (size_t i = 0; i < a.ranks.size(); ++i) {
    uint32_t& to = b_of[a.ranks[i]];
    uint32_t& from = a_of[b.ranks[i]];
    if (to == kNone) to = b.ranks[i];
    if (from == kNone) from = a.ranks[i];
    if (to != b.ranks[i] || from != a.ranks[i]) return false;
  }
  return true;
}

// The letters right before a number, or before the decimal number of which it is the fraction, in
// small letters.
std::string label_of(const NamedPicture& picture, size_t number) {
  const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  size_t end = picture.numbers[number].begin;
  if (end > 1 && picture.name[end - 1] == '.' && is_digit(picture.name[end - 2])) {
    for (--end; end > 0 && is_digit(picture.name[end - 1]);) --end;
    while (end > 0 && (picture.name[end - 1] == '_' || picture.name[end - 1] == '-')) --end;
  }
  if (end > 0 && picture.name[end - 1] == '_') --end;
  size_t begin = end;
  while (begin > 0 && is_letter(picture.name[begin - 1])) --begin;
  std::string label = picture.name.substr(begin, end - begin);
  for (char& c : label) c = static_cast<char>(c | 0x20);
  return label;
}

bool is_one_of(const std::string& label, std::initializer_list<std::string_view> labels) {
  return std::ranges::find(labels, label) != labels.end();
}

GridReading reading_of(const NamedPicture& picture, const NumberColumn& a, const NumberColumn& b) {
  const bool turned = is_one_of(label_of(picture, a.number), {"x", "u", "c", "col", "column"}) &&
                      is_one_of(label_of(picture, b.number), {"y", "v", "r", "row"});
  return turned ? GridReading{&b, &a} : GridReading{&a, &b};
}

// Whether no place of the reading has two pictures.
bool is_unique(const GridReading& reading, size_t pictures) {
  if (reading.rows() * reading.cols() > uint64_t{kMaxGridSide} * kMaxGridSide) return false;
  std::vector<bool> taken(reading.rows() * reading.cols());
  for (size_t i = 0; i < pictures; ++i) {
    if (taken[reading.place(i)]) return false;
    taken[reading.place(i)] = true;
  }
  return true;
}

// Names of one row, as 0_0, 0_1 ...: the number that does not vary is written as the other is, so
// that it may count. In take2_0001 it does not.
bool may_count(std::span<const NamedPicture> pictures, const NumberColumn& constant,
               const NumberColumn& other) {
  const auto width = [&](const NamedPicture& picture, const NumberColumn& column) {
    return picture.numbers[column.number].end - picture.numbers[column.number].begin;
  };
  size_t least = width(pictures.front(), other);
  for (const NamedPicture& picture : pictures) least = std::min(least, width(picture, other));
  return constant.values.size() > 1 || width(pictures.front(), constant) == least;
}

// Calls visit(reading) for each pair of columns that may be row and column.
template <class Visit>
void for_each_pair(std::span<const NamedPicture> pictures, const std::vector<NumberColumn>& columns,
                   const Visit& visit) {
  for (size_t i = 0; i < columns.size(); ++i) {
    for (size_t j = i + 1; j < columns.size(); ++j) {
      if (may_count(pictures, columns[i], columns[j]) &&
          may_count(pictures, columns[j], columns[i])) {
        visit(reading_of(pictures.front(), columns[i], columns[j]));
      }
    }
  }
}

bool has_shape(const GridReading& reading, std::optional<GridShape> grid) {
  return !grid || (reading.rows() == grid->rows && reading.cols() == grid->cols);
}

}  // namespace

int64_t NumberColumn::step() const {
  int64_t step = 0;
  for (size_t i = 1; i < values.size(); ++i) step = std::gcd(step, values[i] - values[i - 1]);
  return std::max<int64_t>(step, 1);
}

uint64_t NumberColumn::extent() const {
  return static_cast<uint64_t>((values.back() - values.front()) / step()) + 1;
}

std::vector<NumberColumn> number_columns(std::span<const NamedPicture> pictures) {
  std::vector<NumberColumn> columns;
  const size_t numbers = pictures.front().numbers.size();
  const auto has_others = [&](const NamedPicture& p) { return p.numbers.size() != numbers; };
  if (std::ranges::any_of(pictures, has_others)) return columns;
  for (size_t number = 0; number < numbers && columns.size() < kMostColumns; ++number) {
    auto column = column_of(pictures, number);
    if (!column || (column->values.size() == 1 && numbers > 2)) continue;
    const auto same = std::ranges::find_if(columns, [&](const NumberColumn& other) {
      return column->values.size() > 1 && say_the_same(other, *column);
    });
    if (same == columns.end()) {
      columns.push_back(std::move(*column));
    } else if (strangeness(*column) < strangeness(*same)) {
      columns.erase(same);
      columns.push_back(std::move(*column));
    }
  }
  return columns;
}

std::array<NumberColumn, 2> position_columns(std::span<const NamedPicture> pictures) {
  return {*column_of(pictures, 0), *column_of(pictures, 1)};
}

bool is_full(const GridReading& reading, size_t pictures, std::optional<GridShape> grid) {
  return reading.rows() * reading.cols() == pictures && has_shape(reading, grid) &&
         (grid || strangeness(reading) < kIrregular) && is_unique(reading, pictures);
}

std::vector<GridReading> full_grids(std::span<const NamedPicture> pictures,
                                    const std::vector<NumberColumn>& columns,
                                    std::optional<GridShape> grid) {
  int least = kIrregular;
  std::vector<GridReading> found;
  for_each_pair(pictures, columns, [&](const GridReading& reading) {
    if (strangeness(reading) > least || !is_full(reading, pictures.size(), grid)) return;
    if (strangeness(reading) < least) found.clear();
    least = strangeness(reading);
    found.push_back(reading);
  });
  return found;
}

std::optional<GridReading> nearest_grid(std::span<const NamedPicture> pictures,
                                        const std::vector<NumberColumn>& columns,
                                        std::optional<GridShape> grid) {
  std::optional<GridReading> nearest;
  auto least = static_cast<double>(2 * pictures.size() + 16);
  for_each_pair(pictures, columns, [&](const GridReading& reading) {
    // A number that is another one in each picture counts pictures.
    if (std::max(reading.rows(), reading.cols()) == pictures.size()) return;
    const double places = grid ? static_cast<double>(reading.rows() * reading.cols())
                               : static_cast<double>(reading.row->extent()) *
                                     static_cast<double>(reading.col->extent());
    if (places > least || !has_shape(reading, grid) || !is_unique(reading, pictures.size())) return;
    least = places;
    nearest = reading;
  });
  return nearest;
}

}  // namespace hmlfc::io
