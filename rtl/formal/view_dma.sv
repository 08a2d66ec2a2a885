// In the DMA each output of a part reaches the inputs that it is for, in the same clock: the positions of the scan become requests, or those of strips where a
// descriptor asks for residuals; answers go to the writer of pixels or to that of strips; of lines for memory a status goes first, then a strip's.
// Whatever the parts put out.
//
// Clauses: Descriptors (docs/view_unit.md)
// Engine: bmc 1
// Cut: view_registers view_fetch view_queue view_scan strip_scan view_place view_writer strip_writer write_port
// Complete: it has no register of its own.
// Fault: hmlfc_view_dma.sv / view.residuals ? strip_by : by / by
// Fault: hmlfc_view_dma.sv / .place_valid(place_valid && !view.residuals) / .place_valid(place_valid)
// Fault: hmlfc_view_dma.sv / .line_ready(port_ready && !status_valid) / .line_ready(port_ready)
// Fault: hmlfc_view_dma.sv / written = writer_empty && strip_empty && port_idle / written = writer_empty && port_idle
`include "inside.svh"
`define RESET(name) (* hierconn *) wire name ; always @* assert (name == rst_n);
module prove_view_dma #(
  parameter integer BLOCK_LOG2 = 1,
  parameter integer AXI_DATA_BITS = 64,
  localparam integer W = AXI_DATA_BITS,
  localparam integer S = 48 << (2 * BLOCK_LOG2)  // of an answer
) (
  input logic clk, input logic rst_n, input logic request_ready, input logic response_valid, input logic [S-1:0] response, input logic [5:0] response_status,
  input logic fetch_arready, input logic fetch_rvalid, input logic [W-1:0] fetch_rdata, input logic [1:0] fetch_rresp, input logic fetch_rlast,
  input logic awready, input logic wready, input logic bvalid, input logic [1:0] bresp, input logic s_awvalid, input logic [11:0] s_awaddr,
  input logic s_wvalid, input logic [31:0] s_wdata, input logic [3:0] s_wstrb, input logic s_bready, input logic s_arvalid, input logic [11:0] s_araddr,
  input logic s_rready
);
  localparam integer A = hmlfc_pkg::ADDRESS_BITS, N = hmlfc_pkg::BLOCK_BITS, V = 194, P = 76;
  logic request_valid, response_ready, fetch_arvalid, awvalid, wvalid, wlast, bready, s_awready, s_wready, s_bvalid, s_arready, s_rvalid, irq, busy;
  logic [63:0]  request;
  logic [A-1:0] fetch_araddr, awaddr;
  logic [7:0]   fetch_arlen, awlen;
  logic [2:0]   awsize;
  logic [1:0]   awburst;
  logic [W-1:0] wdata;
  logic [W/8-1:0] wstrb;
  logic [31:0]  s_rdata;
  hmlfc_view_dma #(.BLOCK_LOG2(BLOCK_LOG2), .AXI_DATA_BITS(AXI_DATA_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .m_request_tvalid(request_valid), .m_request_tready(request_ready), .m_request_tdata(request),
    .s_response_tvalid(response_valid), .s_response_tready(response_ready), .s_response_tdata(response), .s_response_tuser(response_status),
    .fetch_arvalid(fetch_arvalid), .fetch_arready(fetch_arready), .fetch_araddr(fetch_araddr), .fetch_arlen(fetch_arlen), .fetch_rvalid(fetch_rvalid),
    .fetch_rdata(fetch_rdata), .fetch_rresp(fetch_rresp), .fetch_rlast(fetch_rlast), .m_axi_awvalid(awvalid), .m_axi_awready(awready),
    .m_axi_awaddr(awaddr), .m_axi_awlen(awlen), .m_axi_awsize(awsize), .m_axi_awburst(awburst), .m_axi_wvalid(wvalid), .m_axi_wready(wready),
    .m_axi_wdata(wdata), .m_axi_wstrb(wstrb), .m_axi_wlast(wlast), .m_axi_bvalid(bvalid), .m_axi_bready(bready), .m_axi_bresp(bresp),
    .s_axil_awvalid(s_awvalid), .s_axil_awready(s_awready), .s_axil_awaddr(s_awaddr), .s_axil_wvalid(s_wvalid), .s_axil_wready(s_wready),
    .s_axil_wdata(s_wdata), .s_axil_wstrb(s_wstrb), .s_axil_bvalid(s_bvalid), .s_axil_bready(s_bready), .s_axil_arvalid(s_arvalid),
    .s_axil_arready(s_arready), .s_axil_araddr(s_araddr), .s_axil_rvalid(s_rvalid), .s_axil_rready(s_rready), .s_axil_rdata(s_rdata), .irq(irq),
    .busy(busy));
  `RESET(\dut.registers.rst_n )
  `RESET(\dut.fetch.rst_n )
  `RESET(\dut.queue.rst_n )
  `RESET(\dut.scan.rst_n )
  `RESET(\dut.strip_scan.rst_n )
  `RESET(\dut.places.rst_n )
  `RESET(\dut.writer.rst_n )
  `RESET(\dut.strips.rst_n )
  `RESET(\dut.port.rst_n )
  // Registers and descriptors.
  `PORT(1, s_awvalid, \dut.registers.s_axil_awvalid )
  `PORT(1, s_awready, \dut.registers.s_axil_awready )
  `PORT(12, s_awaddr, \dut.registers.s_axil_awaddr )
  `PORT(1, s_wvalid, \dut.registers.s_axil_wvalid )
  `PORT(1, s_wready, \dut.registers.s_axil_wready )
  `PORT(32, s_wdata, \dut.registers.s_axil_wdata )
  `PORT(4, s_wstrb, \dut.registers.s_axil_wstrb )
  `PORT(1, s_bvalid, \dut.registers.s_axil_bvalid )
  `PORT(1, s_bready, \dut.registers.s_axil_bready )
  `PORT(1, s_arvalid, \dut.registers.s_axil_arvalid )
  `PORT(1, s_arready, \dut.registers.s_axil_arready )
  `PORT(12, s_araddr, \dut.registers.s_axil_araddr )
  `PORT(1, s_rvalid, \dut.registers.s_axil_rvalid )
  `PORT(1, s_rready, \dut.registers.s_axil_rready )
  `PORT(32, s_rdata, \dut.registers.s_axil_rdata )
  `PORT(1, irq, \dut.registers.irq )
  `SEEN(1, \dut.registers.irq_changes )
  `LINK(1, \dut.registers.enable , \dut.queue.enable )
  `LINK(1, \dut.registers.disable_queue , \dut.queue.disable_queue )
  `LINK(1, \dut.registers.drain , \dut.queue.drain )
  `LINK(1, \dut.registers.abort_view , \dut.queue.abort_view )
  `LINK(A, \dut.registers.ring_base , \dut.queue.ring_base )
  `LINK(A, \dut.registers.status_base , \dut.queue.status_base )
  `LINK(16, \dut.registers.ring_size , \dut.queue.ring_size )
  `LINK(16, \dut.registers.producer , \dut.queue.producer )
  `LINK(16, \dut.registers.consumer , \dut.queue.consumer )
  `LINK(6, \dut.registers.status , \dut.queue.status )
  `LINK(4, \dut.registers.events , \dut.queue.events )
  `LINK(1, \dut.fetch.start , \dut.queue.fetch_start )
  `LINK(A, \dut.fetch.address , \dut.queue.fetch_address )
  `LINK(1, \dut.fetch.done , \dut.queue.fetched )
  `LINK(32, \dut.fetch.tag , \dut.queue.tag )
  `LINK(1, \dut.fetch.refused , \dut.queue.refused )
  `LINK(1, \dut.fetch.failed , \dut.queue.fetch_failed )
  `PORT(1, fetch_arvalid, \dut.fetch.ar_valid )
  `PORT(1, fetch_arready, \dut.fetch.ar_ready )
  `PORT(A, fetch_araddr, \dut.fetch.ar_address )
  `PORT(8, fetch_arlen, \dut.fetch.ar_len )
  `PORT(1, fetch_rvalid, \dut.fetch.r_valid )
  `PORT(W, fetch_rdata, \dut.fetch.r_data )
  `PORT(1, fetch_rresp[1], \dut.fetch.r_error )
  `PORT(1, fetch_rlast, \dut.fetch.r_last )
  // Requests: view, its blocks, the level at which they stop, and the plane, 3 for RGB.
  `SEEN(V, \dut.fetch.view )
  hmlfc_pkg::view_t view;
  assign view = \dut.fetch.view ;
  `SEEN(1, \dut.queue.view_start )
  `SEEN(1, \dut.queue.ask )
  `SEEN(N, \dut.scan.bx )
  `SEEN(N, \dut.scan.by )
  `SEEN(1, \dut.scan.valid )
  `SEEN(1, \dut.scan.has_block )
  `SEEN(N, \dut.strip_scan.bx )
  `SEEN(N, \dut.strip_scan.by )
  `SEEN(1, \dut.strip_scan.valid )
  `SEEN(1, \dut.strip_scan.strip_ends )
  wire [N-1:0] x = view.residuals ? \dut.strip_scan.bx : \dut.scan.bx ;
  wire [N-1:0] y = view.residuals ? \dut.strip_scan.by : \dut.scan.by ;
  wire         passes = \dut.queue.ask && request_ready;
  `PORT(1, \dut.queue.view_start , \dut.scan.start )
  `PORT(1, \dut.queue.view_start , \dut.strip_scan.start )
  `PORT(4*N, view.blocks, \dut.scan.blocks )
  `PORT(V, view, \dut.strip_scan.view )
  `PORT(1, (\dut.queue.ask && !view.residuals && (request_ready || !\dut.scan.has_block )), \dut.scan.advance )
  `PORT(1, (passes && view.residuals), \dut.strip_scan.advance )
  `PORT(1, (request_valid && request_ready), \dut.queue.asked )
  `PORT(1, ((request_valid && !request_ready) || (view.residuals && \dut.strip_scan.valid && !(request_ready && \dut.strip_scan.strip_ends ))), \dut.queue.request_waits )
  `PORT(1, (response_valid && response_ready), \dut.queue.answered )
  // Answers.
  `SEEN(1, \dut.places.done )
  `SEEN(1, \dut.strips.done )
  `SEEN(1, \dut.places.place_valid )
  `SEEN(1, \dut.writer.block_error )
  `SEEN(1, \dut.strips.block_error )
  `SEEN(6, \dut.writer.error )
  `SEEN(1, \dut.writer.answer_ready )
  `SEEN(1, \dut.strips.answer_ready )
  `SEEN(1, \dut.writer.empty )
  `SEEN(1, \dut.strips.empty )
  `SEEN(1, \dut.port.idle )
  `PORT(1, \dut.queue.view_start , \dut.places.start )
  `PORT(V, view, \dut.places.view )
  `LINK(1, \dut.places.place_ready , \dut.writer.place_ready )
  `LINK(P, \dut.places.place , \dut.writer.place )
  `PORT(1, (\dut.places.place_valid && !view.residuals), \dut.writer.place_valid )
  `PORT(V, view, \dut.writer.view )
  `PORT(1, response_valid, \dut.writer.answer_valid )
  `PORT(S, response, \dut.writer.answer )
  `PORT(6, response_status, \dut.writer.answer_status )
  `PORT(1, \dut.queue.view_start , \dut.strips.start )
  `PORT(V, view, \dut.strips.view )
  `PORT(1, response_valid, \dut.strips.answer_valid )
  `PORT(S/3, response[S/3-1:0], \dut.strips.answer )
  `PORT(6, response_status, \dut.strips.answer_status )
  `SEEN(1, \dut.queue.flush )
  `PORT(1, \dut.queue.flush , \dut.writer.flush )
  `PORT(1, \dut.queue.flush , \dut.strips.flush )
  `PORT(1, (view.residuals ? \dut.strips.done : \dut.places.done ), \dut.queue.placed )
  `PORT(1, (view.residuals ? \dut.strips.block_error : \dut.writer.block_error ), \dut.queue.block_error )
  `PORT(6, (view.residuals ? response_status : \dut.writer.error ), \dut.queue.error )
  `PORT(1, (\dut.writer.empty && \dut.strips.empty && \dut.port.idle ), \dut.queue.written )
  // Lines.
  `SEEN(1, \dut.queue.line_valid )
  `SEEN(1, \dut.strips.line_valid )
  `SEEN(1, \dut.writer.line_valid )
  `SEEN(A-6, \dut.queue.line )
  `SEEN(512, \dut.queue.line_data )
  `SEEN(64, \dut.queue.line_strobe )
  `SEEN(A-6, \dut.strips.line )
  `SEEN(512, \dut.strips.line_data )
  `SEEN(64, \dut.strips.line_strobe )
  `SEEN(A-6, \dut.writer.line )
  `SEEN(512, \dut.writer.line_data )
  `SEEN(64, \dut.writer.line_strobe )
  `SEEN(1, \dut.port.line_ready )
  `SEEN(A-6, \dut.port.line )
  `SEEN(512, \dut.port.line_data )
  `SEEN(64, \dut.port.line_strobe )
  wire [A+569:0] of_queue = {\dut.queue.line , \dut.queue.line_data , \dut.queue.line_strobe };
  wire [A+569:0] of_strips = {\dut.strips.line , \dut.strips.line_data , \dut.strips.line_strobe };
  wire [A+569:0] of_writer = {\dut.writer.line , \dut.writer.line_data , \dut.writer.line_strobe };
  `PORT(1, (\dut.queue.line_valid || \dut.strips.line_valid || \dut.writer.line_valid ), \dut.port.line_valid )
  `PORT(1, \dut.port.line_ready , \dut.queue.line_ready )
  `PORT(1, (\dut.port.line_ready && !\dut.queue.line_valid ), \dut.strips.line_ready )
  `PORT(1, (\dut.port.line_ready && !\dut.queue.line_valid && !\dut.strips.line_valid ), \dut.writer.line_ready )
  `LINK(1, \dut.port.failed , \dut.queue.write_failed )
  `PORT(1, awvalid, \dut.port.m_axi_awvalid )
  `PORT(1, awready, \dut.port.m_axi_awready )
  `PORT(A, awaddr, \dut.port.m_axi_awaddr )
  `PORT(8, awlen, \dut.port.m_axi_awlen )
  `PORT(3, awsize, \dut.port.m_axi_awsize )
  `PORT(2, awburst, \dut.port.m_axi_awburst )
  `PORT(1, wvalid, \dut.port.m_axi_wvalid )
  `PORT(1, wready, \dut.port.m_axi_wready )
  `PORT(W, wdata, \dut.port.m_axi_wdata )
  `PORT(W/8, wstrb, \dut.port.m_axi_wstrb )
  `PORT(1, wlast, \dut.port.m_axi_wlast )
  `PORT(1, bvalid, \dut.port.m_axi_bvalid )
  `PORT(1, bready, \dut.port.m_axi_bready )
  `PORT(2, bresp, \dut.port.m_axi_bresp )
  `SEEN(1, \dut.queue.busy )
  always @* begin
    assert (request_valid == (\dut.queue.ask && (view.residuals ? \dut.strip_scan.valid : \dut.scan.valid && \dut.scan.has_block )));
    assert (request == {3'd0, view.residuals, view.stop_level, view.format >= 4 ? 2'd3 : view.format[1:0], 2'd0, y, 2'd0, x, view.col, view.row});
    assert (response_ready == (view.residuals ? \dut.strips.answer_ready : \dut.writer.answer_ready ));
    assert ({\dut.port.line , \dut.port.line_data , \dut.port.line_strobe } ==
            (\dut.queue.line_valid ? of_queue : \dut.strips.line_valid ? of_strips : of_writer));
    assert (busy == (\dut.queue.busy || !\dut.port.idle || !s_awready || !s_wready || s_bvalid || s_rvalid || \dut.registers.irq_changes ));
  end
endmodule
