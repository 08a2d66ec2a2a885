#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
// What a frame decodes, once mark.comp with kPlanApart has counted: one workgroup.
#include "decode.glsl"
#include "requests.glsl"
#include "frame.glsl"
#include "frame_arguments.glsl"
#include "block_lanes.glsl"
#include "frame_plan.glsl"

void main() {
  if (gl_LocalInvocationIndex == 0u) plan_frame();
}
