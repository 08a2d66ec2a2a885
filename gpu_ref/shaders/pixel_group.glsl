// A workgroup takes 8 x 8 pixels of a frame, one an invocation. Their rays lie close together: in each
// of a few views their taps fill a small *window* of pixels. Columns of views and rows of views have
// lines of such windows. Where the taps lie too far apart for windows, each pixel has one of its own,
// for one view at a time.

const int kWindowsLog2 = 6;
const uint kWindows = 1u << kWindowsLog2;  // as many as invocations

/// A column or row of views: the first bit of the image shown instead of its first view, and the
/// first and the last pixel of the windows in it.
struct Line {
  uint bit;
  int first, last;
};
shared Line window_cols[kWindows];
shared Line window_rows[kWindows];

/// The most columns, in pairs that begin at even ones, and the most rows of a window.
shared uint most_columns, most_rows;

/// Column and row of the invocation's pixel in the frame.
ivec2 pixel_of_invocation() {
  const uint lane = gl_LocalInvocationIndex;
  return ivec2((gl_WorkGroupID.xy << kGroupLog2) +
               uvec2(low_bits(lane, kGroupLog2), lane >> kGroupLog2));
}

// Bounds over the rays of the group that are inside, before displacement: u, v, x, y, and the
// displacement.
const uint kU = 0u, kV = 1u, kX = 2u, kY = 3u, kE = 4u, kBounds = 5u;
shared int group_least[kBounds], group_most[kBounds];

bool has_rays() { return group_least[kU] <= group_most[kU]; }

/// Finds the bounds of the group; all invocations call it, before a barrier.
void find_bounds(Ray ray, int e) {
  const uint lane = gl_LocalInvocationIndex;
  if (lane < kBounds) {
    const bool known = lane == kE && !kGeometry;
    group_least[lane] = known ? 0 : 0x7FFFFFFF;
    group_most[lane] = known ? 0 : -0x7FFFFFFF;
  }
  barrier();
  if (!ray.inside) return;
  atomicMin(group_least[kU], ray.u);
  atomicMin(group_least[kV], ray.v);
  atomicMin(group_least[kX], ray.x);
  atomicMin(group_least[kY], ray.y);
  atomicMax(group_most[kU], ray.u);
  atomicMax(group_most[kV], ray.v);
  atomicMax(group_most[kX], ray.x);
  atomicMax(group_most[kY], ray.y);
  if (!kGeometry) return;
  atomicMin(group_least[kE], e);
  atomicMax(group_most[kE], e);
}

/// The bounds along an axis.
struct Extent {
  ivec2 place;         // u or v; the least and the greatest
  ivec2 at;            // x or y
  int step;            // dx or dy
  ivec2 displacement;  // E or G
};

Extent column_extent() {
  return Extent(ivec2(group_least[kU], group_most[kU]), ivec2(group_least[kX], group_most[kX]),
                frame().record.dx, ivec2(group_least[kE], group_most[kE]));
}

Extent row_extent() {
  const int g0 = displacement_a_row(frame().record, group_least[kE]);
  const int g1 = displacement_a_row(frame().record, group_most[kE]);
  return Extent(ivec2(group_least[kV], group_most[kV]), ivec2(group_least[kY], group_most[kY]),
                frame().record.dy, ivec2(min(g0, g1), max(g0, g1)));
}

/// The least and the most that displacements add in view `view` to rays for which it has weight: so it
/// is less than a step, 2^12, away from them.
ivec2 displaced_by(Extent extent, int view) {
  if (!kGeometry) return ivec2(0);
  const ivec2 steps = clamp((view << 12) - (extent.place >> 4), -(1 << 12), 1 << 12);
  const ivec2 a = extent.displacement.x * steps;
  const ivec2 b = extent.displacement.y * steps;
  return ivec2(min(min(a.x, a.y), min(b.x, b.y)), max(max(a.x, a.y), max(b.x, b.y))) >> 8;
}

// mark.comp leaves the rays for render.comp: the u, v, x and y of each pixel of a group, u = kOutside
// for a ray that is not inside.
const int kOutside = -0x7FFFFFFF - 1;

uint place_of_ray() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kWindows +
         gl_LocalInvocationIndex;
}

void write_ray(Ray ray) {
  frame().rays.ray[place_of_ray()] = ivec4(ray.inside ? ray.u : kOutside, ray.v, ray.x, ray.y);
}

Ray read_ray() {
  const ivec4 words = frame().rays.ray[place_of_ray()];
  return Ray(words.x != kOutside, words.x, words.y, words.z, words.w, frame().record.dx,
             frame().record.dy);
}

/// How a group goes through its views.
struct Passes {
  bool far;         // each pixel has a window of its own, for view number `pass` of its own
  uint count;       // 0 without rays inside
  ivec2 first;      // else: column and row of the first view with taps
  ivec2 views;      // and how many columns and rows of them
  uint cols_log2;   // 2^cols_log2 windows of a row of views, 2^rows_log2 rows a pass
  uint rows_log2;
};

/// Pixels between and below taps that are at most `distance` apart, in units of 2^-12: taps are then at
/// most distance / 2^4 + 1 of 256ths apart, and the first is up to 255 of these after its pixel.
int pixels_of_taps(int distance) { return (((distance >> 4) + 511) >> 8) + 1; }

/// Pixels that the taps along an axis reach at most in any view. Views differ by a shift, and by what
/// displacements add: products of those and of steps, which differ by at most so much in both.
int most_pixels(Extent extent) {
  if (!kGeometry) return pixels_of_taps(extent.at.y - extent.at.x);
  const ivec2 e = extent.displacement;
  const int steps = min((extent.place.y >> 4) - (extent.place.x >> 4), 2 << 12);
  const int added = ((e.y - e.x) << 4) + ((steps * max(abs(e.x), abs(e.y))) >> 8) + 2;
  return pixels_of_taps(extent.at.y - extent.at.x + added);
}
ivec2 most_pixels_of_group() {
  return ivec2(most_pixels(column_extent()), most_pixels(row_extent()));
}

/// `windows_log2`: 2^windows_log2 windows have room; less than 0 where one has too little.
Passes passes_of_group(Filter f, Axis cols, Axis rows, int windows_log2) {
  const ivec2 last = ivec2(cols.last_view, rows.last_view);
  const ivec2 low = ivec2(first_view(f, view_place(f, cols, group_least[kU])),
                          first_view(f, view_place(f, rows, group_least[kV])));
  const ivec2 high = ivec2(first_view(f, view_place(f, cols, group_most[kU])),
                           first_view(f, view_place(f, rows, group_most[kV]))) +
                     (1 << f.views_log2) - 1;
  Passes passes;
  passes.first = clamp(low, ivec2(0), last);
  passes.views = clamp(high, ivec2(0), last) - passes.first + 1;
  passes.cols_log2 = uint(findMSB(2 * passes.views.x - 1));
  const int rows_log2 = min(windows_log2, kWindowsLog2) - int(passes.cols_log2);
  passes.far = rows_log2 < 0 || passes.views.y > int(kWindows);
  passes.rows_log2 = passes.far ? 0u : uint(rows_log2);
  passes.count = passes.far ? 1u << (2u * f.views_log2)
                            : ((uint(passes.views.y) - 1u) >> passes.rows_log2) + 1u;
  if (!has_rays()) passes.count = 0u;
  most_columns = most_rows = passes.far ? 2u : 0u;
  return passes;
}

shared Passes group_passes;  // which one invocation finds, with most_columns and most_rows

/// Column and row of the view of a far pass, of those of a pixel.
ivec2 view_of_pass(Filter f, uint pass) {
  return ivec2(int(low_bits(pass, f.views_log2)), int(pass >> f.views_log2));
}

/// The line of view `view` along an axis, with the taps of all rays that it has weight for.
Line line_of_view(Filter f, Axis axis, Extent extent, int view, uint bit) {
  const ivec2 at = extent.at + extent.step * view + displaced_by(extent, view);
  return Line(bit, first_pixel(tap_place(f, axis, at.x)), last_pixel(tap_place(f, axis, at.y)));
}
uint bit_of_col(int view) { return first_bit(shown_image(ivec2(view, 0))); }
uint bit_of_row(int view) { return first_bit(shown_image(ivec2(0, view))); }

/// The lines of the group's windows, or those of pass `pass`; all invocations call it, before a barrier.
/// `ray` is displaced.
void write_lines(Filter f, Axis cols, Axis rows, Passes passes, Ray ray, uint pass) {
  const uint lane = gl_LocalInvocationIndex;
  if (passes.far) {
    const ivec2 own = view_of_pass(f, pass) +
                      ivec2(first_view(f, view_place(f, cols, ray.u)),
                            first_view(f, view_place(f, rows, ray.v)));
    const ivec2 view = clamp(own, ivec2(0), ivec2(cols.last_view, rows.last_view));
    const int x = tap_place(f, cols, ray.x + ray.dx * view.x);
    const int y = tap_place(f, rows, ray.y + ray.dy * view.y);
    window_cols[lane] = Line(bit_of_col(view.x), first_pixel(x), ray.inside ? last_pixel(x) : -1);
    window_rows[lane] = Line(bit_of_row(view.y), first_pixel(y), last_pixel(y));
    return;
  }
  if (int(lane) < passes.views.x) {
    const int view = passes.first.x + int(lane);
    const Line line = line_of_view(f, cols, column_extent(), view, bit_of_col(view));
    window_cols[lane] = line;
    atomicMax(most_columns, uint((line.last >> 1) - (line.first >> 1)) + 1u);
  }
  if (int(lane) < passes.views.y) {
    const int view = passes.first.y + int(lane);
    const Line line = line_of_view(f, rows, row_extent(), view, bit_of_row(view));
    window_rows[lane] = line;
    atomicMax(most_rows, uint(line.last - line.first) + 1u);
  }
}

/// Windows of a pass, some of which may not be used.
uint windows_of_pass(Passes passes, uint pass) {
  const uint rows = uint(passes.views.y) - (pass << passes.rows_log2);
  return passes.far ? kWindows : min(rows, 1u << passes.rows_log2) << passes.cols_log2;
}

/// The lines, column and row, of window `number` of pass `pass`; whether there is such a window.
bool lines_of_window(Passes passes, uint pass, uint number, out uvec2 lines) {
  lines = passes.far ? uvec2(number)
                     : uvec2(low_bits(number, passes.cols_log2),
                             (pass << passes.rows_log2) + (number >> passes.cols_log2));
  return passes.far || (int(lines.x) < passes.views.x && int(lines.y) < passes.views.y);
}

/// The views of a pixel along each axis in a pass: [first, end).
struct PixelRange {
  ivec2 first, end;  // column, row
};

PixelRange range_of_pass(Filter f, Passes passes, uint pass) {
  if (!passes.far) return PixelRange(ivec2(0), ivec2(1 << f.views_log2));
  return PixelRange(view_of_pass(f, pass), view_of_pass(f, pass) + 1);
}

/// A column or row of views as a pixel needs it.
struct PixelLine {
  uint line;
  uint window;  // its part of the number of a window: those of column and row add up to it
  int weight;   // 0: not at all
  int tap;
};

/// Number i of those of a pixel along an axis; beyond `end` it is not needed. `group_first` is the
/// view of line 0; the ray is at `at` in view 0 and goes on by `step` a view.
PixelLine pixel_line(Filter f, Axis axis, bool far, int place, int at, int step, int group_first,
                     int i, int end) {
  const int number = first_view(f, place) + i;
  const int view = clamp(number, 0, axis.last_view);
  return PixelLine(far ? gl_LocalInvocationIndex : uint(view - group_first), 0u,
                   i < end ? view_weight(f, place, number) : 0, tap_place(f, axis, at + step * view));
}

PixelLine pixel_col(Filter f, Axis axis, Passes passes, Ray ray, PixelRange range, int i) {
  PixelLine col = pixel_line(f, axis, passes.far, view_place(f, axis, ray.u), ray.x, ray.dx,
                             passes.first.x, i, range.end.x);
  if (!passes.far) col.window = col.line;
  return col;
}

/// Not needed either where the windows of the row are not in pass `pass`.
PixelLine pixel_row(Filter f, Axis axis, Passes passes, Ray ray, uint pass, PixelRange range, int i) {
  PixelLine row = pixel_line(f, axis, passes.far, view_place(f, axis, ray.v), ray.y, ray.dy,
                             passes.first.y, i, range.end.y);
  row.window = row.line;
  if (!passes.far) {
    if (row.line >> passes.rows_log2 != pass) row.weight = 0;
    row.window = low_bits(row.line, passes.rows_log2) << passes.cols_log2;
  }
  return row;
}
