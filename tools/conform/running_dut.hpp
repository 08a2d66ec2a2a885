// A decoder under test at work: what the judge and the page of `hmlfc view` ask of it, however it
// is attached.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>
#include <hmlfc/disparity.hpp>

#include "conform/process.hpp"
#include "conform/result.hpp"
#include "vectors/frame_case.hpp"

namespace hmlfc::conform {

/// The exit status of a decoder that cannot run here (no device, no licence): the vector is
/// skipped, which is not a pass.
inline constexpr int kExitSkipped = 77;

/// Thrown where a decoder does not answer; it cannot be asked any more.
struct DutFailure {
  Status status = Status::kError;
  std::string reason;      ///< what it was asked, and what it did instead
  std::string messages{};  ///< the end of standard error of a process that ended
};

/// An answer, or the error that the decoder gave: its name of annex A, where it gives names.
template <class T>
using DutAnswer = tl::expected<T, std::string>;

/// A field of a header as decoders report it.
struct GeometryField {
  const char* name;
  uint32_t hmlfc_dut_geometry::*value;
};
/// All fields, in the order of the answer to `open` (docs/line_protocol.md).
inline constexpr GeometryField kGeometryFields[] = {
    {"rows", &hmlfc_dut_geometry::rows},
    {"cols", &hmlfc_dut_geometry::cols},
    {"width", &hmlfc_dut_geometry::width},
    {"height", &hmlfc_dut_geometry::height},
    {"depth", &hmlfc_dut_geometry::depth},
    {"chroma_format", &hmlfc_dut_geometry::chroma_format},
    {"block_log2", &hmlfc_dut_geometry::block_log2},
    {"tree_height", &hmlfc_dut_geometry::tree_height}};

/// What a decoder can be asked for.
struct Abilities {
  bool views = false;
  bool blocks = false;
  bool traces = false;
  bool levels = false;   ///< blocks at stop levels other than 0
  bool at_once = false;  ///< it decodes all views as it opens a stream, and serves no other stream
  bool records = false;  ///< frame records of cameras
  bool frames = false;   ///< frames of records
  bool cameras = false;  ///< frames of cameras
  bool maps = false;     ///< disparity maps
  bool pixels = false;   ///< traces of pixels of frames
};

/// A frame as a renderer gives it.
struct DutFrame {
  RgbImage image;
  hmlfc_dut_counts counts{-1, -1, -1};  ///< -1: not counted
};

/// A decoder that runs, or a command line that is run for each stream. All functions that ask throw
/// DutFailure.
class RunningDut {
 public:
  RunningDut() = default;
  RunningDut(const RunningDut&) = delete;
  RunningDut& operator=(const RunningDut&) = delete;
  virtual ~RunningDut() = default;

  virtual const Abilities& can() const = 0;

  /// From now on `seconds` remain for all that is asked.
  virtual void allow(double seconds) = 0;

  /// Opens a stream, which answers of the other functions are about; none is open.
  virtual DutAnswer<hmlfc_dut_geometry> open(const std::filesystem::path& file) = 0;
  virtual DutAnswer<RgbImage> view(ViewPos view);
  /// B * B samples.
  virtual DutAnswer<std::vector<int32_t>> block(const BlockAddress& block, int stop_level);
  /// The stages of a block, a JSON object a line (stage_trace.hpp).
  virtual DutAnswer<std::string> trace(const BlockAddress& block, int stop_level);
  virtual void close() = 0;

  /// The record of a camera; the error is the input that is refused.
  virtual DutAnswer<std::vector<int32_t>> record(const hmlfc_dut_camera& camera);
  /// The frame of the request's record, or of its camera where it draws no records. The error may
  /// be followed by its block: "bad_mode 0 1 2 5 3", view, plane, column and row of blocks.
  virtual DutAnswer<DutFrame> frame(const vectors::FrameCase& request);
  /// A map of this many blocks.
  virtual DutAnswer<std::vector<BlockDisparity>> map(ViewPos view, size_t blocks);
  /// The stages of a pixel, a JSON object a line (pixel_trace.hpp).
  virtual DutAnswer<std::string> pixel(const vectors::FrameCase& request, uint32_t x, uint32_t y);

  /// The end of what it wrote on standard error since the last call.
  virtual std::string take_messages() = 0;
};

/// Starts `dut`, which must outlive it. A command line writes its views, or with `frames` a frame
/// or map, into the empty folder `output`. Throws DutFailure.
std::unique_ptr<RunningDut> start(const Dut& dut, const ProcessLimits& limits,
                                  const std::filesystem::path& output, bool frames = false);

/// The processes of one decoder that wait for a stream. Thread-safe.
class WaitingDuts {
 public:
  /// One that waits, or null.
  std::unique_ptr<RunningDut> take();
  void give_back(std::unique_ptr<RunningDut> process);

  /// Whether a vector that failed in a process that has served others is to be run again in a new
  /// one: the first eight are.
  bool is_run_again();

 private:
  std::mutex mutex_;
  unsigned run_again_ = 0;
  std::vector<std::unique_ptr<RunningDut>> waiting_;
};

}  // namespace hmlfc::conform
