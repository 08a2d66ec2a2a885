#include <hmlfc/key_prefetcher.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "bits/parallel.hpp"
#include "decoder/request_guard.hpp"
#include "render/key_images_of.hpp"
#include "render/shown_image.hpp"

namespace hmlfc {

namespace {

thread_local bool is_prefetching = false;

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

struct KeyPrefetcher::State {
  explicit State(const Decoder& of) : decoder(of), thread([this] { run(); }) {}
  ~State();

  void rendered(const FrameRecord& record, int stop_level);
  void plan(const std::array<int, 4>& used, double du, double dv, int stop_level);
  void run();
  Result<void> decode(const KeyImage& key);

  const Decoder& decoder;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<KeyImage> wanted;
  std::set<KeyImage> decoded;
  bool busy = false;
  bool ends = false;
  bool any = false;  // a frame has been rendered, from
  int32_t u = 0;
  int32_t v = 0;
  std::thread thread;  // the last: it uses the others
};

KeyPrefetcher::State::~State() {
  {
    const std::lock_guard lock(mutex);
    ends = true;
  }
  changed.notify_all();
  thread.join();
}

void KeyPrefetcher::State::rendered(const FrameRecord& record, int stop_level) {
  if (!fits(record, decoder.header(), stop_level)) return;
  {
    const std::lock_guard lock(mutex);
    const double du = static_cast<double>(record.u0) - std::exchange(u, record.u0);
    const double dv = static_cast<double>(record.v0) - std::exchange(v, record.v0);
    const bool moved = std::exchange(any, true) && (du != 0 || dv != 0);
    if (!moved) return;
    const auto planned = guard_memory([&]() -> Result<void> {
      plan(views_in_use(record), du, dv, stop_level);
      return {};
    });
    if (!planned) wanted.clear();
  }
  changed.notify_all();
}

// Wants the key images of the views up to kReach in the direction (du, dv), the nearest first.
void KeyPrefetcher::State::plan(const std::array<int, 4>& used, double du, double dv,
                                int stop_level) {
  const StreamHeader& header = decoder.header();
  const double longer = std::max(std::abs(du), std::abs(dv));
  wanted.clear();
  for (int step = 1; step <= kReach; ++step) {
    const int right = static_cast<int>(std::lround(step * du / longer));
    const int down = static_cast<int>(std::lround(step * dv / longer));
    const int last_row = std::min(used[1] + down, static_cast<int>(header.rows) - 1);
    const int last_col = std::min(used[3] + right, static_cast<int>(header.cols) - 1);
    for (int row = std::max(0, used[0] + down); row <= last_row; ++row) {
      for (int col = std::max(0, used[2] + right); col <= last_col; ++col) {
        const ViewPos view{static_cast<uint32_t>(row), static_cast<uint32_t>(col)};
        for (const KeyImage& key : key_images_of(header, view, stop_level)) {
          if (wanted.size() == kMostKeys) return;
          const bool known = decoded.contains(key) || std::ranges::count(wanted, key) > 0;
          if (!known) wanted.push_back(key);
        }
      }
    }
  }
}

void KeyPrefetcher::State::run() {
  is_prefetching = true;
  std::unique_lock lock(mutex);
  while (true) {
    changed.wait(lock, [this] { return ends || !wanted.empty(); });
    if (ends) return;
    const KeyImage key = wanted.front();
    wanted.pop_front();
    busy = true;
    lock.unlock();
    // Failures are left to the frames that need the key image.
    static_cast<void>(guard_memory([&] { return decode(key); }));
    lock.lock();
    busy = false;
    changed.notify_all();
  }
}

// One sample of a key image decodes its whole plane (KEY-3), which is kept.
Result<void> KeyPrefetcher::State::decode(const KeyImage& key) {
  {
    const std::lock_guard lock(mutex);
    decoded.insert(key);
  }
  run_on_threads(1, [&] {
    const ViewPos view = view_under(decoder.header(), key);
    for (const Plane plane : kPlanes) {
      static_cast<void>(decoder.decode_rect(view, plane, {0, 0, 1, 1}, key.level));
    }
  });
  return {};
}

KeyPrefetcher::KeyPrefetcher(const Decoder& decoder) : state_(std::make_unique<State>(decoder)) {}

KeyPrefetcher::~KeyPrefetcher() = default;

void KeyPrefetcher::rendered(const FrameRecord& record, int stop_level) {
  state_->rendered(record, stop_level);
}

void KeyPrefetcher::finish() {
  std::unique_lock lock(state_->mutex);
  state_->changed.wait(lock, [this] { return !state_->busy && state_->wanted.empty(); });
}

bool KeyPrefetcher::is_this_thread() { return is_prefetching; }

}  // namespace hmlfc
