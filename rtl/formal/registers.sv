// Register reads are stable and whole: a read's data and a write's response stay until they are taken; each read and each write gets
// exactly one response; the high word of a counter or of ERROR_ADDRESS that is read next after its low word belongs to the
// same moment; each counter adds its events over all its 64 bits.
//
// Clauses: Registers (docs/decode_unit.md)
// Engine: induction 2 8
// Complete: the counts are bound to the register block's state, so the induction needs no reachability.
// Fault: hmlfc_registers.sv / {31'd0, carries[k]} / {31'd0, !carries[k]}
// Fault: hmlfc_registers.sv / if (read) s_axil_rdata / if (!s_axil_rready) s_axil_rdata
// Fault: hmlfc_registers.sv / has_kept[k] ? kept[32*k +: 32] : pairs[64*k+32 +: 32] / pairs[64*k+32 +: 32]
`include "hmlfc_register_map.svh"

module prove_registers (
  input logic clk, input logic rst_n,
  input logic [11:0] awaddr, input logic [11:0] araddr, input logic awvalid, input logic [31:0] wdata, input logic [3:0] wstrb,
  input logic wvalid, input logic bready, input logic arvalid, input logic rready,
  input logic [10:0] status, input logic [5:0] error, input logic [63:0] error_request, input logic [3:0] events,
  input logic error_valid, input logic [4:0] read_bytes
);
  logic awready, wready, bvalid, arready, rvalid, load, disable_unit;
  logic [1:0] bresp, rresp;
  logic [31:0] rdata;
  logic [63:0] stream_base, stream_bytes, reference_base;
  hmlfc_registers dut (
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

  // Addresses, data and reads taken and not yet answered.
  logic       started = 1'b0;
  logic [1:0] addresses, datas, reads;
  always @(posedge clk) begin
    started <= 1'b1;
    if (!rst_n) {addresses, datas, reads} <= 6'd0;
    else begin
      addresses <= addresses + {1'b0, awvalid && awready} - {1'b0, bvalid && bready};
      datas <= datas + {1'b0, wvalid && wready} - {1'b0, bvalid && bready};
      reads <= reads + {1'b0, arvalid && arready} - {1'b0, rvalid && rready};
    end
  end

  // Pair k, any of the six: its value when its low word was read last, and whether its high word is to be read yet.
  (* anyconst *) logic [2:0] k;
  wire [31:0] pair_high = \dut.pairs [64*k+32 +: 32];
  wire [31:0] kept_high = \dut.kept [32*k +: 32];
  wire        read = arvalid && arready;
  wire        reads_low = read && araddr[11:2] == HMLFC_WORD_ERROR_ADDRESS + {6'd0, k, 1'b0};
  wire        reads_high = read && araddr[11:2] == HMLFC_WORD_ERROR_ADDRESS + 10'd1 + {6'd0, k, 1'b0};
  logic       open, answers_high;
  logic [31:0] high;
  logic [31:0] answer_high;
  always @(posedge clk) begin
    if (!rst_n) open <= 1'b0;
    else if (reads_low) open <= 1'b1;
    else if (reads_high) open <= 1'b0;
    if (reads_low) high <= pair_high;
    answers_high <= rst_n && ((reads_high && open) || (answers_high && !rready));
    if (reads_high) answer_high <= high;
  end

  // Counter k - 1: what it had and what came.
  wire [63:0] pair = \dut.pairs [64*k +: 64];
  wire [24:0] added = {4'd0, events[3], read_bytes, 4'd0, events[2], 4'd0, events[1], 4'd0, events[0]};
  logic        counts;
  logic [63:0] sum;
  always @(posedge clk) begin
    counts <= rst_n && k != 0 && !\dut.clear ;
    sum <= pair + added[5*(k-1) +: 5];
  end

  logic waiting_r, waiting_b;
  logic [31:0] waiting_data;
  always @(posedge clk) begin
    waiting_r <= rst_n && rvalid && !rready;
    waiting_b <= rst_n && bvalid && !bready;
    waiting_data <= rdata;
  end

  always @* begin
    assume (k <= 5);
    if (!started) assume (!rst_n);
    else begin
      assert (reads == {1'b0, rvalid});
      assert (addresses == {1'b0, \dut.address_held } + {1'b0, bvalid});
      assert (datas == {1'b0, \dut.data_held } + {1'b0, bvalid});
      assert (rresp == 0 && bresp == 0);
      assert (open == \dut.has_kept [k]);
      if (open) assert (kept_high == high);
      if (counts) assert (pair == sum);
      if (answers_high) assert (rvalid && rdata == answer_high);
    end
  end
  always @(posedge clk) begin
    if (started && $past(started)) begin
      if (waiting_r) assert (rvalid && rdata == waiting_data);
      if (waiting_b) assert (bvalid);
    end
  end
endmodule
