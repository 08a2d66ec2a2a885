// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// fpga_system on the board ULX3S, whose pins have the board's names: the board's clock of 25 MHz and its USB serial
// port. The button FIRE1 resets; `wifi_gpio0` high keeps the board's other processor from configuring it anew.
module ulx3s #(
    parameter int SIZE_LOG2 = 16,
    parameter int CLOCKS_PER_BIT = 25,
    parameter int BLOCK_LOG2 = 2
) (
    input logic clk_25mhz,
    input logic btn_fire1,
    input logic ftdi_txd,
    output logic ftdi_rxd,
    output logic [3:0] led,
    output logic wifi_gpio0
);
  // Registers are 0 after configuration: the first clocks reset.
  logic [2:0] steady;
  always_ff @(posedge clk_25mhz) steady <= {steady[1:0], !btn_fire1};

  fpga_system #(.SIZE_LOG2(SIZE_LOG2), .CLOCKS_PER_BIT(CLOCKS_PER_BIT), .BLOCK_LOG2(BLOCK_LOG2)) system (
      .clk(clk_25mhz), .rst_n(steady[2]), .rx(ftdi_txd), .tx(ftdi_rxd), .led
  );
  assign wifi_gpio0 = 1'b1;
endmodule

`default_nettype wire
