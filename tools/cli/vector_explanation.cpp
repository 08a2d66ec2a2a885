#include "cli/vector_explanation.hpp"

#include <exception>
#include <new>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "vectors/recipe.hpp"

namespace hmlfc::cli {
namespace {

// What a renderer is asked for.
std::string request_text(const vectors::FrameCase& frame) {
  if (frame.map) {
    return fmt::format("  map      of view {},{}\n", frame.map->view.row, frame.map->view.col);
  }
  std::string text = fmt::format("  camera   {}\n", vectors::camera_words(*frame.camera));
  if (!frame.record) return text;
  return text + fmt::format("  record   {}\n  frame    {} x {}, stop level {}, SHA-256 {}\n",
                            fmt::join(*frame.record, " "), frame.frame->width, frame.frame->height,
                            frame.stop_level, frame.frame->sha256);
}

// How a vector is made.
std::string recipe_text(const std::filesystem::path& suite, const vectors::Vector& vector) {
  const auto folder = suite / "recipes";
  if (vector.frame) return vectors::read_frame_recipes(folder).at(vector.id.text()).dump();
  return vectors::read_recipes(folder).at(vector.id.text()).stream.dump();
}

}  // namespace

std::string expectation_text(const vectors::Expectation& expect) {
  if (expect.outcome == vectors::Outcome::kOk) return "ok";
  if (!expect.input.empty()) return "reject " + expect.input;
  return fmt::format("{} {}", vectors::outcome_name(expect.outcome), error_name(expect.error));
}

std::string explanation(const std::filesystem::path& suite, const vectors::Vector& vector) {
  const vectors::Expectation& expect = vector.expect;
  std::string text = fmt::format(
      "{}\n  {}\n  clauses  {}\n  flags    {}\n  stream   {}, {} bytes, profile {}, level {}\n",
      vector.id.text(), vector.comment, fmt::join(vector.clauses, ", "),
      fmt::join(vector.flags, ", "), vector.input.file.text(), vector.input.bytes,
      profile_name(vector.profile), vector.level);
  text += fmt::format("  growth   milestone {}{}\n", vector.milestone,
                      vector.base ? ", counts only if " + vector.base->text() + " passes" : "");
  if (vector.frame) text += request_text(*vector.frame);
  text += "  expected " + expectation_text(expect);
  if (expect.outcome != vectors::Outcome::kOk && expect.input.empty()) {
    text +=
        fmt::format(" at byte {}, when {}", expect.offset,
                    expect.operation == vectors::Operation::kOpen ? "the stream is opened"
                                                                  : "these blocks are decoded:");
  }
  text += "\n";
  for (const BlockAddress& block : expect.blocks) {
    text += fmt::format("           view {},{} plane {} block {},{}\n", block.view.row,
                        block.view.col, plane_name(block.plane), block.bx, block.by);
  }
  if (vector.output) {
    text += fmt::format("  output   {} x {} views of {} x {}, depth {}, SHA-256 {}\n",
                        vector.output->rows, vector.output->cols, vector.output->width,
                        vector.output->height, vector.output->depth, vector.output->sha256);
  }
  if (vector.trace) {
    text += fmt::format("  trace    {}, {}\n", vector.trace->lines.file.text(),
                        vector.trace->hex.file.text());
  }
  try {
    text += "  recipe   " + recipe_text(suite, vector) + "\n";
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Failure(ExitCode::kInput, error.what());
  }
  return text;
}

}  // namespace hmlfc::cli
