// The version of this library (docs/api.md says what a new one may change).
#pragma once

#include <string_view>

#include <hmlfc/export.hpp>

#define HMLFC_VERSION_MAJOR 1  ///< [0, 999]
#define HMLFC_VERSION_MINOR 0  ///< [0, 999]
#define HMLFC_VERSION_PATCH 0  ///< [0, 999]
#define HMLFC_VERSION "1.0.0"  ///< "MAJOR.MINOR.PATCH"

namespace hmlfc {

/// HMLFC_VERSION as the linked library was built with; differs from the macro where a program runs
/// with another shared library than it was compiled for.
HMLFC_EXPORT std::string_view library_version();

}  // namespace hmlfc
