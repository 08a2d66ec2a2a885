// A setting of the renderers in the accuracy report.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <hmlfc/camera.hpp>

namespace hmlfc::bench {

enum class Backend { kCpu, kGolden, kGpu };

/// One point of the renderer's sweep.
struct FrameSetting {
  std::string text;  ///< as given
  Filter filter = Filter::kQuadrilinear;
  int levels = 1;          ///< of the tree, from the top, [1, tree_height + 1]
  size_t cache_mib = 256;  ///< kept between frames by backends cpu and gpu, [0, 2^20]
  Backend backend = Backend::kCpu;
};

/// Parses FILTER:LEVELS:CACHE:BACKEND, such as "bilinear:4:256:cpu". Nothing if the text does not
/// have this form.
std::optional<FrameSetting> parse_frame_setting(std::string_view text);

}  // namespace hmlfc::bench
