// Where the files of a report lie. Names that come from other files make no path elsewhere.
#pragma once

#include <filesystem>
#include <string>

#include "conform/result.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The folder of decoder `dut` in a report: letters, digits, - and _ of its name, at most 64.
std::string folder_name(const std::string& dut);

/// The folder of the pictures of a failure, relative to the report.
std::filesystem::path pictures_of(const std::string& dut, const vectors::VectorId& id);

/// Whether the pictures of `result`, from wherever it was read, are none or pictures_of() it.
bool has_own_pictures(const VectorResult& result, const std::string& dut);

/// `folder` / `name`, where no part of `name`, which is relative and has no "..", is a symbolic
/// link. Error: one is.
io::IoResult<std::filesystem::path> path_inside(const std::filesystem::path& folder,
                                                const std::filesystem::path& name);

/// Copies the pictures of a failure from one report to another. Errors: they cannot be read or
/// written, or a symbolic link stands in their place.
io::IoResult<void> copy_pictures(const std::filesystem::path& from, const std::filesystem::path& to,
                                 const std::filesystem::path& pictures);

/// Removes the pictures of an earlier failure in `folder`, and nothing else there.
void remove_pictures(const std::filesystem::path& folder);

}  // namespace hmlfc::conform
