// Floating point decides what the encoder writes and rounds what a frame is asked for. The files
// that compute so include this, because a compiler that may reorder it would change the bytes.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "hmlfc: -ffast-math and -Ofast change streams and frames: build this project without them"
#endif
