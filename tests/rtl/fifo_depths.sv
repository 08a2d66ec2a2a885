// A queue of each depth that OUTSTANDING may have, 4 to 64: queue i has depth 4 + i.
module fifo_depths (
    input logic clk,
    input logic rst_n,
    input logic [60:0] in_valid,
    output logic [60:0] in_ready,
    input logic [7:0] in_data,
    output logic [60:0] out_valid,
    input logic [60:0] out_ready,
    output logic [61*8-1:0] out_data,
    output logic [61*7-1:0] count
);
  for (genvar i = 0; i < 61; i++) begin : g_depth
    wire [$clog2(4+i):0] words;
    assign count[7*i+:7] = 7'(words);
    hmlfc_fifo #(
        .WIDTH(8),
        .DEPTH(4 + i)
    ) fifo (
        .clk,
        .rst_n,
        .in_valid(in_valid[i]),
        .in_ready(in_ready[i]),
        .in_data,
        .out_valid(out_valid[i]),
        .out_ready(out_ready[i]),
        .out_data(out_data[8*i+:8]),
        .count(words)
    );
  end
endmodule
