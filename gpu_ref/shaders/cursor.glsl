// Fields of a tile record one after the other (TIL-1). Nothing past its end is ever read.

struct Cursor {
  Record record;
  uint position;  // bits from the record's first
  bool overrun;   // a field was wanted that reaches past the end
};

Cursor cursor_of(Record record) { return Cursor(record, 0u, false); }

/// The next `count` bits, count in [0, 32]; 0 where they are not there.
uint take(inout Cursor cursor, uint count) {
  const bool there = holds(cursor.record, cursor.position, count);
  const uint value = there ? record_bits(cursor.record, cursor.position, count) : 0u;
  cursor.overrun = cursor.overrun || !there;
  cursor.position += count;
  return value;
}

/// Moves over `count` bits, count < 2^20.
void skip(inout Cursor cursor, uint count) {
  cursor.overrun = cursor.overrun || !holds(cursor.record, cursor.position, count);
  cursor.position += count;
}

/// The next 32 bits, which stay; those past the end are 0.
uint peek(Cursor cursor) {
  const uint left = cursor.record.bits - min(cursor.position, cursor.record.bits);
  return record_bits(cursor.record, cursor.position, min(left, 32u));
}
