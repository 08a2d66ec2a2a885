// Marks what the shared library exports. It is built with hidden visibility: a symbol without this
// mark is not part of the API.
#pragma once

#if defined(__GNUC__) || defined(__clang__)
/// In front of each function of the API and in the head of each of its classes.
#define HMLFC_EXPORT __attribute__((visibility("default")))
#else
#define HMLFC_EXPORT
#endif
