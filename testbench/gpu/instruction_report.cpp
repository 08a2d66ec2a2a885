#include "gpu/instruction_report.hpp"

#include <fmt/format.h>

#include <hmlfc/gpu/renderer.hpp>

#include "gpu/frame_path.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kFrames = 3;
constexpr uint64_t kCacheBytes = uint64_t{512} << 20;

KernelCounts& operator+=(KernelCounts& sum, const KernelCounts& counts) {
  sum.instructions += counts.instructions;
  sum.uniform += counts.uniform;
  sum.loads += counts.loads;
  sum.uniform_loads += counts.uniform_loads;
  sum.stores += counts.stores;
  sum.shared += counts.shared;
  sum.atomics += counts.atomics;
  return sum;
}

std::string row(const std::string& name, const KernelCounts& counts, uint64_t pixels) {
  const auto a_pixel = [&](uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(pixels);
  };
  return fmt::format("  {:<10} {:12.1f} {:7.1f} {:7.2f} {:13.2f} {:7.2f} {:7.2f} {:8.2f}\n", name,
                     a_pixel(counts.instructions), a_pixel(counts.uniform), a_pixel(counts.loads),
                     a_pixel(counts.uniform_loads), a_pixel(counts.stores), a_pixel(counts.shared),
                     a_pixel(counts.atomics));
}

}  // namespace

KernelCounts InstructionTable::total() const {
  KernelCounts sum;
  for (const auto& [name, counts] : kernels) sum += counts;
  return sum;
}

Outcome<InstructionReport> InstructionReport::open(DeviceOptions options) {
  KernelCounter counter;
  options.kernels = counter.kernels();
  auto device = Device::open(options);
  if (!device) return tl::unexpected(device.error());
  if (device->info().kind != "CPU") {
    return tl::unexpected(Failure{FailureKind::kUnusable,
                                  "instructions are counted on a device of kind CPU, such as "
                                  "lavapipe, and " +
                                      device->info().name + " is none"});
  }
  return InstructionReport(std::move(counter), std::move(*device));
}

Outcome<InstructionTable> InstructionReport::decode(const StreamView& stream, uint64_t views) {
  auto decoder = GpuDecoder::open(device_, stream);
  if (!decoder) return tl::unexpected(decoder.error());
  counter_.take();  // of the reference area
  const auto areas = whole_views(stream, views + 1);
  for (const PixelArea& area : areas) {
    if (const auto pixels = decoder->decode_rgb({&area, 1}); !pixels) {
      return tl::unexpected(pixels.error());
    }
  }
  const PlaneShape& luma = stream.geometry.plane(Plane::kY);
  return InstructionTable{"decode", areas.size() * luma.width * luma.height, counter_.take()};
}

Outcome<InstructionTable> InstructionReport::frames(const StreamView& stream, const Camera& camera,
                                                    bool cold) {
  auto renderer = GpuRenderer::open(device_, stream, kCacheBytes);
  if (!renderer) return tl::unexpected(renderer.error());
  const auto records = records_of_path(camera, stream.header, kFrames);
  if (!records) return tl::unexpected(records.error());
  for (const FrameRecord& record : *records) {  // makes room
    if (const auto frame = renderer->render(record, 0); !frame) {
      return tl::unexpected(frame.error());
    }
  }
  counter_.take();
  InstructionTable table{cold ? "frame, cold" : "frame, warm"};
  for (const FrameRecord& record : *records) {
    if (cold) renderer->forget();
    if (const auto frame = renderer->render(record, 0); !frame) {
      return tl::unexpected(frame.error());
    }
    table.pixels +=
        static_cast<uint64_t>(record.frame_width) * static_cast<uint64_t>(record.frame_height);
  }
  table.kernels = counter_.take();
  return table;
}

std::string to_text(const InstructionTable& table) {
  std::string text =
      fmt::format("{}, a pixel of {}\n  {:<10} {:>12} {:>7} {:>7} {:>13} {:>7} {:>7} {:>8}\n",
                  table.work, table.pixels, "kernel", "instructions", "uniform", "loads",
                  "uniform loads", "stores", "shared", "atomics");
  for (const auto& [name, counts] : table.kernels) text += row(name, counts, table.pixels);
  return text + row("all", table.total(), table.pixels);
}

}  // namespace hmlfc::gpu
