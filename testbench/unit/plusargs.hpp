// Plusargs for every Verilated unit, from the environment.
#pragma once

#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <verilated.h>

namespace hmlfc::tb {

/// Gives the units of `context` the words of the environment variable HMLFC_RTL_PLUSARGS, such as
/// those of testbench/checker/hmlfc_checker_bind.sv.
inline void take_plusargs(VerilatedContext& context) {
  const char* text = std::getenv("HMLFC_RTL_PLUSARGS");
  std::istringstream stream(text == nullptr ? "" : text);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  std::vector<const char*> arguments{"unit"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  context.commandArgs(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace hmlfc::tb
