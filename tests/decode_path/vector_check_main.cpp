// vector_check SUITE [--vector ID]...: decodes every vector of the suite, or these, by every way of
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
  std::vector<std::string> ids;
  CLI::App app{"Decodes every vector of a suite by every way of decoding"};
  app.add_option("SUITE", suite)->required();
  app.add_option("--vector", ids, "Only these");
  CLI11_PARSE(app, argc, argv);
  auto manifest = hmlfc::vectors::read_manifest(suite);
  if (!manifest) {
    std::cerr << manifest.error().message << '\n';
    return 2;
  }
  size_t decoded = 0;
  size_t failed = 0;
  for (const Vector& vector : manifest->vectors) {
    if (!ids.empty() && std::ranges::find(ids, vector.id.text()) == ids.end()) continue;
    ++decoded;
    const std::string wrong = hmlfc::vectors::check_vector(suite, vector);
    if (wrong.empty()) continue;
    std::cout << vector.id.text() << ": " << wrong << '\n';
    ++failed;
  }
  std::cout << decoded << " vectors, " << failed << " failed\n";
  return failed == 0 && decoded != 0 ? 0 : 1;
}
