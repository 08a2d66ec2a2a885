// A step of the reading of a descriptor from any state: the burst is of the first 48 bytes at the address given; each beat goes to its place, and an
// error is kept; with `done` the fields are those of the bytes. A field outside its interval, or a rectangle that is empty or ends behind 16384, is
// refused.
//
// Clauses: Descriptors (docs/view_unit.md)
// Engine: bmc 3
// Complete: a step from any state; a beat number that no burst comes to is left out.
// Cover: 3
// Fault: hmlfc_view_fetch.sv / read_error || r_error / r_error
// Fault: hmlfc_view_fetch.sv / end_x[16:14] == 0 / end_x[15:14] == 0
// Fault: hmlfc_view_fetch.sv / words[191:168] == 0 / words[190:168] == 0
// Fault: hmlfc_view_fetch.sv / 13'(end_y[13:BLOCK_LOG2]) / 13'(end_y[12:BLOCK_LOG2])
// Fault: hmlfc_view_fetch.sv / reading && !(r_valid && r_last) / reading && !r_last
module prove_view_fetch #(
  parameter integer BLOCK_LOG2 = 1,
  parameter integer DATA_BITS = 64
) (
  input logic clk, input logic rst_n, input logic start, input logic ar_ready, input logic r_valid, input logic r_error, input logic r_last,
  input logic [DATA_BITS-1:0] r_data);
  localparam integer A = hmlfc_pkg::ADDRESS_BITS;
  localparam integer B = 1 << BLOCK_LOG2;
  localparam integer BEATS = 384 / DATA_BITS;
  (* anyconst *) logic [A-7:0] place;
  logic             done, refused, failed, ar_valid;
  logic [31:0]      tag;
  logic [A-1:0]     ar_address;
  logic [7:0]       ar_len;
  hmlfc_pkg::view_t view;
  hmlfc_view_fetch #(.BLOCK_LOG2(BLOCK_LOG2), .DATA_BITS(DATA_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .start(start), .address({place, 6'd0}), .done(done), .view(view), .tag(tag), .refused(refused), .failed(failed),
    .ar_valid(ar_valid), .ar_ready(ar_ready), .ar_address(ar_address), .ar_len(ar_len), .r_valid(r_valid), .r_data(r_data), .r_error(r_error),
    .r_last(r_last));
  (* hierconn *) wire [383:0] \dut.words ;
  (* hierconn *) wire [2:0]   \dut.beat ;
  (* hierconn *) wire         \dut.reading ;
  (* hierconn *) wire         \dut.read_error ;
  (* hierconn *) wire         \dut.received ;
  wire beat_comes = \dut.reading && r_valid;

  // The clock before, and the bytes then.
  logic         was = 1'b0;
  logic         was_start, was_reset, was_beat, was_last, was_received, was_reading, was_offered, was_bad, bad;
  logic [2:0]   number;
  logic [383:0] descriptor;
  logic [DATA_BITS-1:0] was_data;
  always @(posedge clk) begin
    was <= 1'b1;
    {was_start, was_reset, was_beat, was_last, was_received, was_reading} <= {start, !rst_n, beat_comes, r_last, \dut.received , \dut.reading };
    {was_offered, was_bad, bad} <= {ar_valid && !ar_ready, \dut.read_error || r_error, \dut.read_error };
    {number, descriptor, was_data} <= {\dut.beat , \dut.words , r_data};
  end
  // The fields by their bytes.
  function automatic [31:0] word(input [5:0] byte_number);
    word = descriptor[8*byte_number +: 32];
  endfunction
  wire [31:0] x = word(8) & 'hffff, y = word(8) >> 16, width = word(12) & 'hffff, height = word(12) >> 16;
  wire [3:0]  format = descriptor[63:60];
  wire [63:0] destination = {word(20), word(16)}, bitmap = {word(36), word(32)};
  wire [31:0] pitch = word(24);
  wire strips = format >= 8;
  wire legal = format != 3 && format != 7 && format <= 10 && x % B == 0 && y % B == 0 && width != 0 && height != 0 &&
      x + width <= 16384 && y + height <= 16384 && destination % 16 == 0 && destination >> 40 == 0 && pitch % 16 == 0 && pitch >> 24 == 0 &&
      bitmap % 8 == 0 && bitmap >> 40 == 0 && !(strips && (x != 0 || y != 0 || bitmap != 0));

  always @* begin
    assume (!(start && (\dut.reading || \dut.received )));
    if (\dut.reading ) assume (\dut.beat < BEATS);
    assert (ar_len == BEATS - 1);
    if (was && was_start) assert (ar_address == {place, 6'd0} && \dut.beat == 0 && !\dut.read_error );
    if (was && was_beat) begin
      assert (\dut.words [DATA_BITS*number +: DATA_BITS] == was_data && \dut.beat == number + 3'd1 && \dut.read_error == was_bad);
    end
    for (integer i = 0; i < BEATS; i = i + 1) begin
      if (was && !(was_beat && number == i)) assert (\dut.words [DATA_BITS*i +: DATA_BITS] == descriptor[DATA_BITS*i +: DATA_BITS]);
    end
    if (was) begin
      assert (ar_valid == (!was_reset && (was_start || was_offered)) && done == (!was_reset && was_received));
      assert (\dut.reading == (!was_reset && (was_start || (was_reading && !(was_beat && was_last)))));
      assert (\dut.received == (!was_reset && was_beat && was_last));
    end
    if (was && was_received) begin
      assert (failed == bad && tag == (bad ? 0 : word(0)));
      if (!bad) assert (refused == !legal);
      if (!bad && legal) begin
        assert (view.row == (word(4) & 'hfff) && view.col == (word(4) >> 12 & 'hfff) && view.stop_level == (word(4) >> 24 & 'hf));
        assert (view.format == format[2:0] && view.residuals == strips);
        assert (view.blocks.first_x == x / B && view.blocks.last_x == (x + width - 1) / B && view.end_column == (x + width - 1) % B);
        assert (view.blocks.first_y == y / B && view.blocks.last_y == (y + height - 1) / B && view.end_row == (y + height - 1) % B);
        assert (view.destination == destination[A-1:0] && view.pitch == pitch[23:0] && view.bitmap == bitmap[A-1:0]);
      end
    end
    cover (was && done && !bad && legal);
  end
endmodule
