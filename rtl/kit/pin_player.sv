// Plays a record of pins, and compares outputs clock by clock; the unit is beside it (pin_replay.sv, view_pin_replay.sv).
//
// A line of the record has inputs, outputs and a mask of the outputs that have a meaning then, as hexadecimal numbers. An unknown output that has a
// meaning is a difference.
//
// Plusarg: +pins=FILE. Prints "pin_replay: N clocks equal", or the first difference, and ends; the exit status is 0 in both cases, where the simulator
// knows only $finish.
module pin_player #(
    parameter int INPUTS = 1,
    parameter int OUTPUTS = 1
) (
    output logic clk,
    output logic [INPUTS-1:0] inputs,
    input logic [OUTPUTS-1:0] outputs
);
  string name;
  int file, fields;
  int clocks = 0;
  logic [INPUTS-1:0] next;
  logic [OUTPUTS-1:0] expected, mask;
  initial begin
    if ($value$plusargs("pins=%s", name) == 0) $fatal(1, "pin_replay: +pins=FILE is missing");
    file = $fopen(name, "r");
    if (file == 0) $fatal(1, "pin_replay: cannot open the record");
    clk = 0;
    inputs = '0;
    fields = $fscanf(file, "%h %h %h", next, expected, mask);
    while (fields == 3) begin
      clk = 1;
      #1 inputs = next;
      #4 clk = 0;
      #4;
      if ((outputs & mask) !== (expected & mask)) begin
        $display("pin_replay: difference at clock %0d\n  expected %h\n  actual   %h\n  mask     %h", clocks, expected, outputs, mask);
        $finish;
        fields = 0;
      end else begin
        clocks = clocks + 1;
        fields = $fscanf(file, "%h %h %h", next, expected, mask);
        if (fields != 3) $display("pin_replay: %0d clocks equal", clocks);
      end
    end
    $finish;
  end
endmodule
