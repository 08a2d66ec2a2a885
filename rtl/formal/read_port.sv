// The read master with two clients and a memory that answers at any pace:
//   - a burst has at most 16 beats, does not cross 4 KiB, and does not change while it waits;
//   - the bursts are the accepted requests' beats, each once, in the order in which they were accepted;
//   - each request gets exactly its beats: they go to the client that asked, the last of them marked, those with an
//     error too.
// DATA_BITS = 64, OUTSTANDING = 4; requests of up to 1023 beats, of any number of bursts.
//
// Clauses: Read master (docs/decode_unit.md)
// Engine: induction 2 10
// Cover: 26
// Complete: the lists of requests and bursts are bound to the port's registers, so the induction needs no reachability.
module prove_read_port (
  input logic clk, input logic [1:0] request_valid, input logic [2*hmlfc_pkg::ADDRESS_BITS-1:0] request_address,
  input logic [19:0] request_beats, input logic arready, input logic rvalid, input logic [63:0] rdata,
      input logic [1:0] rresp
);
  localparam integer A = hmlfc_pkg::ADDRESS_BITS;
  logic         started = 1'b0;
  logic [1:0]   request_ready, data_valid;
  logic [63:0]  data;
  logic [1:0]   data_last, data_error;
  logic         arvalid, rready;
  logic [A-1:0] araddr;
  logic [7:0]   arlen;
  logic [2:0]   arsize;
  logic [1:0]   arburst;
  logic         rlast;
  hmlfc_read_port #(.CLIENTS(2), .DATA_BITS(64), .OUTSTANDING(4)) dut (
    .clk(clk), .rst_n(started), .requests({request_valid[1], request_address[A +: A], request_beats[19:10],
    request_valid[0], request_address[0 +: A], request_beats[9:0]}), .responses({request_ready[1], data_valid[1],
    data_last[1], data_error[1], request_ready[0], data_valid[0], data_last[0], data_error[0]}), .data(data),
    .reading(), .stray(), .m_axi_arvalid(arvalid), .m_axi_arready(arready), .m_axi_araddr(araddr), .m_axi_arlen(arlen),
    .m_axi_arsize(arsize), .m_axi_arburst(arburst), .m_axi_rvalid(rvalid), .m_axi_rready(rready), .m_axi_rdata(rdata),
    .m_axi_rresp(rresp), .m_axi_rlast(rlast));
  always @(posedge clk) started <= 1'b1;

  // The requests that were accepted and whose beats are not all asked for: at most two, the older first.
  wire take_0 = request_valid[0] && request_ready[0];
  wire take_1 = request_valid[1] && request_ready[1];
  wire take = take_0 || take_1;
  wire [A-1:0] take_address = take_0 ? request_address[0 +: A] : request_address[A +: A];
  wire [9:0]   take_beats = take_0 ? request_beats[9:0] : request_beats[19:10];
  logic [1:0]   asking;
  logic [A-1:0] address_0, address_1;
  logic [9:0]   beats_0, beats_1;
  logic         owner_0, owner_1;
  wire        ar = arvalid && arready;
  wire [9:0]  ar_beats = {2'd0, arlen} + 10'd1;
  wire        ar_ends = beats_0 == ar_beats;
  wire [1:0]  left = asking - {1'b0, ar && ar_ends};
  always @(posedge clk) begin
    if (!started) asking <= 2'd0;
    else begin
      asking <= left + {1'b0, take};
      if (ar && ar_ends) {address_0, beats_0, owner_0} <= {address_1, beats_1, owner_1};
      else if (ar) {address_0, beats_0} <= {address_0 + {ar_beats, 3'd0}, beats_0 - ar_beats};
      if (take && left == 0) {address_0, beats_0, owner_0} <= {take_address, take_beats, take_1};
      if (take && left != 0) {address_1, beats_1, owner_1} <= {take_address, take_beats, take_1};
    end
  end

  // The memory: bursts that it took, their beats still to come, owner and whether the request ends with them.
  logic [2:0]  bursts;
  logic [47:0] queue;  // eight of {ends, owner, arlen[3:0]}, the oldest low
  wire [5:0]  front = queue[5:0];
  logic [3:0]  beat;
  wire        ends_burst = rvalid && rlast;
  wire [2:0]  bursts_left = bursts - {2'd0, ends_burst};
  wire [47:0] queue_left = ends_burst ? queue >> 6 : queue;
  assign rlast = beat == front[3:0];
  always @(posedge clk) begin
    if (!started) {bursts, beat} <= 7'd0;
    else begin
      bursts <= bursts_left + {2'd0, ar};
      queue <= (queue_left & ~(48'h3f << (6 * bursts_left))) |
          (48'({ar_ends, owner_0, arlen[3:0]}) << (6 * bursts_left));
      if (rvalid) beat <= rlast ? 4'd0 : beat + 4'd1;
    end
  end

  // What the clients get: a clock after each beat, the beat.
  logic        due, due_owner, due_last, due_error;
  logic [63:0] due_data;
  always @(posedge clk) begin
    due <= started && rvalid;
    {due_owner, due_last, due_error, due_data} <= {front[4], rlast && front[5], rresp[1], rdata};
  end

  // The same in the port's registers: the request that is being split, and the queue of bursts with the one that waits.
  (* hierconn *) wire \dut.busy ;
  (* hierconn *) wire \dut.client ;
  (* hierconn *) wire [A-13:0] \dut.page ;
  (* hierconn *) wire [8:0] \dut.beat ;
  (* hierconn *) wire [9:0] \dut.left ;
  (* hierconn *) wire [1:0] \dut.bursts.storage.words[0] ;
  (* hierconn *) wire [1:0] \dut.bursts.storage.words[1] ;
  (* hierconn *) wire [1:0] \dut.bursts.storage.words[2] ;
  (* hierconn *) wire [1:0] \dut.bursts.storage.words[3] ;
  (* hierconn *) wire [2:0] \dut.bursts.taken ;
  (* hierconn *) wire [2:0] \dut.bursts.written ;
  (* hierconn *) wire [1:0] \dut.bursts.out_data ;
  wire [7:0]  storage = {\dut.bursts.storage.words[3] , \dut.bursts.storage.words[2] , \dut.bursts.storage.words[1] ,
      \dut.bursts.storage.words[0] };
  wire [7:0]  owners = 8'({storage, storage} >> {\dut.bursts.taken [1:0], 1'b0});  // {ends, owner}, the oldest low
  wire [2:0]  count = \dut.bursts.written - \dut.bursts.taken ;
  wire [A+10:0] splitting = {\dut.page , \dut.beat , 3'd0, \dut.left + 10'd1, \dut.client };

  logic         waiting;
  logic [A+7:0] waiting_burst;
  logic [1:0]   waiting_request;
  logic [2*A-1:0] waiting_address;
  logic [19:0]  waiting_beats;
  always @(posedge clk) begin
    waiting <= started && arvalid && !arready;
    waiting_burst <= {araddr, arlen};
    waiting_request <= started ? request_valid & ~request_ready : 2'd0;
    {waiting_address, waiting_beats} <= {request_address, request_beats};
  end

  always @* begin
    // The contract of clients and memory.
    if (!started) assume (request_valid == 0);
    assume (request_beats[9:0] != 0 && request_beats[19:10] != 0);
    assume (request_address[2:0] == 0 && request_address[A +: 3] == 0);
    if (rvalid) assume (started && bursts != 0);
    if (started && waiting_request[0])
      assume (request_valid[0] && request_address[0 +: A] == waiting_address[0 +: A] &&
          request_beats[9:0] == waiting_beats[9:0]);
    if (started && waiting_request[1])
      assume (request_valid[1] && request_address[A +: A] == waiting_address[A +: A] &&
          request_beats[19:10] == waiting_beats[19:10]);

    if (started) begin
      assert (request_ready != 2'b11 && (request_ready & ~request_valid) == 0);
      assert (rready);
      assert (asking != 3);
      if (arvalid) begin
        assert (arlen <= 15 && arburst == 1 && arsize == 3);
        assert ({4'd0, araddr[11:3]} + {5'd0, arlen} <= 511);
        assert (asking != 0 && araddr == address_0 && ar_beats <= beats_0);
      end

      assert (count <= 4 && bursts <= 4 && count == bursts + {2'd0, arvalid});
      if (count != 0) assert (\dut.bursts.out_data == owners[1:0]);
      for (integer k = 0; k < 4; k = k + 1) if (k < bursts) assert (owners[2*k +: 2] == queue[6*k+4 +: 2]);
      if (arvalid) assert (2'(owners >> {bursts[1:0], 1'b0}) == {ar_ends, owner_0});
      assert (bursts == 0 ? beat == 0 : beat <= front[3:0]);
      assert (asking == {1'b0, arvalid && ar_ends} + {1'b0, \dut.busy });
      if (arvalid && !ar_ends) assert (\dut.busy );
      if (asking != 0) assert (beats_0 != 0);
      if (asking == 2) assert (beats_1 != 0);
      if (\dut.busy )
        assert (splitting == (!arvalid ? {address_0, beats_0, owner_0} : ar_ends ? {address_1, beats_1, owner_1}
                              : {address_0 + {1'b0, ar_beats, 3'd0}, beats_0 - ar_beats, owner_0}));
    end
  end
  logic second = 1'b0;
  logic goes_on = 1'b0;
  always @(posedge clk) begin
    second <= started;
    if (second) begin
      if (waiting) assert (arvalid && {araddr, arlen} == waiting_burst);
      assert (data_valid == (due ? (due_owner ? 2'b10 : 2'b01) : 2'b00));
      if (due) assert (data == due_data && data_last == {2{due_last}} && data_error == {2{due_error}});
    end
    // A request of two bursts ends, of which the second has 16 beats.
    cover (second && ends_burst && front[5] && front[3:0] == 15 && goes_on);
    if (ends_burst) goes_on <= !front[5];
  end
endmodule
