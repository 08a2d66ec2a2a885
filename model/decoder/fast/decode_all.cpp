// Decoder::decode_all and load_references: work over all images, on all cores.
#include <hmlfc/decoder.hpp>

#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "bits/parallel.hpp"
#include "decoder/colour_row.hpp"
#include "decoder/decoder_state.hpp"
#include "decoder/fast/region_decoder.hpp"
#include "decoder/request_guard.hpp"

namespace hmlfc {
namespace {

// Keeps the error of the lowest-numbered task that fails, whatever the order in which threads run:
// a task is left out only when one before it has failed.
class FirstError {
 public:
  void add(uint64_t task, const Error& error) {
    const std::scoped_lock lock(mutex_);
    if (task >= task_) return;
    task_ = task;
    error_ = error;
  }
  bool failed_before(uint64_t task) const { return task_ < task; }
  Result<void> result() const {
    if (task_ != kNone) return tl::unexpected(error_);
    return {};
  }

 private:
  static constexpr uint64_t kNone = ~uint64_t{0};
  std::mutex mutex_;
  std::atomic<uint64_t> task_ = kNone;
  Error error_;
};

void parallel_tasks(uint64_t count, int threads, const std::function<void(size_t)>& body) {
  run_on_threads(threads, [&] { parallel_for(static_cast<size_t>(count), body); });
}

using ViewPlanes = std::array<SamplePlane, kPlaneCount>;

// Decodes all views below one image, so that what they share is decoded once.
class FamilyDecoder {
 public:
  FamilyDecoder(const FastSources& sources, int stop_level, const ViewConsumer& consumer)
      : sources_(sources), stop_level_(stop_level), consumer_(consumer) {}

  // Views whose ancestor at level `parent_level` is `parent`; parent_level is stop_level + 1, or
  // stop_level at the top.
  Result<void> run(int parent_level, ImagePos parent) const {
    if (parent_level == stop_level_) {
      const auto own = decode_image(parent_level, parent);
      if (!own) return tl::unexpected(own.error());
      return deliver(*own, parent);
    }
    std::optional<ViewPlanes> shared;  // decoded for the first child that needs it
    const Geometry& geometry = sources_.stream.geometry;
    for (const ImagePos image : geometry.descendants(parent, parent_level, stop_level_)) {
      if (!geometry.is_key(stop_level_, image) && !shared) {
        auto planes = decode_image(parent_level, parent);
        if (!planes) return tl::unexpected(planes.error());
        shared = std::move(*planes);
      }
      if (auto ok = decode_child(shared, image); !ok) return ok;
    }
    return {};
  }

 private:
  Result<ViewPlanes> decode_image(int level, ImagePos image) const {
    ViewPlanes planes;
    for (const PlaneGroup& group : kPlaneGroups) {
      const BlockRect all = whole_plane(sources_.stream.geometry.plane(group.first));
      auto ok = decode_region(sources_, level, image, group.first, all, group.of(planes));
      if (!ok) return tl::unexpected(ok.error());
    }
    return planes;
  }

  // `parent` is there, unless `image` is a key image.
  Result<void> decode_child(const std::optional<ViewPlanes>& parent, ImagePos image) const {
    if (!parent) {
      const auto key = decode_image(stop_level_, image);
      if (!key) return tl::unexpected(key.error());
      return deliver(*key, image);
    }
    ViewPlanes planes = *parent;
    for (const PlaneGroup& group : kPlaneGroups) {
      const BlockRect all = whole_plane(sources_.stream.geometry.plane(group.first));
      auto ok = add_level(sources_, stop_level_, image, group.first, all, group.of(planes));
      if (!ok) return ok;
    }
    return deliver(planes, image);
  }

  // Hands the picture to every view that shows it.
  Result<void> deliver(const ViewPlanes& planes, ImagePos image) const {
    const StreamHeader& header = sources_.stream.header;
    const bool halved = header.chroma_format == ChromaFormat::k420;
    const Rect all{0, 0, header.width, header.height};
    for (const ImagePos view : sources_.stream.geometry.descendants(image, stop_level_, 0)) {
      consumer_({view.row, view.col}, rgb_picture(planes, all, halved, header.depth));
    }
    return {};
  }

  const FastSources& sources_;
  int stop_level_;
  const ViewConsumer& consumer_;
};

// The error of the first view below `parent` that does not decode, as decode_view names it. There
// is one: the fast path fails on a whole plane only where some block of it does.
Error first_view_error(const Decoder& decoder, int parent_level, ImagePos parent, int stop_level) {
  const Geometry geometry(decoder.header());
  for (const ImagePos at : geometry.descendants(parent, parent_level, 0)) {
    const auto view = decoder.decode_view({at.row, at.col}, stop_level);
    if (!view) return view.error();
  }
  return {ErrorCode::kOutOfMemory, Section::kHeader, 0};
}

}  // namespace

Result<void> Decoder::decode_all(const ViewConsumer& consumer,
                                 const DecodeAllOptions& options) const {
  const int stop_level = options.stop_level;
  const Geometry& geometry = state_->stream.geometry;
  if (stop_level < 0 || stop_level > geometry.top()) {
    return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
  }
  const int parent_level = std::min(stop_level + 1, geometry.top());
  const LevelShape& shape = geometry.level(parent_level);
  const FastSources sources = state_->fast();
  const FamilyDecoder family(sources, stop_level, consumer);
  FirstError first;
  const auto run = [&](size_t i) {
    if (first.failed_before(i)) return;
    const ImagePos parent{static_cast<uint32_t>(i / shape.cols),
                          static_cast<uint32_t>(i % shape.cols)};
    const auto done = guard_memory([&]() -> Result<void> {
      if (family.run(parent_level, parent)) return {};
      return tl::unexpected(first_view_error(*this, parent_level, parent, stop_level));
    });
    if (!done) first.add(i, done.error());
  };
  return guard_request(state_->stream.source, [&] {
    load_images(sources, stop_level);
    parallel_tasks(shape.images(), options.threads, run);
    return first.result();
  });
}

Result<void> Decoder::load_references(int threads) const {
  const Geometry& geometry = state_->stream.geometry;
  FirstError first;
  return guard_request(state_->stream.source, [&] {
    for (int level = geometry.top() - 1; level >= 0; --level) {
      const LevelShape& shape = geometry.level(level);
      if (shape.keyed || (shape.ref_rows == 1 && shape.ref_cols == 1)) continue;
      parallel_tasks(shape.images(), threads, [&](size_t i) {
        const ImagePos image{static_cast<uint32_t>(i / shape.cols),
                             static_cast<uint32_t>(i % shape.cols)};
        if (!geometry.is_reference(level, image)) return;
        const auto read = guard_memory([&]() -> Result<void> {
          for (const Plane plane : kPlanes) {
            state_->references.plane(level, image, plane)->read_all();
          }
          return {};
        });
        if (!read) first.add(geometry.image_number(level, image), read.error());
      });
    }
    return first.result();
  });
}

}  // namespace hmlfc
