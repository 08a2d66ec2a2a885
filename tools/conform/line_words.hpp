// Words of the line protocol (docs/line_protocol.md): numbers, samples and maps in the text of an
// answer. Functions that take the `request` throw DutFailure with it where the text is no answer.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/disparity.hpp>

namespace hmlfc::conform {

inline constexpr size_t kSampleDigits = 4;  ///< of a sample, hexadecimal
inline constexpr size_t kBlockDigits = 5;   ///< of a block of a map: disparity and confidence

/// The beginning of `text`, without control characters, in quotes.
std::string shown(std::string_view text);

/// Throws: the answer is wrong, and why.
[[noreturn]] void wrong_answer(const std::string& request, const std::string& why);

/// Removes `word` and the blank after it, or the end, from the front of `text`; false if they are
/// not there.
bool take_word(std::string_view& text, std::string_view word);

/// The next decimal number of `text`, removed from its front.
template <class T = uint32_t>
std::optional<T> take_number(std::string_view& text) {
  T value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !take_word(text, {text.data(), end})) return std::nullopt;
  return value;
}

/// The numbers of a frame record, separated by commas.
std::optional<std::vector<int32_t>> record_from_words(std::string_view words);

/// `count` samples in two's complement.
std::vector<int32_t> samples_of(const std::string& request, std::string_view text, size_t count);

/// `count` samples of pixels: [0, 2^depth - 1].
std::vector<uint16_t> pixels_of(const std::string& request, std::string_view text, size_t count,
                                int depth);

/// A map of `count` blocks.
std::vector<BlockDisparity> map_of(const std::string& request, std::string_view text, size_t count);

}  // namespace hmlfc::conform
