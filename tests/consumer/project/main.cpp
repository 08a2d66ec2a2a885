// The smallest program that uses the installed library: keeps one view in a light field.
#include <cstdio>

#include <hmlfc/light_field.hpp>

int main() {
  hmlfc::LightField field({.rows = 1, .cols = 2, .width = 1, .height = 1, .depth = 8});
  field.set_view(0, 1, {.width = 1, .height = 1, .depth = 8, .samples = {1, 2, 3}});
  const hmlfc::RgbImage view = field.view(0, 1);
  std::printf("%d %d %d\n", view.samples[0], view.samples[1], view.samples[2]);
  return view.samples[2] == 3 ? 0 : 1;
}
