#include "conform/line_words.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "conform/running_dut.hpp"

namespace hmlfc::conform {
namespace {

constexpr size_t kShownBytes = 60;  // of a wrong answer

// The value of a hexadecimal digit; above 15 for other characters.
unsigned digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return 16;
}

void require_digits(const std::string& request, std::string_view text, size_t count,
                    const char* what, size_t digits) {
  if (text.size() == count * digits) return;
  wrong_answer(request, fmt::format("{} characters instead of {} {} of {} digits", text.size(),
                                    count, what, digits));
}

// The sample at the beginning of `text`.
int32_t sample_of(const std::string& request, std::string_view text) {
  unsigned bits = 0;
  for (const char c : text.substr(0, kSampleDigits)) {
    const unsigned next = digit(c);
    if (next > 15) wrong_answer(request, shown({&c, 1}) + " is not a hexadecimal digit");
    bits = bits << 4 | next;
  }
  return static_cast<int16_t>(bits);
}

}  // namespace

std::string shown(std::string_view text) {
  std::string beginning(text.substr(0, kShownBytes));
  for (char& c : beginning) c = c >= ' ' && c <= '~' ? c : '?';
  return fmt::format("\"{}\"{}", beginning, text.size() > kShownBytes ? "..." : "");
}

void wrong_answer(const std::string& request, const std::string& why) {
  throw DutFailure{Status::kFail, fmt::format("wrong answer to '{}': {}", request, why)};
}

bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  const std::string_view rest = text.substr(word.size());
  if (!rest.empty() && rest.front() != ' ') return false;
  text = rest.substr(std::min<size_t>(1, rest.size()));
  return true;
}

std::optional<std::vector<int32_t>> record_from_words(std::string_view words) {
  std::string text(words);
  std::ranges::replace(text, ',', ' ');
  std::string_view rest = text;
  std::vector<int32_t> numbers;
  while (const auto value = take_number<int32_t>(rest)) numbers.push_back(*value);
  if (!rest.empty() || numbers.size() != HMLFC_DUT_RECORD_NUMBERS) return std::nullopt;
  return numbers;
}

std::vector<int32_t> samples_of(const std::string& request, std::string_view text, size_t count) {
  require_digits(request, text, count, "samples", kSampleDigits);
  std::vector<int32_t> values;
  values.reserve(count);
  for (; !text.empty(); text.remove_prefix(kSampleDigits)) {
    values.push_back(sample_of(request, text));
  }
  return values;
}

std::vector<uint16_t> pixels_of(const std::string& request, std::string_view text, size_t count,
                                int depth) {
  std::vector<uint16_t> pixels;
  pixels.reserve(count);
  for (const int32_t value : samples_of(request, text, count)) {
    if (value < 0 || value >> depth != 0) {
      wrong_answer(request,
                   fmt::format("sample {} is {}, not of {} bits", pixels.size(), value, depth));
    }
    pixels.push_back(static_cast<uint16_t>(value));
  }
  return pixels;
}

std::vector<BlockDisparity> map_of(const std::string& request, std::string_view text,
                                   size_t count) {
  require_digits(request, text, count, "blocks", kBlockDigits);
  std::vector<BlockDisparity> map;
  for (; !text.empty(); text.remove_prefix(kBlockDigits)) {
    const unsigned confidence = digit(text[kSampleDigits]);
    if (confidence > 3) {
      wrong_answer(request, shown(text.substr(kSampleDigits, 1)) + " is no confidence");
    }
    map.push_back(
        {static_cast<int16_t>(sample_of(request, text)), static_cast<uint8_t>(confidence)});
  }
  return map;
}

}  // namespace hmlfc::conform
