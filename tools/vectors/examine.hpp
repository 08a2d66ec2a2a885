// Streams and suites examined: an annotated dump, and checks of the suite's files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "vectors/manifest.hpp"

namespace hmlfc::vectors {

/// One line for each field of `file`, in the order of addresses: byte and bit, the bytes that hold
/// it, name, value and clause. Bytes outside of fields (codestreams, block values) are marked.
/// A damaged stream is shown as far as it can be read, with the error.
std::string annotated_dump(std::span<const uint8_t> file);

/// The defects of the suite in `folder`, whose manifest is `manifest`, one line each: files that
/// are missing, whose sum differs, or that no vector names; ids that are not sorted, unique and
/// named after their group; clauses and flags listed twice; profile, conformance level or output
/// shape that the stream's header contradicts; a stream that should open, but whose header,
/// sections, index or key image table break a rule; traces without count and end marker; blocks
/// files of another shape.
std::vector<std::string> lint_suite(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace hmlfc::vectors
