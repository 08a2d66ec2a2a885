// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Shares one AXI4 read master between CLIENTS.
//
// A client asks for `beats` whole beats from a beat-aligned address; the port splits them into INCR
// bursts of at most 16 beats that do not cross 4 KiB. All bursts have ID 0, so data come back in
// the order of the requests, and a queue of bursts gives the client of each.
//
// Clients: hmlfc_pkg::read_request_t and read_response_t of each, and the beats. A client always takes its beats: it
// asks only for what it has room for.
// `reading`: a request waits or a beat is to come. `stray`: a beat comes and no burst is in flight, as after a reset
// that the memory did not have.
// Clients of lower number go first; a client that asks without end would starve those above it,
// which none does, as all of them wait for their data.
module hmlfc_read_port #(
    parameter int CLIENTS = 2,
    parameter int DATA_BITS = 128,
    parameter int OUTSTANDING = 16,
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS,
    localparam int READ_REQUEST_BITS = hmlfc_pkg::READ_REQUEST_BITS,
    localparam int READ_RESPONSE_BITS = hmlfc_pkg::READ_RESPONSE_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic [CLIENTS*READ_REQUEST_BITS-1:0] requests,
    output logic [CLIENTS*READ_RESPONSE_BITS-1:0] responses,
    output logic [DATA_BITS-1:0] data,
    output logic reading,
    output logic stray,

    output logic m_axi_arvalid,
    input logic m_axi_arready,
    output logic [ADDRESS_BITS-1:0] m_axi_araddr,
    output logic [7:0] m_axi_arlen,
    output logic [2:0] m_axi_arsize,
    output logic [1:0] m_axi_arburst,
    input logic m_axi_rvalid,
    output logic m_axi_rready,
    input logic [DATA_BITS-1:0] m_axi_rdata,
    input logic [1:0] m_axi_rresp,
    input logic m_axi_rlast
);

  localparam int BYTES = DATA_BITS / 8;
  localparam int BEAT_LOG2 = $clog2(BYTES);
  localparam int CLIENT_BITS = CLIENTS > 1 ? $clog2(CLIENTS) : 1;
  localparam int PAGE_BITS = 12 - BEAT_LOG2;  // of the number of a beat in its 4 KiB

  // The request that is being split: what is left of it, from beat `beat` of page `page` on.
  logic busy;
  logic [CLIENT_BITS-1:0] client;
  logic [ADDRESS_BITS-13:0] page;
  logic [PAGE_BITS-1:0] beat;
  logic [9:0] left;  // beats less 1

  // The next burst, by its beats less 1: 16, or as many as the page or the request has left. The number of beats behind
  // `beat` in its page is ~beat.
  wire last_16 = &beat[PAGE_BITS-1:4];
  wire [3:0] room = last_16 ? ~beat[3:0] : 4'd15;
  wire [4:0] last = {1'b0, beat[3:0]} + {1'b0, left[3:0]};
  wire ends = left[9:4] == 0 && !(last_16 && last[4]);
  wire [3:0] burst = ends ? left[3:0] : room;

  // The first client that asks, and what it asks for.
  logic [CLIENTS-1:0] asking, granted, taken, data_valid;
  logic data_last, data_error;
  for (genvar i = 0; i < CLIENTS; i++) begin : g_client
    assign asking[i] = requests[(i+1)*READ_REQUEST_BITS-1];  // read_request_t::valid
    assign responses[i*READ_RESPONSE_BITS+:READ_RESPONSE_BITS] = {taken[i], data_valid[i], data_last, data_error};
  end
  assign granted = asking & ~(asking - 1'b1);
  wire any = asking != 0;
  logic [CLIENT_BITS-1:0] chosen;
  logic [ADDRESS_BITS-1:0] chosen_address;
  logic [9:0] chosen_beats;
  always_comb begin
    chosen = '0;
    {chosen_address, chosen_beats} = '0;
    for (int i = 0; i < CLIENTS; i++) begin
      chosen = chosen | (CLIENT_BITS'(i) & {CLIENT_BITS{granted[i]}});
      {chosen_address, chosen_beats} = {chosen_address, chosen_beats} |
          (requests[i*READ_REQUEST_BITS+:ADDRESS_BITS+10] & {(ADDRESS_BITS + 10) {granted[i]}});
    end
  end

  logic queue_ready, issue;
  assign issue = busy && queue_ready && (!m_axi_arvalid || m_axi_arready);
  wire finished = issue && ends;
  wire take = any && (!busy || finished);
  wire free = !busy || ends;  // the burst that is issued leaves nothing, if there is one

  assign taken = take ? granted : '0;

  always_ff @(posedge clk) begin
    if (!busy || issue) begin
      if (free) begin
        client <= chosen;
        {page, beat} <= chosen_address[ADDRESS_BITS-1:BEAT_LOG2];
        left <= chosen_beats - 10'd1;
      end else begin
        page <= page + (ADDRESS_BITS - 12)'(last_16);
        beat <= beat + PAGE_BITS'(room) + 1'b1;
        left <= left - 10'(room) - 10'd1;
      end
    end
    if (!rst_n) busy <= 1'b0;
    else busy <= take || (busy && !finished);
  end

  always_ff @(posedge clk) begin
    if (!rst_n) m_axi_arvalid <= 1'b0;
    else if (issue) m_axi_arvalid <= 1'b1;
    else if (m_axi_arready) m_axi_arvalid <= 1'b0;
    if (issue) begin
      m_axi_araddr <= {page, beat, BEAT_LOG2'(0)};
      m_axi_arlen <= 8'(burst);
    end
  end
  assign m_axi_arsize = 3'(BEAT_LOG2);
  assign m_axi_arburst = 2'b01;

  // Whose burst comes next, and whether it ends the request.
  logic owner_valid, owner_ends;
  logic [CLIENT_BITS-1:0] owner;
  hmlfc_fifo #(.WIDTH(CLIENT_BITS + 1), .DEPTH(OUTSTANDING)) bursts (
      .clk, .rst_n, .in_valid(issue), .in_ready(queue_ready), .in_data({finished, client}), .out_valid(owner_valid),
      .out_ready(m_axi_rvalid && m_axi_rlast), .out_data({owner_ends, owner}), .count()
  );

  assign m_axi_rready = 1'b1;
  assign reading = any || busy || owner_valid;
  assign stray = m_axi_rvalid && !owner_valid;
  always_ff @(posedge clk) begin
    data_valid <= '0;
    if (rst_n && m_axi_rvalid && owner_valid) data_valid[owner] <= 1'b1;
    data <= m_axi_rdata;
    data_last <= m_axi_rlast && owner_ends;
    data_error <= m_axi_rresp[1];
  end

endmodule

`default_nettype wire
