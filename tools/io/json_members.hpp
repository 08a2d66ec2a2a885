// The members of JSON objects as members of structs: one function for each struct reads and writes
// them.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/json_text.hpp"

namespace hmlfc::io {

/// What is wrong with a text from outside, for people.
class TextError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The members of a JSON object, read into values or written from them in the order of the calls.
/// A struct takes part by a function in its namespace, such as
///
///     static void visit(const Members& m, ViewPos& view) {
///       m("row", view.row);
///       m("col", view.col);
///     }
///
/// Integers are checked to be in the range of their type. Reading throws TextError, which names the
/// member, and std::bad_alloc.
class Members {
 public:
  using Json = nlohmann::ordered_json;

  Members(Json& json, bool reading) : json_(json), reading_(reading) {}

  bool reading() const { return reading_; }
  bool has(const char* key) const { return json_.contains(key); }
  Json& json() const { return json_; }

  /// A member that must be there.
  template <class T>
  void operator()(const char* key, T& value) const {
    known_.emplace_back(key);
    if (!reading_) return write(json_[key], value);
    try {
      read(json_.at(key), value);
    } catch (const Json::exception&) {
      throw TextError(named(key) + " is missing, of the wrong kind or out of range");
    } catch (const TextError& error) {
      throw TextError(named(key) + ": " + error.what());
    }
  }

  /// A member that may be missing, as `value` may.
  template <class T>
  void operator()(const char* key, std::optional<T>& value) const {
    if (reading_ && has(key)) value.emplace();
    if (value) return (*this)(key, *value);
    known_.emplace_back(key);
  }

  /// A member that may be missing: `value` stays. It is always written.
  template <class T>
  void given(const char* key, T& value) const {
    if (!reading_ || has(key)) return (*this)(key, value);
    known_.emplace_back(key);
  }

  /// A member that is missing where `value` is T{}.
  template <class T>
  void unless_empty(const char* key, T& value) const {
    if (reading_ ? has(key) : value != T{}) return (*this)(key, value);
    known_.emplace_back(key);
  }

  /// An integer in [least, greatest] that may be missing.
  template <class T>
  void within(const char* key, T& value, int64_t least, int64_t greatest) const {
    const std::string what = named(key) + " is not an integer in [" + std::to_string(least) + ", " +
                             std::to_string(greatest) + "]";
    try {
      given(key, value);
    } catch (const TextError&) {
      throw TextError(what);
    }
    if (reading_ && !(value >= least && value <= greatest)) throw TextError(what);
  }

  /// The members of object `key`.
  Members at(const char* key) const {
    known_.emplace_back(key);
    if (reading_ && (!has(key) || !json_[key].is_object())) {
      throw TextError(named(key) + " is no object");
    }
    return {json_[key], reading_};
  }

  /// Throws where `where`, the object that is read, has other members than those asked for.
  void refuse_others(const std::string& where) const {
    if (!reading_) return;
    if (!json_.is_object()) throw TextError(where + " is not an object");
    for (const auto& item : json_.items()) {
      if (std::ranges::find(known_, item.key()) == known_.end()) {
        throw TextError(where + " has the unknown key " + shown_json(item.key()));
      }
    }
  }

  /// An enumerator, whose values count from 0, as one of `names`: the value is no object, but that
  /// text.
  template <class T, size_t kCount>
  void as_name(T& value, const std::array<std::string_view, kCount>& names) const {
    if (!reading_) return static_cast<void>(json_ = names[static_cast<size_t>(value)]);
    const auto text = json_.template get<std::string>();
    const auto found = std::ranges::find(names, text);
    if (found == names.end()) {
      std::string all;
      for (const std::string_view name : names)
        all += (all.empty() ? "" : ", ") + std::string(name);
      throw TextError(shown_json(text) + " is none of " + all);
    }
    value = static_cast<T>(found - names.begin());
  }

 private:
  static std::string named(const char* key) { return std::string("\"") + key + "\""; }

  template <class T>
  static void read(Json& json, T& value) {
    if constexpr (requires(const Members& m) { visit(m, value); }) {
      visit(Members(json, true), value);
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      value = integer_of<T>(json);
    } else {
      json.get_to(value);
    }
  }
  template <class T>
  static void read(Json& json, std::vector<T>& values) {
    values.clear();
    for (Json& item : json.get_ref<Json::array_t&>()) read(item, values.emplace_back());
  }

  template <class T>
  static void write(Json& json, T& value) {
    if constexpr (requires(const Members& m) { visit(m, value); }) {
      visit(Members(json, false), value);
    } else {
      json = value;
    }
  }
  template <class T>
  static void write(Json& json, std::vector<T>& values) {
    json = Json::array();
    for (T& value : values) write(json.emplace_back(), value);
  }

  Json& json_;
  bool reading_;
  mutable std::vector<std::string_view> known_;  // members that were asked for
};

/// The object that `value` is read from.
template <class T>
Members::Json written(T value) {
  Members::Json json;
  visit(Members(json, false), value);
  return json;
}

}  // namespace hmlfc::io
