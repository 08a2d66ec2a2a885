// The stages of one block as text.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "oracle/oracle.hpp"

namespace hmlfc::tb {

/// A text file that is closed at the end.
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TextFile = std::unique_ptr<std::FILE, CloseFile>;

/// Writes the records of all levels up to the first with an error, plane by plane, and the answer.
void write_expected(std::FILE* out, const ExpectedAnswer& expected, unsigned block_size);

/// Writes one trace record of a unit with blocks of `block_size`.
void write_record(std::FILE* out, const LevelRecord& record, unsigned block_size);

/// Writes one answer.
void write_answer(std::FILE* out, const Answer& answer, unsigned block_size);

}  // namespace hmlfc::tb
