#include "conform/frame_judge.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <hmlfc/disparity.hpp>
#include <hmlfc/frame_trace.hpp>
#include <hmlfc/renderer.hpp>

#include "conform/pixel_trace.hpp"
#include "conform/view_assembly.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::conform {
namespace {

using vectors::FrameCase;
using vectors::Outcome;

class FrameJudge {
 public:
  FrameJudge(const Trial& trial, RunningDut& dut, VectorResult& result)
      : trial_(trial), frame_(*trial.frame), dut_(dut), result_(result) {}

  void run() {
    const auto geometry = dut_.open(trial_.input);
    if (!geometry) return fail("refused a valid stream: " + geometry.error());
    const auto golden = Decoder::open(trial_.stream, {.check_sections = false});
    if (!golden) {
      return set(Status::kError,
                 "the golden model cannot open the stream: " + to_string(golden.error()));
    }
    if (const auto what = wrong_geometry(golden->header(), *geometry)) {
      return fail("wrong answer to 'open': " + *what);
    }
    if (!vectors::is_of_stream(frame_, golden->header())) {
      return set(Status::kError, "the manifest asks for what the stream does not have");
    }
    set(Status::kPass, {});
    if (frame_.map) {
      judge_map(*golden);
    } else {
      judge_record();
      if (passes() && !(is_about_the_record() && dut_.can().records)) judge_picture(*golden);
    }
    dut_.close();
  }

 private:
  void set(Status status, std::string reason) {
    result_.status = status;
    result_.reason = std::move(reason);
  }
  bool passes() const { return result_.status == Status::kPass; }
  // In this milestone a renderer that makes records is asked for nothing else.
  bool is_about_the_record() const { return result_.milestone == "records"; }
  void fail(std::string reason) { set(Status::kFail, std::move(reason)); }
  void cannot(const char* what) {
    set(Status::kNotSupported, fmt::format("the renderer {}", what));
  }

  // What must come: an input's name, an error's name, or nothing.
  std::string expected_error() const {
    if (trial_.expect.outcome == Outcome::kOk) return {};
    return trial_.expect.input.empty() ? std::string(error_name(trial_.expect.error))
                                       : trial_.expect.input;
  }

  void judge_record() {
    if (!dut_.can().records) return;
    const auto answer = dut_.record(*frame_.camera);
    const std::string error = frame_.record ? std::string() : expected_error();
    if (!answer) return judge_error(answer.error(), error, "the camera");
    if (!frame_.record) return judge_error({}, error, "the camera");
    const auto [expected, actual] = std::ranges::mismatch(*frame_.record, *answer);
    if (expected == frame_.record->end()) return;
    const auto name = frame_record_names()[static_cast<size_t>(expected - frame_.record->begin())];
    fail(fmt::format("record: {} is {} instead of {} (REC-2)", name, *actual, *expected));
    result_.kind = fmt::format("wrong {} of the record (REC-2)", name);
  }

  // `actual` and `expected` are empty where there is no error; the former may state a block.
  void judge_error(const std::string& actual, const std::string& expected, const char* what) {
    const std::string name = actual.substr(0, actual.find(' '));
    const bool named = trial_.dut.error_names;
    if (name == expected || (!named && !actual.empty() && !expected.empty())) {
      return judge_place(actual.substr(std::min(name.size() + 1, actual.size())));
    }
    const auto shown = [](const std::string& error) { return error.empty() ? "no error" : error; };
    fail(fmt::format("{}: {} instead of {}", what, shown(actual), shown(expected)));
    result_.kind = fmt::format("{}: {} instead of {}", what, shown(name), shown(expected));
  }

  void judge_place(const std::string& actual) {
    if (actual.empty() || !trial_.dut.error_names || trial_.expect.blocks.empty()) return;
    const BlockAddress& b = trial_.expect.blocks.front();
    const auto expected = fmt::format("{} {} {} {} {}", b.view.row, b.view.col,
                                      static_cast<unsigned>(b.plane), b.bx, b.by);
    if (actual == expected) return;
    fail(fmt::format("the error lies in view, plane and block {} instead of {}", actual, expected));
    result_.kind = "the error of another block (NED-2)";
  }

  void judge_picture(const Decoder& golden) {
    const Abilities& can = dut_.can();
    if ((!frame_.record || is_about_the_record()) && !can.cameras) {
      return cannot("neither makes records nor takes cameras");
    }
    if (!can.frames && !can.cameras) return cannot("draws no frames");
    const auto answer = dut_.frame(frame_);
    const std::string error = expected_error();
    if (!answer || !error.empty()) {
      return judge_error(answer ? std::string() : answer.error(), error, "the frame");
    }
    if (vectors::sha256(vectors::picture_bytes(answer->image)) != frame_.frame->sha256) {
      describe_difference(golden, answer->image);
    } else {
      judge_counts(answer->counts);
    }
  }

  void judge_counts(const hmlfc_dut_counts& counts) {
    const vectors::FrameSum& sum = *frame_.frame;
    const struct {
      const char* name;
      int64_t actual;
      uint64_t expected;
    } all[] = {
        {"pixels outside (RAY-6)", counts.pixels_outside, sum.pixels_outside},
        {"blocks needed (NED-1)", counts.blocks_needed, sum.blocks_needed},
        {"disparities looked up (SRF-5)", counts.disparities_looked_up, sum.disparities_looked_up}};
    for (const auto& count : all) {
      if (count.actual < 0 || static_cast<uint64_t>(count.actual) == count.expected) continue;
      fail(fmt::format("{}: {} instead of {}", count.name, count.actual, count.expected));
      result_.kind = fmt::format("wrong count of {}", count.name);
      return;
    }
  }

  // A single picture, whose blocks are pixels.
  void describe_difference(const Decoder& golden, const RgbImage& actual) {
    const FrameRecord record = frame_record_of(frame_.record->data());
    Frame expected;
    const auto drawn = make_golden_renderer(golden)->render(record, frame_.stop_level, expected);
    if (!drawn) return set(Status::kError, "the golden model cannot draw the frame");
    result_.difference = first_difference({expected.image}, {actual}, 1, 1);
    if (!result_.difference) return set(Status::kError, kOtherSuite);
    Difference& d = *result_.difference;
    d.planes.clear();  // a frame has none
    result_.kind = "wrong pixels";
    fail(fmt::format("pixel {},{} {}: {} instead of {}; {} of {} pixels", d.x, d.y, d.channel,
                     d.actual, d.expected, d.wrong_blocks, d.blocks));
    result_.stage = wrong_stage(golden, record, d);
    if (trial_.pictures.empty()) return;
    const auto written = write_failure_pictures(trial_.pictures, expected.image, actual);
    if (!written) result_.messages += "\n" + written.error().message;
  }

  std::string wrong_stage(const Decoder& golden, const FrameRecord& record, const Difference& d) {
    if (!dut_.can().pixels) return {};
    try {
      const auto actual = dut_.pixel(frame_, d.x, d.y);
      if (!actual) return "no trace: " + actual.error();
      const auto expected = frame_trace(golden, record, frame_.stop_level, d.x, d.y);
      return expected ? first_wrong_number(*expected, *actual) : std::string();
    } catch (DutFailure& failure) {
      failure.status = Status::kFail;
      failure.reason = result_.reason + "; and then its trace: " + failure.reason;
      throw;
    }
  }

  void judge_map(const Decoder& golden) {
    if (!dut_.can().maps) return cannot("makes no disparity maps");
    const vectors::MapSum& sum = *frame_.map;
    const auto answer = dut_.map(sum.view, size_t{sum.columns} * sum.rows);
    const std::string error = expected_error();
    if (!answer || !error.empty()) {
      return judge_error(answer ? std::string() : answer.error(), error, "the map");
    }
    if (vectors::sha256(vectors::map_bytes(*answer)) == sum.sha256) return;
    for (uint32_t i = 0; i < answer->size(); ++i) {
      const uint32_t bx = i % sum.columns;
      const uint32_t by = i / sum.columns;
      const auto told = block_disparity(golden, sum.view, bx, by);
      if (!told || *told == (*answer)[i]) continue;
      const bool value = told->disparity != (*answer)[i].disparity;
      fail(fmt::format("block {},{}: {} {} instead of {}", bx, by,
                       value ? "disparity" : "confidence",
                       value ? (*answer)[i].disparity : (*answer)[i].confidence,
                       value ? told->disparity : told->confidence));
      result_.kind = value ? "wrong disparities (GEO-4, GEO-5)" : "wrong confidences (GEO-6)";
      return;
    }
    set(Status::kError, kOtherSuite);
  }

  const Trial& trial_;
  const FrameCase& frame_;
  RunningDut& dut_;
  VectorResult& result_;
};

}  // namespace

void judge_frame(const Trial& trial, RunningDut& dut, VectorResult& result) {
  FrameJudge(trial, dut, result).run();
}

}  // namespace hmlfc::conform
