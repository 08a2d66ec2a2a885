// Everything the decoding kernels share, in order.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_control_flow_attributes : require

#include "hmlfc_tables.glsl"

#include "integers.glsl"
#include "shared_numbers.glsl"
#include "arguments.glsl"
