// JSON from outside: every text is read through walk_json(), which bounds it. JSON for outside is
// written by json_text().
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "io/files.hpp"
#include "io/io_error.hpp"

namespace hmlfc::io {

/// What a text of one kind may take.
struct JsonLimits {
  const char* kind;                ///< in messages: "a rig"
  size_t bytes;                    ///< of the text
  size_t depth;                    ///< of objects and arrays inside each other
  size_t token = size_t{1} << 20;  ///< bytes of a string or number as it is written

  /// What is wrong with a text of so many bytes; empty: nothing.
  std::string excess(uint64_t text_bytes) const;
};

/// The most members of an object that parse_json() puts into nlohmann::ordered_json, which looks
/// for a member from the first on. nlohmann::json has no such limit.
inline constexpr size_t kMaxOrderedMembers = 64;

/// Gets the parts of a text in their order. A function that returns false ends the walk.
class JsonHandler : public nlohmann::json_sax<nlohmann::json> {
 public:
  /// What refuse() got; else empty.
  const std::string& error() const { return error_; }

  bool binary(binary_t& /*value*/) final { return refuse("no JSON text"); }
  bool parse_error(size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) final;

 protected:
  /// Ends the walk with this error; false.
  bool refuse(std::string what);

 private:
  std::string error_;
};

/// Hands the parts of `text` to `handler`, in linear time, with memory for one token. Error: the
/// text breaks a limit, which is found before `handler` gets anything; it is no JSON text in UTF-8
/// (RFC 8259); or the error of `handler`. A handler that returned false without an error is none.
tl::expected<void, std::string> walk_json(std::span<const uint8_t> text, const JsonLimits& limits,
                                          JsonHandler& handler);

/// The value of `text`, as nlohmann::json or nlohmann::ordered_json. Errors as walk_json(); an
/// object with a member twice, or with more members than Json takes.
template <class Json>
tl::expected<Json, std::string> parse_json(std::span<const uint8_t> text, const JsonLimits& limits);

/// parse_json() of a file. Errors name it; also: it cannot be read.
template <class Json>
IoResult<Json> read_json_file(const std::filesystem::path& file, const JsonLimits& limits) {
  const auto mapped = map_file(file);
  if (!mapped) return tl::unexpected(mapped.error());
  auto json = parse_json<Json>(mapped->bytes(), limits);
  if (!json) return file_error(file, json.error());
  return std::move(*json);
}

/// The integer `value`, in the range of T; a fraction is none, even one that ends in .0. Throws
/// Json::exception if it is no such integer.
template <class T, class Json>
T integer_of(const Json& value) {
  if (value.is_number_unsigned()) {
    if (const auto number = value.template get<uint64_t>(); std::in_range<T>(number)) {
      return static_cast<T>(number);
    }
  } else if (value.is_number_integer()) {
    if (const auto number = value.template get<int64_t>(); std::in_range<T>(number)) {
      return static_cast<T>(number);
    }
  }
  throw Json::other_error::create(501, "an integer is missing or out of range", nullptr);
}

/// The integer `json[key]`. Throws as integer_of(), and where there is no such key.
template <class T, class Json, class Key>
T integer_at(const Json& json, Key key) {
  return integer_of<T>(json.at(key));
}

/// The integers of the array `json[key]`. Throws as integer_at().
template <class T, class Json, class Key>
std::vector<T> integers_at(const Json& json, Key key) {
  const Json& array = json.at(key);
  std::vector<T> integers;
  for (size_t i = 0; i < array.size(); ++i) integers.push_back(integer_at<T>(array, i));
  return integers;
}

/// `value`, or a text from outside, for a message: as JSON in ASCII without control characters, cut
/// to 80 characters.
std::string shown_json(const nlohmann::json& value);

/// The bytes of `text`, which must outlive them.
inline std::span<const uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

/// `text` with U+FFFD for what is not UTF-8.
std::string valid_utf8(std::string_view text);

/// `value` as JSON text: on one line, or `indent` spaces a level. Strings may hold anything: U+FFFD
/// stands for what is not UTF-8.
template <class Json>
std::string json_text(const Json& value, int indent = -1) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace hmlfc::io
