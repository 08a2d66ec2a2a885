// Which pixels of which views make a pixel of a frame, and their weights (SMP-1, SMP-2).

const int kFilterNearest = 0;
const int kFilterQuadrilinear = 2;

/// Views along one axis: `count` from `first` on. The weight of view m is that of view_weight; views
/// outside the grid stand for its border.
struct ViewRange {
  int first, count;
  int place;  // A of SMP-1
};

/// `place`: U or V of RAY-3.
ViewRange view_range(FrameRecord f, int place) {
  if (f.filter_kind == kFilterNearest) return ViewRange((place + kHalfStep) >> 16, 1, 0);
  const int steps = 1 << f.aperture;
  const int k = 8 - 2 * f.aperture;
  const int a = (place + (1 << (15 - k))) >> (16 - k);
  return ViewRange((a >> k) - steps + 1, 2 * steps, a);
}

/// wc or wr of SMP-1; 256 for filter nearest, whose one view has a weight of 65536.
int view_weight(FrameRecord f, ViewRange range, int m) {
  if (f.filter_kind == kFilterNearest) return 256;
  const int k = 8 - 2 * f.aperture;
  return max(0, (1 << (f.aperture + k)) - abs((m << k) - range.place));
}

/// One axis of the taps in a view: pixel `first`, and with a fraction the next one.
struct AxisTaps {
  int first;
  int fraction;  // of 256, weight of pixel first + 1
};

/// The taps at coordinate x, x(c) or y(r) of RAY-4, in a picture of `size` pixels.
AxisTaps axis_taps(FrameRecord f, int x, int size) {
  const int inside = clamp(x, 0, (size - 1) << 12);
  if (f.filter_kind != kFilterQuadrilinear) return AxisTaps((inside + kHalfPixel) >> 12, 0);
  const int rounded = (inside + 8) >> 4;
  return AxisTaps(rounded >> 8, rounded & 255);
}

/// The image of the level shown that stands for view (r, c) (DEC-1).
uvec2 shown_image(int row, int col) { return ancestor(uvec2(row, col), frame().stop_level); }
