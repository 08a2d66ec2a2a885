// Traces of one block as text.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "oracle/golden_stream.hpp"
#include "oracle/level_record.hpp"

namespace hmlfc::tb {

/// A text file that is closed at the end.
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TextFile = std::unique_ptr<std::FILE, CloseFile>;

/// Writes every field and stage that the golden model reports for `request`, reading reference
/// blocks on demand, plane by plane.
void write_model_trace(std::FILE* out, const GoldenStream& stream, const Request& request);

/// Writes one trace record of a unit with blocks of `block_size`.
void write_record(std::FILE* out, const LevelRecord& record, unsigned block_size);

/// Writes one answer.
void write_answer(std::FILE* out, const Answer& answer, unsigned block_size);

}  // namespace hmlfc::tb
