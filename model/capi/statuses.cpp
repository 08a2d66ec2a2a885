// Version and statuses by name.
#include <array>

#include <hmlfc/hmlfc.h>
#include <hmlfc/error.hpp>
#include <hmlfc/version.hpp>

namespace {

struct OwnStatus {
  int status;
  const char* name;
  const char* meaning;
};

constexpr std::array<OwnStatus, 4> kOwnStatuses{{
    {HMLFC_STATUS_BAD_ARGUMENT, "bad_argument", "an argument of the function is outside its range"},
    {HMLFC_STATUS_NO_FILE, "no_file", "the file cannot be read"},
    {HMLFC_STATUS_BAD_CAMERA, "bad_camera", "the camera takes no frame of this light field"},
    {HMLFC_STATUS_INTERNAL, "internal", "a defect of the library"},
}};

bool is_of_annex_a(int status) { return status >= 0 && status < hmlfc::kErrorCodeCount; }

}  // namespace

// Names and meanings are literals, which end in 0.
const char* hmlfc_version(void) { return hmlfc::library_version().data(); }

const char* hmlfc_status_name(int status) {
  if (is_of_annex_a(status)) return hmlfc::error_name(static_cast<hmlfc::ErrorCode>(status)).data();
  for (const OwnStatus& own : kOwnStatuses) {
    if (own.status == status) return own.name;
  }
  return "unknown_status";
}

const char* hmlfc_status_meaning(int status) {
  if (is_of_annex_a(status)) {
    return hmlfc::error_meaning(static_cast<hmlfc::ErrorCode>(status)).data();
  }
  for (const OwnStatus& own : kOwnStatuses) {
    if (own.status == status) return own.meaning;
  }
  return "no status of this library";
}
