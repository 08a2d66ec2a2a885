// The first line of a Y4M video.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/y4m.hpp"

namespace hmlfc::io {

/// What Y4mWriter notes of a light field: XHMLFC=ROWSxCOLS,serpentine,DEPTH.
struct Y4mNote {
  GridShape grid;
  FrameOrder order = FrameOrder::kRaster;
  int depth = 8;  ///< [8, 12]
};

struct Y4mHeader {
  uint32_t width = 0;   ///< [1, 65536]
  uint32_t height = 0;  ///< [1, 65536]
  ChromaPlanes chroma;
  VideoLevels levels;
  std::string guessed;  ///< what the header does not say and is taken for granted, for people
  std::optional<Y4mNote> note;
};

/// The line without its end, of a video of 4:4:4.
std::string write_y4m_header(const Y4mHeader& header);

/// The header that `line`, without its end, states. Error: what is wrong and what to do.
tl::expected<Y4mHeader, std::string> parse_y4m_header(std::string_view line);

}  // namespace hmlfc::io
