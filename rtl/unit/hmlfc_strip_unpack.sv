// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// Unpacks strips of the reference area into lines of samples, a quarter of 16 samples a clock.
//
// `ask`, unless `full`, gives a strip the next of SLOTS slots and says which place its lines are for. `write` brings a
// beat of the strip in `slot`, with `ends` its last, and `failed` then says that a beat was not read. Strips leave in
// the order in which they were asked for, `valid` with `place` and `lines` until `take`. A line is {error, samples}, the
// samples of one block SAMPLE_BITS wide in two's complement, row by row; `error` is the number that an undecodable block
// carries, or bus_error.
module hmlfc_strip_unpack #(
    parameter int BLOCK_LOG2 = 2,
    parameter int SAMPLE_BITS = 10,
    parameter int DATA_BITS = 128,
    parameter int PLACE_BITS = 8,
    parameter int SLOTS = 32,  // a power of two, at least 2
    localparam int SLOT_BITS = $clog2(SLOTS),
    localparam int BEAT_BITS = $clog2(hmlfc_pkg::STRIP_BYTES * 8 / DATA_BITS),
    localparam int SAMPLES = 1 << (2 * BLOCK_LOG2),
    localparam int LINES = 64 / SAMPLES,
    localparam int LINE_BITS = 6 + SAMPLES * SAMPLE_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic ask,
    input logic [PLACE_BITS-1:0] ask_place,
    output logic full,

    input logic write,
    input logic ends,
    input logic failed,
    input logic [SLOT_BITS-1:0] slot,
    input logic [BEAT_BITS-1:0] beat,
    input logic [DATA_BITS-1:0] data,

    output logic valid,
    output logic [PLACE_BITS-1:0] place,
    output logic [LINES*LINE_BITS-1:0] lines,
    input logic take
);

  localparam int RAW = 15;  // the width that stands for samples of 14 bits of which some are errors
  localparam int RAW_BITS = 14;
  localparam int HEAD_HALVES = hmlfc_pkg::STRIP_HEAD_HALVES;
  localparam int BEAT_HALVES = DATA_BITS / 16;
  localparam int HALVES_BITS = hmlfc_pkg::STRIP_HALVES_BITS;
  localparam int READY_BITS = 3;  // of the number of strips that wait unpacked

  logic [SLOT_BITS:0] asked, begun, taken;  // count strips; the low bits are the slot
  logic [SLOTS-1:0] complete, spoiled;
  assign full = asked - taken == (SLOT_BITS + 1)'(SLOTS);
  always_ff @(posedge clk) begin
    if (ask) begin
      asked <= asked + 1'b1;
      complete[asked[SLOT_BITS-1:0]] <= 1'b0;
    end
    if (ends) begin
      complete[slot] <= 1'b1;
      spoiled[slot] <= failed;
    end
    if (!rst_n) asked <= '0;
  end

  // Lanes of halves: a read takes LANES halves of a strip from any one on, each lane its own row.
  localparam int LANES = DATA_BITS < 256 ? 8 : 16;
  localparam int LANE_LOG2 = $clog2(LANES);
  localparam int ROW_BITS = HALVES_BITS - LANE_LOG2;
  logic read;
  logic [SLOT_BITS-1:0] read_slot;
  logic [HALVES_BITS-1:0] read_half;
  logic [LANE_LOG2-1:0] lane_1;  // of the first half of the read before
  logic [LANES*16-1:0] lanes;
  localparam int LOW_BITS = LANES < RAW_BITS ? LANES * 16 : RAW_BITS * 16;  // of a quarter in its first read
  wire [LOW_BITS-1:0] halves_1 = LOW_BITS'({lanes, lanes} >> {lane_1, 4'd0});
  wire [HALVES_BITS-1:0] write_half = HALVES_BITS'(beat) << $clog2(BEAT_HALVES);
  for (genvar l = 0; l < LANES; l++) begin : g_lane
    /* verilator lint_off CMPCONST */  // never for the last lane
    wire [ROW_BITS-1:0] row = read_half[HALVES_BITS-1:LANE_LOG2] + ROW_BITS'(read_half[LANE_LOG2-1:0] > LANE_LOG2'(l));
    /* verilator lint_on CMPCONST */
    wire here = BEAT_HALVES >= LANES || write_half[LANE_LOG2-1] == 1'(l >= LANES / 2);
    hmlfc_ram #(.WIDTH(16), .DEPTH(SLOTS << ROW_BITS)) beats (
        .clk, .write(write && here), .write_address({slot, write_half[HALVES_BITS-1:LANE_LOG2]}),
        .write_data(data[l%BEAT_HALVES*16+:16]), .read, .read_address({read_slot, row}), .read_data(lanes[l*16+:16])
    );
  end

  // A strip that is complete is read quarter by quarter, each in one read, or two where it is longer. What the read
  // before gave is looked at beside the next: `heads` begins with its quarter. Of a strip that failed whatever comes is
  // read.
  logic step, active, first_1, second_1;
  logic [PLACE_BITS-1:0] strip_place;
  logic strip_failed;
  logic [79:0] head, later_heads;
  wire [79:0] heads = first_1 ? head : later_heads;
  logic [1:0] quarter;
  logic [HALVES_BITS-1:0] half_1;
  wire [3:0] width = heads[3:0];
  wire [3:0] halves = width == 4'(RAW) ? 4'(RAW_BITS) : width;
  wire more = !second_1 && 5'(halves) > 5'(LANES);
  wire second = active && more;
  wire whole = active && !more;
  wire ends_strip = whole && quarter == 2'd3;
  wire begins = (!active || ends_strip) && begun != asked && complete[begun[SLOT_BITS-1:0]];
  assign read = step && (begins || (active && !ends_strip));
  assign read_slot = begins ? begun[SLOT_BITS-1:0] : taken[SLOT_BITS-1:0];
  assign read_half = begins ? HALVES_BITS'(HEAD_HALVES) :
      half_1 + (more ? HALVES_BITS'(LANES) : HALVES_BITS'(halves));
  for (genvar h = 0; h < HEAD_HALVES; h++) begin : g_head
    hmlfc_ram #(.WIDTH(16), .DEPTH(SLOTS)) of_strip (
        .clk, .write(write && beat == BEAT_BITS'(h / BEAT_HALVES)), .write_address(slot),
        .write_data(data[h%BEAT_HALVES*16+:16]), .read(step && begins), .read_address(begun[SLOT_BITS-1:0]),
        .read_data(head[h*16+:16])
    );
  end
  hmlfc_ram #(.WIDTH(PLACE_BITS), .DEPTH(SLOTS)) places (
      .clk, .write(ask), .write_address(asked[SLOT_BITS-1:0]), .write_data(ask_place), .read(step && begins),
      .read_address(begun[SLOT_BITS-1:0]), .read_data(strip_place)
  );

  // A quarter: 16 fields.
  logic fields_valid, fields_move;
  logic [RAW_BITS*16-1:0] fields;
  logic [3:0] fields_width;
  logic [15:0] fields_base;
  logic [1:0] fields_quarter;
  logic fields_failed;
  logic [PLACE_BITS-1:0] fields_place;
  assign step = !fields_valid || fields_move;
  always_ff @(posedge clk) begin
    if (step) begin
      {second_1, lane_1} <= {second, read_half[LANE_LOG2-1:0]};
      first_1 <= begins || (first_1 && second);
      if (!second) half_1 <= read_half;
      if (begins) begin
        begun <= begun + 1'b1;
        strip_failed <= spoiled[begun[SLOT_BITS-1:0]];
      end
      if (ends_strip) taken <= taken + 1'b1;
      if (whole) later_heads <= heads >> 20;
      quarter <= begins ? 2'd0 : quarter + 2'(whole);
      if (!second_1) fields[LOW_BITS-1:0] <= halves_1;
      fields_width <= width;
      fields_base <= heads[19:4];
      fields_quarter <= quarter;
      fields_failed <= strip_failed;
      fields_place <= strip_place;
      active <= begins || (active && !ends_strip);
      fields_valid <= whole;
    end
    if (!rst_n) begin
      begun <= '0;
      taken <= '0;
      active <= 1'b0;
      fields_valid <= 1'b0;
    end
  end
  if (LOW_BITS < RAW_BITS * 16) begin : g_second
    always_ff @(posedge clk) if (step) fields[RAW_BITS*16-1:LOW_BITS] <= halves_1[RAW_BITS*16-LOW_BITS-1:0];
  end

  // Samples: base + a field of `width` bits. In a quarter of width RAW a bit of the base says of each four samples
  // whether they are an error.
  wire raw = fields_width == 4'(RAW);
  wire [RAW_BITS*16+1:0] padded = {2'd0, fields};
  logic [16*SAMPLE_BITS-1:0] samples;
  localparam int ERRORS = SAMPLES < 16 ? 16 / SAMPLES : 1;  // of a quarter
  logic [ERRORS*6-1:0] errors;
  always_comb begin
    for (int s = 0; s < 16; s++) begin
      logic [15:0] field;
      field = 16'(fields[RAW_BITS*s+:RAW_BITS]) & {16{raw}};
      for (int w = 1; w <= (SAMPLE_BITS < RAW_BITS ? SAMPLE_BITS : RAW_BITS); w++) begin
        field = field | (padded[w*s+:16] & 16'((1 << w) - 1) & {16{fields_width == 4'(w)}});
      end
      samples[s*SAMPLE_BITS+:SAMPLE_BITS] =
          SAMPLE_BITS'(field) + (raw ? '0 : fields_base[SAMPLE_BITS-1:0]);
    end
    for (int e = 0; e < ERRORS; e++) begin
      errors[e*6+:6] = fields_failed ? HMLFC_ERROR_BUS_ERROR :
          raw && fields_base[e] ? fields[e*4*RAW_BITS+:6] : 6'd0;
    end
  end

  // Strips that are unpacked, quarter by quarter, and the one that is offered.
  localparam int QUARTER_BITS = ERRORS * 6 + 16 * SAMPLE_BITS;
  logic [READY_BITS:0] unpacked, offered;  // count strips
  wire keep = fields_valid && fields_move;
  wire offer = unpacked != offered && (!valid || take);
  logic [4*QUARTER_BITS-1:0] quarters;
  assign fields_move = unpacked - offered != (READY_BITS + 1)'(1 << READY_BITS);
  for (genvar q = 0; q < 4; q++) begin : g_quarter
    hmlfc_ram #(.WIDTH(QUARTER_BITS), .DEPTH(1 << READY_BITS)) lines_of (
        .clk, .write(keep && fields_quarter == 2'(q)), .write_address(unpacked[READY_BITS-1:0]),
        .write_data({errors, samples}), .read(offer), .read_address(offered[READY_BITS-1:0]),
        .read_data(quarters[q*QUARTER_BITS+:QUARTER_BITS])
    );
  end
  hmlfc_ram #(.WIDTH(PLACE_BITS), .DEPTH(1 << READY_BITS)) ready_places (
      .clk, .write(keep), .write_address(unpacked[READY_BITS-1:0]), .write_data(fields_place), .read(offer),
      .read_address(offered[READY_BITS-1:0]), .read_data(place)
  );
  always_ff @(posedge clk) begin
    if (!rst_n) begin
      unpacked <= '0;
      offered <= '0;
      valid <= 1'b0;
    end else begin
      if (keep && fields_quarter == 2'd3) unpacked <= unpacked + 1'b1;
      if (offer) offered <= offered + 1'b1;
      valid <= offer || (valid && !take);
    end
  end
  always_comb begin
    for (int s = 0; s < 64; s++) begin
      lines[s/SAMPLES*LINE_BITS+s%SAMPLES*SAMPLE_BITS+:SAMPLE_BITS] =
          quarters[s/16*QUARTER_BITS+s%16*SAMPLE_BITS+:SAMPLE_BITS];
      if (s % SAMPLES == 0) begin
        lines[s/SAMPLES*LINE_BITS+SAMPLES*SAMPLE_BITS+:6] =
            quarters[s/16*QUARTER_BITS+16*SAMPLE_BITS+s%16/SAMPLES*6+:6];
      end
    end
  end

endmodule

`default_nettype wire
