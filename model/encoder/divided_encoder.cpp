#include <hmlfc/divided_encoder.hpp>

#include <algorithm>
#include <new>
#include <thread>
#include <utility>

#include "bits/little_endian.hpp"
#include "bits/parallel.hpp"
#include "encoder/cached_views.hpp"
#include "encoder/coding_params.hpp"
#include "encoder/encode_progress.hpp"
#include "encoder/encode_session.hpp"
#include "encoder/part_grid.hpp"
#include "encoder/stream_writer.hpp"

namespace hmlfc {
namespace {

// Views that trials have looked at may take this share of a memory bound.
constexpr uint64_t kTrialShare = 4;
// Views kept for each thread: the one being coded, whose error is measured later.
constexpr uint64_t kViewsPerThread = 2;

// Head that save_part() writes before the bytes of an image or of a plane of a key image.
struct SavedHead {
  static constexpr size_t kBytes = 24;
  uint32_t is_key = 0;
  uint32_t crc = 0;  // of a key plane's samples
  uint64_t number = 0;
  uint64_t size = 0;

  std::vector<uint8_t> bytes() const {
    std::vector<uint8_t> out;
    append_le(out, is_key);
    append_le(out, crc);
    append_le(out, number);
    append_le(out, size);
    return out;
  }

  static SavedHead of(std::span<const uint8_t> bytes) {
    return {load_le<uint32_t>(bytes, 0), load_le<uint32_t>(bytes, 4), load_le<uint64_t>(bytes, 8),
            load_le<uint64_t>(bytes, 16)};
  }
};

std::string megabytes(uint64_t bytes) { return std::to_string((bytes >> 20) + 1) + "M"; }

int usable_threads(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

struct DividedEncoder::State {
  // The numbers of the images of part `part`, and of the planes of its key images.
  template <class Image, class KeyPlane>
  void for_each_owned(size_t part, const Image& image, const KeyPlane& key_plane) const {
    const ImageRange range = views_of_part(grid, part);
    const Geometry& geometry = session->geometry();
    for (int level = 0; level <= geometry.top(); ++level) {
      for (const ImagePos at : geometry.level(level).all_images()) {
        if (!owns(range, geometry, level, at)) continue;
        image(static_cast<size_t>(geometry.image_number(level, at)));
        if (!geometry.is_key(level, at)) continue;
        const auto key = static_cast<size_t>(geometry.key_number(level, at));
        for (size_t p = 0; p < kPlaneCount; ++p) key_plane(key * kPlaneCount + p);
      }
    }
  }

  SettledCoding settled;
  PartGrid grid;
  int threads = 1;
  std::optional<CachedViews> views;
  std::optional<EncodeSession> session;
  CodedImages coded;
  uint64_t images_done = 0;
};

DividedEncoder::DividedEncoder(std::unique_ptr<State> state) : state_(std::move(state)) {}
DividedEncoder::DividedEncoder(DividedEncoder&&) noexcept = default;
DividedEncoder& DividedEncoder::operator=(DividedEncoder&&) noexcept = default;
DividedEncoder::~DividedEncoder() = default;

tl::expected<DividedEncoder, EncodeError> DividedEncoder::create(const ViewProvider& views,
                                                                 const EncodeParams& params,
                                                                 const Division& division,
                                                                 CodeStorage& storage) {
  const auto refused = [](std::string message) {
    return tl::unexpected(EncodeError{std::move(message)});
  };
  if (const char* problem = problem_of(views.shape(), params)) return refused(problem);
  auto state = std::make_unique<State>();
  const uint64_t memory = division.memory.value_or(CachedViews::kUnlimited);
  state->threads = usable_threads(params.threads);
  try {
    run_on_threads(division.memory ? 1 : state->threads, [&] {
      state->settled = settle_coding(views, with_defaults(params), nullptr, memory / kTrialShare);
    });
    const auto header = header_for(views.shape(), state->settled.params);
    if (!header) return refused(kOutsideInterval);
    state->grid = division.parts.value_or(small_parts(*header));
    if (!covers(state->grid, *header)) return refused("the parts do not make up the grid of views");
    if (division.memory && !division.parts) {
      uint64_t least = 0;
      const auto fitting =
          fitting_parts(*header, params.extended.preset, memory, state->threads, least);
      if (!fitting) {
        return refused("the memory is too small for these views: " + megabytes(least) +
                       " is the least that would do");
      }
      state->grid = fitting->grid;
      state->threads = fitting->threads;
    }
    const LightFieldShape& shape = views.shape();
    const uint64_t view_bytes =
        uint64_t{shape.width} * shape.height * 3 * (shape.depth > 8 ? 2 : 1);
    state->views.emplace(views,
                         view_bytes * kViewsPerThread * static_cast<uint64_t>(state->threads));
    state->session.emplace(*state->views, *header, state->settled.probe, &storage);
    state->coded = state->session->no_images();
  } catch (const std::bad_alloc&) {
    return memory_is_out();
  }
  return DividedEncoder(std::move(state));
}

const EncodeParams& DividedEncoder::params() const { return state_->settled.params; }
const PartGrid& DividedEncoder::parts() const { return state_->grid; }
int DividedEncoder::threads() const { return state_->threads; }
const StreamHeader& DividedEncoder::header() const { return state_->session->header(); }
const ErrorSums& DividedEncoder::error() const { return state_->coded.error; }

tl::expected<void, EncodeError> DividedEncoder::encode_part(size_t part, const Progress& progress) {
  State& state = *state_;
  const EncodeSession& session = *state.session;
  const auto known = [&](int level, ImagePos at) {
    const uint64_t key = session.geometry().key_number(level, at);
    return state.coded.keys.has(static_cast<size_t>(key) * kPlaneCount);
  };
  try {
    run_on_threads(state.threads, [&] {
      const EncodePart images =
          part_of_views(session.geometry(), views_of_part(state.grid, part), known);
      ProgressCounter counter(progress, session.geometry().image_count(), state.images_done);
      session.encode_part(params(), images, {[&] { counter.add(); }, {}}, state.coded);
      state.images_done = counter.done();
    });
  } catch (const std::bad_alloc&) {
    return memory_is_out();
  }
  return {};
}

void DividedEncoder::save_part(size_t part, const ByteSink& sink) const {
  const CodedImages& coded = state_->coded;
  const auto save = [&](SavedHead head, std::span<const uint8_t> bytes) {
    head.size = bytes.size();
    sink(head.bytes());
    sink(bytes);
  };
  state_->for_each_owned(
      part,
      [&](size_t image) {
        coded.records.visit(image, [&](const ImageCode& code) {
          save({0, 0, image, 0}, to_bytes(code));
        });
      },
      [&](size_t plane) {
        save({1, coded.keys.crc(plane), plane, 0}, coded.keys.codestream(plane));
      });
}

bool DividedEncoder::load_part(size_t part, std::span<const uint8_t> bytes,
                               const ErrorSums& error) {
  CodedImages& coded = state_->coded;
  bool good = true;
  size_t at = 0;
  // The bytes of the next image or plane, which has to be `number`.
  const auto next = [&](uint32_t is_key, size_t number, SavedHead& head) {
    good = good && bytes.size() - at >= SavedHead::kBytes;
    if (!good) return std::span<const uint8_t>();
    head = SavedHead::of(bytes.subspan(at));
    at += SavedHead::kBytes;
    good = head.is_key == is_key && head.number == number && head.size <= bytes.size() - at;
    if (!good) return std::span<const uint8_t>();
    at += static_cast<size_t>(head.size);
    return bytes.subspan(at - static_cast<size_t>(head.size), static_cast<size_t>(head.size));
  };
  state_->for_each_owned(
      part,
      [&](size_t image) {
        SavedHead head;
        const auto code = next(0, image, head);
        if (!good) return;
        coded.records.open(image) = image_code_of(code);
        coded.records.close(image);
      },
      [&](size_t plane) {
        SavedHead head;
        const auto codestream = next(1, plane, head);
        if (good) coded.keys.set(plane, {codestream.begin(), codestream.end()}, head.crc);
      });
  if (!good || at != bytes.size()) return false;
  coded.error.add(error);
  return true;
}

void DividedEncoder::write(std::span<const uint8_t> rig, const ByteSink& sink) const {
  StreamHeader header = state_->session->header();
  if (!rig.empty()) header.feature_flags |= feature_bit(Feature::kCameraRig);
  write_stream(header, state_->coded, rig, sink);
}

}  // namespace hmlfc
