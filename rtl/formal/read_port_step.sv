// Each step of the read master, of any number of clients, from any state:
//   - the first client that asks is accepted when no request is split, or the last burst of that one goes out, and the port takes what it asks for;
//   - a burst goes out when the queue has room and no other one waits, whatever arready is: as many beats as the request, its page of 4 KiB and 16 allow;
//   - it waits unchanged; what is left of the request is what comes after it, and the queue is told whose it is and whether it ends the request;
//   - a beat goes to the client that the queue names, the last of a request marked, one with an error too; `reading` and `stray`.
// Order and number of all bursts and beats: proof read_port. The queue: proof fifo. CLIENTS = 3, DATA_BITS = 64, ADDRESS_BITS = 14, OUTSTANDING = 4.
//
// Clauses: Read master (docs/decode_unit.md)
// Engine: bmc 2
// Cut: fifo
// Cover: 2
// Complete: the request that is split, the burst that waits and the queue are all the state there is.
// Fault: hmlfc_read_port.sv / (!m_axi_arvalid || m_axi_arready) / m_axi_arready
// Fault: hmlfc_read_port.sv / request_ready = take ? granted / request_ready = any ? granted
// Fault: hmlfc_read_port.sv / & {10{granted[i]}} / & {10{granted[i] || i == 1}}
// Fault: hmlfc_read_port.sv / room = last_16 ? ~beat[3:0] : 4'd15 / room = 4'd15
// Fault: hmlfc_read_port.sv / {finished, client} / {finished, chosen}
// Fault: hmlfc_read_port.sv / any || busy || owner_valid / busy || owner_valid
`include "inside.svh"
module prove_read_port_step #(
  parameter integer CLIENTS = 3,
  parameter integer DATA_BITS = 64,
  parameter integer ADDRESS_BITS = 14,
  parameter integer OUTSTANDING = 4
) (
  input logic clk, input logic rst_n, input logic [CLIENTS-1:0] request_valid, input logic [CLIENTS*ADDRESS_BITS-1:0] request_address,
  input logic [CLIENTS*10-1:0] request_beats, input logic arready, input logic rvalid, input logic [DATA_BITS-1:0] rdata, input logic [1:0] rresp,
  input logic rlast
);
  localparam integer A = ADDRESS_BITS;
  localparam integer L = $clog2(DATA_BITS / 8);  // of the bytes of a beat
  localparam integer C = CLIENTS > 1 ? $clog2(CLIENTS) : 1;
  localparam integer P = 12 - L;
  logic [CLIENTS-1:0]   request_ready, data_valid;
  logic [DATA_BITS-1:0] data;
  logic                 data_last, data_error, reading, stray, arvalid, rready;
  logic [A-1:0]         araddr;
  logic [7:0]           arlen;
  logic [2:0]           arsize;
  logic [1:0]           arburst;
  hmlfc_read_port #(.CLIENTS(CLIENTS), .DATA_BITS(DATA_BITS), .ADDRESS_BITS(ADDRESS_BITS), .OUTSTANDING(OUTSTANDING)) dut (
    .clk(clk), .rst_n(rst_n), .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address),
    .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error), .reading(reading), .stray(stray),
    .m_axi_arvalid(arvalid), .m_axi_arready(arready), .m_axi_araddr(araddr), .m_axi_arlen(arlen), .m_axi_arsize(arsize), .m_axi_arburst(arburst),
    .m_axi_rvalid(rvalid), .m_axi_rready(rready), .m_axi_rdata(rdata), .m_axi_rresp(rresp), .m_axi_rlast(rlast));

  // The request that is split, from beat `beat` of `page` on, and what goes into the queue and is in front of it.
  `SEEN(1, \dut.busy )
  `SEEN(C, \dut.client )
  `SEEN(A-12, \dut.page )
  `SEEN(P, \dut.beat )
  `SEEN(10, \dut.left )
  `SEEN(1, \dut.bursts.in_valid )
  `SEEN(1, \dut.bursts.in_ready )
  `SEEN(C+1, \dut.bursts.in_data )
  `SEEN(1, \dut.bursts.out_valid )
  `SEEN(1, \dut.bursts.out_ready )
  `SEEN(C+1, \dut.bursts.out_data )
  wire           busy = \dut.busy ;
  wire           goes = \dut.bursts.in_valid ;  // a burst, to the channel and into the queue
  wire [A-L-1:0] place = {\dut.page , \dut.beat };
  wire [10:0]    beats = {1'b0, \dut.left } + 11'd1;

  // The burst.
  wire [10:0] of_page = (11'd1 << P) - \dut.beat ;
  wire [10:0] short = beats < of_page ? beats : of_page;
  wire [10:0] size = short < 16 ? short : 11'd16;
  wire        ends = size == beats;

  // Any client, and those before it.
  (* anyconst *) logic [C-1:0] who;
  wire [CLIENTS-1:0] before = request_valid & ~({CLIENTS{1'b1}} << who);
  wire               take = request_valid[who] && request_ready[who];
  wire [A-1:0]       asked = request_address[who*A +: A];
  wire [9:0]         asked_beats = request_beats[who*10 +: 10];
  wire               any_take = (request_valid & request_ready) != 0;

  // What the next clock must show.
  logic                 second = 1'b0;
  logic                 was_reset, was_busy, went, ended, took, any_took, waited, was_valid, last, error, mine;
  logic [A-L-1:0]       was_place, took_place;
  logic [10:0]          was_beats, was_size;
  logic [9:0]           took_beats;
  logic [C-1:0]         was_client;
  logic [A+7:0]         was_burst;
  logic [DATA_BITS-1:0] beat;
  always @(posedge clk) begin
    second <= 1'b1;
    {was_reset, was_busy, went, ended, took, any_took} <= {!rst_n, busy, goes, ends, take, any_take};
    {was_place, was_beats, was_size, was_client} <= {place, beats, size, \dut.client };
    {took_place, took_beats} <= {asked[A-1:L], asked_beats};
    {waited, was_burst} <= {arvalid && !arready, araddr, arlen};
    {was_valid, beat} <= {rvalid && \dut.bursts.out_valid , rdata};
    {last, error} <= {rlast && \dut.bursts.out_data [C], rresp[1]};
    mine <= \dut.bursts.out_data [C-1:0] == who;
  end

  always @* begin
    assume (who < CLIENTS && asked_beats != 0);
    assume (\dut.bursts.out_data [C-1:0] < CLIENTS);
    assert (rready && arsize == L && arburst == 1);
    assert (request_ready[who] == (request_valid[who] && before == 0 && (!busy || (goes && ends))));
    assert (goes == (busy && \dut.bursts.in_ready && (!arvalid || arready)));
    if (goes) assert (\dut.bursts.in_data == {ends, \dut.client });
    assert (\dut.bursts.out_ready == (rvalid && rlast));
    assert (reading == (busy || \dut.bursts.out_valid || request_valid != 0));
    assert (stray == (rvalid && !\dut.bursts.out_valid ));
    if (second && was_reset) assert (!busy && !arvalid && data_valid == 0);
    if (second && !was_reset) begin
      assert (busy == (any_took || (was_busy && !(went && ended))));
      if (took) assert ({place, beats} == {took_place, 1'b0, took_beats} && \dut.client == who);
      if (was_busy && !went) assert ({place, beats, \dut.client } == {was_place, was_beats, was_client});
      if (went && !ended) assert (place == (A-L)'(was_place + was_size) && beats == was_beats - was_size && \dut.client == was_client);
      assert (arvalid == (went || waited));
      if (went) assert (araddr[A-1:L] == was_place && araddr[L-1:0] == 0 && arlen == was_size - 11'd1);
      if (waited) assert ({araddr, arlen} == was_burst);
      assert (data_valid[who] == (was_valid && mine));
      if (data_valid[who]) assert ({data, data_last, data_error} == {beat, last, error});
    end
    cover (second && !was_reset && took && went && ended && was_size == 16);
    cover (second && !was_reset && went && !ended && was_size < 16);
  end
endmodule
