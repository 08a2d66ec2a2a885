// The rays of pixels, and the cells that they are in (SRF-1).

/// A cell has 2^kCellLog2 pixels each way.
const int kCellLog2 = 2;

/// Cells that hold `pixels` pixels.
int cells_along(int pixels) { return (pixels + (1 << kCellLog2) - 1) >> kCellLog2; }

/// The ray of pixel `at`; not inside where the frame has no such pixel.
Ray ray_of_pixel(ivec2 at) {
  const FrameRecord f = frame().record;
  Ray ray = trace(f, 2 * at.x + 1 - f.frame_width, 2 * at.y + 1 - f.frame_height);
  if (at.x >= f.frame_width || at.y >= f.frame_height) ray.inside = false;
  return ray;
}

/// The ray of cell `cell`, through its middle, or the last pixel where that is beyond it.
Ray ray_of_cell(ivec2 cell) {
  const FrameRecord f = frame().record;
  return trace(f, min(8 * cell.x + 4 - f.frame_width, f.frame_width - 1),
               min(8 * cell.y + 4 - f.frame_height, f.frame_height - 1));
}

/// E of the cell of pixel `at` of the frame; 0 without geometry.
int displacement_at(ivec2 at) {
  if (!kGeometry) return 0;
  const ivec2 cell = at >> kCellLog2;
  return int(frame().displacements.word[cell.y * cells_along(frame().record.frame_width) + cell.x]);
}
