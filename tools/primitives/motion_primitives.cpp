// Vectors and the values between samples.
#include <utility>

#include "arithmetic/motion.hpp"
#include "primitives/planes.hpp"

namespace hmlfc::primitives {
namespace {

// The farthest reference image (specification, section 11).
constexpr int64_t kMaxOffset = 382;

VectorRules rules_of(const Inputs& in, unsigned shift, int32_t row_scale) {
  const int32_t window = in["window"];
  const int precision = in["vector_precision"];
  return {window << precision, shift, row_scale};
}

std::string vector_of_disparity(const Inputs& in) {
  const unsigned precision = in["vector_precision"];
  const unsigned shift = unsigned{in["disparity_precision"]} - precision;
  const MotionVector vector =
      disparity_vector(in["d"], in["rows"], in["cols"], rules_of(in, shift, in["row_scale"]));
  return joined(vector.x, vector.y);
}

Primitive disparity_vector_primitive() {
  return {"disparity-vector",
          "MOT-8",
          {within("window", 0, kMaxWindow),
           within("vector_precision", 0, 3),
           {"disparity_precision", "[vector_precision, 5]",
            [](const Inputs& in) {
              return Interval{int64_t{in["vector_precision"]}, 5};
            }},
           within("row_scale", -127, 127),
           within("d", kMinDisparity, kMaxDisparity),
           within("rows", -kMaxOffset, kMaxOffset, "rk - r"),
           within("cols", -kMaxOffset, kMaxOffset, "ck - c")},
          {},
          "vx vy",
          2 * kDrawn,
          vector_of_disparity};
}

Primitive explicit_vector_primitive() {
  return {"explicit-vector",
          "MOT-8",
          {within("window", 0, kMaxWindow), within("vector_precision", 0, 3),
           within("explicit_x", -2048, 2047), within("explicit_y", -2048, 2047)},
          {},
          "vx vy",
          kDrawn,
          [](const Inputs& in) {
            const MotionVector vector =
                explicit_vector(in["explicit_x"], in["explicit_y"], rules_of(in, 0, 0));
            return joined(vector.x, vector.y);
          }};
}

Primitive displacement() {
  return {"displacement",
          "MOT-9",
          {within("vector_precision", 0, 3),
           within("halved", 0, 1, "1 for Co and Cg in format 4:2:0 with motion plane 3"),
           {"v", "[-V, V] of the largest window",
            [](const Inputs& in) {
              const int64_t bound = int64_t{kMaxWindow} << int{in["vector_precision"]};
              return Interval{-bound, bound};
            }}},
          {},
          "i f",
          kAll,
          [](const Inputs& in) {
            const uint32_t halved = in["halved"];
            const SubpelVector vector =
                subpel_vector({in["v"], 0}, in["vector_precision"], halved != 0);
            return joined(vector.ix, vector.fx);
          }};
}

// Inputs of one reference: a fraction, then ref at (0, 0), (1, 0), (0, 1) and (1, 1).
std::vector<Column> reference_columns(const std::string& name) {
  std::vector<Column> columns{within("fx" + name, 0, 7), within("fy" + name, 0, 7)};
  const std::pair<const char*, const char*> places[] = {{"00", "x + ix, y + iy"},
                                                        {"10", "x + ix + 1, y + iy"},
                                                        {"01", "x + ix, y + iy + 1"},
                                                        {"11", "x + ix + 1, y + iy + 1"}};
  for (const auto& [place, position] : places) {
    columns.push_back(
        residual_column("ref" + name + "_" + place, std::string("ref(") + position + ")"));
  }
  return columns;
}

// I of MOT-9.
int32_t sum_of(const Inputs& in, const std::string& name) {
  const std::string ref = "ref" + name + "_";
  return weighted_sum(tap_weights(in["fx" + name], in["fy" + name]),
                      {in[ref + "00"], in[ref + "10"], in[ref + "01"], in[ref + "11"]});
}

Primitive interpolation() {
  std::vector<Column> columns{depth_column(), plane_column()};
  for (const Column& column : reference_columns("")) columns.push_back(column);
  return {"interpolation", "MOT-9", columns, {}, "R", 2 * kDrawn, [](const Inputs& in) {
            return joined(one_reference_value(sum_of(in, "")));
          }};
}

Primitive interpolation_of_two() {
  std::vector<Column> columns{depth_column(), plane_column()};
  for (const char* name : {"1", "2"}) {
    for (const Column& column : reference_columns(name)) columns.push_back(column);
  }
  return {"interpolation-two", "MOT-9", columns, {}, "R", 2 * kDrawn, [](const Inputs& in) {
            return joined(two_reference_value(sum_of(in, "1"), sum_of(in, "2")));
          }};
}

}  // namespace

std::vector<Primitive> motion_primitives() {
  return {disparity_vector_primitive(), explicit_vector_primitive(), displacement(),
          interpolation(), interpolation_of_two()};
}

}  // namespace hmlfc::primitives
