#include "syntax/stream_view.hpp"

namespace hmlfc {

bool StreamView::fetch(ByteRange range) const {
  if (reads != nullptr) reads->on_read(range.offset, range.bytes);
  return source == nullptr || is_loaded(*source, range);
}

}  // namespace hmlfc
