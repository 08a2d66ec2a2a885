// Plays a record of pins to a decode unit, such as a netlist after synthesis, and compares its outputs clock by clock (pin_player.sv).
//
// The order of the pins is that of the concatenations below. The netlist has the parameters of the unit that was recorded.
module pin_replay #(
    parameter int BLOCK_LOG2 = 1,
    parameter int AXI_DATA_BITS = 64,
    localparam int ADDRESS_BITS = 40,
    localparam int ANSWER_BITS = 3 * 16 << (2 * BLOCK_LOG2),
    localparam int INPUTS = 139 + AXI_DATA_BITS,
    localparam int OUTPUTS = 66 + ANSWER_BITS + ADDRESS_BITS
);
  logic clk;
  logic rst_n, request_valid, request_last, response_ready, ar_ready, r_valid, r_last, r_id;
  logic [63:0] request_data;
  logic [1:0] r_resp;
  logic [AXI_DATA_BITS-1:0] r_data;
  logic aw_valid, w_valid, b_ready, lite_ar_valid, lite_r_ready;
  logic [11:0] aw_addr, lite_ar_addr;
  logic [31:0] w_data;
  logic [3:0] w_strb;

  logic request_ready, response_valid, response_last, ar_valid, ar_id, r_ready, aw_ready, w_ready, b_valid, lite_ar_ready, lite_r_valid;
  logic [5:0] response_user;
  logic [ANSWER_BITS-1:0] response_data;
  logic [ADDRESS_BITS-1:0] ar_addr;
  logic [7:0] ar_len;
  logic [2:0] ar_size;
  logic [1:0] ar_burst, b_resp, lite_r_resp;
  logic [31:0] lite_r_data;

  hmlfc_decode_unit unit (
      .clk(clk),
      .rst_n(rst_n),
      .s_request_tvalid(request_valid),
      .s_request_tready(request_ready),
      .s_request_tdata(request_data),
      .s_request_tlast(request_last),
      .m_response_tvalid(response_valid),
      .m_response_tready(response_ready),
      .m_response_tdata(response_data),
      .m_response_tuser(response_user),
      .m_response_tlast(response_last),
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
      .active()
  );

  logic [INPUTS-1:0] inputs;
  logic [OUTPUTS-1:0] outputs;
  assign {rst_n, request_valid, request_last, request_data, response_ready, ar_ready, r_valid, r_last, r_resp, r_id, r_data, aw_valid, aw_addr, w_valid,
          w_data, w_strb, b_ready, lite_ar_valid, lite_ar_addr, lite_r_ready} = inputs;
  assign outputs = {
    request_ready, response_valid, response_last, response_user, response_data, ar_valid, ar_addr, ar_len, ar_size, ar_burst, ar_id, r_ready, aw_ready,
    w_ready, b_valid, b_resp, lite_ar_ready, lite_r_valid, lite_r_data, lite_r_resp
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
