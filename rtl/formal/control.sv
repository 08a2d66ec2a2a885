// The registers of the stream are what LOAD reads, its commands begin and end LOAD, STATUS and the counters see what happens in the unit, and bytes
// are counted by the beat. Every bit between registers, LOAD and the ports goes to its own place. BLOCK_LOG2 = 2, MAX_DEPTH = 12, beats of 64 bits.
//
// Clauses: none: registers (docs/decode_unit.md)
// Engine: bmc 1
// Complete: no state; registers and LOAD may give anything.
// Fault: hmlfc_control.sv / enable && load_error == 0 / enable
// Fault: hmlfc_control.sv / idle && !reading / idle
// Fault: hmlfc_control.sv / .in_flight(!idle) / .in_flight(loading)
// Fault: hmlfc_control.sv / answered && answer_error != 0 / answer_error != 0
// Fault: hmlfc_control.sv / .stalled, / .stalled(beat),

// In the place of both parts: what they are given, and any outputs.
module hmlfc_registers #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0, parameter integer AXI_DATA_BITS = 0) (
  input logic clk, input logic rst_n, input logic [11:0] s_axil_awaddr, input logic [11:0] s_axil_araddr, input logic s_axil_awvalid,
  output logic s_axil_awready, input logic [31:0] s_axil_wdata, input logic [3:0] s_axil_wstrb, input logic s_axil_wvalid,
  output logic s_axil_wready, output logic [1:0] s_axil_bresp, output logic s_axil_bvalid, input logic s_axil_bready, input logic s_axil_arvalid,
  output logic s_axil_arready, output logic [31:0] s_axil_rdata, output logic [1:0] s_axil_rresp, output logic s_axil_rvalid,
  input logic s_axil_rready, output logic [63:0] stream_base, output logic [63:0] stream_bytes, output logic [63:0] reference_base,
  output logic load, output logic disable_unit, input logic ready, input logic loading, input logic idle, input logic stray,
  input logic [5:0] load_error, input logic error_valid, input logic [5:0] error, input logic [63:0] error_request, input logic block_done,
  input logic in_flight, input logic stalled, input logic [4:0] read_bytes, input logic answered
);
  (* anyseq *) logic [40:0] answers;
  (* anyseq *) logic [193:0] commands;
  wire [65:0] accesses = {rst_n, s_axil_awaddr, s_axil_araddr, s_axil_awvalid, s_axil_wdata, s_axil_wstrb, s_axil_wvalid, s_axil_bready,
                          s_axil_arvalid, s_axil_rready};
  wire [9:0]  status = {ready, loading, idle, stray, load_error};
  wire [79:0] events = {error_valid, error, error_request, block_done, in_flight, stalled, read_bytes, answered};
  wire [95:0] parameters = {32'(BLOCK_LOG2), 32'(MAX_DEPTH), 32'(AXI_DATA_BITS)};
  assign {s_axil_awready, s_axil_wready, s_axil_bresp, s_axil_bvalid, s_axil_arready, s_axil_rdata, s_axil_rresp, s_axil_rvalid} = answers;
  assign {stream_base, stream_bytes, reference_base, load, disable_unit} = commands;
endmodule

module hmlfc_loader #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0, parameter integer DATA_BITS = 0) (
  input logic clk, input logic rst_n, input logic load, input logic disable_unit, input logic idle, output logic loading, output logic enable,
  output logic flush, output logic [5:0] error, input logic [63:0] stream_base, input logic [63:0] stream_bytes, input logic [63:0] reference_base,
  output logic [750:0] stream, output logic [983:0] levels, output logic request_valid, input logic request_ready,
  output logic [39:0] request_address, output logic [9:0] request_beats, input logic data_valid, input logic [DATA_BITS-1:0] data,
  input logic data_last, input logic data_error
);
  (* anyseq *) logic [8:0] ends;
  (* anyseq *) logic [1785:0] results;
  wire [263:0] given = {rst_n, idle, stream_base, stream_bytes, reference_base, load, disable_unit, request_ready, data_valid, data, data_last,
                        data_error};
  wire [95:0]  parameters = {32'(BLOCK_LOG2), 32'(MAX_DEPTH), 32'(DATA_BITS)};
  assign {loading, enable, flush, error} = ends;
  assign {stream, levels, request_valid, request_address, request_beats} = results;
endmodule

module prove_control #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer MAX_DEPTH = 12,
  parameter integer DATA_BITS = 64
) (
  input logic clk, input logic rst_n, input logic [11:0] awaddr, input logic [11:0] araddr, input logic awvalid, input logic [31:0] wdata,
  input logic [3:0] wstrb, input logic wvalid, input logic bready, input logic arvalid, input logic rready, input logic idle, input logic reading,
  input logic stray, input logic block_done, input logic answered, input logic [5:0] answer_error, input logic [63:0] answered_request,
  input logic stalled, input logic beat, input logic request_ready, input logic data_valid, input logic [DATA_BITS-1:0] data,
  input logic data_last, input logic data_error
);
  logic          awready, wready, bvalid, arready, rvalid, loading, enable, flush, request_valid;
  logic [1:0]    bresp, rresp;
  logic [31:0]   rdata;
  logic [5:0]    load_error;
  logic [750:0]  stream;
  logic [983:0]  levels;
  logic [39:0]   request_address;
  logic [9:0]    request_beats;
  hmlfc_control #(.BLOCK_LOG2(BLOCK_LOG2), .MAX_DEPTH(MAX_DEPTH), .DATA_BITS(DATA_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .s_axil_awvalid(awvalid), .s_axil_awready(awready), .s_axil_awaddr(awaddr), .s_axil_wvalid(wvalid),
    .s_axil_wready(wready), .s_axil_wdata(wdata), .s_axil_wstrb(wstrb), .s_axil_bvalid(bvalid), .s_axil_bready(bready), .s_axil_bresp(bresp),
    .s_axil_arvalid(arvalid), .s_axil_arready(arready), .s_axil_araddr(araddr), .s_axil_rvalid(rvalid), .s_axil_rready(rready),
    .s_axil_rdata(rdata), .s_axil_rresp(rresp), .idle(idle), .reading(reading), .stray(stray), .loading(loading), .enable(enable),
    .load_error(load_error), .flush(flush), .stream(stream), .levels(levels), .block_done(block_done), .answered(answered),
    .answer_error(answer_error), .answered_request(answered_request), .stalled(stalled), .beat(beat), .request_valid(request_valid),
    .request_ready(request_ready), .request_address(request_address), .request_beats(request_beats), .data_valid(data_valid), .data(data),
    .data_last(data_last), .data_error(data_error));
  (* hierconn *) wire [40:0] \dut.registers.answers ;
  (* hierconn *) wire [193:0] \dut.registers.commands ;
  (* hierconn *) wire [65:0] \dut.registers.accesses ;
  (* hierconn *) wire [9:0] \dut.registers.status ;
  (* hierconn *) wire [79:0] \dut.registers.events ;
  (* hierconn *) wire [95:0] \dut.registers.parameters ;
  (* hierconn *) wire [8:0] \dut.loader.ends ;
  (* hierconn *) wire [1785:0] \dut.loader.results ;
  (* hierconn *) wire [263:0] \dut.loader.given ;
  (* hierconn *) wire [95:0] \dut.loader.parameters ;
  wire [4:0]  bytes = beat ? 5'd8 : 5'd0;
  wire [95:0] parameters = {32'(BLOCK_LOG2), 32'(MAX_DEPTH), 32'(DATA_BITS)};
  always @* begin
    assert (\dut.registers.parameters == parameters && \dut.loader.parameters == parameters);
    assert ({awready, wready, bresp, bvalid, arready, rdata, rresp, rvalid} == \dut.registers.answers );
    assert (\dut.registers.accesses == {rst_n, awaddr, araddr, awvalid, wdata, wstrb, wvalid, bready, arvalid, rready});
    assert ({loading, enable, flush, load_error} == \dut.loader.ends );
    assert ({stream, levels, request_valid, request_address, request_beats} == \dut.loader.results );
    assert (\dut.loader.given == {rst_n, idle, \dut.registers.commands , request_ready, data_valid, data, data_last, data_error});
    // Ready: the last LOAD succeeded. Idle: no request and no read is in flight. An answer's error counts when the answer is given.
    assert (\dut.registers.status == {enable && load_error == 0, loading, idle && !reading, stray, load_error});
    assert (\dut.registers.events [78:0] == {answer_error, answered_request, block_done, !idle, stalled, bytes, answered});
    assert (\dut.registers.events [79] == (answered && answer_error != 0));
  end
endmodule
