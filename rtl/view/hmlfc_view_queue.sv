// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Has descriptors decoded and written, and writes their statuses (docs/view_unit.md).
//
// Two sides work on descriptors in order, the first as many as LIST ahead of the second:
//   asking     `next` is read ahead (`next_valid`). `ask_start` begins it; `ask` allows requests, until all are
//              `asked_all`, or, with ABORT, until none is in flight; `next_take` removes it
//   answering  `view` from `view_start` on: `answering` until all its places are `placed`; `flush` until nothing of it
//              is held (`empty`); then its status waits for the responses of its bursts, and is written as a line of
//              memory
// A descriptor that is refused or was not read passes without requests. `busy`: a descriptor is under way or begins, or
// `events` are due. Lines have a kind, which comes back with the response (`answered_*`): 0 data, 2 a status, 3 one
// with another result than 0.
module hmlfc_view_queue #(
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic enable,
    input logic disable_queue,
    input logic drain,
    input logic abort_view,
    input logic [ADDRESS_BITS-1:0] status_base,
    input logic [15:0] ring_size,
    input logic [15:0] producer,
    output logic [15:0] consumer,
    output logic [5:0] status,
    output logic [3:0] events,
    output logic busy,

    output logic fetch_enable,
    output logic [15:0] begun,
    input logic fetching,
    input logic next_valid,
    input hmlfc_pkg::view_t next,
    output logic next_take,

    output logic asking,
    output logic ask_start,
    output logic ask,
    input logic request_ready,
    input logic request_waits,  // offered, and not taken; or it is not the last that must come with those before
    input logic asked_all,
    input logic asked,
    input logic answered,

    output hmlfc_pkg::view_t view,
    output logic view_start,
    output logic answering,
    input logic placed,
    input logic block_error,
    input logic [5:0] error,
    output logic flush,
    input logic empty,
    input logic data_written,  // a line of data goes to the port

    output logic line_valid,
    input logic line_ready,
    output logic [ADDRESS_BITS-7:0] line,
    output logic [511:0] line_data,
    output logic [63:0] line_strobe,
    output logic [1:0] line_kind,
    input logic write_answered,
    input logic [1:0] answered_kind,
    input logic write_failed
);

  localparam int LIST = 4;  // descriptors that are asked for and not answered
  localparam logic [7:0] STATUS_OK = 8'd0, STATUS_BLOCKS = 8'd1, STATUS_REFUSED = 8'd2, STATUS_BUS = 8'd3,
      STATUS_ABORTED = 8'd4;

  // ---- Whether descriptors begin.
  logic enabled, draining, aborting, status_lost;
  wire ring_empty = producer == consumer;
  wire running = begun != consumer || asking || fetching;
  wire stops = !running && (aborting || (draining && (ring_empty || !enabled)));
  assign status = {status_lost, ring_empty, aborting, draining, running, enabled};
  assign fetch_enable = enabled && !aborting;
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

  // ---- Asking. A descriptor begins when its first request would be taken, so that none waits before a LOAD.
  typedef enum logic [1:0] {IDLE, RUN, FLUSH, CLOSE} state_t;
  state_t state;
  logic asks_no_more, list_ready, view_valid, close;
  logic [2:0] list_count;
  logic [15:0] in_flight;
  wire skips = next.refused || next.failed;
  wire begins = fetch_enable && next_valid && !asking && list_ready && (skips || request_ready);
  assign ask_start = begins && !skips;
  assign ask = asking && !asks_no_more;
  // The last one is not asked for whole, and what was asked for is there.
  wire last_runs = list_count == 3'd1 && state == RUN;
  wire cut = asking && asks_no_more && last_runs && !placed && in_flight == 0;
  wire ask_ends = asking && (asked_all || cut || (asks_no_more && (list_count == 0 || (last_runs && placed))));
  assign next_take = (begins && skips) || ask_ends;
  always_ff @(posedge clk) begin
    if (!rst_n) begin
      asking <= 1'b0;
      asks_no_more <= 1'b0;
      in_flight <= '0;
      begun <= '0;
    end else begin
      asking <= ask_start || (asking && !ask_ends);
      asks_no_more <= asking && !ask_ends && (asks_no_more || (aborting && !request_waits));
      in_flight <= in_flight + 16'(asked) - 16'(answered);
      begun <= begun + 16'(begins);
    end
  end
  hmlfc_fifo #(.WIDTH(hmlfc_pkg::DESCRIPTOR_BITS), .DEPTH(LIST)) list (
      .clk, .rst_n, .in_valid(begins), .in_ready(list_ready), .in_data(next), .out_valid(view_valid),
      .out_ready(close), .out_data(view), .count(list_count)
  );

  // ---- Answering.
  logic slot_valid;
  assign view_start = state == IDLE && view_valid && !view.refused && !view.failed;
  assign answering = state == RUN;
  assign flush = state == FLUSH;
  assign close = state == CLOSE && !slot_valid;
  always_ff @(posedge clk) begin
    if (!rst_n) state <= IDLE;
    else begin
      unique case (state)
        IDLE: if (view_valid) state <= view_start ? RUN : CLOSE;
        RUN: if (placed || cut) state <= FLUSH;
        FLUSH: if (empty) state <= CLOSE;
        default: if (close) state <= IDLE;
      endcase
    end
  end

  // ---- What is counted of it. Responses come in the order of the bursts: first those of the one that is closed.
  logic was_cut;
  logic [5:0] first_error;
  logic [31:0] block_errors, write_errors;
  logic [5:0] waiting, slot_waiting;  // bursts without response
  wire data_answered = write_answered && !answered_kind[1];
  wire of_slot = slot_waiting != 0;
  wire own_answered = data_answered && !of_slot;
  wire [31:0] own_errors = write_errors + 32'(own_answered && write_failed);
  wire [5:0] own_waiting = waiting + 6'(data_written) - 6'(own_answered);
  always_ff @(posedge clk) begin
    if (state == IDLE) begin
      first_error <= '0;
      block_errors <= '0;
      was_cut <= 1'b0;
    end else begin
      if (block_error && block_errors == 0) first_error <= error;
      if (block_error) block_errors <= block_errors + 32'd1;
      if (cut) was_cut <= 1'b1;
    end
    write_errors <= rst_n && !close ? own_errors : 32'd0;
    waiting <= rst_n && !close ? own_waiting : 6'd0;
  end

  // ---- The status of the one that is closed, and CONSUMER.
  logic [31:0] tag, slot_blocks, slot_writes;
  logic slot_cut, slot_refused, slot_failed;
  logic [5:0] slot_error;
  logic [15:0] closed;  // descriptors whose status was written
  logic [7:0] result;
  always_comb begin
    result = STATUS_OK;
    if (slot_blocks != 0) result = STATUS_BLOCKS;
    if (slot_failed || slot_writes != 0) result = STATUS_BUS;
    else if (slot_refused) result = STATUS_REFUSED;
    if (slot_cut) result = STATUS_ABORTED;
  end
  wire finished = write_answered && answered_kind[1];
  always_ff @(posedge clk) begin
    if (close) begin
      tag <= view.tag;
      {slot_cut, slot_refused, slot_failed, slot_error} <= {was_cut, view.refused, view.failed, first_error};
      slot_blocks <= block_errors;
      slot_writes <= own_errors;
      slot_waiting <= own_waiting;
    end else if (data_answered && of_slot) begin
      slot_writes <= slot_writes + 32'(write_failed);
      slot_waiting <= slot_waiting - 6'd1;
    end
    if (!rst_n) begin
      slot_valid <= 1'b0;
      slot_waiting <= '0;
      status_lost <= 1'b0;
      closed <= '0;
      consumer <= '0;
    end else begin
      slot_valid <= close || (slot_valid && !(line_valid && line_ready));
      status_lost <= status_lost || (finished && write_failed);
      closed <= closed + 16'(line_valid && line_ready);
      consumer <= consumer + 16'(finished);
    end
  end
  wire [15:0] place = closed & (ring_size - 16'd1);
  wire [ADDRESS_BITS-1:0] status_address = status_base + {20'd0, place, 4'd0};
  assign line_valid = slot_valid && slot_waiting == 0;
  assign line = status_address[ADDRESS_BITS-1:6];
  wire [127:0] words = {slot_writes, slot_blocks, 18'd0, slot_error, result, tag};
  assign line_data = {4{words}};
  assign line_strobe = 64'hffff << {status_address[5:4], 4'd0};
  assign line_kind = {1'b1, result != STATUS_OK};

  // Done, error, ring empty, stopped.
  logic stopped, counted;
  always_ff @(posedge clk) {stopped, counted} <= rst_n ? {stops, finished} : 2'b00;
  assign busy = running || begins || stops || stopped || counted;
  assign events = {stopped, counted && ring_empty, finished && (answered_kind[0] || write_failed), finished};

endmodule

`default_nettype wire
