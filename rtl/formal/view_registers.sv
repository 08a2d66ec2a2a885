// The registers of the view queue, of all runs: each read and each write gets exactly one response, which stays until
// it is taken; each word reads as the register map has it, every other one as 0; a write changes the bytes of wstrb of
// its own word alone, within its mask, and a 1 in CONTROL acts for one clock; an event sets its bit of
// INTERRUPT_STATUS, a 1 written clears it, and irq follows a clock later, with irq_changes before.
//
// Clauses: Registers (docs/view_unit.md)
// Engine: induction 2 9
// Complete: what is held of a write is bound to the module's registers, so the induction needs no reachability.
`include "hmlfc_register_map.svh"

module prove_view_registers (
  input logic clk, input logic rst_n, input logic [11:0] awaddr, input logic [11:0] araddr, input logic awvalid,
      input logic [31:0] wdata,
  input logic [3:0] wstrb, input logic wvalid, input logic bready, input logic arvalid, input logic rready,
      input logic [15:0] consumer,
  input logic [5:0] status, input logic [3:0] events
);
  localparam integer A = hmlfc_pkg::ADDRESS_BITS;
  logic awready, wready, bvalid, arready, rvalid, enable, disable_queue, drain, abort_view, irq, irq_changes;
  logic [31:0] rdata;
  logic [A-1:0] ring_base, status_base;
  logic [15:0] ring_size, producer;
  hmlfc_view_registers dut (
    .clk(clk), .rst_n(rst_n), .s_axil_awaddr(awaddr), .s_axil_araddr(araddr), .s_axil_awvalid(awvalid),
    .s_axil_awready(awready), .s_axil_wdata(wdata), .s_axil_wstrb(wstrb), .s_axil_wvalid(wvalid),
    .s_axil_wready(wready), .s_axil_bvalid(bvalid), .s_axil_bready(bready), .s_axil_arvalid(arvalid),
    .s_axil_arready(arready), .s_axil_rdata(rdata), .s_axil_rvalid(rvalid), .s_axil_rready(rready), .enable(enable),
    .disable_queue(disable_queue), .drain(drain), .abort_view(abort_view), .ring_base(ring_base),
    .status_base(status_base), .ring_size(ring_size), .producer(producer), .consumer(consumer), .status(status),
    .events(events), .irq(irq), .irq_changes(irq_changes));
  (* hierconn *) wire \dut.address_held ;
  (* hierconn *) wire \dut.data_held ;
  (* hierconn *) wire [9:0] \dut.write_word ;
  (* hierconn *) wire [31:0] \dut.write_data ;
  (* hierconn *) wire [31:0] \dut.mask ;
  (* hierconn *) wire [3:0] \dut.interrupt_status ;
  (* hierconn *) wire [3:0] \dut.interrupt_enable ;

  // Addresses, data and reads taken and not yet answered.
  logic       started = 1'b0;
  logic [1:0] addresses, datas, reads;
  wire        read = arvalid && arready;
  always @(posedge clk) begin
    started <= 1'b1;
    if (!rst_n) {addresses, datas, reads} <= 6'd0;
    else begin
      addresses <= addresses + {1'b0, awvalid && awready} - {1'b0, bvalid && bready};
      datas <= datas + {1'b0, wvalid && wready} - {1'b0, bvalid && bready};
      reads <= reads + {1'b0, read} - {1'b0, rvalid && rready};
    end
  end

  // The write that is answered from this clock on; what the words were in the last clock, and what they must be:
  // enables of interrupts, size, bases, low word first, producer.
  localparam integer WORDS = 7;
  localparam [69:0] PLACES = {HMLFC_WORD_PRODUCER, HMLFC_WORD_STATUS_BASE + 10'd1, HMLFC_WORD_STATUS_BASE,
      HMLFC_WORD_RING_BASE + 10'd1,
                              HMLFC_WORD_RING_BASE, HMLFC_WORD_RING_SIZE, HMLFC_WORD_INTERRUPT_ENABLE};
  localparam [223:0] KEPT = {HMLFC_REG_PRODUCER_MASK, HMLFC_REG_STATUS_BASE_MASK, HMLFC_REG_RING_BASE_MASK,
      HMLFC_REG_RING_SIZE_MASK,
                             HMLFC_REG_INTERRUPT_ENABLE_MASK};
  logic         was_answered;
  logic [9:0]   word;
  logic [31:0]  value, bytes;
  logic [223:0] words, before, expected_words;
  logic [3:0]   pending, was_pending, was_events;
  assign words = {16'd0, producer, 64'(status_base), 64'(ring_base), 16'd0, ring_size, 28'd0, \dut.interrupt_enable };
  wire          written = bvalid && !was_answered;
  wire [31:0]   ones = written ? value & bytes : 32'd0;
  always @(posedge clk) begin
    was_answered <= bvalid;
    before <= rst_n ? words : '0;
    was_pending <= rst_n ? pending : 4'd0;
    was_events <= rst_n ? events : 4'd0;
    if (awvalid && awready) word <= awaddr[11:2];
    if (wvalid && wready) {value, bytes} <= {wdata, {8{wstrb[3]}}, {8{wstrb[2]}}, {8{wstrb[1]}}, {8{wstrb[0]}}};
  end
  always @* begin
    expected_words = before;
    for (integer i = 0; i < WORDS; i = i + 1)
      if (written && word == PLACES[10*i +: 10])
        expected_words[32*i +: 32] = ((before[32*i +: 32] & ~bytes) | (value & bytes)) & KEPT[32*i +: 32];
    pending = (was_pending & ~(word == HMLFC_WORD_INTERRUPT_STATUS ? ones[3:0] : 4'd0)) | was_events;
  end

  logic [31:0] expected, wanted;
  logic        answers, interrupts;
  always @* begin
    case (araddr[11:2])
      HMLFC_WORD_VIEW_ID: expected = 32'h514c4d48;
      HMLFC_WORD_VIEW_STATUS: expected = {26'd0, status};
      HMLFC_WORD_INTERRUPT_STATUS: expected = {28'd0, pending};
      HMLFC_WORD_CONSUMER: expected = {16'd0, consumer};
      default: expected = 32'd0;
    endcase
    for (integer i = 0; i < WORDS; i = i + 1) if (araddr[11:2] == PLACES[10*i +: 10]) expected = words[32*i +: 32];
  end
  logic        waiting_b;
  always @(posedge clk) begin
    answers <= rst_n && (read || (answers && !rready));
    if (read) wanted <= expected;
    interrupts <= rst_n && (pending & \dut.interrupt_enable ) != 0;
    waiting_b <= rst_n && bvalid && !bready;
  end

  always @* begin
    if (!started) assume (!rst_n);
    else begin
      assert (reads == {1'b0, rvalid} && answers == rvalid);
      assert (addresses == {1'b0, \dut.address_held } + {1'b0, bvalid} &&
          datas == {1'b0, \dut.data_held } + {1'b0, bvalid});
      if (waiting_b) assert (bvalid);
      if (\dut.address_held ) assert (word == \dut.write_word );
      if (\dut.data_held ) assert (value == \dut.write_data && bytes == \dut.mask );
      assert (words == expected_words && pending == \dut.interrupt_status );
      assert ({abort_view, drain, disable_queue, enable} == (word == HMLFC_WORD_VIEW_CONTROL ? ones[3:0] : 4'd0));
      if (answers) assert (rdata == wanted);
      assert (irq == interrupts && irq_changes == (irq != ((pending & \dut.interrupt_enable ) != 0)));
    end
  end
endmodule
