// Headers from recipes, and what the keys of a JSON object set.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <hmlfc/format.hpp>

#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// What the keys of a JSON object set in a Target.
template <class Target>
using Setters = std::map<std::string, std::function<void(Target&, const Json&)>>;

/// T, or what an optional T holds.
template <class T>
struct Plain {
  using Type = T;
};
template <class T>
struct Plain<std::optional<T>> {
  using Type = T;
};

/// Sets a number.
template <class Target, class T>
auto number(T Target::*member) {
  return [member](Target& target, const Json& json) {
    target.*member = json.get<typename Plain<T>::Type>();
  };
}

/// The value of the word `json`, one of `words`.
template <class T>
T value_of_word(const Json& json, const std::map<std::string, T>& words) {
  const auto found = words.find(json.get<std::string>());
  if (found == words.end()) throw TextError(json.dump() + " is not one of the allowed words");
  return found->second;
}

/// Sets one of `words`.
template <class Target, class T>
auto word(T Target::*member, std::map<std::string, typename Plain<T>::Type> words) {
  return [member, words = std::move(words)](Target& target, const Json& json) {
    target.*member = value_of_word(json, words);
  };
}

/// Sets all keys of `json`. Throws TextError for an unknown key, which is not `kind`.
template <class Target>
void set_all(Target& target, const Json& json, const Setters<Target>& setters, const char* kind) {
  for (const auto& [key, value] : json.items()) {
    const auto setter = setters.find(key);
    if (setter == setters.end()) throw TextError("\"" + key + "\" is not " + kind);
    setter->second(target, value);
  }
}

inline std::map<std::string, ChromaFormat> chroma_formats() {
  return {{"420", ChromaFormat::k420}, {"444", ChromaFormat::k444}};
}

/// The header whose fields `json` names as FIL-1 and EXT-2 do; "features" lists flags by name,
/// "levels" reference groups [ref_rows, ref_cols] or [ref_rows, ref_cols, key_references] from
/// level 0 on, the last of them for all levels above. Defaults: one view of 16 x 16 pixels, depth
/// 8, 4:2:0, blocks of 4, window 16, no tree, no reference groups. Throws TextError if the fields
/// break FIL-1 or EXT-2.
StreamHeader header_from(const Json& json);

/// The properties of a header as flags of a vector: "extended", "depth10", "predictive" ...
std::vector<std::string> header_flags(const StreamHeader& header);

}  // namespace hmlfc::vectors
