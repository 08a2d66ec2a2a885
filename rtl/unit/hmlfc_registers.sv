// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_register_map.svh"
`default_nettype none

// The register block of the decode unit: an AXI4-Lite subordinate of 32 bits (docs/decode_unit.md).
//
// BLOCK_LOG2, MAX_DEPTH, AXI_DATA_BITS   what PARAMETERS reports
//
// s_axil_*              all outputs are registered; one read and one write at a time, OKAY always;
//                       wstrb is obeyed; address bits 1:0 do not matter
// stream_*, reference_* the registers as written; of a base the bits of an address, the others are 0
// load, disable_unit    one clock each for a 1 written to its bit of CONTROL
// ready, loading, idle, load_error   what STATUS reports
// stray                 a beat came that nothing asked for: STATUS keeps it until reset
// error_valid           an answer with the error `error` to the request `error_request` was given
//                       in this clock: the first since CLEAR is kept
// block_done, in_flight, stalled, read_bytes, answered   what the counters add in this clock:
//                       BLOCKS, CYCLES, STALLS, BYTES_READ ([0, 32] bytes), REQUESTS
// CLEAR zeroes the counters and the first error; an event in its clock is not counted.
module hmlfc_registers #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int AXI_DATA_BITS = 128
) (
    input logic clk,
    input logic rst_n,

    input logic [11:0] s_axil_awaddr,
    input logic [11:0] s_axil_araddr,
    input logic s_axil_awvalid,
    output logic s_axil_awready,
    input logic [31:0] s_axil_wdata,
    input logic [3:0] s_axil_wstrb,
    input logic s_axil_wvalid,
    output logic s_axil_wready,
    output logic [1:0] s_axil_bresp,
    output logic s_axil_bvalid,
    input logic s_axil_bready,
    input logic s_axil_arvalid,
    output logic s_axil_arready,
    output logic [31:0] s_axil_rdata,
    output logic [1:0] s_axil_rresp,
    output logic s_axil_rvalid,
    input logic s_axil_rready,

    output logic [63:0] stream_base,
    output logic [63:0] stream_bytes,
    output logic [63:0] reference_base,
    output logic load,
    output logic disable_unit,

    input logic ready,
    input logic loading,
    input logic idle,
    input logic stray,
    input logic [5:0] load_error,
    input logic error_valid,
    input logic [5:0] error,
    input logic [63:0] error_request,
    input logic block_done,
    input logic in_flight,
    input logic stalled,
    input logic [5:0] read_bytes,
    input logic answered
);
`ifndef __ICARUS__  // version 11 has no elaboration tasks
  if (HMLFC_REG_STREAM_BASE_MASK != (64'd1 << hmlfc_pkg::ADDRESS_BITS) - 64'd1) begin : check_address_bits
    $error("registers.json: the addresses are not of ADDRESS_BITS");
  end
`endif

  // Write channel: address and data are accepted one by one, and used when both have arrived.
  logic        address_held, data_held, write;
  logic [9:0]  write_word;
  logic [31:0] write_data;
  logic [3:0]  write_bytes;

  assign s_axil_awready = !address_held;
  assign s_axil_wready = !data_held;
  assign s_axil_bresp = 2'b00;
  assign write = address_held && data_held && !s_axil_bvalid;

  always_ff @(posedge clk) begin
    if (s_axil_awready) write_word <= s_axil_awaddr[11:2];
    if (s_axil_wready) begin
      write_data <= s_axil_wdata;
      write_bytes <= s_axil_wstrb;
    end
    if (!rst_n) begin
      address_held <= 1'b0;
      data_held <= 1'b0;
      s_axil_bvalid <= 1'b0;
    end else begin
      if (s_axil_awvalid && s_axil_awready) address_held <= 1'b1;
      if (s_axil_wvalid && s_axil_wready) data_held <= 1'b1;
      if (s_axil_bready) s_axil_bvalid <= 1'b0;
      if (write) begin
        address_held <= 1'b0;
        data_held <= 1'b0;
        s_axil_bvalid <= 1'b1;
      end
    end
  end

  // Registers that are written.
  logic [31:0] write_mask, control;
  logic clear;
  assign write_mask = {{8{write_bytes[3]}}, {8{write_bytes[2]}}, {8{write_bytes[1]}}, {8{write_bytes[0]}}};
  assign control = write && write_word == HMLFC_WORD_CONTROL ? write_data & write_mask : 32'd0;

  // Three pairs: their words, the low one first, and which of their bits are kept.
  localparam [59:0] SETTING_WORDS = {
    HMLFC_WORD_REFERENCE_BASE + 10'd1, HMLFC_WORD_REFERENCE_BASE, HMLFC_WORD_STREAM_BYTES + 10'd1,
        HMLFC_WORD_STREAM_BYTES,
    HMLFC_WORD_STREAM_BASE + 10'd1, HMLFC_WORD_STREAM_BASE};
  localparam [191:0] SETTING_MASKS = {HMLFC_REG_REFERENCE_BASE_MASK, HMLFC_REG_STREAM_BYTES_MASK,
      HMLFC_REG_STREAM_BASE_MASK};
  logic [191:0] settings;
  assign stream_base = settings[63:0];
  assign stream_bytes = settings[127:64];
  assign reference_base = settings[191:128];

  always_ff @(posedge clk) begin
    load <= control[HMLFC_REG_CONTROL_LOAD_SHIFT] && rst_n;
    clear <= control[HMLFC_REG_CONTROL_CLEAR_SHIFT] && rst_n;
    disable_unit <= control[HMLFC_REG_CONTROL_DISABLE_SHIFT] && rst_n;
    for (int k = 0; k < 24; k = k + 1) begin
      if (!rst_n) settings[8*k +: 8] <= 8'd0;
      else if (write && write_word == SETTING_WORDS[10*(k/4) +: 10] && write_bytes[k%4])
        settings[8*k +: 8] <= write_data[8*(k%4) +: 8] & SETTING_MASKS[8*k +: 8];
    end
  end

  // What the unit reports: pair 0 is the request of the first error, 1 to 5 the counters. Their low words:
  localparam [59:0] PAIR_WORDS = {
    HMLFC_WORD_REQUESTS, HMLFC_WORD_BYTES_READ, HMLFC_WORD_STALLS, HMLFC_WORD_CYCLES, HMLFC_WORD_BLOCKS,
    HMLFC_WORD_ERROR_ADDRESS};
  logic         strayed;
  logic [5:0]   first_error;
  logic         has_error;
  logic [383:0] pairs;

  // A counter is two halves: what the low one carries reaches the high one a clock later. Its pair has the sum, which
  // is exact.
  localparam int COUNTERS = 5;
  logic [63:0]  request;
  logic [159:0] lows, highs;
  logic [4:0]   carries;
  wire [29:0]   added = {5'd0, answered, read_bytes, 5'd0, stalled, 5'd0, in_flight, 5'd0, block_done};
  always_comb begin
    pairs[63:0] = request;
    for (int k = 0; k < COUNTERS; k = k + 1) begin
      pairs[64*(k+1) +: 64] = {highs[32*k +: 32] + {31'd0, carries[k]}, lows[32*k +: 32]};
    end
  end
  always_ff @(posedge clk) begin
    for (int k = 0; k < COUNTERS; k = k + 1) begin
      {carries[k], lows[32*k +: 32]} <= {1'b0, lows[32*k +: 32]} + {27'd0, added[6*k +: 6]};
      highs[32*k +: 32] <= pairs[64*(k+1)+32 +: 32];
    end
    if (!rst_n || clear) {highs, carries, lows} <= '0;
  end

  always_ff @(posedge clk) strayed <= rst_n && (strayed || stray);

  always_ff @(posedge clk) begin
    if (!rst_n || clear) begin
      first_error <= 6'd0;
      has_error <= 1'b0;
      request <= 64'd0;
    end else if (error_valid && !has_error) begin
      first_error <= error;
      has_error <= 1'b1;
      request <= error_request;
    end
  end

  // Read channel. A read of a pair's low word keeps its high word for the next read of that one.
  logic         read;
  logic [9:0]   read_word;
  logic [31:0]  read_data;
  logic [191:0] kept;
  logic [5:0]   has_kept;

  assign s_axil_arready = !s_axil_rvalid;
  assign s_axil_rresp = 2'b00;
  assign read = s_axil_arvalid && s_axil_arready;
  assign read_word = s_axil_araddr[11:2];

  localparam [31:0] PARAMETERS = (32'(BLOCK_LOG2) << HMLFC_REG_PARAMETERS_BLOCK_LOG2_SHIFT) |
      (32'(MAX_DEPTH) << HMLFC_REG_PARAMETERS_MAX_DEPTH_SHIFT) |
          (32'(AXI_DATA_BITS / 8) << HMLFC_REG_PARAMETERS_BEAT_BYTES_SHIFT);
  logic [31:0] status;
  always_comb begin
    status = 32'd0;
    status[HMLFC_REG_STATUS_READY_SHIFT] = ready;
    status[HMLFC_REG_STATUS_LOADING_SHIFT] = loading;
    status[HMLFC_REG_STATUS_IDLE_SHIFT] = idle;
    status[HMLFC_REG_STATUS_STRAY_SHIFT] = strayed;
    status[HMLFC_REG_STATUS_LOAD_ERROR_SHIFT +: 6] = load_error;
  end

  always @* begin
    unique case (read_word)
      HMLFC_WORD_ID: read_data = HMLFC_REG_ID_RESET;
      HMLFC_WORD_PARAMETERS: read_data = PARAMETERS;
      HMLFC_WORD_STATUS: read_data = status;
      HMLFC_WORD_STREAM_BASE: read_data = stream_base[31:0];
      HMLFC_WORD_STREAM_BASE + 10'd1: read_data = stream_base[63:32];
      HMLFC_WORD_STREAM_BYTES: read_data = stream_bytes[31:0];
      HMLFC_WORD_STREAM_BYTES + 10'd1: read_data = stream_bytes[63:32];
      HMLFC_WORD_REFERENCE_BASE: read_data = reference_base[31:0];
      HMLFC_WORD_REFERENCE_BASE + 10'd1: read_data = reference_base[63:32];
      HMLFC_WORD_ERROR: read_data = 32'(first_error) << HMLFC_REG_ERROR_NUMBER_SHIFT;
      default: read_data = 32'd0;
    endcase
    for (int k = 0; k < 6; k = k + 1) begin
      if (read_word == PAIR_WORDS[10*k +: 10]) read_data = pairs[64*k +: 32];
      if (read_word == PAIR_WORDS[10*k +: 10] + 10'd1) begin
        read_data = has_kept[k] ? kept[32*k +: 32] : pairs[64*k+32 +: 32];
      end
    end
  end

  always_ff @(posedge clk) begin
    if (read) s_axil_rdata <= read_data;
    for (int k = 0; k < 6; k = k + 1) begin
      if (read && read_word == PAIR_WORDS[10*k +: 10]) begin
        kept[32*k +: 32] <= pairs[64*k+32 +: 32];
      end
      if (!rst_n) has_kept[k] <= 1'b0;
      else if (read && read_word == PAIR_WORDS[10*k +: 10]) has_kept[k] <= 1'b1;
      else if (read && read_word == PAIR_WORDS[10*k +: 10] + 10'd1) has_kept[k] <= 1'b0;
    end
    if (!rst_n) s_axil_rvalid <= 1'b0;
    else s_axil_rvalid <= read || (s_axil_rvalid && !s_axil_rready);
  end
endmodule

`default_nettype wire
