#include "kernel_accesses.hpp"

#include <sstream>
#include <string_view>

#include "device_state.hpp"

namespace hmlfc::gpu {
namespace {

// The variants that differ in the buffers they use; those without a line are as kPlain.
enum class Kind : uint8_t { kPlain, kReferencePass, kStages, kCounted, kGeometry };

struct KernelBuffers {
  const char* kernel;
  Kind kind;
  const char* reads;
  const char* writes;
};

// Members of Arguments and of FrameArguments by name. What is in chunks counts as one buffer.
constexpr KernelBuffers kKernels[] = {
    {"expand", Kind::kPlain, "shape areas", "requests"},
    {"walk", Kind::kPlain, "shape stream references requests damage", "entries"},
    {"walk", Kind::kReferencePass, "shape stream references requests", "entries"},
    {"walk", Kind::kCounted, "shape stream references requests damage frame counters", "entries"},
    {"residuals", Kind::kReferencePass, "shape stream requests entries damage",
     "references damage"},
    {"samples", Kind::kPlain, "shape stream references requests entries", "statuses samples"},
    {"samples", Kind::kStages, "shape stream references requests entries",
     "statuses samples stages"},
    {"samples", Kind::kCounted,
     "shape stream references requests entries frame counters slots used_pages",
     "pool counters used_pages"},
    {"colour", Kind::kPlain, "shape colour_areas statuses samples", "pixels pixel_statuses"},
    {"mark", Kind::kCounted, "shape frame needed held counters used_pages",
     "needed rays counters used_pages dispatches"},
    {"compact", Kind::kCounted, "shape frame needed held pages counters",
     "requests needed held pages slots counters"},
    {"render", Kind::kCounted, "shape frame pages rays counters pool", "drawn results"},
    {"surface", Kind::kGeometry, "shape frame disparities looked_up counters",
     "displacements looked_up counters"},
    {"mark", Kind::kGeometry, "shape frame needed held displacements counters used_pages",
     "needed rays counters used_pages dispatches"},
    {"compact", Kind::kGeometry, "shape frame needed held pages counters",
     "requests needed looked_up held pages slots counters"},
    {"render", Kind::kGeometry, "shape frame pages rays displacements counters pool",
     "drawn results"},
};

Kind kind_of(const Variant& variant) {
  if (variant.geometry) return Kind::kGeometry;
  if (variant.counted) return Kind::kCounted;
  if (variant.reference_pass) return Kind::kReferencePass;
  return variant.stages ? Kind::kStages : Kind::kPlain;
}

const KernelBuffers& buffers_of(const std::string& kernel, Kind kind) {
  for (const Kind wanted : {kind, Kind::kPlain}) {
    for (const KernelBuffers& buffers : kKernels) {
      if (buffers.kernel == kernel && buffers.kind == wanted) return buffers;
    }
  }
  throw MachineError(FailureKind::kInternal,
                     "kernel_accesses.cpp: nothing is known of " + kernel + " in this variant");
}

struct NamedBuffer {
  std::string_view name;
  uint64_t Arguments::*member;
};

constexpr NamedBuffer kArgumentBuffers[] = {{"shape", &Arguments::shape},
                                            {"stream", &Arguments::stream},
                                            {"references", &Arguments::references},
                                            {"areas", &Arguments::areas},
                                            {"requests", &Arguments::requests},
                                            {"entries", &Arguments::entries},
                                            {"statuses", &Arguments::statuses},
                                            {"samples", &Arguments::samples},
                                            {"stages", &Arguments::stages},
                                            {"damage", &Arguments::damage},
                                            {"colour_areas", &Arguments::colour_areas},
                                            {"pixels", &Arguments::pixels},
                                            {"pixel_statuses", &Arguments::pixel_statuses},
                                            {"frame", &Arguments::frame}};

struct NamedFrameBuffer {
  std::string_view name;
  uint64_t FrameArguments::*member;
};

constexpr NamedFrameBuffer kFrameBuffers[] = {{"needed", &FrameArguments::needed},
                                              {"held", &FrameArguments::held},
                                              {"pages", &FrameArguments::pages},
                                              {"slots", &FrameArguments::slots},
                                              {"counters", &FrameArguments::counters},
                                              {"used_pages", &FrameArguments::used_pages},
                                              {"results", &FrameArguments::results},
                                              {"dispatches", &FrameArguments::dispatches},
                                              {"drawn", &FrameArguments::drawn},
                                              {"rays", &FrameArguments::rays},
                                              {"displacements", &FrameArguments::displacements},
                                              {"disparities", &FrameArguments::disparities},
                                              {"looked_up", &FrameArguments::looked_up},
                                              {"pool", &FrameArguments::pool}};

uint64_t address_of(std::string_view name, const Arguments& arguments,
                    const FrameArguments* frame) {
  for (const NamedBuffer& buffer : kArgumentBuffers) {
    if (buffer.name == name) return arguments.*buffer.member;
  }
  for (const NamedFrameBuffer& buffer : kFrameBuffers) {
    if (buffer.name == name && frame != nullptr) return frame->*buffer.member;
  }
  throw MachineError(FailureKind::kInternal,
                     "kernel_accesses.cpp: no buffer is named \"" + std::string(name) + "\"");
}

void add(const char* names, bool writes, const Arguments& arguments, const FrameArguments* frame,
         std::vector<BufferAccess>& accesses) {
  std::istringstream list(names);
  for (std::string name; list >> name;) {
    accesses.push_back({address_of(name, arguments, frame), name, !writes, writes});
  }
}

}  // namespace

std::vector<BufferAccess> accesses_of(const std::string& kernel, const Variant& variant,
                                      const Arguments& arguments, const FrameArguments* frame) {
  const KernelBuffers& buffers = buffers_of(kernel, kind_of(variant));
  std::vector<BufferAccess> accesses;
  add(buffers.reads, false, arguments, frame, accesses);
  add(buffers.writes, true, arguments, frame, accesses);
  return accesses;
}

}  // namespace hmlfc::gpu
