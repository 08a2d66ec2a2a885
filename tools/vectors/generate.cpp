#include "vectors/generate.hpp"

#include <exception>
#include <mutex>
#include <set>

#include "io/atomic_file.hpp"
#include "syntax/header.hpp"

namespace hmlfc::vectors {
namespace {

constexpr uint64_t kSeed = 1;

// The failures of all vectors, by id, whichever thread meets one first.
class Failures {
 public:
  void add(const std::string& id, const std::string& message) {
    const std::lock_guard lock(mutex_);
    messages_[id] = message;
  }
  bool any() const { return !messages_.empty(); }

  /// One line each.
  std::string text() const {
    std::string lines;
    for (const auto& [id, message] : messages_) lines += (lines.empty() ? "" : "\n") + message;
    return lines;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> messages_;
};

}  // namespace

io::IoResult<SuiteFiles> generate_suite(const std::filesystem::path& folder, unsigned threads,
                                        const io::Progress& progress) {
  Recipes recipes;
  try {
    recipes = read_recipes(folder);
  } catch (const std::exception& error) {
    return tl::unexpected(io::IoError{error.what()});
  }
  std::vector<std::string> ids;
  for (const auto& [id, recipe] : recipes) ids.push_back(id);
  Manifest manifest{kVectorsVersion, kVersion, "hmlfc vectors generate", kSeed, {}};
  manifest.vectors.resize(ids.size());
  std::vector<SuiteFiles> parts(ids.size());
  Failures failures;
  io::for_each_index(ids.size(), threads, progress, [&](size_t i) {
    try {
      manifest.vectors[i] = make_vector(recipes, ids[i], parts[i]);
    } catch (const std::exception& error) {
      failures.add(ids[i], error.what());
    }
  });
  if (failures.any()) return tl::unexpected(io::IoError{failures.text()});
  SuiteFiles files;
  for (SuiteFiles& part : parts) files.merge(part);
  const std::string text = manifest_text(manifest);
  files["manifest.json"] = {text.begin(), text.end()};
  return files;
}

io::IoResult<void> write_suite(const SuiteFiles& files, const std::filesystem::path& folder) {
  std::set<std::string> groups;
  for (const auto& [name, bytes] : files) {
    const auto group = std::filesystem::path(name).parent_path().string();
    std::error_code error;
    if (!group.empty() && groups.insert(group).second) {
      std::filesystem::create_directories(folder / group, error);
    }
    if (error) return io::system_error(folder / group, "cannot be made", error.value());
    if (auto ok = io::write_file(folder / name, bytes); !ok) return ok;
  }
  for (const std::string& group : groups) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder / group, error)) {
      const std::string name = group + "/" + entry.path().filename().string();
      if (!files.contains(name)) std::filesystem::remove(entry.path(), error);
    }
    if (error) return io::system_error(folder / group, "cannot be tidied up", error.value());
  }
  return {};
}

}  // namespace hmlfc::vectors
