#include "primitives/primitive.hpp"

#include <algorithm>
#include <utility>

namespace hmlfc::primitives {

Column within(std::string name, int64_t lo, int64_t hi, const std::string& meaning) {
  std::string range = "[" + std::to_string(lo) + ", " + std::to_string(hi) + "]";
  if (!meaning.empty()) range += ": " + meaning;
  return {std::move(name), std::move(range), [lo, hi](const Inputs&) { return Interval{lo, hi}; }};
}

Bytes random_bytes(std::string range, std::function<size_t(const Inputs&)> count) {
  const auto draw = [count = std::move(count)](const Inputs& inputs, vectors::Random& random) {
    std::vector<uint8_t> bytes(count(inputs));
    const uint32_t kind = random.below(8);
    for (uint8_t& byte : bytes) {
      byte = static_cast<uint8_t>(kind == 0 ? 0 : kind == 1 ? 0xFF : random.below(256));
    }
    return bytes;
  };
  return {std::move(range), draw};
}

const std::vector<Primitive>& all_primitives() {
  static const std::vector<Primitive> all = [] {
    std::vector<Primitive> list;
    for (const auto& area : {bit_primitives(), number_primitives(), sequence_primitives(),
                             sample_primitives(), motion_primitives(), key_primitives()}) {
      list.insert(list.end(), area.begin(), area.end());
    }
    return list;
  }();
  return all;
}

const Primitive* find_primitive(std::string_view name) {
  const auto& all = all_primitives();
  const auto found = std::ranges::find(all, name, &Primitive::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace hmlfc::primitives
