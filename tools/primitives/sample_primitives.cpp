// Steps, residuals, samples and colour.
#include "arithmetic/bise.hpp"
#include "arithmetic/colour.hpp"
#include "arithmetic/reconstruct.hpp"
#include "primitives/planes.hpp"

namespace hmlfc::primitives {
namespace {

int64_t level_count(const Inputs& in) { return levels_of_code(in["level_code"]).count; }

Interval bias_interval(const Inputs& in) {
  const int64_t end = int64_t{1} << (int{in["depth"]} + 1);
  return {-end, end - 1};
}

Primitive residual() {
  return {
      "residual",
      "TIL-10 STP-3",
      {depth_column(),
       plane_column(),
       {"level_code", "[0, 27 + 3 * (depth - 8)]",
        [](const Inputs& in) {
          return Interval{0, int64_t{max_residual_level_code(in["depth"])}};
        }},
       {"value", "[0, N - 1]",
        [](const Inputs& in) {
          return Interval{0, level_count(in) - 1};
        }},
       {"bias", "[-2^(depth + 1), 2^(depth + 1) - 1]", bias_interval},
       within("step_code", 0, kMaxStepCode)},
      {},
      "residual",
      2 * kDrawn,
      [](const Inputs& in) {
        return joined(stepped_residual(in["value"], static_cast<uint32_t>(level_count(in)),
                                       in["bias"], step_of_code(in["step_code"]), range_of(in)));
      }};
}

Primitive prediction() {
  return {"prediction",
          "DEC-3",
          {depth_column(), plane_column(), sample_column("P"), within("minus", 0, 1),
           residual_column("R")},
          {},
          "A",
          kDrawn,
          [](const Inputs& in) {
            const uint32_t minus = in["minus"];
            return joined(motion_prediction(in["P"], minus != 0, in["R"], range_of(in)));
          }};
}

Primitive sample() {
  return {
      "sample",
      "DEC-3",
      {depth_column(), plane_column(), sample_column("A"), residual_column("residual")},
      {},
      "sample",
      kDrawn,
      [](const Inputs& in) { return joined(add_residual(in["A"], in["residual"], range_of(in))); }};
}

Column colour_column(std::string name, Plane plane) {
  return {std::move(name), "[lo, hi] of its plane", [plane](const Inputs& in) {
            const SampleRange range = sample_range(plane, in["depth"]);
            return Interval{range.lo, range.hi};
          }};
}

Primitive colour() {
  return {"colour",
          "COL-2",
          {depth_column(), colour_column("Y", Plane::kY), colour_column("Co", Plane::kCo),
           colour_column("Cg", Plane::kCg)},
          {},
          "R G B",
          2 * kDrawn,
          [](const Inputs& in) {
            const Rgb rgb = inverse_colour({in["Y"], in["Co"], in["Cg"]}, in["depth"]);
            return joined(rgb.r, rgb.g, rgb.b);
          }};
}

}  // namespace

std::vector<Primitive> sample_primitives() {
  const Primitive step{
      "step", "STP-2", {within("code", 0, kMaxStepCode)}, {}, "step", kAll, [](const Inputs& in) {
        return joined(step_of_code(in["code"]));
      }};
  return {step, residual(), prediction(), sample(), colour()};
}

}  // namespace hmlfc::primitives
