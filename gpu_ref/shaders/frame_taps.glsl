// Which pixels of which views make a pixel of a frame, and their weights (SMP-1, SMP-2). All filters
// are one formula: filter nearest is that of aperture 0 with the place of a whole view, and a filter
// of whole pixels rounds to those.

const int kFilterNearest = 0;
const int kFilterQuadrilinear = 2;

/// The numbers of a frame's filter.
struct Filter {
  int place_round, place_shift, place_mask;  // from U and V to A of SMP-1
  int view_log2;                             // k of SMP-1
  int reach;                                 // the weight of a view at the place itself
  uint views_log2;                           // of those along an axis, at least 2
  int tap_round, tap_mask;
};

Filter filter_of_frame() {
  const bool nearest = frame().record.filter_kind == kFilterNearest;
  const bool whole = frame().record.filter_kind != kFilterQuadrilinear;
  const int aperture = nearest ? 0 : frame().record.aperture;
  const int k = 8 - 2 * aperture;
  return Filter(nearest ? kHalfStep : 1 << (15 - k), 16 - k, nearest ? ~255 : ~0, k,
                1 << (aperture + k), uint(aperture) + 1u, whole ? kHalfPixel : 8, whole ? ~255 : ~0);
}

/// One axis of the grid of views and of their pictures.
struct Axis {
  int last_view;
  int last_place;  // of the last pixel, in units of 2^-12
};

Axis column_axis() { return Axis(frame().record.cols - 1, (frame().record.width - 1) << 12); }
Axis row_axis() { return Axis(frame().record.rows - 1, (frame().record.height - 1) << 12); }

/// A of SMP-1; `place`: Us or Vs of SRF-2.
int view_place(Filter f, Axis axis, int place) {
  const int inside = clamp(place, 0, axis.last_view << 16);
  return ((inside + f.place_round) >> f.place_shift) & f.place_mask;
}

/// The first of the views along an axis; they may lie outside the grid.
int first_view(Filter f, int view_place) {
  return (view_place >> f.view_log2) + 1 - (1 << (f.views_log2 - 1u));
}

/// wc or wr of SMP-1.
int view_weight(Filter f, int view_place, int view) {
  return max(0, f.reach - abs((view << f.view_log2) - view_place));
}

/// The tap along an axis in view `view`, in pixels and their fraction of 256: pixel floor and, with a
/// fraction, the next one. `at`: x(c) or y(r) there. Not less for a greater `at`.
int tap_place(Filter f, Axis axis, int at) {
  return ((clamp(at, 0, axis.last_place) + f.tap_round) >> 4) & f.tap_mask;
}
int first_pixel(int tap) { return tap >> 8; }
int last_pixel(int tap) { return (tap + 255) >> 8; }

/// The image of the level shown that stands for view (column, row) (DEC-1).
uvec2 shown_image(ivec2 view) { return ancestor(uvec2(view.y, view.x), frame().stop_level); }
