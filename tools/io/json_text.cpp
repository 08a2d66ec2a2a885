#include "io/json_text.hpp"

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace hmlfc::io {
namespace {

// Follows strings and brackets through a text, be it JSON or not.
class LimitCheck {
 public:
  explicit LimitCheck(const JsonLimits& limits) : limits_(limits) {}

  // Takes the next byte. What is wrong with it; empty: nothing.
  std::string next(uint8_t byte) {
    if (byte == 0) return "no JSON text";  // the library takes it for the end of the text
    if (quoted_) {
      quoted_ = escaped_ || byte != '"';
      escaped_ = !escaped_ && byte == '\\';
      return lengthen();
    }
    if (std::string_view(" \t\r\n,:[]{}").find(static_cast<char>(byte)) == std::string_view::npos) {
      if (byte == '"') token_ = 0;
      quoted_ = byte == '"';
      return lengthen();
    }
    token_ = 0;
    if ((byte == '[' || byte == '{') && ++depth_ > limits_.depth) {
      return fmt::format("objects and arrays are nested deeper than the {} of {}", limits_.depth,
                         limits_.kind);
    }
    if ((byte == ']' || byte == '}') && depth_ > 0) --depth_;
    return {};
  }

 private:
  std::string lengthen() {
    if (++token_ <= limits_.token) return {};
    return fmt::format("a string or number is longer than the {} bytes of {}", limits_.token,
                       limits_.kind);
  }

  const JsonLimits& limits_;
  size_t depth_ = 0;
  size_t token_ = 0;  // bytes of the one that is being read
  bool quoted_ = false;
  bool escaped_ = false;
};

// Empty: the text keeps to its limits.
std::string broken_limit(std::span<const uint8_t> text, const JsonLimits& limits) {
  if (std::string excess = limits.excess(text.size()); !excess.empty()) return excess;
  LimitCheck check(limits);
  for (size_t i = 0; i < text.size(); ++i) {
    const std::string wrong = check.next(text[i]);
    if (!wrong.empty()) return fmt::format("{}: byte {}", wrong, i + 1);
  }
  return {};
}

// Makes a value of the parts.
template <class Json>
class Builder final : public JsonHandler {
 public:
  Json value;

  bool null() override { return add(nullptr); }
  bool boolean(bool part) override { return add(part); }
  bool number_integer(number_integer_t part) override { return add(part); }
  bool number_unsigned(number_unsigned_t part) override { return add(part); }
  bool number_float(number_float_t part, const string_t& /*text*/) override { return add(part); }
  bool string(string_t& part) override { return add(std::move(part)); }
  bool start_object(size_t /*count*/) override { return open(Json::object()); }
  bool start_array(size_t /*count*/) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Json& object = *open_.back();
    if (object.contains(name)) {
      return refuse(fmt::format("the member {} is there twice", shown_json(name)));
    }
    if (std::is_same_v<Json, nlohmann::ordered_json> && object.size() == kMaxOrderedMembers) {
      return refuse(fmt::format("an object has more than {} members", kMaxOrderedMembers));
    }
    member_ = &object[name];
    return true;
  }

 private:
  Json& put(Json part) {
    Json& place = open_.empty()              ? value
                  : open_.back()->is_array() ? open_.back()->emplace_back(nullptr)
                                             : *member_;
    return place = std::move(part);
  }
  bool add(Json part) {
    put(std::move(part));
    return true;
  }
  bool open(Json part) {
    Json& place = put(std::move(part));
    open_.push_back(&place);
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<Json*> open_;  // from the outermost on; what holds an open one does not grow
  Json* member_ = nullptr;   // of the innermost, whose value comes next
};

}  // namespace

std::string JsonLimits::excess(uint64_t text_bytes) const {
  if (text_bytes <= bytes) return {};
  return fmt::format("{} bytes are more than the {} of {}", text_bytes, bytes, kind);
}

bool JsonHandler::parse_error(size_t position, const std::string& token,
                              const nlohmann::detail::exception& error) {
  constexpr int kNumberOverflow = 406;
  if (error.id == kNumberOverflow) return refuse("no JSON text: a number is too large");
  std::string text = fmt::format("no JSON text: byte {}", position);
  const std::string_view what = error.what();
  const size_t line = what.find(" at line ");
  if (line != what.npos && !what.substr(line).starts_with(" at line 1,")) {
    text += "," + std::string(what.substr(line + 3, what.find(',', line) - line - 3));
  }
  const char last = token.empty() ? ' ' : token.back();
  if (last == 'N' || last == 'I') text += ", where JSON has no NaN or Infinity";
  if (last == '/' || last == '#') text += ", where JSON has no comments";
  return refuse(std::move(text));
}

bool JsonHandler::refuse(std::string what) {
  error_ = std::move(what);
  return false;
}

tl::expected<void, std::string> walk_json(std::span<const uint8_t> text, const JsonLimits& limits,
                                          JsonHandler& handler) {
  if (std::string broken = broken_limit(text, limits); !broken.empty()) {
    return tl::unexpected(std::move(broken));
  }
  nlohmann::json::sax_parse(text.begin(), text.end(), &handler);
  if (!handler.error().empty()) return tl::unexpected(handler.error());
  return {};
}

template <class Json>
tl::expected<Json, std::string> parse_json(std::span<const uint8_t> text,
                                           const JsonLimits& limits) {
  Builder<Json> builder;
  if (auto walked = walk_json(text, limits, builder); !walked) {
    return tl::unexpected(std::move(walked.error()));
  }
  return std::move(builder.value);
}

template tl::expected<nlohmann::json, std::string> parse_json(std::span<const uint8_t>,
                                                              const JsonLimits&);
template tl::expected<nlohmann::ordered_json, std::string> parse_json(std::span<const uint8_t>,
                                                                      const JsonLimits&);

std::string shown_json(const nlohmann::json& value) {
  constexpr size_t kMost = 80;
  constexpr std::string_view kCut = "...";
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > kMost) text.replace(kMost - kCut.size(), std::string::npos, kCut);
  return text;
}

std::string valid_utf8(std::string_view text) {
  return nlohmann::json::parse(json_text(nlohmann::json(text))).get<std::string>();
}

}  // namespace hmlfc::io
