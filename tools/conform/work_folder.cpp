#include "conform/work_folder.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>

namespace hmlfc::conform {

namespace fs = std::filesystem;

void remove_tree(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (!error) return;
  std::string words[] = {"rm", "-rf", "--", path.string()};
  char* const arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                             nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments, environ) != 0) return;
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

WorkFolder::WorkFolder(const fs::path& prefix) : path_(prefix) {
  fs::create_directories(prefix.parent_path(), error_);
  if (error_) return;
  std::string name = prefix.string() + "-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) {
    error_ = {errno, std::generic_category()};
  } else {
    path_ = name;
  }
}

WorkFolder::~WorkFolder() {
  if (!error_) remove_tree(path_);
}

}  // namespace hmlfc::conform
