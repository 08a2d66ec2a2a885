// One pixel's ray in integers (docs/rendering.md, section 3).

struct Ray {
  bool inside;
  int u, v;    // Us and Vs of SRF-2: units of 2^-16 steps
  int x, y;    // in view (r, c) it is at (x + dx * c, y + dy * r): units of 2^-12 pixels (RAY-4)
  int dx, dy;
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

/// The ray of direction a, b of RAY-1.
Ray trace(FrameRecord f, int a, int b) {
  Ray ray = Ray(false, 0, 0, 0, 0, f.dx, f.dy);
  const ivec3 n = ivec3(direction(f, 0, a, b), direction(f, 1, a, b), direction(f, 2, a, b));
  if (n.z < (1 << 26) || (abs(n.x) >> 2) >= n.z || (abs(n.y) >> 2) >= n.z) return ray;
  const int w = reciprocal(n.z);
  const int sx = multiply_shift(n.x, w, 29);
  const int sy = multiply_shift(n.y, w, 29);
  const int u = f.u0 - multiply_shift(f.zu, sx, 28);
  const int v = f.v0 - multiply_shift(f.zv, sy, 28);
  if (!is_among_views(u, f.cols) || !is_among_views(v, f.rows)) return ray;
  ray.u = clamp(u, -kHalfStep, ((f.cols - 1) << 16) + kHalfStep);
  ray.v = clamp(v, -kHalfStep, ((f.rows - 1) << 16) + kHalfStep);
  ray.x = f.x0 + multiply_shift(f.gain, sx, 28) - f.dx * f.c0;
  ray.y = f.y0 + multiply_shift(f.gain, sy, 28) - f.dy * f.r0;
  const int col = min((ray.u + kHalfStep) >> 16, f.cols - 1);
  const int row = min((ray.v + kHalfStep) >> 16, f.rows - 1);
  ray.inside = is_in_picture(ray.x + f.dx * col, f.width) &&
               is_in_picture(ray.y + f.dy * row, f.height);
  return ray;
}

/// G of SRF-2.
int displacement_a_row(FrameRecord f, int e) { return (e * f.pitch + (1 << 7)) >> 8; }

/// What has displacement `e` on the ray (SRF-2, SRF-4). A view number times 2^12 is a whole number of 2^-8, so
/// that the shift rounds what is left alone.
Ray displaced(FrameRecord f, Ray ray, int e) {
  const int g = displacement_a_row(f, e);
  ray.x += multiply_shift(-e, ray.u >> 4, 8);
  ray.y += multiply_shift(-g, ray.v >> 4, 8);
  ray.dx += 16 * e;
  ray.dy += 16 * g;
  return ray;
}
