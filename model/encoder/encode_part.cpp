#include "encoder/encode_part.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "encoder/motion_prediction.hpp"

namespace hmlfc {
namespace {

using Images = std::set<ImagePos>;

std::vector<ImagePos> listed(const Images& images) { return {images.begin(), images.end()}; }

// Finds, from the views up, what coding a range of views depends on.
class PartFinder {
 public:
  PartFinder(const Geometry& geometry, const ImageRange& views,
             const std::function<bool(int, ImagePos)>& known)
      : geometry_(geometry),
        views_(views),
        known_(known),
        motion_(!geometry.motion_planes().empty()),
        needed_(static_cast<size_t>(geometry.top()) + 1) {}

  EncodePart run() {
    EncodePart part;
    part.views = views_;
    for (int level = 0; level <= geometry_.top(); ++level) part.levels.push_back(find(level));
    // The top level of a tree consists of key images: what is needed of it needs no image next to
    // it, and every image that is looked at below has its parent among what is needed.
    Images originals = needed_.back();
    for (int level = geometry_.top(); level > 0; --level) {
      part.levels[static_cast<size_t>(level)].originals = listed(originals);
      originals = children(originals, level);
    }
    return part;
  }

 private:
  LevelPart find(int level) {
    const auto l = static_cast<size_t>(level);
    const LevelShape& shape = geometry_.level(level);
    add_owned(level);
    Images references;
    LevelPart part;
    part.predicts = uint64_t{shape.group_rows()} * shape.group_cols() < shape.images();
    Images groups;
    for (const ImagePos at : needed_[l]) {
      const ImagePos own = geometry_.reference_of(level, at);
      references.insert(own);
      if (own != at) {
        part.predictive.push_back(at);
        groups.insert(own);
        const ReferenceImages places = reference_images(geometry_, level, at);
        if (motion_) references.insert(places.begin(), places.end());
      } else if (owns(views_, geometry_, level, at) && !members_of(geometry_, level, at).empty()) {
        groups.insert(at);
      }
    }
    part.references = listed(references);
    part.groups = listed(groups);
    for (const ImagePos at : part.references) {
      part.known.push_back(shape.keyed && known_(level, at));
    }
    add_parents(level, part.predictive);
    if (!shape.keyed) add_parents(level, part.references);
    if (motion_) add_searched(level, groups, part);
    return part;
  }

  void add_owned(int level) {
    const ImagePos first = geometry_.ancestor({views_.row0, views_.col0}, 0, level);
    const ImagePos last = geometry_.ancestor({views_.row1 - 1, views_.col1 - 1}, 0, level);
    for (const ImagePos at : ImageRange{first.row, last.row + 1, first.col, last.col + 1}) {
      if (owns(views_, geometry_, level, at)) needed_[static_cast<size_t>(level)].insert(at);
    }
  }

  void add_parents(int level, const std::vector<ImagePos>& images) {
    if (level == geometry_.top()) return;
    for (const ImagePos at : images) {
      needed_[static_cast<size_t>(level) + 1].insert(geometry_.ancestor(at, level, level + 1));
    }
  }

  // What the search of disparities and the refinement of key images look at: other images of the
  // groups, at keyed levels also the second references of these.
  void add_searched(int level, const Images& groups, LevelPart& part) {
    const bool keyed = geometry_.level(level).keyed;
    const Images references(part.references.begin(), part.references.end());
    Images context;
    for (size_t i = 0; i < part.references.size(); ++i) {
      const ImagePos reference = part.references[i];
      const bool refined = keyed && !part.known[i];
      if (!refined && !groups.contains(reference)) continue;
      const std::vector<ImagePos> members = members_of(geometry_, level, reference);
      if (!keyed) add_parents(level, members);
      for (const ImagePos at : members) {
        const ImagePos other = reference_images(geometry_, level, at)[1];
        if (keyed && !references.contains(other)) context.insert(other);
      }
    }
    part.context = listed(context);
  }

  // The images of `level` - 1, in [0, top - 1], that `images` of `level` are the means of.
  Images children(const Images& images, int level) const {
    Images found;
    for (const ImagePos at : images) {
      for (const ImagePos child : geometry_.descendants(at, level, level - 1)) found.insert(child);
    }
    return found;
  }

  const Geometry& geometry_;
  ImageRange views_;
  const std::function<bool(int, ImagePos)>& known_;
  bool motion_;
  std::vector<Images> needed_;
};

}  // namespace

bool owns(const ImageRange& views, const Geometry& geometry, int level, ImagePos at) {
  const auto [row, col] = *geometry.descendants(at, level, 0).begin();
  return row >= views.row0 && row < views.row1 && col >= views.col0 && col < views.col1;
}

EncodePart sampled_part(const Geometry& geometry, const std::vector<ImagePos>& sample) {
  EncodePart part;
  LevelPart& level = part.levels.emplace_back();
  level.predictive = sample;
  for (const ImagePos at : sample) {
    for (const ImagePos place : reference_images(geometry, 0, at)) {
      if (std::ranges::find(level.references, place) == level.references.end()) {
        level.references.push_back(place);
      }
    }
  }
  if (sample.empty()) level.references.push_back(geometry.reference_of(0, {0, 0}));
  level.known.resize(level.references.size());
  level.predicts = !sample.empty();
  for (const ImagePos at : level.references) {
    const auto is_member = [&](ImagePos member) { return geometry.reference_of(0, member) == at; };
    if (std::ranges::any_of(sample, is_member)) level.groups.push_back(at);
  }
  return part;
}

EncodePart part_of_views(const Geometry& geometry, const ImageRange& views,
                         const std::function<bool(int level, ImagePos at)>& known) {
  return PartFinder(geometry, views, known).run();
}

std::vector<ImagePos> members_of(const Geometry& geometry, int level, ImagePos reference) {
  std::vector<ImagePos> members;
  for (const ImagePos at : geometry.group_images(level, reference)) {
    if (at != reference) members.push_back(at);
  }
  return members;
}

std::vector<ImagePos> spread_images(std::vector<ImagePos> images, size_t count) {
  if (images.size() <= count) return images;
  const uint32_t row0 = images.front().row;
  const uint32_t rows = images.back().row - row0 + 1;
  const auto [least, most] = std::ranges::minmax_element(images, {}, &ImagePos::col);
  const uint32_t col0 = least->col;
  const uint32_t cols = most->col - col0 + 1;
  // Rows in order, columns at multiples of the golden section, 55 to 89.
  std::vector<ImagePos> some;
  for (size_t i = 0; i < count; ++i) {
    const size_t middle = 2 * i + 1;
    const auto row = static_cast<int32_t>(row0 + middle * rows / (2 * count));
    const auto col = static_cast<int32_t>(col0 + middle * 55 % 178 * cols / 178);
    const auto nearest = std::ranges::min_element(images, {}, [&](ImagePos at) {
      return std::abs(static_cast<int32_t>(at.row) - row) +
             std::abs(static_cast<int32_t>(at.col) - col);
    });
    some.push_back(*nearest);
    images.erase(nearest);
  }
  return some;
}

int32_t distance_from_references(const Geometry& geometry, ImagePos at) {
  const auto views_apart = [&](ImagePos reference) {
    return std::abs(row_offset(reference, at)) + std::abs(col_offset(reference, at));
  };
  const ReferenceImages places = reference_images(geometry, 0, at);
  return 4 * views_apart(places[0]) + views_apart(places[1]);
}

}  // namespace hmlfc
