// One pixel's ray in integers (docs/rendering.md, section 3).

struct Ray {
  bool inside;
  int u, v;    // units of 2^-16 steps (RAY-3)
  int x, y;    // x(0) and y(0) of RAY-4: units of 2^-12 pixels
};

const int kHalfStep = 1 << 15;
const int kHalfPixel = 1 << 11;

/// floor((x * y) / 2^k), the product in 64 bits, the result in 32; k in [1, 31].
int multiply_shift(int x, int y, int k) {
  int high, low;
  imulExtended(x, y, high, low);
  return (high << (32 - k)) | int(uint(low) >> k);
}

/// floor((2^57 - 1) / nz) of RAY-2; nz in [2^26, 2^30]. A quotient of the upper bits, too small by at
/// most 2^-12 of it, then twice what the rest holds of nz by the same quotient. Every rest is at least
/// 0: all roundings are down. What is left is less than 2 nz.
int reciprocal(int nz) {
  const uint divisor = uint(nz);
  const uint coarse = 0xFFFFFFFFu / ((divisor >> 11) + 1u);  // of 2^43, in [2^12, 2^17]
  uint quotient = coarse << 14;
  uint high, low;
  umulExtended(divisor, quotient, high, low);
  uvec2 rest = uvec2(~low, 0x1FFFFFFu - high);  // below 2^45
  const uint more = (((rest.y << 2) | (rest.x >> 30)) * coarse) >> 13;
  umulExtended(divisor, more, high, low);
  rest = u64_sub(rest, uvec2(low, high));  // below 2^38
  const uint last = (((rest.y << 12) | (rest.x >> 20)) * coarse) >> 23;
  quotient += more + last;
  return int(quotient + (rest.x - last * divisor >= divisor ? 1u : 0u));
}

/// Whether a place among `views` views lies inside (RAY-3).
bool is_among_views(int place, int views) {
  return views <= 1 || (place >= -kHalfStep && place <= ((views - 1) << 16) + kHalfStep);
}

/// RAY-5 in one coordinate.
bool is_in_picture(int x, int size) {
  return x >= -kHalfPixel && x <= (size << 12) - kHalfPixel - 1;
}

/// One component of the direction of RAY-1.
int direction(FrameRecord f, int axis, int a, int b) {
  return f.n0_hi[axis] + a * f.na_hi[axis] + b * f.nb_hi[axis] +
         ((f.n0_lo[axis] + a * f.na_lo[axis] + b * f.nb_lo[axis]) >> 12);
}

/// The ray of pixel (i, j); not inside where the frame has no such pixel.
Ray trace(FrameRecord f, int i, int j) {
  Ray ray = Ray(false, 0, 0, 0, 0);
  if (i >= f.frame_width || j >= f.frame_height) return ray;
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
  ray.x = f.x0 + multiply_shift(f.gain, sx, 28) - f.dx * f.c0;
  ray.y = f.y0 + multiply_shift(f.gain, sy, 28) - f.dy * f.r0;
  ray.inside = is_in_picture(ray.x + f.dx * ((ray.u + kHalfStep) >> 16), f.width) &&
               is_in_picture(ray.y + f.dy * ((ray.v + kHalfStep) >> 16), f.height);
  return ray;
}
