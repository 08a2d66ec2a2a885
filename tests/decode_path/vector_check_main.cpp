// vector_check SUITE [--first ID]... [--stop]: decodes every vector of the suite by every way of
// decoding and prints each that does not do what the manifest says. Small streams come first, those
// named by --first before them; --stop ends with the first failure. Exit status: 0 none failed, 1
// some failed, 2 wrong arguments.
#include <algorithm>
#include <iostream>
#include <string_view>
#include <vector>

#include "vector_check.hpp"

namespace {

using hmlfc::vectors::Vector;

struct Arguments {
  std::filesystem::path suite;
  std::vector<std::string> first;
  bool stop = false;
  bool valid = false;
};

Arguments parse(const std::vector<std::string>& list) {
  Arguments arguments;
  for (size_t i = 0; i < list.size(); ++i) {
    if (list[i] == "--stop") {
      arguments.stop = true;
    } else if (list[i] == "--first" && i + 1 < list.size()) {
      arguments.first.push_back(list[++i]);
    } else if (arguments.suite.empty() && !list[i].starts_with("--")) {
      arguments.suite = list[i];
    } else {
      return arguments;
    }
  }
  arguments.valid = !arguments.suite.empty();
  return arguments;
}

void sort_vectors(std::vector<Vector>& vectors, const std::vector<std::string>& first) {
  const auto rank = [&](const Vector& vector) {
    return std::find(first.begin(), first.end(), vector.id) - first.begin();
  };
  std::stable_sort(vectors.begin(), vectors.end(), [&](const Vector& a, const Vector& b) {
    return std::pair(rank(a), a.input.bytes) < std::pair(rank(b), b.input.bytes);
  });
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse({argv + 1, argv + argc});
  if (!arguments.valid) {
    std::cerr << "usage: vector_check SUITE [--first ID]... [--stop]\n";
    return 2;
  }
  auto manifest = hmlfc::vectors::read_manifest(arguments.suite);
  if (!manifest) {
    std::cerr << manifest.error().message << '\n';
    return 2;
  }
  sort_vectors(manifest->vectors, arguments.first);
  size_t failed = 0;
  for (const Vector& vector : manifest->vectors) {
    const std::string wrong = hmlfc::vectors::check_vector(arguments.suite, vector);
    if (wrong.empty()) continue;
    std::cout << vector.id << ": " << wrong << '\n';
    ++failed;
    if (arguments.stop) return 1;
  }
  std::cout << manifest->vectors.size() << " vectors, " << failed << " failed\n";
  return failed == 0 ? 0 : 1;
}
