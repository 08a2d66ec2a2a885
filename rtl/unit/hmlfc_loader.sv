// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_tables.svh"
`default_nettype none

// LOAD: reads the header and derives the geometry, when no request is in flight. Sections are left unchecked (FIL-6).
//
// `load` begins (while one goes on it begins no other), `disable_unit` ends readiness, also that which a LOAD under way
// would give; `load` in the same clock or later takes that back. `enable`: requests may be accepted: a LOAD has ended,
// with `error` or 0. `flush` is high for one clock when what is known of the last stream is to be forgotten.
module hmlfc_loader #(
    parameter int BLOCK_LOG2 = 2,
    parameter int MAX_DEPTH = 8,
    parameter int DATA_BITS = 128,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int LEVELS = hmlfc_pkg::LEVELS,
    localparam int LEVEL_BITS = hmlfc_pkg::LEVEL_BITS
) (
    input logic clk,
    input logic rst_n,
    input logic load,
    input logic disable_unit,
    input logic idle,  // no request is in flight
    output logic loading,
    output logic enable,
    output logic flush,
    output logic [5:0] error,

    input logic [63:0] stream_base,
    input logic [63:0] stream_bytes,
    input logic [63:0] reference_base,
    output hmlfc_pkg::config_t stream,
    output logic [LEVELS*LEVEL_BITS-1:0] levels,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  typedef enum logic [1:0] {
    IDLE,
    WAIT,
    HEADER,
    GEOMETRY
  } state_t;
  state_t state;

  logic header_done, geometry_start, geometry_done;
  logic [5:0] header_error, geometry_error;
  logic [8:0] features;
  logic [12:0] rows, cols;
  logic [16:0] width, height;
  logic [3:0] depth, tree_height;
  logic chroma_444;
  logic [1:0] block_log2, vector_precision;
  logic [6:0] window;
  logic [7:0] cluster_rows, cluster_cols, row_scale;
  logic [2:0] disparity_precision, motion_tile_log2, disparity_grid_log2;
  logic [16*24-1:0] level_entries;
  logic [63:0] root_offset, root_size, group_offset, group_size, tile_offset, tile_size;

  wire begin_load = state == WAIT && idle;
  hmlfc_header #(.DATA_BITS(DATA_BITS)) header (
      .clk, .rst_n, .start(begin_load), .stream_base(stream_base[ADDRESS_BITS-1:0]), .stream_bytes, .done(header_done),
      .error(header_error), .features, .rows, .cols, .width, .height, .depth, .chroma_444, .block_log2, .window,
      .cluster_rows, .cluster_cols, .tree_height, .vector_precision, .disparity_precision, .motion_tile_log2,
      .disparity_grid_log2, .row_scale, .levels(level_entries), .root_offset, .root_size, .group_offset, .group_size,
      .tile_offset, .tile_size, .request, .response, .data
  );
  hmlfc_geometry #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH)) geometry (
      .clk, .rst_n, .start(geometry_start), .done(geometry_done), .error(geometry_error),
      .stream_base(stream_base[ADDRESS_BITS-1:0]), .reference_base(reference_base[ADDRESS_BITS-1:0]), .features, .rows,
      .cols, .width, .height, .depth, .chroma_444, .block_log2, .window, .cluster_rows, .cluster_cols, .tree_height,
      .vector_precision, .disparity_precision, .motion_tile_log2, .disparity_grid_log2, .row_scale, .level_entries,
      .root_offset, .root_size, .group_offset, .group_size, .tile_offset, .tile_size, .stream, .levels
  );

  logic wanted;  // LOAD was written after DISABLE, or with it
  wire still_wanted = load || (wanted && !disable_unit);

  assign loading = state != IDLE;
  assign flush = begin_load;
  assign geometry_start = header_done && header_error == 0;
  always_ff @(posedge clk) begin
    unique case (state)
      WAIT: if (idle) state <= HEADER;
      HEADER:
      if (header_done) begin
        error <= header_error;
        enable <= header_error != 0 && still_wanted;
        state <= header_error != 0 ? IDLE : GEOMETRY;
      end
      GEOMETRY:
      if (geometry_done) begin
        error <= geometry_error;
        enable <= still_wanted;
        state <= IDLE;
      end
      default: ;
    endcase
    if (load && state == IDLE) begin
      enable <= 1'b0;
      state <= WAIT;
    end
    if (disable_unit && !load) enable <= 1'b0;
    wanted <= still_wanted;
    if (!rst_n) begin
      state <= IDLE;
      enable <= 1'b0;
      error <= '0;
    end
  end

endmodule

`default_nettype wire
