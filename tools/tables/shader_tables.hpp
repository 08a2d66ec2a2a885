// The numbers that the shaders share with the golden model.
#pragma once

namespace hmlfc {

/// Writes shaders/hmlfc_tables.glsl to standard output, with numbers taken from the model.
void put_shader_tables();

}  // namespace hmlfc
