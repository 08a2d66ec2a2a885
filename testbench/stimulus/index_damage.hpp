// Damage to the fields of a stream's index and of its records, one kind at a time.
#pragma once

#include <cstdint>
#include <span>

#include "stimulus/conditions.hpp"
#include "syntax/header.hpp"

namespace hmlfc::tb {

/// Root entries, one in two and at least one, get a `first` beyond the GROUP section
/// (bad_root_entry).
void corrupt_root_entries(std::span<uint8_t> stream, const StreamHeader& header, Random& random);

/// Group records, one in two and at least one, get offset_bits or upper bits that they must not
/// have (bad_group_record), or lose their end table beyond the section.
void corrupt_group_records(std::span<uint8_t> stream, const StreamHeader& header, Random& random);

/// End tables of intact groups: entries, one in four and at least one of each table, leave their
/// record 0 to 3 bytes, so that it ends within its fixed fields, or before it begins.
void corrupt_end_tables(std::span<uint8_t> stream, const StreamHeader& header, Random& random);

/// The first bytes of tile records of intact groups, where the modes, masks, bounds and codes are:
/// one record in two gets one to three wrong bits there.
void corrupt_record_heads(std::span<uint8_t> stream, const StreamHeader& header, Random& random);

}  // namespace hmlfc::tb
