#include "conform/report_folder.hpp"

#include <cctype>
#include <system_error>
namespace hmlfc::conform {

namespace fs = std::filesystem;

std::string folder_name(const std::string& dut) {
  std::string name;
  for (const char c : dut) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "dut" : name.substr(0, 64);
}

fs::path pictures_of(const std::string& dut, const vectors::VectorId& id) {
  return fs::path(folder_name(dut)) / "failures" / id;
}

bool has_own_pictures(const VectorResult& result, const std::string& dut) {
  return result.pictures.empty() || result.pictures == pictures_of(dut, result.id);
}

io::IoResult<fs::path> path_inside(const fs::path& folder, const fs::path& name) {
  fs::path path = folder;
  for (const fs::path& part : name) {
    path /= part;
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(path, ignored))) {
      return io::file_error(path, "is a symbolic link; reports have none, so remove it");
    }
  }
  return path;
}

io::IoResult<void> copy_pictures(const fs::path& from, const fs::path& to,
                                 const fs::path& pictures) {
  for (const char* name : kFailurePictures) {
    const auto source = path_inside(from, pictures / name);
    const auto target = path_inside(to, pictures / name);
    if (!source || !target) return tl::unexpected(source ? target.error() : source.error());
    std::error_code error;
    fs::create_directories(target->parent_path(), error);
    if (!error) fs::copy_file(*source, *target, fs::copy_options::overwrite_existing, error);
    if (error) return io::system_error(*source, "cannot be copied", error.value());
  }
  return {};
}

void remove_pictures(const fs::path& folder) {
  for (const char* name : kFailurePictures) {
    std::error_code ignored;
    fs::remove(folder / name, ignored);
  }
}

}  // namespace hmlfc::conform
