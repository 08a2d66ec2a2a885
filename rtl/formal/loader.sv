// A LOAD goes on from `load`, when none does, until it ends with the first error of its two parts; it forgets the
// stream before when no request is in flight. Requests may be accepted from the end of a LOAD to the next one while the
// last command is LOAD; of LOAD and DISABLE in one clock LOAD counts. BLOCK_LOG2 = 2, MAX_DEPTH = 12, beats of 64 bits.
//
// Clauses: FIL-8, LOAD and DISABLE (docs/decode_unit.md)
// Engine: induction 2 6
// Cut: header geometry
// Complete: header and geometry may end at any time, with anything.
module prove_loader (input logic clk, input logic load, input logic disable_unit, input logic idle);
  logic       started = 1'b0;
  logic       loading, enable, flush;
  logic [5:0] error;
  hmlfc_loader #(.BLOCK_LOG2(2), .MAX_DEPTH(12), .DATA_BITS(64)) dut (
    .clk(clk), .rst_n(started), .load(load), .disable_unit(disable_unit), .idle(idle), .loading(loading),
    .enable(enable), .flush(flush), .error(error), .stream_base(64'd0), .stream_bytes(64'd0), .reference_base(64'd0),
    .stream(), .levels(), .request(), .response(4'd0), .data(64'd0));
  (* hierconn *) wire \dut.wanted ;
  (* hierconn *) wire [1:0] \dut.state ;

  logic       wanted = 1'b0;  // the last command is LOAD
  logic       ended = 1'b0;   // a LOAD has ended, and no other begun
  logic       waits = 1'b0;   // the LOAD has not begun to read
  logic       was_loading = 1'b0;
  logic [5:0] last_error;
  wire        has_ended = ended || (was_loading && !loading);
  always @(posedge clk) begin
    started <= 1'b1;
    was_loading <= started && loading;
    last_error <= error;
    if (started) begin
      if (load) wanted <= 1'b1;
      else if (disable_unit) wanted <= 1'b0;
      if (flush) waits <= 1'b0;
      if (has_ended) ended <= 1'b1;
      if (load && !loading) {waits, ended} <= 2'b10;
    end
  end
  always @* if (started) begin
    assert (enable == (has_ended && wanted));
    assert (!(has_ended && loading));
    if (ended) assert (error == last_error);
    assert (flush == (waits && idle));
    if (waits || was_loading) assert (loading || has_ended);
    assert (waits == (\dut.state == 1));
    if (loading) assert (\dut.wanted == wanted);
  end
endmodule
