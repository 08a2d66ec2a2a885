#include "syntax/naive_tile.hpp"

#include <algorithm>

#include "arithmetic/naive_bise.hpp"

namespace hmlfc::test {
namespace {

const std::vector<uint32_t>& level_counts() {
  static const std::vector<uint32_t> counts = naive_level_counts();
  return counts;
}

// v, K and c of TIL-6.
struct Widths {
  unsigned v = 0;
  unsigned K = 0;
  unsigned c = 0;
};

Widths widths_of(int window) {
  const auto values = static_cast<uint32_t>(2 * window + 1);
  Widths widths;
  while ((1u << widths.v) < values) ++widths.v;
  while (level_counts()[widths.K] < values) ++widths.K;
  while ((1u << widths.c) <= widths.K) ++widths.c;
  return widths;
}

void put_mask(NaiveBits& bits, unsigned mode, uint64_t mask) {
  if (mode == 2) bits.put(mask, 64);
  if (mode != 3) return;
  for (unsigned q = 0; q < 16; ++q) bits.put(((mask >> (4 * q)) & 15) != 0 ? 1 : 0, 1);
  for (unsigned q = 0; q < 16; ++q) {
    const uint64_t four = (mask >> (4 * q)) & 15;
    if (four != 0) bits.put(four, 4);
  }
}

void put_vectors(NaiveBits& bits, const TileModel& tile) {
  const Widths widths = widths_of(tile.context.window);
  bits.put(tile.sign_mode, 2);
  bits.put(static_cast<uint64_t>(tile.min_x + tile.context.window), widths.v);
  bits.put(tile.codes_x, widths.c);
  bits.put(static_cast<uint64_t>(tile.min_y + tile.context.window), widths.v);
  bits.put(tile.codes_y, widths.c);
  std::vector<uint32_t> x, y;
  for (const BlockModel& block : tile.blocks) {
    if (!block.motion) continue;
    if (tile.sign_mode == 2) bits.put(block.negative ? 1 : 0, 1);
    x.push_back(static_cast<uint32_t>(block.dx - tile.min_x));
    y.push_back(static_cast<uint32_t>(block.dy - tile.min_y));
  }
  naive_bise_encode(bits, level_counts()[tile.codes_x], x);
  naive_bise_encode(bits, level_counts()[tile.codes_y], y);
}

void put_headers(NaiveBits& bits, const TileModel& tile) {
  bits.put(tile.level_base, 6).put(tile.level_bits, 3).put(tile.bias_bits, 4);
  if (tile.context.steps) bits.put(tile.step_base, 4).put(tile.step_bits, 2);
  for (const BlockModel& block : tile.blocks) {
    if (!block.residual) continue;
    bits.put(block.level_code - tile.level_base, tile.level_bits);
    if (tile.context.steps) bits.put(block.step_code - tile.step_base, tile.step_bits);
    bits.put_signed(block.bias, tile.bias_bits);
  }
}

// The modes that can say `mask`: 0 and 1 for two masks alone, 2 and 3 for each.
unsigned draw_mode(std::mt19937& random, uint64_t mask, uint64_t inside) {
  std::vector<unsigned> modes{2, 3};
  if (mask == 0) modes.insert(modes.end(), 4, 0);
  if (mask == inside) modes.insert(modes.end(), 4, 1);
  return modes[static_cast<size_t>(draw(random, 0, static_cast<int>(modes.size()) - 1))];
}

// A least component and a level code whose values reach every component in use.
void draw_bounds(std::mt19937& random, int window, std::vector<int*> components, int& least,
                 unsigned& code) {
  if (components.empty()) return;
  const unsigned K = widths_of(window).K;
  code = static_cast<unsigned>(draw(random, 0, static_cast<int>(K)));
  least = draw(random, -window, window);
  const int most = std::min(window, least + static_cast<int>(level_counts()[code]) - 1);
  for (int* component : components) *component = draw(random, least, most);
}

void draw_motion(std::mt19937& random, TileModel& tile) {
  std::vector<int*> x, y;
  tile.sign_mode = static_cast<unsigned>(draw(random, 0, 2));
  for (BlockModel& block : tile.blocks) {
    if (!block.motion) continue;
    block.negative = tile.sign_mode == 1 || (tile.sign_mode == 2 && draw(random, 0, 1) != 0);
    x.push_back(&block.dx);
    y.push_back(&block.dy);
  }
  draw_bounds(random, tile.context.window, x, tile.min_x, tile.codes_x);
  draw_bounds(random, tile.context.window, y, tile.min_y, tile.codes_y);
}

void draw_residuals(std::mt19937& random, TileModel& tile) {
  const int depth = tile.context.depth;
  const int most_code = 27 + 3 * (depth - 8);
  tile.level_base = static_cast<unsigned>(draw(random, 0, most_code));
  tile.level_bits = static_cast<unsigned>(draw(random, 0, 6));
  tile.bias_bits = static_cast<unsigned>(draw(random, 0, depth + 2));
  const int base = static_cast<int>(tile.level_base);
  const int reach = std::min(most_code, base + (1 << tile.level_bits) - 1);
  if (tile.context.steps) {
    tile.step_base = static_cast<unsigned>(draw(random, 0, 15));
    tile.step_bits = static_cast<unsigned>(draw(random, 0, 3));
  }
  const int step_base = static_cast<int>(tile.step_base);
  const int step_reach = std::min(15, step_base + (1 << tile.step_bits) - 1);
  const int half = tile.bias_bits == 0 ? 0 : 1 << (tile.bias_bits - 1);
  for (BlockModel& block : tile.blocks) {
    if (!block.residual) continue;
    block.level_code = static_cast<unsigned>(draw(random, base, reach));
    if (tile.context.steps) {
      block.step_code = static_cast<unsigned>(draw(random, step_base, step_reach));
    }
    block.bias = draw(random, -half, std::max(half - 1, 0));
    const auto levels = static_cast<int>(level_counts()[block.level_code]);
    for (uint64_t i = 0; i < tile.context.block_samples; ++i) {
      block.values.push_back(static_cast<uint32_t>(draw(random, 0, levels - 1)));
    }
  }
}

// Nothing, everything, about half or a few of the blocks inside.
uint64_t draw_mask(std::mt19937& random, uint64_t inside) {
  const auto word = [&] { return (uint64_t{random()} << 32) | random(); };
  const uint64_t masks[] = {0, inside, word() & inside, word() & word() & word() & word() & inside};
  return masks[draw(random, 0, 3)];
}

}  // namespace

int draw(std::mt19937& random, int lo, int hi) {
  return std::uniform_int_distribution(lo, hi)(random);
}

uint64_t TileModel::motion_mask() const {
  uint64_t mask = 0;
  for (size_t k = 0; k < 64; ++k) mask |= uint64_t{blocks[k].motion} << k;
  return mask;
}

uint64_t TileModel::residual_mask() const {
  uint64_t mask = 0;
  for (size_t k = 0; k < 64; ++k) mask |= uint64_t{blocks[k].residual} << k;
  return mask;
}

TileRecord write_tile(const TileModel& tile) {
  TileRecord record;
  NaiveBits& bits = record.bits;
  if (tile.context.predictive) bits.put(tile.motion_mode, 2);
  bits.put(tile.residual_mode, 2);
  if (tile.context.predictive) put_mask(bits, tile.motion_mode, tile.motion_mask());
  put_mask(bits, tile.residual_mode, tile.residual_mask());
  record.vectors_begin = bits.size();
  if (tile.motion_mask() != 0) put_vectors(bits, tile);
  record.residuals_begin = bits.size();
  if (tile.residual_mask() != 0) put_headers(bits, tile);
  record.head_end = bits.size();
  for (size_t k = 0; k < 64; ++k) {
    const BlockModel& block = tile.blocks[k];
    if (block.residual) naive_bise_encode(bits, level_counts()[block.level_code], block.values);
    record.ends[k] = bits.size();
  }
  return record;
}

TileModel draw_tile(std::mt19937& random, const TileContext& context) {
  TileModel tile;
  tile.context = context;
  const uint64_t motion = context.predictive ? draw_mask(random, context.blocks_inside) : 0;
  const uint64_t residual = draw_mask(random, context.blocks_inside);
  for (size_t k = 0; k < 64; ++k) {
    tile.blocks[k].motion = (motion >> k) % 2 != 0;
    tile.blocks[k].residual = (residual >> k) % 2 != 0;
  }
  tile.motion_mode = draw_mode(random, motion, context.blocks_inside);
  tile.residual_mode = draw_mode(random, residual, context.blocks_inside);
  draw_motion(random, tile);
  draw_residuals(random, tile);
  return tile;
}

TileContext draw_context(std::mt19937& random) {
  TileContext context;
  context.predictive = draw(random, 0, 3) != 0;
  PlaneShape plane;
  plane.blocks_x = static_cast<uint32_t>(draw(random, 1, 8));
  plane.blocks_y = static_cast<uint32_t>(draw(random, 1, 8));
  if (draw(random, 0, 1) != 0) plane.blocks_x = plane.blocks_y = 8;
  context.blocks_inside = blocks_inside(plane, 0, 0);
  context.window = draw(random, 0, 1) != 0 ? draw(random, 0, 127) : draw(random, 0, 3);
  context.depth = draw(random, 8, 12);
  context.block_samples = uint64_t{4} << (2 * draw(random, 0, 2));
  context.steps = draw(random, 0, 1) != 0;
  return context;
}

}  // namespace hmlfc::test
