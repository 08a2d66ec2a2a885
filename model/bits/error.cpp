#include <hmlfc/error.hpp>

#include <array>

namespace hmlfc {
namespace {

struct ErrorText {
  std::string_view name;
  std::string_view meaning;
};

constexpr std::array<ErrorText, kErrorCodeCount> kErrorTexts{{
    {"ok", "no error"},
    {"truncated", "the file ends before the header or a section does"},
    {"bad_magic", "not an HMLFC stream"},
    {"bad_version", "a version this document does not describe"},
    {"bad_header_crc", "the header is damaged"},
    {"bad_profile", "a profile this decoder does not know"},
    {"bad_feature", "a feature flag the profile does not allow"},
    {"bad_header_field", "a header field outside its interval"},
    {"bad_section_table", "a section of wrong type or place"},
    {"trailing_bytes", "bytes after the last section"},
    {"bad_section_crc", "a section is damaged"},
    {"bad_section_size", "a section's size does not fit its content"},
    {"bad_top_entry", "an entry of the TOP table out of place"},
    {"bad_top_image", "a codestream with markers that are not allowed"},
    {"bad_top_crc", "key samples do not decode, or differ from the encoder's"},
    {"top_sample_range", "a key sample outside its interval"},
    {"bad_root_entry", "a group record number past the GROUP section"},
    {"bad_group_record", "a group record with impossible fields"},
    {"bad_tile_offset", "a tile record out of place"},
    {"tile_overrun", "a field past the end of its tile record"},
    {"mask_outside", "a mask bit for a block outside the plane"},
    {"bad_mode", "a reserved value of sign_mode, level_bits or bias_bits"},
    {"bad_levels", "a level code beyond what the depth or the window allows"},
    {"vector_range", "a vector component outside the window"},
    {"limit_exceeded", "beyond this decoder's stated limits"},
    {"bad_request", "the caller asked for a view, plane, block or level that is not there"},
    {"out_of_memory", "the decoder could not get the memory it needs"},
    {"bus_error", "a read failed: of memory, in hardware, or of the stream's source"},
}};

constexpr std::array<std::string_view, 6> kSectionNames{"header", "TOP",  "ROOT",
                                                        "GROUP",  "TILE", "RIG"};

}  // namespace

std::string_view error_name(ErrorCode code) { return kErrorTexts[static_cast<size_t>(code)].name; }

std::string_view error_meaning(ErrorCode code) {
  return kErrorTexts[static_cast<size_t>(code)].meaning;
}

std::string_view section_name(Section section) {
  return kSectionNames[static_cast<size_t>(section)];
}

std::string to_string(const Error& error) {
  std::string text(error_name(error.code));
  // A request and the memory have no place in the file.
  if (error.code != ErrorCode::kBadRequest && error.code != ErrorCode::kOutOfMemory) {
    text.append(" in ").append(section_name(error.section));
    text.append(" at byte ").append(std::to_string(error.offset));
  }
  return text.append(": ").append(error_meaning(error.code));
}

}  // namespace hmlfc
