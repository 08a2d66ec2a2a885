#include "io/io_error.hpp"

#include <system_error>

namespace hmlfc::io {

tl::unexpected<IoError> system_error(const std::filesystem::path& file, std::string_view what,
                                     int error_number) {
  const std::string reason = std::generic_category().message(error_number);
  return file_error(file, std::string(what) + ": " + reason);
}

}  // namespace hmlfc::io
