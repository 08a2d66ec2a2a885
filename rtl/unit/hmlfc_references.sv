// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Fetches the samples that predict a block: requests the windows of its references from both caches (DEC-4)
// and queues the block until they arrive.
//
//   reference_ask -+-> [8] -> cache A (K0) ----------> a_*    with CACHES = 1 there is only cache B, for all
//                  +-> [8] -> cache B (K1, K2, K3) --> b_*
//                  +-> [256] residuals, places ------> out_*
//
// A miss of one cache does not hold up the other. The windows of a cache come in the order of the blocks that have one
// there. Clients of the read master: 0 cache A, 1 cache B.
module hmlfc_references #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int DATA_BITS = 128,
    parameter int CACHES = 2,  // 1, 2
    parameter int CACHE_STRIPS = 512,  // of cache A; B has twice as many
    parameter int FILLS = 32,  // strips in flight of each, a power of two
    parameter int STRIP_READ = 32,  // bytes of a strip that are read at once
    parameter int CLOCKS = 1,  // of a window
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int READ_REQUEST_BITS = hmlfc_pkg::READ_REQUEST_BITS,
    localparam int READ_RESPONSE_BITS = hmlfc_pkg::READ_RESPONSE_BITS,
    localparam int VALUE_BITS = MAX_DEPTH + 2,
    localparam int RESIDUAL_BITS = VALUE_BITS << (2 * BLOCK_LOG2),
    localparam int WINDOW_BITS = ((1 << BLOCK_LOG2) / CLOCKS + 1) * ((1 << BLOCK_LOG2) + 1) * VALUE_BITS
) (
    input logic clk,
    input logic rst_n,
    input hmlfc_pkg::config_t stream,
    input logic flush,

    input logic in_valid,
    output logic in_ready,
    input hmlfc_pkg::flow_t in_flow,
    input hmlfc_pkg::image_references_t in_image,  // of in_flow.job.id
    input logic in_has_residual,
    input logic [RESIDUAL_BITS-1:0] in_residual,

    output logic out_valid,
    input logic out_ready,
    output hmlfc_pkg::pending_t out_pending,
    output logic [RESIDUAL_BITS-1:0] out_residual,

    // Of cache A and of cache B.
    output logic [1:0] window_valid,
    input logic [1:0] window_ready,
    output logic [2*6-1:0] window_error,
    output logic [2*WINDOW_BITS-1:0] window,

    output logic [2*READ_REQUEST_BITS-1:0] requests,
    input logic [2*READ_RESPONSE_BITS-1:0] responses,
    input logic [DATA_BITS-1:0] data
);

  localparam int PENDING_BITS = hmlfc_pkg::PENDING_BITS;
  localparam int SLOT_BITS = ADDRESS_BITS + 80;

  logic [1:0] asked_valid, asked_ready;
  logic [2*SLOT_BITS-1:0] asked;
  logic pending_valid, pending_ready;
  hmlfc_pkg::pending_t pending;
  logic [RESIDUAL_BITS-1:0] pending_residual;
  hmlfc_reference_ask #(.BLOCK_LOG2(BLOCK_LOG2), .RESIDUAL_BITS(RESIDUAL_BITS), .CACHES(CACHES),
      .UNITS(CLOCKS > 1 ? 1 : 2)) reference_ask (
      .clk, .rst_n, .stream, .image(in_image), .in_flow, .in_valid, .in_ready, .in_has_residual, .in_residual,
      .a_valid(asked_valid[0]), .a_ready(asked_ready[0]), .a_window(asked[0+:SLOT_BITS]), .b_valid(asked_valid[1]),
      .b_ready(asked_ready[1]), .b_window(asked[SLOT_BITS+:SLOT_BITS]), .out_valid(pending_valid),
      .out_ready(pending_ready), .out_pending(pending), .out_residual(pending_residual)
  );

  if (CACHES == 1) begin : g_no_cache
    assign {window_valid[0], window_error[0+:6], window[0+:WINDOW_BITS], requests[0+:READ_REQUEST_BITS]} = '0;
    assign asked_ready[0] = 1'b0;
  end
  for (genvar c = CACHES == 1 ? 1 : 0; c < 2; c++) begin : g_cache
    logic slot_valid, slot_ready;
    logic [SLOT_BITS-1:0] slot;
    hmlfc_fifo #(.WIDTH(SLOT_BITS), .DEPTH(8)) before_cache (
        .clk, .rst_n, .in_valid(asked_valid[c]), .in_ready(asked_ready[c]), .in_data(asked[c*SLOT_BITS+:SLOT_BITS]),
        .out_valid(slot_valid), .out_ready(slot_ready), .out_data(slot), .count()
    );
    hmlfc_reference_cache #(
        .BLOCK_LOG2(BLOCK_LOG2), .SAMPLE_BITS(VALUE_BITS), .DATA_BITS(DATA_BITS), .STRIPS((c + 1) * CACHE_STRIPS),
        .SECTIONS(c + 1), .FILLS(FILLS), .STRIP_READ(STRIP_READ), .CLOCKS(CLOCKS)
    ) cache (
        .clk, .rst_n, .flush, .in_valid(slot_valid), .in_ready(slot_ready), .in_address(slot[79+:ADDRESS_BITS]),
        .in_plane(slot[77+:2]), .in_section(slot[ADDRESS_BITS+79]), .in_strips_x(slot[66+:11]), .in_width(slot[51+:15]),
        .in_height(slot[36+:15]), .in_x(slot[19+:17]), .in_y(slot[2+:17]), .in_extra_x(slot[1]), .in_extra_y(slot[0]),
        .out_valid(window_valid[c]), .out_ready(window_ready[c]), .out_error(window_error[c*6+:6]),
        .out_window(window[c*WINDOW_BITS+:WINDOW_BITS]), .request(requests[c*READ_REQUEST_BITS+:READ_REQUEST_BITS]),
        .response(responses[c*READ_RESPONSE_BITS+:READ_RESPONSE_BITS]), .data
    );
  end

  hmlfc_fifo #(.WIDTH(PENDING_BITS + RESIDUAL_BITS), .DEPTH(256), .BYPASS(CLOCKS == 1)) before_compose (
      .clk, .rst_n, .in_valid(pending_valid), .in_ready(pending_ready), .in_data({pending, pending_residual}),
      .out_valid, .out_ready, .out_data({out_pending, out_residual}), .count()
  );

endmodule

`default_nettype wire
