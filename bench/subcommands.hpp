// The subcommands of hmlfc_measure. All throw: std::invalid_argument for wrong arguments,
// std::runtime_error where something does not open or decode.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace hmlfc::bench {

using Arguments = std::span<const std::string>;
using Json = nlohmann::ordered_json;

/// [FILE.hmlfc]: prints tables of frames/s and CPU time of frames along an orbit, and of the first
/// frame. Without FILE: Chess in profile extended at quality 64.
void render(Arguments arguments);

/// FILE.hmlfc RUNS: decodes all views RUNS times, each with a new decoder. cpu_seconds, the least
/// of a decoding over all threads, and reference_bytes, the decoded sparse reference images.
Json decode(Arguments arguments);

/// FILE.hmlfc SOURCE.hmlfc FRAMES SIDE FILTER:LEVELS:CACHE...: draws FRAMES square frames of an
/// orbit, from an empty cache on, with each setting. SOURCE decodes to the uncompressed light
/// field; LEVELS are those of the tree from the top, [1, tree_height + 1]; CACHE is MiB of decoded
/// pixels. For each setting: frame, the setting; median_cpu_seconds and p95_cpu_seconds of a frame;
/// blocks_needed and blocks_decoded of a frame, on average; mse_total, mse_stream, mse_filter,
/// mse_fixed, largest_fixed (frame_sweep.cpp) and, for filter quadrilinear, bound_fixed (ERR-1).
Json frames(Arguments arguments);

/// FILE.hmlfc PATH FRAMES SIDE cold|warm plane|stream: what square frames along PATH need: orbit,
/// line, dolly (forwards from the middle of the grid) or view (the middle view). cold: each frame
/// with a new decoder and renderer; warm: all with the same. plane, stream: as --geometry of `hmlfc
/// render`. For each frame views, blocks needed, decoded, reused and zero, cpu_seconds, looked_up,
/// key_samples, and `reads`, [offset, length] of the file.
Json path(Arguments arguments);

/// FILE.hmlfc RUNS: decodes the middle block of Y of the middle view RUNS times, each with a new
/// decoder. open_cpu_seconds, cpu_seconds, walks, fields, reads.
Json block(Arguments arguments);

/// FILE.hmlfc, and on stdin lines: an empty one starts anew with a stream just opened; any other is
/// a request, rectangles ROW COL X Y WIDTH HEIGHT of views, one after another. decode_seconds of
/// all views on one thread, and for each request the distinct bytes it reads without opening the
/// stream, the samples computed (B * B for each walk, and key images whole), and the bytes of key
/// images held since the stream was opened.
Json requests(Arguments arguments);

}  // namespace hmlfc::bench
