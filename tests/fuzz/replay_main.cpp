// replay_TARGET [--write FOLDER] PATH...: runs a fuzz target on seeds made of the streams PATH (in
// folders: every *.hmlfc below), and on findings (*.input) as they are. --write: writes the seeds
// to FOLDER instead. Prints the number of inputs; exit status 2 if there are none.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <string>

#include "bits/crc32c.hpp"
#include "target.hpp"

namespace {

namespace fs = std::filesystem;
using hmlfc::fuzz::Bytes;

Bytes read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_seed(const fs::path& folder, const Bytes& seed) {
  const std::string name = std::to_string(hmlfc::crc32c(seed)) + "-" + std::to_string(seed.size());
  std::ofstream file(folder / name, std::ios::binary);
  std::copy(seed.begin(), seed.end(), std::ostreambuf_iterator<char>(file));
  if (!file.flush()) throw std::runtime_error((folder / name).string() + ": cannot be written");
}

std::set<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    const auto kind = entry.path().extension();
    if (kind == ".hmlfc" || kind == ".input") files.insert(entry.path());
  }
  return files;
}

size_t use(const fs::path& path, const fs::path& folder) {
  const Bytes bytes = read_file(path);
  const auto seeds =
      path.extension() == ".hmlfc" ? hmlfc::fuzz::seeds(bytes) : std::vector<Bytes>{bytes};
  for (const Bytes& seed : seeds) {
    if (folder.empty()) {
      hmlfc::fuzz::run(seed);
    } else {
      write_seed(folder, seed);
    }
  }
  return seeds.size();
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  fs::path folder;
  if (arguments.size() > 1 && arguments[0] == "--write") {
    folder = arguments[1];
    fs::create_directories(folder);
    arguments.erase(arguments.begin(), arguments.begin() + 2);
  }
  size_t count = 0;
  for (const std::string& argument : arguments) {
    for (const fs::path& path : files_of(argument)) count += use(path, folder);
  }
  std::cout << count << " inputs\n";
  return count == 0 ? 2 : 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
