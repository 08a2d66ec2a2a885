// A memory with clocked reads as a macro: its ports begin and end paths, as flip-flops do. Small memories stay.
// Bits of WR_EN that are one signal are one pin of the macro: CONNMAP gives each bit the number of its signal.
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
  parameter _TECHMAP_BITS_CONNMAP_ = 0;
  parameter [WR_PORTS*WIDTH*_TECHMAP_BITS_CONNMAP_-1:0] _TECHMAP_CONNMAP_WR_EN_ = 0;
  wire _TECHMAP_FAIL_ = SIZE * WIDTH <= 512 || ~&RD_CLK_ENABLE[RD_PORTS-1:0];
  localparam INS = RD_PORTS * (ABITS + 1) + WR_PORTS * (WIDTH + ABITS);
  localparam BITS = _TECHMAP_BITS_CONNMAP_;
  wire [INS-1:0] ins = {RD_EN, RD_ADDR, WR_ADDR, WR_DATA};
  genvar i;
  generate
    for (i = 0; i < WR_PORTS * WIDTH; i = i + 1) begin : enable
      if (i == 0 || _TECHMAP_CONNMAP_WR_EN_[i*BITS+:BITS] != _TECHMAP_CONNMAP_WR_EN_[(i-(i!=0))*BITS+:BITS])
        (* keep *) DFFPOSX1 pin (.CLK(WR_CLK[0]), .D(WR_EN[i]), .Q());
    end
    for (i = 0; i < INS; i = i + 1) begin : in
      (* keep *) DFFPOSX1 bit_in (.CLK(WR_CLK[0]), .D(ins[i]), .Q());
    end
    for (i = 0; i < RD_PORTS * WIDTH; i = i + 1) begin : out
      (* keep *) DFFPOSX1 bit_out (.CLK(WR_CLK[0]), .D(RD_DATA[i]), .Q(RD_DATA[i]));
    end
  endgenerate
endmodule
