// Register reads are stable and whole: a read's data and a write's response stay until they are taken; each read and each write gets
// exactly one response; the high word of a counter or of ERROR_ADDRESS that is read next after its low word belongs to the
// same moment; each counter adds its events over all its 64 bits. Each word reads as the register map has it, every other one as 0. A write
// changes the bytes of wstrb of its own word alone, and a 1 in CONTROL acts for one clock. ERROR and ERROR_ADDRESS keep the first error since
// CLEAR, which zeroes them and the counters.
//
// Clauses: Registers (docs/decode_unit.md)
// Engine: induction 2 6
// Complete: the counts are bound to the register block's state, so the induction needs no reachability.
// Fault: hmlfc_registers.sv / {31'd0, carries[k]} / {31'd0, !carries[k]}
// Fault: hmlfc_registers.sv / if (read) s_axil_rdata / if (!s_axil_rready) s_axil_rdata
// Fault: hmlfc_registers.sv / SETTING_MASKS[32*k +: 32] / 32'hffffffff
// Fault: hmlfc_registers.sv / error_valid && !has_error / error_valid
// Fault: hmlfc_registers.sv / rst_n && (strayed / rst_n && (1'b0
// Fault: hmlfc_registers.sv / has_kept[k] ? kept[32*k +: 32] : pairs[64*k+32 +: 32] / pairs[64*k+32 +: 32]
`include "hmlfc_register_map.svh"

module prove_registers #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 8,
  parameter integer AXI_DATA_BITS = 128
) (
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
  (* hierconn *) wire [5:0] \dut.first_error ;
  (* hierconn *) wire \dut.has_error ;
  (* hierconn *) wire \dut.strayed ;

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
  logic        counts, zeroed;
  logic [63:0] sum;
  always @(posedge clk) begin
    zeroed <= !rst_n || \dut.clear ;
    counts <= rst_n && k != 0 && !\dut.clear ;
    sum <= pair + added[5*(k-1) +: 5];
  end

  // The first error, and the stray beat.
  logic        has_error, strayed;
  logic [5:0]  first_error;
  logic [63:0] first_request;
  always @(posedge clk) begin
    if (!rst_n || \dut.clear ) {has_error, first_error, first_request} <= '0;
    else if (error_valid && !has_error) {has_error, first_error, first_request} <= {1'b1, error, error_request};
    strayed <= rst_n && (strayed || status[9]);
  end

  // The write that is answered in this clock; what the settings were in the last, and what they must be.
  localparam [59:0] WORDS = {HMLFC_WORD_REFERENCE_BASE + 10'd1, HMLFC_WORD_REFERENCE_BASE, HMLFC_WORD_STREAM_BYTES + 10'd1,
                             HMLFC_WORD_STREAM_BYTES, HMLFC_WORD_STREAM_BASE + 10'd1, HMLFC_WORD_STREAM_BASE};
  localparam [191:0] KEPT = {HMLFC_REG_REFERENCE_BASE_MASK, HMLFC_REG_STREAM_BYTES_MASK, HMLFC_REG_STREAM_BASE_MASK};
  logic         was_answered;
  logic [9:0]   word;
  logic [31:0]  value, bytes;
  logic [191:0] before, settings;
  wire          written = bvalid && !was_answered;
  wire [31:0]   acts = written && word == HMLFC_WORD_CONTROL ? value & bytes : 32'd0;
  always @(posedge clk) begin
    was_answered <= bvalid;
    before <= rst_n ? {reference_base, stream_bytes, stream_base} : '0;
    if (awvalid && awready) word <= awaddr[11:2];
    if (wvalid && wready) {value, bytes} <= {wdata, {8{wstrb[3]}}, {8{wstrb[2]}}, {8{wstrb[1]}}, {8{wstrb[0]}}};
  end
  always @* begin
    settings = before;
    for (integer i = 0; i < 6; i = i + 1) begin
      if (written && word == WORDS[10*i +: 10]) settings[32*i +: 32] = ((before[32*i +: 32] & ~bytes) | (value & bytes)) & KEPT[32*i +: 32];
    end
  end

  // What a read must give; of pairs, of pair k alone.
  logic [31:0] expected, wanted;
  logic        is_known, answers;
  always @* begin
    is_known = reads_low || (reads_high && !open) || araddr[11:2] < HMLFC_WORD_ERROR_ADDRESS || araddr[11:2] >= HMLFC_WORD_REQUESTS + 10'd2;
    case (araddr[11:2])
      HMLFC_WORD_ID: expected = 32'h464c4d48;
      HMLFC_WORD_PARAMETERS: expected = {16'd0, 8'(AXI_DATA_BITS / 8), 4'(MAX_DEPTH), 4'(BLOCK_LOG2)};
      HMLFC_WORD_STATUS: expected = {18'd0, status[8:3], 4'd0, strayed, status[2:0]};
      HMLFC_WORD_ERROR: expected = {26'd0, first_error};
      default: expected = 32'd0;
    endcase
    for (integer i = 0; i < 6; i = i + 1) if (araddr[11:2] == WORDS[10*i +: 10]) expected = settings[32*i +: 32];
    if (reads_low) expected = \dut.pairs [64*k +: 32];
    if (reads_high) expected = pair_high;
  end
  always @(posedge clk) begin
    answers <= rst_n && read && is_known;
    wanted <= expected;
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
      if (answers) assert (rdata == wanted);
      assert ({reference_base, stream_bytes, stream_base} == settings);
      assert (load == acts[0] && \dut.clear == acts[1] && disable_unit == acts[2]);
      assert (strayed == \dut.strayed && has_error == \dut.has_error && first_error == \dut.first_error );
      assert (\dut.pairs [63:0] == first_request);
      if (zeroed) assert (pair == 0);
      if (\dut.address_held ) assert (word == \dut.write_word );
      if (\dut.data_held ) assert (value == \dut.write_data && bytes == \dut.write_mask );
    end
  end
  always @(posedge clk) begin
    if (started && $past(started)) begin
      if (waiting_r) assert (rvalid && rdata == waiting_data);
      if (waiting_b) assert (bvalid);
    end
  end
endmodule
