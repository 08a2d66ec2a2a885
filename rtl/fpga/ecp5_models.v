// SPDX-License-Identifier: BSD-3-Clause
// Cells of the ECP5 of which Yosys has no model, as this system uses them: with one clock, without output registers
// and initial contents. The netlist is simulated with them.

// A block RAM of 1024 words of 18 bits, each of two bytes of 9: port B reads and writes, as A does, 1 to 18 bits; with
// 36 bits A writes and B reads two words.
module DP16KD (
    input DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9, DIA8, DIA7, DIA6, DIA5, DIA4, DIA3, DIA2,
        DIA1, DIA0,
    input ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0,
    input CEA, OCEA, CLKA, WEA, RSTA, CSA0, CSA1, CSA2,
    output DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9, DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2,
        DOA1, DOA0,
    input DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9, DIB8, DIB7, DIB6, DIB5, DIB4, DIB3, DIB2,
        DIB1, DIB0,
    input ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0,
    input CEB, OCEB, CLKB, WEB, RSTB, CSB0, CSB1, CSB2,
    output DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9, DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2,
        DOB1, DOB0
);
  parameter DATA_WIDTH_A = 18;
  parameter DATA_WIDTH_B = 18;
  reg [17:0] words [0:1023];
  reg [17:0] even, odd;  // what comes out
  wire [17:0] di_a = {DIA17, DIA16, DIA15, DIA14, DIA13, DIA12, DIA11, DIA10, DIA9, DIA8, DIA7, DIA6, DIA5, DIA4,
      DIA3, DIA2, DIA1, DIA0};
  wire [13:0] ad_a = {ADA13, ADA12, ADA11, ADA10, ADA9, ADA8, ADA7, ADA6, ADA5, ADA4, ADA3, ADA2, ADA1, ADA0};
  assign {DOA17, DOA16, DOA15, DOA14, DOA13, DOA12, DOA11, DOA10, DOA9, DOA8, DOA7, DOA6, DOA5, DOA4, DOA3, DOA2,
      DOA1, DOA0} = even;
  wire [17:0] di_b = {DIB17, DIB16, DIB15, DIB14, DIB13, DIB12, DIB11, DIB10, DIB9, DIB8, DIB7, DIB6, DIB5, DIB4,
      DIB3, DIB2, DIB1, DIB0};
  wire [13:0] ad_b = {ADB13, ADB12, ADB11, ADB10, ADB9, ADB8, ADB7, ADB6, ADB5, ADB4, ADB3, ADB2, ADB1, ADB0};
  assign {DOB17, DOB16, DOB15, DOB14, DOB13, DOB12, DOB11, DOB10, DOB9, DOB8, DOB7, DOB6, DOB5, DOB4, DOB3, DOB2,
      DOB1, DOB0} = odd;

  // Where the bits of an address begin in its word: in each byte eight of them.
  function [4:0] place(input integer width, input [3:0] low);
    place = width == 18 ? 5'd0 : low[3] * 5'd9 + (width == 9 ? 5'd0 : {2'd0, low[2:0]} & -width);
  endfunction
  // The bits of a word that are written: with 18 bits the address enables each byte.
  function [17:0] mask(input integer width, input [3:0] low);
    mask = width == 18 ? {{9{low[1]}}, {9{low[0]}}} : ((18'd1 << width) - 18'd1) << place(width, low);
  endfunction
  function [17:0] written(input [17:0] old, input [17:0] data, input [17:0] bits);
    written = old & ~bits | data & bits;
  endfunction
  wire [17:0] mask_a = mask(DATA_WIDTH_A, ad_a[3:0]);
  wire [17:0] mask_b = mask(DATA_WIDTH_B, ad_b[3:0]);
  // Reads give what was there before; both ports may write to a word.
  always @(posedge CLKA) begin
    if (DATA_WIDTH_A == 36) begin
      if (CEB) {odd, even} <= {words[{ad_b[13:5], 1'b1}], words[{ad_b[13:5], 1'b0}]};
      if (CEA && WEA) begin
        words[{ad_a[13:5], 1'b0}] = written(words[{ad_a[13:5], 1'b0}], di_a, mask(18, ad_a[3:0]));
        words[{ad_a[13:5], 1'b1}] = written(words[{ad_a[13:5], 1'b1}], di_b, mask(18, ad_a[3:0] >> 2));
      end
    end else begin
      if (CEA) even <= words[ad_a[13:4]] >> place(DATA_WIDTH_A, ad_a[3:0]);
      if (CEB) odd <= words[ad_b[13:4]] >> place(DATA_WIDTH_B, ad_b[3:0]);
      if (CEA && WEA)
        words[ad_a[13:4]] = written(words[ad_a[13:4]], di_a << place(DATA_WIDTH_A, ad_a[3:0]), mask_a);
      if (CEB && WEB)
        words[ad_b[13:4]] = written(words[ad_b[13:4]], di_b << place(DATA_WIDTH_B, ad_b[3:0]), mask_b);
    end
  end
endmodule

module MULT18X18D (
    input A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1, A0,
    input B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1, B0,
    input C17, C16, C15, C14, C13, C12, C11, C10, C9, C8, C7, C6, C5, C4, C3, C2, C1, C0,
    input SIGNEDA, SIGNEDB, SOURCEA, SOURCEB,
    output P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18, P17, P16, P15,
        P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0
);
  wire signed [18:0] a = {SIGNEDA && A17, A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5, A4, A3, A2, A1,
      A0};
  wire signed [18:0] b = {SIGNEDB && B17, B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5, B4, B3, B2, B1,
      B0};
  wire signed [37:0] product = a * b;
  assign {P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18, P17, P16, P15,
      P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0} = product[35:0];
endmodule
