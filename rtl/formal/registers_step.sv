// The registers from any legal state, step by step, so with counters of any value: a write changes the bytes of wstrb of its setting alone; a read gives the word,
// the high word of a pair as it was when the low one was read last; each counter adds its events over 64 bits.
//
// Clauses: Registers (docs/decode_unit.md)
// Engine: bmc 2
// Complete: any state whose settings are legal and one step from it; what a read of another word gives, responses and commands are those of proof registers.
// Fault: hmlfc_registers.sv / has_kept[k] ? kept[32*k +: 32] : pairs[64*k+32 +: 32] / pairs[64*k+32 +: 32]
// Fault: hmlfc_registers.sv / settings[32*k +: 32] & ~write_mask / settings[32*k +: 32] & write_mask
// Fault: hmlfc_registers.sv / {31'd0, carries[k]} / {31'd0, !carries[k]}
`include "hmlfc_register_map.svh"

module prove_registers_step #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 12,
  parameter integer AXI_DATA_BITS = 64
) (
  input logic clk, input logic rst_n, input logic [11:0] awaddr, input logic [11:0] araddr, input logic awvalid, input logic [31:0] wdata,
  input logic [3:0] wstrb, input logic wvalid, input logic bready, input logic arvalid, input logic rready, input logic [10:0] status,
  input logic [5:0] error, input logic [63:0] error_request, input logic [3:0] events, input logic error_valid, input logic [4:0] read_bytes
);
  logic awready, wready, bvalid, arready, rvalid, load, disable_unit;
  logic [1:0] bresp, rresp;
  logic [31:0] rdata;
  logic [63:0] stream_base, stream_bytes, reference_base;
  hmlfc_registers #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .AXI_DATA_BITS(AXI_DATA_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .s_axil_awaddr(awaddr), .s_axil_araddr(araddr), .s_axil_awvalid(awvalid), .s_axil_awready(awready),
    .s_axil_wdata(wdata), .s_axil_wstrb(wstrb), .s_axil_wvalid(wvalid), .s_axil_wready(wready), .s_axil_bresp(bresp),
    .s_axil_bvalid(bvalid), .s_axil_bready(bready), .s_axil_arvalid(arvalid), .s_axil_arready(arready), .s_axil_rdata(rdata),
    .s_axil_rresp(rresp), .s_axil_rvalid(rvalid), .s_axil_rready(rready), .stream_base(stream_base), .stream_bytes(stream_bytes),
    .reference_base(reference_base), .load(load), .disable_unit(disable_unit), .ready(status[0]),
    .loading(status[1]), .idle(status[2]), .stray(status[9]), .load_error(status[8:3]), .error_valid(error_valid), .error(error),
    .error_request(error_request), .block_done(events[0]), .in_flight(events[1]), .stalled(events[2]), .read_bytes(read_bytes),
    .answered(events[3]));
  (* hierconn *) wire [383:0] \dut.pairs ;
  (* hierconn *) wire [191:0] \dut.kept ;
  (* hierconn *) wire [5:0] \dut.has_kept ;
  (* hierconn *) wire \dut.clear ;
  (* hierconn *) wire \dut.address_held ;
  (* hierconn *) wire \dut.data_held ;
  (* hierconn *) wire [9:0] \dut.write_word ;
  (* hierconn *) wire [31:0] \dut.write_data ;
  (* hierconn *) wire [31:0] \dut.write_mask ;

  // Pair k and setting i, any of them: words E + 2k and E + 2k + 1, and S + i.
  (* anyconst *) logic [2:0] k;
  (* anyconst *) logic [2:0] i;
  wire [63:0]  pair = \dut.pairs [64*k +: 64];
  wire [31:0]  kept = \dut.kept [32*k +: 32];
  wire         read = arvalid && arready;
  wire         low = read && araddr[11:2] == HMLFC_WORD_ERROR_ADDRESS + {6'd0, k, 1'b0};
  wire         high = read && araddr[11:2] == HMLFC_WORD_ERROR_ADDRESS + 10'd1 + {6'd0, k, 1'b0};
  wire [24:0]  added = {4'd0, events[3], read_bytes, 4'd0, events[2], 4'd0, events[1], 4'd0, events[0]};
  wire [191:0] settings = {reference_base, stream_bytes, stream_base};
  wire [31:0]  setting = settings[32*i +: 32];
  wire [31:0]  mask = i[0] && i != 3 ? 32'hff : 32'hffffffff;  // of an address the upper word has 8 bits
  wire         written = \dut.address_held && \dut.data_held && !bvalid && \dut.write_word == HMLFC_WORD_STREAM_BASE + {7'd0, i};
  logic        was = 1'b0, was_low, was_high, was_written, was_clear, was_kept;
  logic [31:0] next_low, next_high, next_setting, next_kept;
  logic [63:0] next_pair;
  always @(posedge clk) begin
    {was, was_low, was_high, was_written, was_clear} <= {rst_n, low, high, written, \dut.clear };
    was_kept <= low || (\dut.has_kept [k] && !high);
    next_low <= pair[31:0];
    next_high <= \dut.has_kept [k] ? kept : pair[63:32];
    next_kept <= low ? pair[63:32] : kept;
    next_pair <= \dut.clear ? 64'd0 : pair + added[5*(k-1) +: 5];
    next_setting <= written ? ((setting & ~\dut.write_mask ) | (\dut.write_data & \dut.write_mask )) & mask : setting;
  end
  always @* begin
    assume (k <= 5 && i <= 5);
    if (!was) assume ((setting & ~mask) == 0);
    if (was) begin
      if (was_low) assert (rdata == next_low);
      if (was_high) assert (rdata == next_high);
      assert (kept == next_kept && \dut.has_kept [k] == was_kept);
      if (k != 0) assert (pair == next_pair);
      assert (setting == next_setting);
    end
  end
endmodule
