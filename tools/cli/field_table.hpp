// The fields of one walk as a table for people.
#pragma once

#include <string>
#include <vector>

#include "cli/block_trace.hpp"

namespace hmlfc::cli {

/// One line of the table: a field, or several of one name in a row.
struct FieldRow {
  std::string section;
  std::string address;  ///< "0x0001f4.3": byte in hexadecimal, bit
  std::string bits;
  std::string name;
  std::string value;
  std::string clause;
};

/// The rows of `walk`: masks in hexadecimal, codes with their meaning, the values of a residual
/// block as one row.
std::vector<FieldRow> field_rows(const TracedWalk& walk);

/// `rows` under a heading, each line after `indent` spaces; long values are broken.
std::string field_table(const std::vector<FieldRow>& rows, size_t indent);

}  // namespace hmlfc::cli
