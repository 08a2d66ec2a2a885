#include "capi/outcome.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>

#include "capi/structs.hpp"

namespace hmlfc::capi {
namespace {

// Appends as much of `part` as fits to `text`, of which `used` bytes are taken.
size_t append(std::array<char, HMLFC_FAILURE_TEXT>& text, size_t used, std::string_view part) {
  const size_t count = std::min(part.size(), text.size() - 1 - used);
  std::copy_n(part.begin(), count, text.begin() + static_cast<ptrdiff_t>(used));
  return used + count;
}

}  // namespace

tl::unexpected<Refusal> refuse(hmlfc_status status, std::string_view text) {
  Refusal refusal{status};
  append(refusal.text, 0, text);
  return tl::unexpected<Refusal>(refusal);
}

tl::unexpected<Refusal> refuse(const Error& error) {
  Refusal refusal{static_cast<hmlfc_status>(error.code), error.section, error.offset};
  append(refusal.text, 0, to_string(error));
  return tl::unexpected<Refusal>(refusal);
}

tl::unexpected<Refusal> bad_argument(std::string_view name, std::string_view what) {
  Refusal refusal{HMLFC_STATUS_BAD_ARGUMENT};
  const size_t used = append(refusal.text, append(refusal.text, 0, name), " ");
  append(refusal.text, used, what);
  return tl::unexpected<Refusal>(refusal);
}

Outcome check_pointer(const void* pointer, std::string_view name) {
  if (pointer == nullptr) return bad_argument(name, "is null");
  return {};
}

bool is_usable(const hmlfc_failure* failure) {
  return failure == nullptr || reaches(failure->struct_size, &hmlfc_failure::text);
}

int tell(hmlfc_failure* failure, const Outcome& outcome) {
  const Refusal refusal = outcome ? Refusal{HMLFC_STATUS_OK} : outcome.error();
  if (failure != nullptr) {
    hmlfc_failure told{};
    told.offset = refusal.offset;
    told.status = refusal.status;
    told.section = static_cast<int32_t>(refusal.section);
    std::copy(refusal.text.begin(), refusal.text.end(), told.text);
    write_struct(told, *failure);
  }
  return refusal.status;
}

Outcome refuse_exception() noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return refuse(HMLFC_STATUS_OUT_OF_MEMORY, "out_of_memory");
  } catch (const std::length_error&) {
    return refuse(HMLFC_STATUS_OUT_OF_MEMORY, "out_of_memory: more than a container can hold");
  } catch (const std::exception& exception) {
    return refuse(HMLFC_STATUS_INTERNAL, exception.what());
  } catch (...) {
    return refuse(HMLFC_STATUS_INTERNAL, "an unknown exception");
  }
}

}  // namespace hmlfc::capi
