#include "hazards.hpp"

#include <algorithm>

namespace hmlfc::gpu {
namespace {

std::string work_names(unsigned work) {
  constexpr const char* kNames[] = {"compute", "transfer", "indirect", "host"};
  std::string names;
  for (unsigned i = 0; i < 4; ++i) {
    if ((work >> i & 1u) != 0) names += (names.empty() ? "" : ", ") + std::string(kNames[i]);
  }
  return names;
}

}  // namespace

void Hazards::add_buffer(uint64_t buffer) {
  parts_.erase(buffer);
  accesses_.erase(buffer);
}

uint64_t Hazards::begin() {
  for (auto& [buffer, list] : accesses_) {
    for (Access& access : list) {
      access.number = 0;
      access.barriers = 0;
    }
  }
  barriers_.clear();
  hazard_.clear();
  command_ = "the beginning";
  number_ = 0;
  return ++submission_;
}

void Hazards::finished(uint64_t number) {
  for (auto& [buffer, list] : accesses_) {
    for (Access& access : list) {
      if (access.submission <= number) access.submission = 0;
    }
    std::erase_if(list,
                  [](const Access& access) { return !access.writes && access.submission == 0; });
  }
}

void Hazards::barrier(unsigned before, unsigned after) {
  barriers_.push_back({before, after, 0, 0, command_});
}

void Hazards::command(const std::string& name) {
  command_ = name;
  ++number_;
}

void Hazards::access(Work work, const BufferAccess& access) {
  const auto part = parts_.find(access.buffer);
  const bool whole = part == parts_.end();
  const uint64_t at = whole ? 0 : part->second.at;
  auto& list = accesses_[whole ? access.buffer : part->second.whole];
  const Access added{command_,
                     number_,
                     work,
                     at + access.begin,
                     at + std::min(access.end, UINT64_MAX - at),
                     access.writes,
                     barriers_.size(),
                     submission_};
  for (const Access& first : list) {
    const bool same_bytes = first.begin < added.end && added.begin < first.end;
    if (first.number == added.number) continue;
    if (first.submission == 0 && added.writes) continue;
    if (same_bytes && (first.writes || added.writes)) order(first, added, access.name);
  }
  // Drops accesses that this write overwrites: later conflicts are caught against the write itself.
  if (access.writes) {
    std::erase_if(list, [&](const Access& first) {
      return first.number != added.number && added.begin <= first.begin && first.end <= added.end;
    });
  }
  list.push_back(added);
}

// Finds the barriers that order `second` after `first`.
void Hazards::order(const Access& first, const Access& second, const std::string& name) {
  std::vector<Barrier*> found;
  for (size_t i = first.barriers; i < second.barriers; ++i) {
    Barrier& barrier = barriers_[i];
    if ((barrier.before & first.work) != 0 && (barrier.after & second.work) != 0) {
      found.push_back(&barrier);
    }
  }
  if (found.empty() && hazard_.empty()) {
    hazard_ = second.command + (second.writes ? " writes " : " reads ") + name + ", which " +
              first.command + (first.writes ? " writes" : " reads") +
              (first.number == 0 ? " in an earlier submission" : "") + ", without a barrier from " +
              work_names(first.work) + " to " + work_names(second.work);
  } else if (found.size() == 1) {
    found.front()->used_before |= first.work;
    found.front()->used_after |= second.work;
  }
}

std::string Hazards::end() {
  if (!hazard_.empty()) return hazard_;
  for (size_t i = 1; i < barriers_.size(); ++i) {
    const Barrier& barrier = barriers_[i];
    const unsigned before = barrier.before & ~barrier.used_before;
    const unsigned after = barrier.after & ~barrier.used_after;
    if (before == 0 && after == 0) continue;
    return "nothing needs that the barrier after " + barrier.previous +
           (before != 0 ? " waits for " + work_names(before)
                        : " makes " + work_names(after) + " wait");
  }
  return {};
}

}  // namespace hmlfc::gpu
