// What the stream says about one block of one image, and how walk.comp hands it to the kernels
// that make samples.

const uint kKindNone = 0u;   // above the first level that is decoded (DEC-1, EXT-5)
const uint kKindKey = 1u;    // a block of a key image (DEC-2)
const uint kKindCoded = 2u;  // any other block (DEC-3)

/// A displaced reference image: the place of its plane in the reference area, whole samples ix and
/// iy, and fx and fy eighths in [0, 7] (MOT-9).
struct Reference {
  uint base;
  int ix, iy, fx, fy;
};

/// The same in two words.
struct PackedReference {
  uint base, vector;
};

struct BlockEntry {
  uint status;     // an error of annex A, or ok
  uint kind;
  uint count;      // references in use: 0 without motion, 1 or 2
  bool negative;   // sign -
  bool residual;   // the block has values
  uint level_code;
  uint step_code;
  int bias;
  uint values_word, values_bit;  // where the block's values begin in the stream
  PackedReference references[2];  // of a key image, its plane is that of the first
};

const uint ENTRY_WORDS = 8u;

BlockEntry empty_entry(uint kind) {
  const PackedReference none = PackedReference(0u, 0u);
  return BlockEntry(ERROR_OK, kind, 0u, false, false, 0u, 0u, 0, 0u, 0u,
                    PackedReference[2](none, none));
}

uint vector_word(ivec2 whole, ivec2 eighths) {
  return (uint(whole.x) & 0x3FFu) | (uint(whole.y) & 0x3FFu) << 10 | uint(eighths.x) << 20 |
         uint(eighths.y) << 24;
}

Reference unpacked_reference(PackedReference packed_reference) {
  const uint vector = packed_reference.vector;
  return Reference(packed_reference.base, bitfieldExtract(int(vector), 0, 10),
                   bitfieldExtract(int(vector), 10, 10), int((vector >> 20) & 7u),
                   int(vector >> 24));
}

void write_entry(uint number, BlockEntry entry) {
  arguments.entries.half_entry[2u * number] =
      uvec4(entry.status | entry.kind << 8 | entry.count << 10 | uint(entry.negative) << 12 |
                uint(entry.residual) << 13 | entry.level_code << 16 | entry.step_code << 24,
            entry.values_word, entry.values_bit | (uint(entry.bias) & 0xFFFFu) << 16,
            entry.references[0].base);
  arguments.entries.half_entry[2u * number + 1u] =
      uvec4(entry.references[0].vector, entry.references[1].base, entry.references[1].vector, 0u);
}

/// An entry as write_entry leaves it. What it says is unpacked where it is used: so it takes few
/// registers until then.
struct KeptEntry {
  uvec4 first, second;
};

KeptEntry read_entry(uint number) {
  return KeptEntry(arguments.entries.half_entry[2u * number],
                   arguments.entries.half_entry[2u * number + 1u]);
}

uint status_of(KeptEntry entry) { return entry.first.x & 0xFFu; }
uint kind_of(KeptEntry entry) { return (entry.first.x >> 8) & 3u; }
uint reference_count(KeptEntry entry) { return (entry.first.x >> 10) & 3u; }
bool is_negative(KeptEntry entry) { return (entry.first.x & (1u << 12)) != 0u; }
bool has_residual(KeptEntry entry) { return (entry.first.x & (1u << 13)) != 0u; }
uint level_code_of(KeptEntry entry) { return (entry.first.x >> 16) & 0xFFu; }
uint step_code_of(KeptEntry entry) { return entry.first.x >> 24; }
int bias_of(KeptEntry entry) { return int(entry.first.z) >> 16; }
uint values_word_of(KeptEntry entry) { return entry.first.y; }
uint values_bit_of(KeptEntry entry) { return entry.first.z & 31u; }
uint base_of(KeptEntry entry) { return entry.first.w; }

PackedReference first_reference(KeptEntry entry) {
  return PackedReference(entry.first.w, entry.second.x);
}
PackedReference second_reference(KeptEntry entry) {
  return PackedReference(entry.second.y, entry.second.z);
}
