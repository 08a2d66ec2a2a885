#include "view/ahead.hpp"

#include <algorithm>
#include <cmath>

#include "bits/parallel.hpp"
#include "syntax/geometry.hpp"
#include "view/frame_reads.hpp"

namespace hmlfc::view {

namespace {

void collect(const Geometry& geometry, bool two_references, int level, ImagePos image,
             std::set<KeyImage>& keys) {
  if (geometry.is_key(level, image)) {
    keys.insert({level, image.row, image.col});
    return;
  }
  if (!geometry.is_reference(level, image)) {
    ReferenceImages references = reference_images(geometry, level, image);
    if (!two_references) references.fill(references[0]);
    for (const ImagePos reference : references) {
      collect(geometry, two_references, level, reference, keys);
    }
  }
  if (level == geometry.top()) return;
  collect(geometry, two_references, level + 1, geometry.ancestor(image, level, level + 1), keys);
}

// A view that shows the key image at its level.
ViewPos view_under(const StreamHeader& header, const KeyImage& key) {
  ViewPos view{key.row, key.col};
  for (int level = 0; level < key.level; ++level) {
    view.row *= header.cluster_rows;
    view.col *= header.cluster_cols;
  }
  return view;
}

}  // namespace

std::set<KeyImage> key_images_of(const StreamHeader& header, ViewPos view, int stop_level) {
  const Geometry geometry(header);
  std::set<KeyImage> keys;
  const ImagePos image = geometry.ancestor({view.row, view.col}, 0, stop_level);
  collect(geometry, header.has(Feature::kTwoReferences), stop_level, image, keys);
  return keys;
}

Ahead::Ahead(const Decoder& decoder) : decoder_(decoder), thread_([this] { run(); }) {}

Ahead::~Ahead() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Ahead::rendered(const std::array<int, 4>& used, double u, double v, int stop_level) {
  {
    const std::lock_guard lock(mutex_);
    const double du = u - u_;
    const double dv = v - v_;
    const bool moved = any_ && (du != 0 || dv != 0);
    any_ = true;
    u_ = u;
    v_ = v;
    if (!moved) return;
    plan(used, du, dv, stop_level);
  }
  changed_.notify_all();
}

// Wants the key images of the views up to kReach in the direction (du, dv), the nearest first.
void Ahead::plan(const std::array<int, 4>& used, double du, double dv, int stop_level) {
  const StreamHeader& header = decoder_.header();
  const double longer = std::max(std::abs(du), std::abs(dv));
  wanted_.clear();
  for (int step = 1; step <= kReach; ++step) {
    const int right = static_cast<int>(std::lround(step * du / longer));
    const int down = static_cast<int>(std::lround(step * dv / longer));
    const int last_row = std::min(used[1] + down, static_cast<int>(header.rows) - 1);
    const int last_col = std::min(used[3] + right, static_cast<int>(header.cols) - 1);
    for (int row = std::max(0, used[0] + down); row <= last_row; ++row) {
      for (int col = std::max(0, used[2] + right); col <= last_col; ++col) {
        const ViewPos view{static_cast<uint32_t>(row), static_cast<uint32_t>(col)};
        for (const KeyImage& key : key_images_of(header, view, stop_level)) {
          if (wanted_.size() == kMostKeys) return;
          const bool known = decoded_.contains(key) || std::ranges::count(wanted_, key) > 0;
          if (!known) wanted_.push_back(key);
        }
      }
    }
  }
}

void Ahead::run() {
  FrameReads::mark_thread();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ends_ || !wanted_.empty(); });
    if (ends_) return;
    const KeyImage key = wanted_.front();
    wanted_.pop_front();
    decoded_.insert(key);  // corrupt ones, too: frames that need them say so
    busy_ = true;
    lock.unlock();
    // One sample of a key image decodes its whole plane (KEY-3), which is kept.
    run_on_threads(1, [&] {
      for (const Plane plane : kPlanes) {
        static_cast<void>(decoder_.decode_rect(view_under(decoder_.header(), key), plane,
                                               {0, 0, 1, 1}, key.level));
      }
    });
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

void Ahead::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !busy_ && wanted_.empty(); });
}

}  // namespace hmlfc::view
