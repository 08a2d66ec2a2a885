// Options and positionals that are read strictly: "4x4", "3,5", plain decimal numbers.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <hmlfc/decoder.hpp>

#include "io/view_list.hpp"

namespace hmlfc::cli {

/// A decimal number: digits, after a minus where T is signed; nothing before or behind, and within
/// the range of T. "010" is ten.
template <std::integral T>
std::optional<T> parse_integer(std::string_view text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || last != end) return std::nullopt;
  return value;
}

/// N numbers with `separator` between them: parse_numbers<2>("16x9", 'x') = {16, 9}.
template <size_t N>
std::optional<std::array<uint32_t, N>> parse_numbers(std::string_view text, char separator) {
  std::array<uint32_t, N> numbers{};
  for (size_t i = 0; i < N; ++i) {
    const size_t end = i + 1 < N ? text.find(separator) : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = parse_integer<uint32_t>(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers[i] = *number;
    if (i + 1 < N) text.remove_prefix(end + 1);
  }
  return numbers;
}

/// From `least` to `most` decimal numbers with commas between them: "7.5,3,-2". NaN and infinities
/// are none.
std::optional<std::vector<double>> parse_decimals(std::string_view text, size_t least, size_t most);

/// Stores what `text` says, or returns the complaint: what was expected.
using Reader = std::function<std::optional<std::string>(const std::string& text)>;

/// Adds an option ("--name,-n") or positional ("NAME") whose one value `reader` takes. `type_name`
/// shows in the help.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type_name,
                       const std::string& description, Reader reader);

/// Stores an integer in [lo, hi] in `target`, a T or an optional T.
template <std::integral T, class Target>
Reader integer_reader(Target& target, T lo, T hi) {
  return [&target, lo, hi](const std::string& text) -> std::optional<std::string> {
    const auto value = parse_integer<T>(text);
    if (!value || *value < lo || *value > hi) {
      return fmt::format("an integer in [{}, {}]", lo, hi);
    }
    target = *value;
    return std::nullopt;
  };
}

/// An integer in [lo, hi]; the help shows the value that `target` has now as the default.
template <std::integral T>
CLI::Option* add_integer(CLI::App& app, const std::string& name, T& target,
                         std::type_identity_t<T> lo, std::type_identity_t<T> hi,
                         const std::string& description) {
  return add_value(app, name, "N", description, integer_reader<T>(target, lo, hi))
      ->default_str(std::to_string(target));
}

/// The same without a default.
template <std::integral T>
CLI::Option* add_integer(CLI::App& app, const std::string& name, std::optional<T>& target,
                         std::type_identity_t<T> lo, std::type_identity_t<T> hi,
                         const std::string& description) {
  return add_value(app, name, "N", description, integer_reader<T>(target, lo, hi));
}

/// A decimal number in [lo, hi].
CLI::Option* add_decimal(CLI::App& app, const std::string& name, const std::string& type_name,
                         std::optional<double>& target, double lo, double hi,
                         const std::string& description);

/// One of a few words.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& target,
                        std::vector<std::pair<std::string, T>> choices,
                        const std::string& description) {
  std::string words;
  for (const auto& [word, value] : choices) {
    if (!words.empty()) words += '|';
    words += word;
  }
  const auto reader = [&target, choices = std::move(choices),
                       words](const std::string& text) -> std::optional<std::string> {
    for (const auto& [word, value] : choices) {
      if (word != text) continue;
      target = value;
      return std::nullopt;
    }
    return words;
  };
  return add_value(app, name, words, description, reader);
}

/// Rows and columns, each in [1, max], as "RxC".
CLI::Option* add_rows_by_cols(CLI::App& app, const std::string& name, uint32_t& rows,
                              uint32_t& cols, uint32_t max, const std::string& description);

/// --grid RxC, for folders whose names do not tell it.
CLI::Option* add_grid(CLI::App& app, std::optional<io::GridShape>& target);

/// --view R,C.
CLI::Option* add_view(CLI::App& app, std::optional<ViewPos>& target,
                      const std::string& description);

/// --levels N: levels of the tree to use, from the top.
CLI::Option* add_levels(CLI::App& app, std::optional<int>& target);

/// --threads N, 0 for all cores.
CLI::Option* add_threads(CLI::App& app, int& target);

/// -o, --output: a path that is required.
CLI::Option* add_output(CLI::App& app, std::filesystem::path& target, const std::string& type_name,
                        const std::string& description);

/// A required positional path.
CLI::Option* add_path(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      const std::string& description);

}  // namespace hmlfc::cli
