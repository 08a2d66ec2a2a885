// vector_check SUITE [--first ID]... [--stop]: decodes every vector of the suite by every way of
// decoding and prints each that does not do what the manifest says. Exit status: 0 none failed, 1
// some failed, 2 the suite cannot be read; those of CLI11 for wrong arguments.
#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "vector_check.hpp"

using hmlfc::vectors::Vector;

int main(int argc, char** argv) {
  std::filesystem::path suite;
  std::vector<std::string> first;
  bool stop = false;
  CLI::App app{"Decodes every vector of a suite by every way of decoding, small streams first"};
  app.add_option("SUITE", suite)->required();
  app.add_option("--first", first, "Vectors to begin with");
  app.add_flag("--stop", stop, "End with the first failure");
  CLI11_PARSE(app, argc, argv);
  auto manifest = hmlfc::vectors::read_manifest(suite);
  if (!manifest) {
    std::cerr << manifest.error().message << '\n';
    return 2;
  }
  const auto rank = [&](const Vector& vector) {
    return std::pair(std::ranges::find(first, vector.id.text()) - first.begin(),
                     vector.input.bytes);
  };
  std::ranges::stable_sort(manifest->vectors, {}, rank);
  size_t failed = 0;
  for (const Vector& vector : manifest->vectors) {
    const std::string wrong = hmlfc::vectors::check_vector(suite, vector);
    if (wrong.empty()) continue;
    std::cout << vector.id.text() << ": " << wrong << '\n';
    ++failed;
    if (stop) return 1;
  }
  std::cout << manifest->vectors.size() << " vectors, " << failed << " failed\n";
  return failed == 0 ? 0 : 1;
}
