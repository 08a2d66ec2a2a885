// stress_streams COMMAND: decodes streams with every quantity of the width table watched; prints
// what was reached as JSON. `--help` lists the commands. Exit status: 0 nothing wrong, 1 a value
// left its interval, a conversion lost its value or ways of decoding differ, 2 wrong arguments.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include <CLI/CLI.hpp>

#include "geometry_extremes.hpp"
#include "search.hpp"
#include "values/narrow.hpp"
#include "vectors/random_stream.hpp"

namespace hmlfc::stress {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path folder = ".";
  uint64_t blocks = 400;
  std::string plant;
  std::vector<fs::path> paths;
  uint64_t seed = 1;
  double seconds = 1e9;
  uint64_t count = 1'000'000'000;
  fs::path found;
};

std::vector<uint8_t> read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// The files with this extension in or below `paths`, sorted.
std::vector<fs::path> files_below(const std::vector<fs::path>& paths,
                                  const std::string& extension) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (entry.path().extension() == extension) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void run_files(Session& session, const Arguments& arguments) {
  for (const fs::path& file : files_below(arguments.paths, ".hmlfc")) {
    session.run(file.filename().string(), read_file(file));
  }
}

std::vector<Json> recipes_below(const std::vector<fs::path>& paths) {
  std::vector<Json> recipes;
  for (const fs::path& file : files_below(paths, ".json")) {
    for (const Json& recipe : vectors::read_json(file)) recipes.push_back(recipe);
  }
  return recipes;
}

void run_recipes(Session& session, const Arguments& arguments) {
  for (const fs::path& file : files_below(arguments.paths, ".json")) {
    size_t number = 0;
    for (const Json& recipe : vectors::read_json(file)) {
      session.run(file.filename().string() + " " + std::to_string(number++), stream_of(recipe));
    }
  }
}

void run_random(Session& session, const Arguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  for (uint64_t n = 0; n < arguments.count; ++n) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    if (elapsed.count() >= arguments.seconds) return;
    const uint64_t seed = arguments.seed + n;
    session.run("random stream " + std::to_string(seed), vectors::random_stream(seed, {}));
  }
}

void run_search(Session& session, const Arguments& arguments) {
  const Archive archive = search(session, arguments.seed, arguments.seconds, arguments.count,
                                 recipes_below(arguments.paths));
  if (arguments.found.empty()) return;
  std::ofstream out(arguments.found);
  out << "[\n";
  const std::vector<Json> recipes = archive.cover();
  for (size_t i = 0; i < recipes.size(); ++i) {
    out << recipes[i].dump() << (i + 1 < recipes.size() ? ",\n" : "\n");
  }
  out << "]\n";
}

// A fault for the tests to find.
void plant(const std::string& what) {
  if (what.empty()) return;
  if (what == "lossy") {
    volatile int beyond = 40000;
    static_cast<void>(narrow<int16_t>(static_cast<int>(beyond)));
  } else if (what == "overflow") {
    volatile int32_t most = INT32_MAX;
    const int32_t one_more = most + 1;  // ends a build that checks for it
    std::cerr << one_more << '\n';
  } else if (!plant_narrow(what)) {
    throw CLI::ValidationError("--plant", what + " is no quantity of the width table");
  }
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Decodes streams with every quantity of the width table watched.");
  app.add_option("--folder", arguments.folder, "where streams are stored")
      ->check(CLI::ExistingDirectory);
  app.add_option("--blocks", arguments.blocks, "blocks decoded one by one of a stream, at most");
  app.add_option("--plant", arguments.plant,
                 "a fault to find: lossy, overflow, or the quantity whose interval is narrowed");
  app.require_subcommand(1);
  const auto limit = [&](CLI::App* command) {
    command->add_option("--seed", arguments.seed);
    command->add_option("--seconds", arguments.seconds);
    command->add_option("--count", arguments.count, "streams at most");
  };
  auto* files = app.add_subcommand("files", "streams in files, or in all files below folders");
  files->add_option("PATH", arguments.paths)->required()->check(CLI::ExistingPath);
  auto* recipes = app.add_subcommand("recipes", "streams of recipes");
  recipes->add_option("PATH", arguments.paths)->required()->check(CLI::ExistingPath);
  auto* random = app.add_subcommand("random", "random valid streams");
  limit(random);
  auto* climb = app.add_subcommand("search", "search for streams that reach the intervals' ends");
  limit(climb);
  climb->add_option("--from", arguments.paths, "recipes to begin with")->check(CLI::ExistingPath);
  climb->add_option("--found", arguments.found, "where the recipes that came closest are written");
  auto* geometry = app.add_subcommand("geometry", "numbers of the largest trees, without streams");
  try {
    app.parse(argc, argv);
    plant(arguments.plant);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  Session session(arguments.folder, arguments.blocks);
  if (files->parsed()) run_files(session, arguments);
  if (recipes->parsed()) run_recipes(session, arguments);
  if (random->parsed()) run_random(session, arguments);
  if (climb->parsed()) run_search(session, arguments);
  if (geometry->parsed()) session.add("the largest tree, without a stream", geometry_extremes());
  std::cout << session.report().dump(1) << '\n';
  return session.findings().empty() ? 0 : 1;
}

}  // namespace
}  // namespace hmlfc::stress

int main(int argc, char** argv) {
  try {
    return hmlfc::stress::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "stress_streams: " << error.what() << '\n';
    return 2;
  }
}
