#include <hmlfc/version.hpp>

namespace hmlfc {

std::string_view library_version() { return HMLFC_VERSION; }

}  // namespace hmlfc
