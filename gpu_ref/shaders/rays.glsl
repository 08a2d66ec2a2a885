// One pixel's ray in integers (docs/rendering.md, section 3).

struct Ray {
  bool inside;
  int u, v;    // units of 2^-16 steps (RAY-3)
  int xb, yb;  // units of 2^-12 pixels (RAY-4)
};

const int kHalfStep = 1 << 15;
const int kHalfPixel = 1 << 11;

/// floor((x * y) / 2^k), the product in 64 bits, the result in 32; k in [1, 31].
int multiply_shift(int x, int y, int k) {
  int high, low;
  imulExtended(x, y, high, low);
  return (high << (32 - k)) | int(uint(low) >> k);
}

/// One component of the direction of RAY-1.
int direction(FrameRecord f, int axis, int a, int b) {
  return f.n0_hi[axis] + a * f.na_hi[axis] + b * f.nb_hi[axis] +
         ((f.n0_lo[axis] + a * f.na_lo[axis] + b * f.nb_lo[axis]) >> 12);
}

/// floor((2^57 - 1) / nz) of RAY-2, bit by bit; nz in [2^26, 2^30].
int reciprocal(int nz) {
  const uint divisor = uint(nz);
  uint rest = (1u << 25) - 1u;  // the upper bits of 2^57 - 1, less than any divisor
  uint quotient = 0u;
  for (uint i = 0u; i < 32u; ++i) {
    rest = (rest << 1) | 1u;
    quotient <<= 1;
    if (rest >= divisor) {
      rest -= divisor;
      quotient |= 1u;
    }
  }
  return int(quotient);
}

/// Whether a place among `views` views lies inside (RAY-3).
bool is_among_views(int place, int views) {
  return views <= 1 || (place >= -kHalfStep && place <= ((views - 1) << 16) + kHalfStep);
}

/// RAY-5 in one coordinate.
bool is_in_picture(int x, int size) {
  return x >= -kHalfPixel && x <= (size << 12) - kHalfPixel - 1;
}

/// x(c) and y(r) of RAY-4.
int x_in_view(FrameRecord f, int xb, int col) { return xb + f.dx * (col - f.c0); }
int y_in_view(FrameRecord f, int yb, int row) { return yb + f.dy * (row - f.r0); }

/// The ray of pixel (i, j).
Ray trace(FrameRecord f, int i, int j) {
  Ray ray = Ray(false, 0, 0, 0, 0);
  const int a = 2 * i + 1 - f.frame_width;
  const int b = 2 * j + 1 - f.frame_height;
  const ivec3 n = ivec3(direction(f, 0, a, b), direction(f, 1, a, b), direction(f, 2, a, b));
  if (n.z < (1 << 26) || (abs(n.x) >> 2) >= n.z || (abs(n.y) >> 2) >= n.z) return ray;
  const int r = reciprocal(n.z);
  const int sx = multiply_shift(n.x, r, 29);
  const int sy = multiply_shift(n.y, r, 29);
  const int u = f.u0 - multiply_shift(f.zu, sx, 28);
  const int v = f.v0 - multiply_shift(f.zv, sy, 28);
  if (!is_among_views(u, f.cols) || !is_among_views(v, f.rows)) return ray;
  ray.u = clamp(u, 0, (f.cols - 1) << 16);
  ray.v = clamp(v, 0, (f.rows - 1) << 16);
  ray.xb = f.x0 + multiply_shift(f.gain, sx, 28);
  ray.yb = f.y0 + multiply_shift(f.gain, sy, 28);
  ray.inside = is_in_picture(x_in_view(f, ray.xb, (ray.u + kHalfStep) >> 16), f.width) &&
               is_in_picture(y_in_view(f, ray.yb, (ray.v + kHalfStep) >> 16), f.height);
  return ray;
}
