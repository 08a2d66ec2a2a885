// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Takes descriptors from the ring one by one, has each decoded and written, and writes its status (docs/view_unit.md).
//
// A descriptor: `fetch_start` until `fetched`; `view_start` until all places of the view are `placed`, or, with ABORT,
// until no request is in flight; `flush` until nothing is held or awaits its response (`written`); then its status as a
// line of memory. `ask` allows requests. `busy`: a descriptor is under way or begins, or `events` are due.
module hmlfc_view_queue #(
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic enable,
    input logic disable_queue,
    input logic drain,
    input logic abort_view,
    input logic [ADDRESS_BITS-1:0] ring_base,
    input logic [ADDRESS_BITS-1:0] status_base,
    input logic [15:0] ring_size,
    input logic [15:0] producer,
    output logic [15:0] consumer,
    output logic [5:0] status,
    output logic [3:0] events,
    output logic busy,

    output logic fetch_start,
    output logic [ADDRESS_BITS-1:0] fetch_address,
    input logic fetched,
    input logic [31:0] tag,
    input logic refused,
    input logic fetch_failed,

    output logic view_start,
    output logic ask,
    input logic request_waits,  // offered, and not taken; or it is not the last that must come with those before
    input logic asked,
    input logic answered,
    input logic placed,
    input logic block_error,
    input logic [5:0] error,
    output logic flush,
    input logic written,
    input logic write_failed,

    output logic line_valid,
    input logic line_ready,
    output logic [ADDRESS_BITS-7:0] line,
    output logic [511:0] line_data,
    output logic [63:0] line_strobe
);

  typedef enum logic [2:0] {IDLE, FETCH, CHECK, RUN, FLUSH, STATUS, FINISH} state_t;
  state_t state;

  localparam logic [7:0] STATUS_OK = 8'd0, STATUS_BLOCKS = 8'd1, STATUS_REFUSED = 8'd2, STATUS_BUS = 8'd3,
      STATUS_ABORTED = 8'd4;

  // ---- Whether descriptors are taken.
  logic enabled, draining, aborting, status_lost;
  wire ring_empty = producer == consumer;
  wire running = state != IDLE;
  wire finished = state == FINISH && written;
  wire stops = (draining && ring_empty && !running) || (aborting && (finished || !running));
  assign status = {status_lost, ring_empty, aborting, draining, running, enabled};
  always_ff @(posedge clk) begin
    if (!rst_n) begin
      enabled <= 1'b0;
      draining <= 1'b0;
      aborting <= 1'b0;
    end else begin
      enabled <= (enabled || enable) && !disable_queue && !stops;
      draining <= (draining || drain) && !stops;
      aborting <= (aborting || abort_view) && !stops;
    end
  end

  // ---- One descriptor.
  logic [15:0] place;
  assign place = consumer & (ring_size - 16'd1);
  assign fetch_start = state == IDLE && enabled && !aborting && !ring_empty;
  assign fetch_address = ring_base + {18'd0, place, 6'd0};
  assign view_start = state == CHECK && !aborting && !refused && !fetch_failed;

  logic asks_no_more;
  logic [15:0] in_flight;
  assign ask = state == RUN && !asks_no_more;
  assign flush = state == FLUSH;
  wire aborted = asks_no_more && in_flight == 0 && !asked;
  always_ff @(posedge clk) begin
    if (!rst_n) begin
      state <= IDLE;
      consumer <= '0;
    end else begin
      unique case (state)
        IDLE: if (fetch_start) state <= FETCH;
        FETCH: if (fetched) state <= CHECK;
        CHECK: state <= view_start ? RUN : STATUS;
        RUN: if (placed || aborted) state <= FLUSH;
        FLUSH: if (written) state <= STATUS;
        STATUS: if (line_ready) state <= FINISH;
        default: if (written) state <= IDLE;
      endcase
      if (finished) consumer <= consumer + 16'd1;
    end
    if (!rst_n || state != RUN) begin
      asks_no_more <= 1'b0;
      in_flight <= '0;
    end else begin
      if (aborting && !request_waits) asks_no_more <= 1'b1;
      in_flight <= in_flight + 16'(asked) - 16'(answered);
    end
  end

  // ---- What is reported of it.
  logic was_aborted;
  logic [5:0] first_error;
  logic [31:0] block_errors, write_errors;
  logic [7:0] result;
  always_comb begin
    result = STATUS_OK;
    if (block_errors != 0) result = STATUS_BLOCKS;
    if (fetch_failed || write_errors != 0) result = STATUS_BUS;
    else if (refused) result = STATUS_REFUSED;
    if (was_aborted) result = STATUS_ABORTED;
  end
  always_ff @(posedge clk) begin
    if (state == IDLE) begin
      first_error <= '0;
      block_errors <= '0;
      write_errors <= '0;
      was_aborted <= 1'b0;
    end else begin
      if (block_error && block_errors == 0) first_error <= error;
      if (block_error) block_errors <= block_errors + 32'd1;
      if (write_failed && state != FINISH) write_errors <= write_errors + 32'd1;
      if (aborting && (state == CHECK || (state == RUN && !placed))) was_aborted <= 1'b1;
    end
    if (!rst_n) status_lost <= 1'b0;
    else if (state == FINISH && write_failed) status_lost <= 1'b1;
  end

  wire [ADDRESS_BITS-1:0] status_address = status_base + {20'd0, place, 4'd0};
  assign line_valid = state == STATUS;
  assign line = status_address[ADDRESS_BITS-1:6];
  wire [127:0] words = {write_errors, block_errors, 18'd0, first_error, result, tag};
  assign line_data = {4{words}};
  assign line_strobe = 64'hffff << {status_address[5:4], 4'd0};

  // Done, error, ring empty, stopped.
  logic stopped, counted;
  always_ff @(posedge clk) {stopped, counted} <= rst_n ? {stops, finished} : 2'b00;
  assign busy = running || fetch_start || stops || stopped || counted;
  assign events = {stopped, counted && ring_empty, (finished && result != STATUS_OK) ||
      (state == FINISH && write_failed), finished};

endmodule

`default_nettype wire
