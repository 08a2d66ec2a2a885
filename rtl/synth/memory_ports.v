// A memory with clocked reads as a macro: its ports begin and end paths, as flip-flops do. Small memories stay.
module \$mem_v2 (RD_CLK, RD_EN, RD_ARST, RD_SRST, RD_ADDR, RD_DATA, WR_CLK, WR_EN, WR_ADDR, WR_DATA);
  parameter MEMID = "";
  parameter SIZE = 0, OFFSET = 0, ABITS = 0, WIDTH = 0, INIT = 0;
  parameter RD_PORTS = 0, RD_CLK_ENABLE = 0, RD_CLK_POLARITY = 0, RD_TRANSPARENCY_MASK = 0, RD_COLLISION_X_MASK = 0, RD_WIDE_CONTINUATION = 0;
  parameter RD_CE_OVER_SRST = 0, RD_ARST_VALUE = 0, RD_SRST_VALUE = 0, RD_INIT_VALUE = 0;
  parameter WR_PORTS = 0, WR_CLK_ENABLE = 0, WR_CLK_POLARITY = 0, WR_PRIORITY_MASK = 0, WR_WIDE_CONTINUATION = 0;
  input [RD_PORTS-1:0] RD_CLK, RD_EN, RD_ARST, RD_SRST;
  input [RD_PORTS*ABITS-1:0] RD_ADDR;
  output [RD_PORTS*WIDTH-1:0] RD_DATA;
  input [WR_PORTS-1:0] WR_CLK;
  input [WR_PORTS*WIDTH-1:0] WR_EN;
  input [WR_PORTS*ABITS-1:0] WR_ADDR;
  input [WR_PORTS*WIDTH-1:0] WR_DATA;
  wire _TECHMAP_FAIL_ = SIZE * WIDTH <= 512 || ~&RD_CLK_ENABLE[RD_PORTS-1:0];
  localparam INS = RD_PORTS * (ABITS + 1) + WR_PORTS * (2 * WIDTH + ABITS);
  wire [INS-1:0] ins = {RD_EN, RD_ADDR, WR_EN, WR_ADDR, WR_DATA};
  genvar i;
  generate
    for (i = 0; i < INS; i = i + 1) begin : in
      (* keep *) DFFPOSX1 bit_in (.CLK(WR_CLK[0]), .D(ins[i]), .Q());
    end
    for (i = 0; i < RD_PORTS * WIDTH; i = i + 1) begin : out
      (* keep *) DFFPOSX1 bit_out (.CLK(WR_CLK[0]), .D(ins[0]), .Q(RD_DATA[i]));
    end
  endgenerate
endmodule
