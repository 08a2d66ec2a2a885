#include "vectors/json.hpp"

#include "io/files.hpp"

namespace hmlfc::vectors {

Json read_json(const std::filesystem::path& file) {
  const auto mapped = io::MappedFile::open(file);
  if (!mapped) throw TextError(mapped.error().message);
  const auto bytes = mapped->bytes();
  try {
    return Json::parse(bytes.begin(), bytes.end());
  } catch (const Json::exception& error) {
    throw TextError(file.string() + ": " + error.what());
  }
}

}  // namespace hmlfc::vectors
