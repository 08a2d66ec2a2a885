#include "vectors/frame_vector.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include <fmt/format.h>

#include <hmlfc/disparity.hpp>
#include <hmlfc/frame_trace.hpp>
#include <hmlfc/renderer.hpp>

#include "vectors/digest.hpp"
#include "vectors/milestone.hpp"

namespace hmlfc::vectors {
namespace {

template <class T>
T value_or_throw(Result<T> result) {
  if (!result) throw TextError(to_string(result.error()));
  return std::move(*result);
}

Expectation refusal(const Error& error, const BlockAddress& block) {
  return {Outcome::kReject, error.code, error.offset, Operation::kBlock, {block}, {}};
}

// The first block of a frame that does not decode (NED-2).
BlockAddress failing_block(const Decoder& decoder, const FrameNeeds& needs, int stop_level) {
  const auto fails = [&](const BlockAddress& block) {
    return !decoder.decode_block(block, {.stop_level = stop_level});
  };
  const auto found = std::ranges::find_if(needs.blocks, fails);
  if (found == needs.blocks.end()) throw TextError("no block of the frame fails");
  return *found;
}

Expectation expect_picture(const Decoder& decoder, const FrameRecord& record, FrameCase& frame) {
  const auto needs = value_or_throw(frame_needs(decoder, record, frame.stop_level));
  FrameSum& sum = frame.frame.emplace();
  sum.width = static_cast<uint32_t>(record.frame_width);
  sum.height = static_cast<uint32_t>(record.frame_height);
  sum.depth = decoder.header().depth;
  sum.pixels_outside = needs.pixels_outside;
  sum.blocks_needed = needs.blocks.size();
  sum.disparities_looked_up = needs.disparities_looked_up;
  Frame golden;
  Frame fast;
  const auto drawn = make_golden_renderer(decoder)->render(record, frame.stop_level, golden);
  const auto again = make_cpu_renderer(decoder)->render(record, frame.stop_level, fast);
  const bool same = drawn ? again && golden.image.samples == fast.image.samples
                          : !again && drawn.error().code == again.error().code;
  if (!same) throw TextError("the golden and the fast renderer differ");
  if (!drawn) return refusal(drawn.error(), failing_block(decoder, needs, frame.stop_level));
  sum.sha256 = sha256(picture_bytes(golden.image));
  return {};
}

Expectation expect_map(const Decoder& decoder, MapSum& sum) {
  const StreamHeader& header = decoder.header();
  const uint32_t side = header.block_size();
  sum.columns = (header.width + side - 1) / side;
  sum.rows = (header.height + side - 1) / side;
  std::vector<BlockDisparity> blocks;
  for (uint32_t i = 0; i < sum.columns * sum.rows; ++i) {
    const BlockAddress block{sum.view, Plane::kY, i % sum.columns, i / sum.columns};
    const auto told = block_disparity(decoder, sum.view, block.bx, block.by);
    if (!told) return refusal(told.error(), block);
    blocks.push_back(*told);
  }
  sum.sha256 = sha256(map_bytes(blocks));
  return {};
}

// Throws unless a recipe expects this of `key`.
void require(const Json& recipe, const char* key, std::string_view found) {
  const auto expect = recipe.value("expect", Json::object()).value(key, std::string());
  if (expect == found) return;
  throw TextError(
      fmt::format("the recipe expects {} \"{}\", the golden model \"{}\"", key, expect, found));
}

Vector made_vector(const std::string& id, const Json& recipe, const std::vector<Vector>& vectors,
                   const SuiteFiles& files) {
  const auto stream = recipe.at("stream").get<std::string>();
  const auto found = std::ranges::find(vectors, VectorId(stream), &Vector::id);
  if (found == vectors.end()) throw TextError("there is no stream " + stream);
  Vector vector;
  vector.id = VectorId(id);
  vector.group = "frames";
  vector.profile = found->profile;
  vector.level = found->level;
  vector.clauses = recipe.at("clauses");
  vector.flags = recipe.value("flags", std::vector<std::string>{});
  vector.comment = recipe.at("comment");
  vector.milestone = recipe.at("milestone");
  if (&milestones_with(vector.milestone) != &frame_milestones()) {
    throw TextError(vector.milestone + " is no milestone of renderers");
  }
  vector.input = found->input;
  const auto decoder = value_or_throw(Decoder::open(files.at(vector.input.file.text())));
  FrameCase& frame = vector.frame.emplace();
  frame.stop_level = recipe.value("stop_level", 0);
  if (recipe.contains("map")) {
    frame.map.emplace().view = {recipe["map"].at(0), recipe["map"].at(1)};
  } else {
    frame.camera = camera_from(recipe.value("camera", Json::object()));
  }
  vector.expect = expect_frame(decoder, frame);
  require(recipe, "input", vector.expect.input);
  const ErrorCode error = vector.expect.error;
  require(recipe, "error", error == ErrorCode::kOk ? std::string_view() : error_name(error));
  if (vector.expect.outcome == Outcome::kReject) {
    vector.base = VectorId("frames/" + recipe.at("base").get<std::string>());
  }
  return vector;
}

}  // namespace

Expectation expect_frame(const Decoder& decoder, FrameCase& frame) {
  if (frame.map) return expect_map(decoder, *frame.map);
  const auto record = frame_record(camera_of(*frame.camera), decoder.header());
  if (!record) {
    Expectation expect;
    expect.outcome = Outcome::kReject;
    expect.input = record.error().input;
    return expect;
  }
  const auto numbers = frame_record_values(*record);
  frame.record.emplace(numbers.begin(), numbers.end());
  return expect_picture(decoder, *record, frame);
}

Vector make_frame_vector(const std::string& id, const Json& recipe,
                         const std::vector<Vector>& vectors, const SuiteFiles& files) {
  try {
    return made_vector(id, recipe, vectors, files);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw TextError(id + ": " + error.what());
  }
}

}  // namespace hmlfc::vectors
