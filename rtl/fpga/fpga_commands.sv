// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Carries out commands that come as bytes: access to memory and to AXI4-Lite registers.
//
// A command has 8 bytes: its letter, an address of 3 bytes and a value of 4, little-endian. What is no letter of a
// command where one may begin is skipped. Each is answered with 4 bytes, little-endian:
//
//   W   writes as many bytes as the value says, which follow; the answer is their CRC
//   R   sends as many bytes; the answer after them is their CRC
//   C   the answer is the CRC of as many bytes
//   w   writes the value to the register; the answer is the value
//   r   reads the register; the answer is what it has
//
// A CRC is CRC-32C; counts are not 0. `mem_rdata` is there in the clock after `mem_read`. The responses of registers
// are taken in the clock in which they come.
module fpga_commands #(
    parameter int SIZE_LOG2 = 16
) (
    input logic clk,
    input logic rst_n,

    input logic in_valid,
    input logic [7:0] in_data,
    output logic out_valid,
    input logic out_ready,
    output logic [7:0] out_data,

    output logic mem_read,
    output logic mem_write,
    output logic [SIZE_LOG2-1:0] mem_address,
    output logic [7:0] mem_wdata,
    input logic [7:0] mem_rdata,

    output logic lite_awvalid,
    input logic lite_awready,
    output logic lite_wvalid,
    input logic lite_wready,
    input logic lite_bvalid,
    output logic lite_arvalid,
    input logic lite_arready,
    input logic lite_rvalid,
    output logic [11:0] lite_address,
    output logic [31:0] lite_wdata,
    input logic [31:0] lite_rdata
);
  typedef enum logic [2:0] {HEAD, WRITE, READ, TAKE, SEND, REGISTER, ANSWER} state_t;
  localparam logic [31:0] POLYNOMIAL = 32'h82f63b78;

  function automatic logic [31:0] crc_of(input logic [31:0] crc, input logic [7:0] data);
    crc_of = crc ^ {24'd0, data};
    for (int i = 0; i < 8; ++i) crc_of = (crc_of >> 1) ^ (crc_of[0] ? POLYNOMIAL : 32'd0);
  endfunction

  state_t state;
  logic [63:0] head;  // the first byte is the lowest
  logic [2:0] have;   // bytes of it; of the answer those that are sent
  logic [31:0] sum;   // inverse of the CRC so far; the answer
  logic [7:0] data;
  wire [7:0] letter = head[7:0];
  wire is_letter = in_data == "W" || in_data == "R" || in_data == "C" || in_data == "w" || in_data == "r";
  wire of_register = letter == "w" || letter == "r";
  wire last = head[63:32] == 32'd1;

  assign mem_address = head[8+:SIZE_LOG2];
  assign mem_read = state == READ;
  assign mem_write = state == WRITE && in_valid;
  assign mem_wdata = in_data;
  assign lite_address = head[8+:12];
  assign lite_wdata = head[63:32];
  assign out_valid = state == SEND || state == ANSWER;
  assign out_data = state == SEND ? data : of_register ? sum[7:0] : ~sum[7:0];

  always_ff @(posedge clk) begin
    if (mem_write || mem_read) head[31:8] <= head[31:8] + 24'd1;
    if (mem_write || state == TAKE) sum <= crc_of(sum, state == TAKE ? mem_rdata : in_data);
    if (lite_awready) lite_awvalid <= 1'b0;
    if (lite_wready) lite_wvalid <= 1'b0;
    if (lite_arready) lite_arvalid <= 1'b0;
    case (state)
      HEAD: begin
        sum <= '1;
        if (in_valid && (have != 0 || is_letter)) begin
          head <= {in_data, head[63:8]};
          have <= have + 3'd1;
          if (have == 3'd7) begin
            case (head[15:8])
              "W": state <= WRITE;
              "R", "C": state <= READ;
              default: begin
                state <= REGISTER;
                {lite_awvalid, lite_wvalid} <= {2{head[15:8] == "w"}};
                lite_arvalid <= head[15:8] == "r";
              end
            endcase
          end
        end
      end
      WRITE:
      if (in_valid) begin
        head[63:32] <= head[63:32] - 32'd1;
        if (last) state <= ANSWER;
      end
      READ: state <= TAKE;
      TAKE: begin
        data <= mem_rdata;
        head[63:32] <= head[63:32] - 32'd1;
        state <= letter == "R" ? SEND : last ? ANSWER : READ;
      end
      SEND: if (out_ready) state <= head[63:32] == 0 ? ANSWER : READ;
      REGISTER:
      if (lite_bvalid || lite_rvalid) begin
        sum <= lite_bvalid ? lite_wdata : lite_rdata;
        state <= ANSWER;
      end
      default:
      if (out_ready) begin
        sum <= sum >> 8;
        have <= have + 3'd1;
        if (have == 3'd3) begin
          have <= 3'd0;
          state <= HEAD;
        end
      end
    endcase
    if (!rst_n) begin
      state <= HEAD;
      have <= 3'd0;
      {lite_awvalid, lite_wvalid, lite_arvalid} <= '0;
    end
  end
endmodule

`default_nettype wire
