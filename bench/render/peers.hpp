// Other codecs that decode the same view.
#pragma once

#include <optional>
#include <string>

#include <hmlfc/image.hpp>

namespace hmlfc::bench {

struct Peer {
  std::string name;
  double seconds = 0;  ///< CPU time to decode on one thread
  RgbImage decoded;
};

/// OpenJPEG with its usual lossy coding (9/7, irreversible colour transform), at the lowest rate
/// that reaches `psnr` dB over RGB. `image` has depth 8.
std::optional<Peer> openjpeg_peer(const RgbImage& image, double psnr);

/// ASTC in blocks of 8 x 8 by astcenc. `image` has depth 8.
std::optional<Peer> astc_peer(const RgbImage& image);

}  // namespace hmlfc::bench
