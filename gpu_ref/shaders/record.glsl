// A tile record: where it lies in the stream, and bits of it (TIL-1).

/// A bit string of `bits` bits that begins with bit `bit` of stream word `word`. Bits beyond what any
/// record needs are not counted: bits <= 2^23.
struct Record {
  uint status;  // an error of annex A, or ok
  bool empty;   // there is none: an empty tile (IDX-7), or an error
  uint word;
  uint bit;
  uint bits;
};

Record no_record(uint status) { return Record(status, true, 0u, 0u, 0u); }

/// Whether the record has `count` bits from `position` on.
bool holds(Record record, uint position, uint count) {
  return position <= record.bits && count <= record.bits - position;
}

/// Bits [position, position + count) of the record, which holds them; count in [0, 32].
uint record_bits(Record record, uint position, uint count) {
  const uint at = record.bit + position;
  return stream_bits(record.word + (at >> 5), at & 31u, count);
}

/// Value i of the sequence of `count` values at bit `position` of the record, which holds it.
uint record_value(Record record, uint position, Levels levels, uint count, uint i) {
  const uint at = record.bit + position;
  return bise_value(record.word + (at >> 5), at & 31u, levels, count, i);
}
