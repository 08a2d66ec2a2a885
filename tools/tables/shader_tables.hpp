// The constants of the golden model that the shaders use.
#pragma once

#include <string>
#include <string_view>

namespace hmlfc {

/// `name` in upper case.
std::string upper(std::string_view name);

/// Writes an empty line and a comment.
void put_heading(const char* text);

/// Writes shaders/hmlfc_tables.glsl to standard output, with numbers taken from the model.
void put_shader_tables();

}  // namespace hmlfc
