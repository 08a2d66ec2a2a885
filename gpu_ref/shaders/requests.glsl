// Requests and the chain of images that each goes through (DEC-1).

/// The walk of a reference image's own blocks: one entry a request, of its own level (DEC-4).
layout(constant_id = 1) const bool kReferencePass = false;

uint plane_of(Request request) { return request.site & 0xFFu; }
uint level_of(Request request) { return (request.site >> 8) & 0xFFu; }
bool is_valid(Request request) { return (request.site >> 16) != 0u; }
uvec2 block_of(Request request) { return uvec2(request.block & 0xFFFFu, request.block >> 16); }
uvec2 image_of(Request request) { return uvec2(request.image & 0xFFFFu, request.image >> 16); }

/// Entries of a request in the buffer of entries.
uint entries_of_request() { return kReferencePass ? 1u : arguments.shape.top + 1u; }

/// The ancestor `steps` levels above image `at` (row, column).
uvec2 ancestor(uvec2 at, uint steps) {
  for (uint k = 0u; k < steps; ++k) {
    at.x = divided(at.x, arguments.shape.cluster_rows, arguments.shape.cluster_row_inverse);
    at.y = divided(at.y, arguments.shape.cluster_cols, arguments.shape.cluster_col_inverse);
  }
  return at;
}
