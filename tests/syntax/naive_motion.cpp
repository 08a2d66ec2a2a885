#include "syntax/naive_motion.hpp"

#include <algorithm>

#include "arithmetic/naive_bise.hpp"
#include "syntax/naive_tile.hpp"

namespace hmlfc::test {
namespace {

uint32_t parts(uint32_t size, uint32_t part) {
  uint32_t count = 0;
  for (uint32_t covered = 0; covered < size; covered += part) ++count;
  return count;
}

// The least level count that is at least `count`.
uint32_t levels_for(size_t count) {
  for (const uint32_t levels : naive_level_counts()) {
    if (levels >= count) return levels;
  }
  return 0;
}

int draw_signed(std::mt19937& random, unsigned bits) {
  if (bits == 0) return 0;
  const int half = 1 << (bits - 1);
  return draw(random, 0, 2) == 0 ? draw(random, -half, half - 1)
                                 : draw(random, -std::min(half, 30), std::min(half - 1, 30));
}

bool is_usable(const EntryModel& entry, const MotionRules& rules) {
  return entry.choice == 0 || entry.choice == 11 || (entry.choice < 11 && rules.disparities);
}

EntryModel draw_entry(std::mt19937& random, const MotionRules& rules, unsigned explicit_bits) {
  EntryModel entry;
  if (rules.two_references) entry.reference_set = static_cast<unsigned>(draw(random, 0, 7));
  entry.choice = static_cast<unsigned>(draw(random, 0, 15));
  if (draw(random, 0, 2) == 0) entry.choice = 11;
  if (rules.disparities && draw(random, 0, 2) == 0) entry.choice = 1;
  if (rules.signs) entry.negative = draw(random, 0, 1) != 0;
  if (entry.choice == 10 || entry.choice == 11) {
    entry.explicit_x = draw_signed(random, explicit_bits);
  }
  if (entry.choice == 11) entry.explicit_y = draw_signed(random, explicit_bits);
  return entry;
}

}  // namespace

NaiveBits write_motion(const MotionModel& tile) {
  NaiveBits bits;
  bits.put(tile.motion_block, 2).put(tile.palette.size() - 1, 3).put(tile.explicit_bits, 4);
  for (const EntryModel& entry : tile.palette) {
    if (tile.rules.two_references) bits.put(entry.reference_set, 3);
    bits.put(entry.choice, 4);
    if (tile.rules.signs) bits.put(entry.negative ? 1 : 0, 1);
    if (entry.choice == 10 || entry.choice == 11) {
      bits.put_signed(entry.explicit_x, tile.explicit_bits);
    }
    if (entry.choice == 11) bits.put_signed(entry.explicit_y, tile.explicit_bits);
  }
  naive_bise_encode(bits, levels_for(tile.palette.size()), tile.indices);
  return bits;
}

MotionModel draw_motion_tile(std::mt19937& random, const MotionRules& rules, uint32_t width,
                             uint32_t height) {
  MotionModel tile;
  tile.rules = rules;
  tile.motion_block = static_cast<unsigned>(draw(random, static_cast<int>(rules.least_block), 3));
  tile.explicit_bits = static_cast<unsigned>(draw(random, 0, 12));
  tile.palette.clear();
  std::vector<uint32_t> usable;
  const int entries = draw(random, 1, 8);
  for (int i = 0; i < entries; ++i) {
    EntryModel entry = draw_entry(random, rules, tile.explicit_bits);
    if (i + 1 == entries && usable.empty() && !is_usable(entry, rules)) entry = {};
    if (is_usable(entry, rules)) usable.push_back(static_cast<uint32_t>(i));
    tile.palette.push_back(entry);
  }
  tile.columns = parts(width, tile.side());
  tile.rows = parts(height, tile.side());
  tile.indices.clear();
  for (uint32_t i = 0; i < tile.columns * tile.rows; ++i) {
    tile.indices.push_back(usable[random() % usable.size()]);
  }
  return tile;
}

NaiveBits write_disparities(const DisparityModel& tile) {
  NaiveBits bits;
  bits.put_signed(tile.least, 13).put(tile.code, 5);
  naive_bise_encode(bits, naive_level_counts()[tile.code], tile.values);
  return bits;
}

DisparityModel draw_disparity_tile(std::mt19937& random, uint32_t width, uint32_t height,
                                   uint32_t side) {
  DisparityModel tile;
  const bool far = draw(random, 0, 3) == 0;
  tile.least = far ? draw(random, -4096, 4095) : draw(random, -60, 20);
  tile.code = static_cast<unsigned>(draw(random, 0, far ? 27 : 15));
  tile.columns = parts(width, side);
  tile.rows = parts(height, side);
  const auto levels = static_cast<int>(naive_level_counts()[tile.code]);
  tile.values.clear();
  for (uint32_t i = 0; i < tile.columns * tile.rows; ++i) {
    const int most = std::min(levels - 1, 4095 - tile.least);
    tile.values.push_back(static_cast<uint32_t>(draw(random, 0, most)));
  }
  return tile;
}

}  // namespace hmlfc::test
