// stress_streams COMMAND: decodes streams with every quantity of the width table watched; prints
// what was reached as JSON. `--help` lists the commands. Exit status: 0 no findings, 1 a value left
// its interval or a conversion lost its value, 2 wrong arguments.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <CLI/CLI.hpp>

#include "program.hpp"
#include "session.hpp"
#include "syntax/geometry.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc::stress {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path folder = ".";
  uint64_t blocks = 400;
  std::vector<fs::path> paths;
  uint64_t seed = 1;
  double seconds = 1e9;
  uint64_t count = 1'000'000'000;
};

std::vector<uint8_t> read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// The streams in or below `paths`, sorted.
std::vector<fs::path> streams_below(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (entry.path().extension() == ".hmlfc") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void run_files(Session& session, const Arguments& arguments) {
  for (const fs::path& file : streams_below(arguments.paths)) {
    session.run(file.filename().string(), read_file(file));
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

StreamHeader largest_header() {
  StreamHeader header;
  header.profile = Profile::kExtended;
  header.feature_flags = feature_bit(Feature::kMotionTiles) | feature_bit(Feature::kChromaMotion);
  header.rows = 4096;
  header.cols = 4096;
  header.width = 65536;
  header.height = 65536;
  header.chroma_format = ChromaFormat::k444;
  header.block_log2 = 1;
  header.motion_tile_log2 = 5;
  header.cluster_rows = 1;
  header.cluster_cols = 2;
  header.tree_height = 15;
  header.levels.assign(16, LevelEntry{255, 255, 0});
  return header;
}

// Returns what the numbers of the last image and its last tile reach (IDX-1, IDX-2) in the largest
// tree. The index of such a stream would take over 7 * 10^12 bytes, so only the arithmetic runs.
Ranges geometry_extremes() {
  const StreamHeader header = largest_header();
  const Geometry geometry(header);
  const uint64_t first = geometry.image_number(header.tree_height, {0, 0});
  static_cast<void>(geometry.tile_number(first, Plane::kY, 0, 0));
  const uint64_t last = geometry.image_number(0, {header.rows - 1, header.cols - 1});
  const size_t motion = geometry.motion_planes().size() - 1;
  const MotionPlaneShape& plane = geometry.motion_planes()[motion];
  static_cast<void>(
      geometry.motion_tile_number(last, motion, plane.tiles_x - 1, plane.tiles_y - 1));
  return take_ranges();
}

void add_commands(CLI::App& app, Arguments& arguments) {
  app.add_option("--folder", arguments.folder, "folder to store streams in")
      ->check(CLI::ExistingDirectory);
  app.add_option("--blocks", arguments.blocks, "most blocks of a stream to decode one by one");
  app.require_subcommand(1);
  auto* files = app.add_subcommand("files", "streams in files, or in all files below folders");
  files->add_option("PATH", arguments.paths)->required()->check(CLI::ExistingPath);
  auto* random = app.add_subcommand("random", "random valid streams");
  random->add_option("--seed", arguments.seed);
  random->add_option("--seconds", arguments.seconds);
  random->add_option("--count", arguments.count, "most streams");
  app.add_subcommand("geometry", "image and tile numbers of the largest tree, without a stream");
}

vectors::Json run_command(const std::string& command, const Arguments& arguments) {
  Session session(arguments.folder, arguments.blocks);
  if (command == "files") run_files(session, arguments);
  if (command == "random") run_random(session, arguments);
  if (command == "geometry") {
    session.add("the largest tree, without a stream", geometry_extremes());
  }
  return session.report();
}

}  // namespace
}  // namespace hmlfc::stress

int main(int argc, char** argv) {
  using namespace hmlfc::stress;
  Arguments arguments;
  CLI::App app("Decodes streams with every quantity of the width table watched.", "stress_streams");
  add_commands(app, arguments);
  return run_program(app, argc, argv, [&] {
    return run_command(app.get_subcommands().front()->get_name(), arguments);
  });
}
