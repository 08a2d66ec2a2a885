#include "conform/block_commands.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "conform/command_decoder.hpp"

namespace hmlfc::conform {

namespace {

std::string stream_of(const Suite& suite, const vectors::Vector& vector) {
  return (suite.folder / vector.input.file).string();
}

// " --view 0,1 --plane Co --block 3,2", or nothing where no block is known to be wrong.
std::string block_options(const vectors::Vector& vector, const VectorResult& result) {
  if (!result.difference) return "";
  const Difference& d = *result.difference;
  const Plane plane = d.planes.empty() || !vector.output ? Plane::kY : d.planes.front();
  const auto block = d.block(plane, vector.output ? vector.output->chroma : ChromaFormat::k444);
  return fmt::format(" --view {},{} --plane {} --block {},{}", block.view.row, block.view.col,
                     plane_name(plane), block.bx, block.by);
}

std::string list_command(const char* kind, const Suite& suite, const vectors::Vector& vector) {
  return fmt::format("hmlfc vectors {} {} --suite {}", kind, vector.id.text(),
                     shell_word(suite.folder.string()));
}

// The command that shows how the wrong pixel of a frame comes about.
std::string frame_command(const Suite& suite, const vectors::Vector& vector,
                          const VectorResult& result) {
  if (!result.difference) return list_command("explain", suite, vector);
  const std::string stream = stream_of(suite, vector);
  const auto levels = static_cast<int64_t>(geometry_of(stream).tree_height) + 1;
  return fmt::format("hmlfc render {} --inputs {} --levels {} --trace {},{}", shell_word(stream),
                     vectors::camera_words(*vector.frame->camera),
                     levels - vector.frame->stop_level, result.difference->x, result.difference->y);
}

}  // namespace

std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    const std::string_view others = "/._-+=:@%,";
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           others.find(c) != others.npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string inspect_command(const Suite& suite, const vectors::Vector& vector,
                            const VectorResult& result) {
  if (vector.frame) return frame_command(suite, vector, result);
  const std::string block = block_options(vector, result);
  if (!block.empty())
    return fmt::format("hmlfc inspect {}{}", shell_word(stream_of(suite, vector)), block);
  return list_command("inspect", suite, vector);
}

std::string view_command(const Suite& suite, const vectors::Vector& vector, const Dut& dut,
                         const VectorResult& result) {
  if (vector.frame) return {};
  return fmt::format("hmlfc view {} --dut {}{}", shell_word(stream_of(suite, vector)),
                     shell_word(dut.text), block_options(vector, result));
}

}  // namespace hmlfc::conform
