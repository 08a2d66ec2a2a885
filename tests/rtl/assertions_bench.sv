// Legal traffic on a channel, a read master and an AXI4-Lite subordinate under the rules of rtl/kit; +fault=NAME breaks one.
module assertions_bench;
  logic clk = 1'b0, rst_n = 1'b0;
  always #5 clk = !clk;
  string fault;

  logic valid = 1'b0, ready = 1'b0;
  logic [7:0] payload = 8'd0;
  axi_channel_assertions #(.NAME("channel"), .BITS(8)) channel (.clk, .rst_n, .valid, .ready, .payload);

  logic arvalid = 1'b0, rvalid = 1'b0, rlast = 1'b0;
  logic [15:0] araddr;
  logic [7:0] arlen;
  logic [2:0] arsize;
  logic [1:0] arburst;
  axi_read_assertions #(.NAME("reads"), .ADDRESS_BITS(16), .OUTSTANDING(2)) reads (
      .clk, .rst_n, .arvalid, .arready(1'b1), .araddr, .arlen, .arsize, .arburst, .rvalid, .rready(1'b1), .rlast);

  logic awvalid = 1'b0, wvalid = 1'b0, wlast = 1'b0, answer = 1'b0;
  logic [15:0] awaddr;
  logic [7:0] awlen;
  logic [2:0] awsize;
  logic [1:0] awburst, answer_response;
  axi_write_assertions #(.NAME("writes"), .ADDRESS_BITS(16), .OUTSTANDING(2)) writes (
      .clk, .rst_n, .awvalid, .awready(1'b1), .awaddr, .awlen, .awsize, .awburst, .wvalid, .wready(1'b1), .wdata(128'd7), .wstrb(16'hffff),
      .wlast, .bvalid(answer), .bready(1'b1), .bresp(answer_response));

  logic access = 1'b0, bvalid = 1'b0, dvalid = 1'b0;
  logic [1:0] response;
  axi_lite_assertions #(.NAME("lite")) lite (
      .clk, .rst_n, .awvalid(access), .awready(1'b1), .awaddr(12'd4), .wvalid(access), .wready(1'b1), .wdata(32'd0), .wstrb(4'd15),
      .bvalid, .bready(1'b1), .bresp(response), .arvalid(access), .arready(1'b1), .araddr(12'd8), .rvalid(dvalid), .rready(1'b1),
      .rdata(32'd0), .rresp(response));

  task automatic waits;
    valid = 1'b1;
    payload = 8'h5a;
    @(negedge clk);
    if (fault == "drop") valid = 1'b0;
    if (fault == "change") payload = 8'h5b;
    @(negedge clk) ready = 1'b1;
    @(negedge clk) {valid, ready} = 2'b00;
  endtask

  task automatic bursts;
    arvalid = 1'b1;
    araddr = fault == "cross" ? 16'h0fd0 : fault == "unaligned" ? 16'h1008 : 16'h0fc0;  // to the end of its 4 KiB
    arlen = fault == "long" ? 8'd16 : 8'd3;
    arsize = fault == "size" ? 3'd3 : 3'd4;
    arburst = fault == "wrap" ? 2'b10 : 2'b01;
    repeat (fault == "many" ? 3 : 2) @(negedge clk);
    arvalid = 1'b0;
    for (int beat = 0; beat < 8; beat++) begin
      rvalid = 1'b1;
      rlast = beat % 4 == (fault == "early" ? 2 : 3);
      @(negedge clk);
    end
    rvalid = 1'b0;
  endtask

  task automatic written;
    awvalid = 1'b1;
    awaddr = fault == "write_cross" ? 16'h0fd0 : fault == "write_unaligned" ? 16'h1008 : 16'h0fc0;
    awlen = fault == "write_long" ? 8'd16 : 8'd3;
    awsize = fault == "write_size" ? 3'd3 : 3'd4;
    awburst = fault == "write_wrap" ? 2'b10 : 2'b01;
    repeat (fault == "write_many" ? 3 : 2) @(negedge clk);
    awvalid = 1'b0;
    answer = fault == "write_response";
    for (int beat = 0; beat < 8; beat++) begin
      wvalid = 1'b1;
      wlast = beat % 4 == (fault == "write_early" ? 2 : 3);
      @(negedge clk);
    end
    wvalid = 1'b0;
    answer = 1'b1;
    answer_response = fault == "write_exokay" ? 2'b01 : 2'b10;
    repeat (2) @(negedge clk);
    answer = 1'b0;
  endtask

  task automatic accesses;
    access = 1'b1;
    @(negedge clk) access = 1'b0;
    response = fault == "exokay" ? 2'b01 : 2'b10;
    {bvalid, dvalid} = 2'b11;
    @(negedge clk) {bvalid, dvalid} = {fault == "response", fault == "data"};
    @(negedge clk) {bvalid, dvalid} = 2'b00;
  endtask

  initial begin
    if ($value$plusargs("fault=%s", fault) == 0) fault = "none";
    valid = fault == "reset";
    repeat (3) @(negedge clk);
    valid = 1'b0;
    rst_n = 1'b1;
    @(negedge clk);
    waits();
    bursts();
    written();
    accesses();
    @(negedge clk);
    $display("no rule was broken");
    $finish;
  end
endmodule
