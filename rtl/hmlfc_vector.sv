// The displacement of a block in a reference image, from a disparity or an explicit vector
// (MOT-8, MOT-9).
//
// disparity                 d, [-4096, 4095]
// coefficient_x             ck - c, [-511, 511]
// coefficient_y             row_scale * (rk - r), [-131071, 131071]
// vector_precision          [0, 3]
// disparity_precision       [vector_precision, 5]; does not matter with explicit_mode
// window                    W, [0, 127]
// explicit_mode             choice 11: the vector is (explicit_x, explicit_y)
// explicit_x, explicit_y    [-2048, 2047], in vector units
// halve                     Co or Cg in format 4:2:0 with motion plane 3
// ix, iy                    whole samples, [-127, 127]
// fx, fy                    eighths of a sample beyond them, [0, 7]
//
// Latency 2 clocks with advance, one vector a clock: products; rounding, clamp and split.
module hmlfc_vector (
  input  logic        clk,
  input  logic        advance,
  input  logic [12:0] disparity,
  input  logic [9:0]  coefficient_x,
  input  logic [17:0] coefficient_y,
  input  logic [1:0]  vector_precision,
  input  logic [2:0]  disparity_precision,
  input  logic [6:0]  window,
  input  logic        explicit_mode,
  input  logic [11:0] explicit_x,
  input  logic [11:0] explicit_y,
  input  logic        halve,
  output logic [8:0]  ix,
  output logic [8:0]  iy,
  output logic [2:0]  fx,
  output logic [2:0]  fy
);
  localparam integer PRODUCT_BITS = 31;  // d * row_scale * (rk - r), and its rounding

  logic [3:0] s;  // of MOT-8
  assign s = {1'b0, disparity_precision} - {2'd0, vector_precision};

  logic [PRODUCT_BITS-1:0] product_x, product_y;
  logic [3:0]              shift_x, shift_y;  // of rshift
  logic [10:0]             bound;             // V
  logic [1:0]              precision;
  logic                    halved;

  always_ff @(posedge clk) begin
    if (advance) begin
      product_x <= explicit_mode ? {{19{explicit_x[11]}}, explicit_x}
                 : {{18{disparity[12]}}, disparity} * {{21{coefficient_x[9]}}, coefficient_x};
      product_y <= explicit_mode ? {{19{explicit_y[11]}}, explicit_y}
                 : {{18{disparity[12]}}, disparity} * {{13{coefficient_y[17]}}, coefficient_y};
      shift_x <= explicit_mode ? 4'd0 : s;
      shift_y <= explicit_mode ? 4'd0 : s + 4'd4;
      bound <= {4'd0, window} << vector_precision;
      precision <= vector_precision;
      halved <= halve;
    end
  end

  // rshift(x, k) of MOT-8.
  function automatic [PRODUCT_BITS-1:0] round_shift(input [PRODUCT_BITS-1:0] x, input [3:0] k);
    logic [PRODUCT_BITS-1:0] half;
    half = {{(PRODUCT_BITS - 1) {1'b0}}, 1'b1} << k;
    half = {1'b0, half[PRODUCT_BITS-1:1]};
    round_shift = $signed(x + half) >>> k;
  endfunction

  // x moved to [-limit, limit].
  function automatic [10:0] clamp(input [PRODUCT_BITS-1:0] x, input [10:0] limit);
    logic [PRODUCT_BITS-1:0] wide;
    wide = {{(PRODUCT_BITS - 11) {1'b0}}, limit};
    clamp = x[10:0];
    if ($signed(x) > $signed(wide)) clamp = limit;
    if ($signed(x) < -$signed(wide)) clamp = -limit;
  endfunction

  // u of MOT-9: [-1016, 1016], with one more bit for its rounding.
  function automatic [11:0] eighths(input [10:0] v, input [1:0] vector_bits, input half_size);
    logic [11:0] u;
    u = {v[10], v} << (2'd3 - vector_bits);
    eighths = u;
    if (half_size) begin
      u = u + 12'd1;
      eighths = {u[11], u[11:1]};
    end
  endfunction

  logic [11:0] u_x, u_y;
  assign u_x = eighths(clamp(round_shift(product_x, shift_x), bound), precision, halved);
  assign u_y = eighths(clamp(round_shift(product_y, shift_y), bound), precision, halved);

  always_ff @(posedge clk) begin
    if (advance) begin
      {ix, fx} <= u_x;
      {iy, fy} <= u_y;
    end
  end
endmodule
