// Formulas of the specification, written anew for the proofs: nothing here is shared with the decode unit.
`ifndef HMLFC_SPECIFICATION_SVH
`define HMLFC_SPECIFICATION_SVH

// N of a level code in [0, 39] (BISE-1).
function automatic [14:0] spec_levels(input [5:0] k);
  case (k)
    6'd0: spec_levels = 15'd1;
    6'd1: spec_levels = 15'd2;
    6'd2: spec_levels = 15'd3;
    default: spec_levels = (15'd4 + (k - 6'd3) % 6'd3) << ((k - 6'd3) / 6'd3);
  endcase
endfunction

// Values that a digit of N takes: 1, 3 or 5 (BISE-2).
function automatic [2:0] spec_digit(input [14:0] levels);
  spec_digit = 3'd1;
  for (integer n = 0; n <= 14; n = n + 1) begin
    if (levels == 15'd3 << n && n <= 13) spec_digit = 3'd3;
    if (levels == 15'd5 << n && n <= 12) spec_digit = 3'd5;
  end
endfunction

// Plain bits n of N (BISE-2).
function automatic [3:0] spec_plain(input [14:0] levels);
  spec_plain = 4'd0;
  for (integer n = 0; n <= 14; n = n + 1) begin
    if (levels == 15'd1 << n) spec_plain = n[3:0];
    if (levels == 15'd3 << n && n <= 13) spec_plain = n[3:0];
    if (levels == 15'd5 << n && n <= 12) spec_plain = n[3:0];
  end
endfunction

// BISE-8: {t4, t3, t2, t1, t0}, two bits each.
function automatic [9:0] spec_trits(input [7:0] T);
  reg [4:0] C;
  reg [1:0] t4, t3, t2, t1, t0;
  if (T[4:2] == 7) begin
    C = {T[7:5], T[1:0]};
    t4 = 2;
    t3 = 2;
  end else begin
    C = T[4:0];
    t4 = T[6:5] == 3 ? 2 : T[7];
    t3 = T[6:5] == 3 ? T[7] : T[6:5];
  end
  if (C[1:0] == 3) begin
    t2 = 2;
    t1 = C[4];
    t0 = {C[3], C[2] & ~C[3]};
  end else if (C[3:2] == 3) begin
    t2 = 2;
    t1 = 2;
    t0 = C[1:0];
  end else begin
    t2 = C[4];
    t1 = C[3:2];
    t0 = {C[1], C[0] & ~C[1]};
  end
  spec_trits = {t4, t3, t2, t1, t0};
endfunction

// BISE-9: {q2, q1, q0}, three bits each.
function automatic [8:0] spec_quints(input [6:0] Q);
  reg [4:0] C;
  reg [2:0] q2, q1, q0;
  if (Q[2:1] == 3 && Q[6:5] == 0) begin
    q2 = {Q[0], Q[4] & ~Q[0], Q[3] & ~Q[0]};
    q1 = 4;
    q0 = 4;
  end else begin
    if (Q[2:1] == 3) begin
      q2 = 4;
      C = {Q[4:3], ~Q[6], ~Q[5], Q[0]};
    end else begin
      q2 = Q[6:5];
      C = Q[4:0];
    end
    q1 = C[2:0] == 5 ? 4 : C[4:3];
    q0 = C[2:0] == 5 ? C[4:3] : C[2:0];
  end
  spec_quints = {q2, q1, q0};
endfunction

// CNV-2.
function automatic signed [31:0] spec_clamp(input signed [31:0] x, input signed [31:0] lo, input signed [31:0] hi);
  spec_clamp = x < lo ? lo : x > hi ? hi : x;
endfunction

`endif
