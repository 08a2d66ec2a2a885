// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// The rules of axi_*_assertions.sv at the pins of hmlfc_view_unit and of the DMA in it, by bind. Reads have two IDs:
// those of the decode unit are checked at its own pins.
bind hmlfc_view_dma axi_write_assertions #(
    .NAME("view_dma writes"), .ADDRESS_BITS(ADDRESS_BITS), .DATA_BITS(AXI_DATA_BITS), .MAX_BEATS(512 / AXI_DATA_BITS)
) write_rules (
    .clk, .rst_n, .awvalid(m_axi_awvalid), .awready(m_axi_awready), .awaddr(m_axi_awaddr), .awlen(m_axi_awlen),
    .awsize(m_axi_awsize), .awburst(m_axi_awburst), .wvalid(m_axi_wvalid), .wready(m_axi_wready), .wdata(m_axi_wdata),
    .wstrb(m_axi_wstrb), .wlast(m_axi_wlast), .bvalid(m_axi_bvalid), .bready(m_axi_bready), .bresp(m_axi_bresp));
bind hmlfc_view_dma axi_channel_assertions #(
    .NAME("view_dma requests"), .BITS(64)
) request_rules (
    .clk, .rst_n(unit_rst_n), .valid(m_request_tvalid), .ready(m_request_tready), .payload(m_request_tdata));
bind hmlfc_view_dma axi_channel_assertions #(
    .NAME("view_dma descriptors"), .BITS(ADDRESS_BITS + 8)
) fetch_rules (
    .clk, .rst_n(unit_rst_n), .valid(fetch_arvalid), .ready(fetch_arready), .payload({fetch_araddr, fetch_arlen}));
bind hmlfc_view_unit axi_channel_assertions #(
    .NAME("view_unit reads"), .BITS(ADDRESS_BITS + 9)
) read_rules (
    .clk, .rst_n, .valid(m_axi_arvalid), .ready(m_axi_arready), .payload({m_axi_araddr, m_axi_arlen, m_axi_arid}));
bind hmlfc_view_rows axi_channel_assertions #(
    .NAME("view_rows rows"), .BITS(2 * ADDRESS_BITS + BLOCK_LOG2 + 630)
) row_rules (
    .clk, .rst_n, .valid(out_valid), .ready(out_ready),
    .payload({out_entry, out_line, out_line_next, out_data, out_strobe, out_strobe_next, out_wraps}));
bind hmlfc_view_writer hmlfc_line_assertions #(.NAME("view_writer")) lines_have (
    .clk, .rst_n, .line_valid, .line_strobe);
bind hmlfc_strip_writer hmlfc_line_assertions #(.NAME("strip_writer")) lines_have (
    .clk, .rst_n, .line_valid, .line_strobe);
bind hmlfc_write_port hmlfc_line_assertions #(.NAME("write_port")) lines_have (
    .clk, .rst_n, .line_valid, .line_strobe);
bind hmlfc_view_unit axi_lite_assertions #(
    .NAME("view_unit s_axil")
) register_rules (
    .clk, .rst_n, .awvalid(s_axil_awvalid), .awready(s_axil_awready), .awaddr(s_axil_awaddr), .wvalid(s_axil_wvalid),
    .wready(s_axil_wready), .wdata(s_axil_wdata), .wstrb(s_axil_wstrb), .bvalid(s_axil_bvalid), .bready(s_axil_bready),
    .bresp(s_axil_bresp), .arvalid(s_axil_arvalid), .arready(s_axil_arready), .araddr(s_axil_araddr),
    .rvalid(s_axil_rvalid), .rready(s_axil_rready), .rdata(s_axil_rdata), .rresp(s_axil_rresp));

`default_nettype wire
