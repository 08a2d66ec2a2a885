#include "io/notes.hpp"

#include <algorithm>
#include <utility>

namespace hmlfc::io {

Notes::Kind* Notes::find(const std::string& what) {
  const auto found = std::ranges::find(kinds_, what, &Kind::what);
  return found == kinds_.end() ? nullptr : &*found;
}

void Notes::add(const std::filesystem::path& file, std::string what) {
  Kind* known = find(what);
  if (known == nullptr) {
    kinds_.push_back({std::move(what), file});
  } else if (known->first != file) {
    ++known->others;
  }
}

Notes Notes::add(const Notes& later) {
  Notes fresh;
  for (const Kind& kind : later.kinds_) {
    if (Kind* known = find(kind.what)) {
      known->others += kind.others + 1;
    } else {
      kinds_.push_back(kind);
      fresh.kinds_.push_back(kind);
    }
  }
  return fresh;
}

std::vector<std::string> Notes::lines() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    const std::string more =
        kind.others > 0 ? " and " + std::to_string(kind.others) + " more: " : ": ";
    lines.push_back(kind.first.string() + more + kind.what);
  }
  return lines;
}

}  // namespace hmlfc::io
