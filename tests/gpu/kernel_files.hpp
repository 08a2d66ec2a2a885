// Kernels from files, in place of the library's own.
#pragma once

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include <hmlfc/gpu/device.hpp>

#include "io/files.hpp"

namespace hmlfc::gpu {

/// Of arguments NAME=FILE.spv. Throws std::runtime_error where a file cannot be read.
inline KernelCode read_kernels(std::span<const std::string> arguments) {
  KernelCode kernels;
  for (const std::string& argument : arguments) {
    const size_t equals = argument.find('=');
    const auto file = io::map_file(argument.substr(equals + 1));
    if (!file) throw std::runtime_error(file.error().message);
    auto& words = kernels[argument.substr(0, equals)];
    words.resize(file->bytes().size() / 4);
    std::memcpy(words.data(), file->bytes().data(), 4 * words.size());
  }
  return kernels;
}

}  // namespace hmlfc::gpu
