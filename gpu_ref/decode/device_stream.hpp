// A stream on the device: its bytes, its shape and its reference area.
#pragma once

#include <cstdint>

#include "device/arguments.hpp"
#include "device/buffer.hpp"
#include "device/kernels.hpp"
#include "stream_shape.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// ROOT, GROUP and TILE as they are, TOP as decoded samples.
class DeviceStream {
 public:
  /// Uploads `stream`, decodes its key images on the host and its other reference images on the
  /// device. Throws MachineError.
  DeviceStream(Device::State& device, const StreamView& stream);

  /// Returns the arguments that do not change: shape, stream, references, damage.
  Arguments arguments() const;

  /// Returns whether stream or reference area need a table of chunks.
  bool chunked() const { return words_.chunked() || references_.chunked(); }

  uint64_t reference_bytes() const { return references_.bytes(); }

 private:
  void upload_coded(Device::State& device, const StreamView& stream);
  void upload_keys(Device::State& device, const StreamView& stream);
  void decode_references(Device::State& device, const StreamView& stream);

  ChunkedWords words_;
  ChunkedWords references_;
  StreamShapeRecord shape_record_;
  Buffer shape_;
  Buffer damage_;
};

}  // namespace hmlfc::gpu
