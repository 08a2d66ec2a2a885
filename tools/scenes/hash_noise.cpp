#include "scenes/hash_noise.hpp"

namespace hmlfc::scenes {

double value_noise(uint64_t seed, double x, double y) {
  const int64_t left = floor_to_int(x);
  const int64_t top = floor_to_int(y);
  const double u = x - static_cast<double>(left);
  const double v = y - static_cast<double>(top);
  const double across = u * u * (3.0 - 2.0 * u);
  const double down = v * v * (3.0 - 2.0 * v);
  const double a = cell_noise(seed, left, top);
  const double b = cell_noise(seed, left + 1, top);
  const double c = cell_noise(seed, left, top + 1);
  const double d = cell_noise(seed, left + 1, top + 1);
  const double upper = a + (b - a) * across;
  const double lower = c + (d - c) * across;
  return upper + (lower - upper) * down;
}

double layered_noise(uint64_t seed, double x, double y, int octaves) {
  double sum = 0.0;
  double weight = 0.5;
  double total = 0.0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * value_noise(seed + static_cast<uint64_t>(octave), x, y);
    total += weight;
    weight *= 0.5;
    x = 2.0 * x + 17.25;
    y = 2.0 * y - 9.75;
  }
  return sum / total;
}

}  // namespace hmlfc::scenes
