// The error type of the library hmlfc_io: a sentence for people.
#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <tl/expected.hpp>

namespace hmlfc::io {

/// Why an operation on a file failed: "FILE: what is wrong; what to do".
struct IoError {
  std::string message;
  bool out_of_memory = false;  ///< nothing is wrong with the file
  int error_number = 0;        ///< of the system, a value of errno; 0: it has nothing to say
};

template <class T>
using IoResult = tl::expected<T, IoError>;

/// The failure "FILE: what", ready to be returned as any IoResult.
inline tl::unexpected<IoError> file_error(const std::filesystem::path& file,
                                          std::string_view what) {
  return tl::unexpected(IoError{file.string() + ": " + std::string(what)});
}

/// The failure "FILE: not enough memory to do `what`".
inline tl::unexpected<IoError> memory_error(const std::filesystem::path& file,
                                            std::string_view what) {
  return tl::unexpected(IoError{file.string() + ": not enough memory " + std::string(what), true});
}

/// The failure "FILE: what: the system's reason"; `error_number` is a value of errno.
inline tl::unexpected<IoError> system_error(const std::filesystem::path& file,
                                            std::string_view what, int error_number) {
  return tl::unexpected(IoError{file.string() + ": " + std::string(what) + ": " +
                                    std::generic_category().message(error_number),
                                error_number == ENOMEM, error_number});
}

}  // namespace hmlfc::io
