// Plays a record of pins to a view unit, as pin_replay.sv does to a decode unit.
module view_pin_replay #(
    parameter int AXI_DATA_BITS = 64,
    localparam int ADDRESS_BITS = 40,
    localparam int INPUTS = 77 + AXI_DATA_BITS,
    localparam int OUTPUTS = 75 + 2 * ADDRESS_BITS + AXI_DATA_BITS + AXI_DATA_BITS / 8
);
  logic clk;
  logic rst_n, ar_ready, r_valid, r_last, r_id, write_aw_ready, write_w_ready, write_b_valid;
  logic [1:0] r_resp, write_b_resp;
  logic [AXI_DATA_BITS-1:0] r_data;
  logic aw_valid, w_valid, b_ready, lite_ar_valid, lite_r_ready;
  logic [11:0] aw_addr, lite_ar_addr;
  logic [31:0] w_data;
  logic [3:0] w_strb;

  logic ar_valid, ar_id, r_ready, aw_ready, w_ready, b_valid, lite_ar_ready, lite_r_valid;
  logic write_aw_valid, write_w_valid, write_w_last, write_b_ready, interrupt;
  logic [ADDRESS_BITS-1:0] ar_addr, write_aw_addr;
  logic [7:0] ar_len, write_aw_len;
  logic [2:0] ar_size, write_aw_size;
  logic [1:0] ar_burst, write_aw_burst, b_resp, lite_r_resp;
  logic [31:0] lite_r_data;
  logic [AXI_DATA_BITS-1:0] write_w_data;
  logic [AXI_DATA_BITS/8-1:0] write_w_strb;

  hmlfc_view_unit unit (
      .clk(clk),
      .rst_n(rst_n),
      .m_axi_arvalid(ar_valid),
      .m_axi_arready(ar_ready),
      .m_axi_araddr(ar_addr),
      .m_axi_arlen(ar_len),
      .m_axi_arsize(ar_size),
      .m_axi_arburst(ar_burst),
      .m_axi_arid(ar_id),
      .m_axi_rvalid(r_valid),
      .m_axi_rready(r_ready),
      .m_axi_rdata(r_data),
      .m_axi_rresp(r_resp),
      .m_axi_rlast(r_last),
      .m_axi_rid(r_id),
      .m_axi_awvalid(write_aw_valid),
      .m_axi_awready(write_aw_ready),
      .m_axi_awaddr(write_aw_addr),
      .m_axi_awlen(write_aw_len),
      .m_axi_awsize(write_aw_size),
      .m_axi_awburst(write_aw_burst),
      .m_axi_awid(),
      .m_axi_wvalid(write_w_valid),
      .m_axi_wready(write_w_ready),
      .m_axi_wdata(write_w_data),
      .m_axi_wstrb(write_w_strb),
      .m_axi_wlast(write_w_last),
      .m_axi_bvalid(write_b_valid),
      .m_axi_bready(write_b_ready),
      .m_axi_bresp(write_b_resp),
      .m_axi_bid(1'b0),
      .s_axil_awvalid(aw_valid),
      .s_axil_awready(aw_ready),
      .s_axil_awaddr(aw_addr),
      .s_axil_wvalid(w_valid),
      .s_axil_wready(w_ready),
      .s_axil_wdata(w_data),
      .s_axil_wstrb(w_strb),
      .s_axil_bvalid(b_valid),
      .s_axil_bready(b_ready),
      .s_axil_bresp(b_resp),
      .s_axil_arvalid(lite_ar_valid),
      .s_axil_arready(lite_ar_ready),
      .s_axil_araddr(lite_ar_addr),
      .s_axil_rvalid(lite_r_valid),
      .s_axil_rready(lite_r_ready),
      .s_axil_rdata(lite_r_data),
      .s_axil_rresp(lite_r_resp),
      .irq(interrupt),
      .active()
  );

  logic [INPUTS-1:0] inputs;
  logic [OUTPUTS-1:0] outputs;
  assign {rst_n, ar_ready, r_valid, r_last, r_resp, r_id, r_data, aw_valid, aw_addr, w_valid, w_data, w_strb, b_ready, lite_ar_valid, lite_ar_addr,
          lite_r_ready, write_aw_ready, write_w_ready, write_b_valid, write_b_resp} = inputs;
  assign outputs = {
    ar_valid, ar_addr, ar_len, ar_size, ar_burst, ar_id, r_ready, aw_ready, w_ready, b_valid, b_resp, lite_ar_ready, lite_r_valid, lite_r_data,
    lite_r_resp, write_aw_valid, write_aw_addr, write_aw_len, write_aw_size, write_aw_burst, write_w_valid, write_w_data, write_w_strb, write_w_last,
    write_b_ready, interrupt
  };

  pin_player #(
      .INPUTS(INPUTS),
      .OUTPUTS(OUTPUTS)
  ) player (
      .clk(clk),
      .inputs(inputs),
      .outputs(outputs)
  );
endmodule
