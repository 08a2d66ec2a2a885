// The frame of a rendering kernel, behind the arguments of the decoding kernels.

Frame frame() { return Frame(arguments.frame); }

/// The requests of this dispatch: the host says how many, or with kCounted compact.comp did.
layout(constant_id = 3) const bool kCounted = false;

uint request_count() {
  return kCounted ? frame().counters.word[kCountNeeded] : arguments.request_count;
}
