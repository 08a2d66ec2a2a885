// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Reads 16 bytes from any byte address: a client of hmlfc_read_port.
//
// `start` with an address begins a read (when `idle`); `done` is high for one clock when `bytes`, byte i
// at bits 8i+7:8i, and `error` (a bus error) are valid; they hold until the next start.
module hmlfc_aligned_read #(
    parameter int DATA_BITS = 128,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic start,
    input logic [ADDRESS_BITS-1:0] address,
    output logic idle,
    output logic done,
    output logic [127:0] bytes,
    output logic error,

    output hmlfc_pkg::read_request_t request,
    input hmlfc_pkg::read_response_t response,
    input logic [DATA_BITS-1:0] data
);

  localparam int BYTES = DATA_BITS / 8;
  localparam int BEAT_LOG2 = $clog2(BYTES);
  localparam int MAX_BEATS = (2 * BYTES + 14) / BYTES;

  logic waiting;
  logic [BEAT_LOG2-1:0] offset;
  logic [MAX_BEATS*DATA_BITS-1:0] beats;
  logic [$clog2(MAX_BEATS+1)-1:0] beat;

  assign idle = !waiting && !request.valid;
  assign bytes = 128'(beats >> {offset, 3'b000});

  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (start) begin
      request.address <= {address[ADDRESS_BITS-1:BEAT_LOG2], BEAT_LOG2'(0)};
      request.beats <= (10'(address[BEAT_LOG2-1:0]) + 10'(15 + BYTES)) >> BEAT_LOG2;
      offset <= address[BEAT_LOG2-1:0];
      error <= 1'b0;
      beat <= '0;
    end
    if (waiting && response.valid) begin
      for (int i = 0; i < MAX_BEATS; i++) if (32'(beat) == i) beats[i*DATA_BITS+:DATA_BITS] <= data;
      beat <= beat + 1'b1;
      error <= error || response.error;
      done <= response.last;
    end
    if (!rst_n) begin
      request.valid <= 1'b0;
      waiting <= 1'b0;
      done <= 1'b0;
    end else if (start) begin
      request.valid <= 1'b1;
      waiting <= 1'b1;
    end else begin
      if (response.ready) request.valid <= 1'b0;
      if (response.valid && response.last) waiting <= 1'b0;
    end
  end

endmodule

`default_nettype wire
