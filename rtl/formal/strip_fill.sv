// A step from any state: a strip that is asked for takes the next slot, is read from its address on, and leaves room for the others; when its head has come,
// what is left of it is asked for first. Beats go to their slot in order; a slot is complete with its last beat, failed with one that has an error. The
// oldest strip is assembled beat by beat, of a failed one a beat, and offered until it is taken. Its lines are the samples of the strip's bit string.
// Queues and memories give anything. BLOCK_LOG2 = 2, samples of 14 bits, 64 bits.
//
// Clauses: none: the reference area (docs/decode_unit.md)
// Engine: bmc 2
// Cut: ram
// Complete: any step.
// Fault: hmlfc_strip_fill.sv / request_slot = request_more ? more_slot : first_slot / request_slot = first_slot
// Fault: hmlfc_strip_fill.sv / data_error || (beat != 0 && burst_failed) / data_error
// Fault: hmlfc_strip_fill.sv / complete[burst_slot] <= !more_push / complete[burst_slot] <= 1'b1
// Fault: hmlfc_strip_fill.sv / assign ask_ready = asked - taken != (SLOT_BITS + 1)'(SLOTS) / assign ask_ready = 1'b1
// Fault: hmlfc_strip_fill.sv / w <= SAMPLE_BITS; w++ / w < SAMPLE_BITS; w++
// Fault: hmlfc_strip_fill.sv / ADDRESS_BITS'(FIRST_BYTES) / ADDRESS_BITS'(0)
`include "hmlfc_tables.svh"

// In the place of the queues: what they are given, and any outputs.
module hmlfc_fifo #(parameter integer WIDTH = 0, parameter integer DEPTH = 0) (
  input logic clk, input logic rst_n, input logic in_valid, output logic in_ready, input logic [WIDTH-1:0] in_data, output logic out_valid,
  input logic out_ready, output logic [WIDTH-1:0] out_data, output logic [$clog2(DEPTH):0] count);
  (* anyseq *) logic [WIDTH:0] any;
  assign {out_valid, out_data} = any;
  assign in_ready = 1'b1;
  assign count = '0;
  wire [WIDTH+2:0] given = {rst_n, in_valid, out_ready, in_data};
  wire [15:0] room = DEPTH;
endmodule

module prove_strip_fill #(
  parameter integer PLACE_BITS = 6
) (
  input logic clk, input logic rst_n, input logic ask, input logic [39:0] ask_address, input logic [PLACE_BITS-1:0] ask_place, input logic take,
  input logic request_ready, input logic data_valid, input logic [63:0] data, input logic data_last, input logic data_error
);
  logic         ask_ready, valid, request_valid;
  logic [PLACE_BITS-1:0] place;
  logic [4*230-1:0] lines;
  logic [39:0]  request_address;
  logic [9:0]   request_beats;
  hmlfc_strip_fill #(.BLOCK_LOG2(2), .SAMPLE_BITS(14), .DATA_BITS(64), .PLACE_BITS(PLACE_BITS), .SLOTS(32)) dut (
    .clk(clk), .rst_n(rst_n), .ask(ask), .ask_ready(ask_ready), .ask_address(ask_address), .ask_place(ask_place), .valid(valid), .place(place),
    .lines(lines), .take(take), .request_valid(request_valid), .request_ready(request_ready), .request_address(request_address),
    .request_beats(request_beats), .data_valid(data_valid), .data(data), .data_last(data_last), .data_error(data_error));

  // Queues of begins {slot, address}, of slots whose rest is to be asked for, and of bursts {rest, slot}.
  (* hierconn *) wire [45:0] \dut.firsts.any ;
  (* hierconn *) wire [47:0] \dut.firsts.given ;
  (* hierconn *) wire [5:0]  \dut.mores.any ;
  (* hierconn *) wire [7:0]  \dut.mores.given ;
  (* hierconn *) wire [6:0]  \dut.bursts.any ;
  (* hierconn *) wire [8:0]  \dut.bursts.given ;
  (* hierconn *) wire [15:0] \dut.firsts.room , \dut.mores.room , \dut.bursts.room ;
  wire        first_valid = \dut.firsts.any [45], more_valid = \dut.mores.any [5], burst_valid = \dut.bursts.any [6], rest = \dut.bursts.any [5];
  wire [4:0]  first_slot = \dut.firsts.any [44:40], more_slot = \dut.mores.any [4:0], burst_slot = \dut.bursts.any [4:0];
  wire [39:0] first_address = \dut.firsts.any [39:0];
  // Memories of beats and of places.
  (* hierconn *) wire        \dut.beats.write , \dut.beats.read , \dut.places.write , \dut.places.read ;
  (* hierconn *) wire [9:0]  \dut.beats.write_address , \dut.beats.read_address ;
  (* hierconn *) wire [63:0] \dut.beats.write_data , \dut.beats.read_data ;
  (* hierconn *) wire [4:0]  \dut.places.write_address , \dut.places.read_address ;
  (* hierconn *) wire [PLACE_BITS-1:0] \dut.places.write_data , \dut.places.read_data ;

  // Strips in flight.
  (* hierconn *) wire [5:0]  \dut.asked , \dut.taken ;
  (* hierconn *) wire [31:0] \dut.complete , \dut.failed ;
  (* hierconn *) wire [4:0]  \dut.sum_slot ;
  (* hierconn *) wire [39:0] \dut.sum_address ;
  (* hierconn *) wire [4:0]  \dut.beat , \dut.total ;
  (* hierconn *) wire        \dut.burst_failed ;
  wire [5:0]  in_flight = \dut.asked - \dut.taken ;
  wire [4:0]  asks = \dut.asked [4:0], slot = \dut.taken [4:0];
  wire [3:0]  head_width = data[3:0];
  wire [10:0] head_bits = 20 + 64 * (head_width == 15 ? 11'd16 : 11'(head_width));
  wire [4:0]  total = \dut.beat == 0 ? 5'((head_bits + 63) / 64) : \dut.total ;
  wire        error = data_error || (\dut.beat != 0 && \dut.burst_failed );
  wire        ends = data_valid && data_last && burst_valid;
  wire        goes_on = ends && !rest && !error && total > 4;
  wire        moved = request_valid && request_ready;
  wire [4:0]  known_total = 5'(request_beats + 4);  // of the strip whose rest is asked for

  // Assembly.
  (* hierconn *) wire [17*64-1:0] \dut.assembly , \dut.strip ;
  (* hierconn *) wire [4:0]  \dut.number , \dut.word_number ;
  (* hierconn *) wire        \dut.word_valid , \dut.word_last , \dut.word_failed , \dut.assembled , \dut.assembly_failed , \dut.strip_failed ;
  (* hierconn *) wire [PLACE_BITS-1:0] \dut.assembly_place ;
  wire        offers = \dut.assembled && (!valid || take);
  wire        puts = \dut.word_valid && (!\dut.assembled || offers);
  wire        reads = in_flight != 0 && \dut.complete [slot] && (!\dut.word_valid || puts);
  (* hierconn *) wire        \dut.last ;

  // Samples of a strip.
  wire [3:0]  width = \dut.strip [3:0];
  wire [15:0] base = \dut.strip [19:4];
  logic [15:0] field, sample;
  logic [4*230-1:0] expected;
  always @* begin
    expected = 0;
    for (integer s = 0; s < 64; s = s + 1) begin
      field = 16'd0;
      for (integer w = 1; w <= 14; w = w + 1) field = field | (\dut.strip [20 + w*s +: 16] & 16'((1 << w) - 1) & {16{width == 4'(w)}});
      sample = width == 15 ? \dut.strip [20 + 16*s +: 16] : base + field;
      expected[s/16*230 + s%16*14 +: 14] = sample[13:0];
      if (s%16 == 0)  // numbers of errors are less than 32
        expected[s/16*230 + 224 +: 6] = \dut.strip_failed ? HMLFC_ERROR_BUS_ERROR : width == 15 && sample[15:5] == 11'h400 ? 6'(sample[4:0]) : 6'd0;
    end
  end

  (* anyconst *) logic [4:0] any;  // slot
  logic         was = 1'b0;
  logic         was_reset, wrote_address, read_address, wrote_total;
  logic [39:0]  address;
  logic [4:0]   any_total;
  logic [9:0]   state;
  logic [5:0]   asked, taken;
  logic         is_complete, has_failed;
  logic [4:0]   sum_slot;
  logic [39:0]  sum_address;
  logic [4:0]   beat, next_total, number, word_number;
  logic         burst_failed, word_last, word_failed, assembly_failed, strip_failed, word_valid, assembled, next_valid;
  logic [17*64-1:0] assembly, strip;
  logic [PLACE_BITS-1:0] assembly_place, next_place;
  always @(posedge clk) begin
    was <= 1'b1;
    asked <= rst_n ? \dut.asked + 6'(ask) : 6'd0;
    taken <= rst_n ? \dut.taken + 6'(reads && \dut.last ) : 6'd0;
    is_complete <= ends && burst_slot == any ? !goes_on : ask && asks == any ? 1'b0 : \dut.complete [any];
    has_failed <= ends && burst_slot == any ? error : ask && asks == any ? 1'b0 : \dut.failed [any];
    {sum_slot, sum_address} <= ask ? {asks, ask_address} : {\dut.sum_slot , \dut.sum_address };
    // The address behind the first beats, and the number of beats, of a slot.
    wrote_address <= \dut.sum_slot == any;
    read_address <= more_valid && more_slot == any;
    address <= \dut.sum_slot == any ? \dut.sum_address + 32 : request_address;
    wrote_total <= ends && !rest && burst_slot == any;
    any_total <= ends && !rest && burst_slot == any ? total : known_total;
    beat <= !rst_n ? 5'd0 : data_valid ? data_last ? 5'd0 : \dut.beat + 5'd1 : \dut.beat ;
    {next_total, burst_failed} <= data_valid ? {total, error} : {\dut.total , \dut.burst_failed };
    number <= !rst_n ? 5'd0 : reads ? \dut.last ? 5'd0 : \dut.number + 5'd1 : \dut.number ;
    {word_number, word_last, word_failed} <= reads ? {\dut.number , \dut.last , \dut.failed [slot]} : {\dut.word_number , \dut.word_last , \dut.word_failed };
    assembly <= \dut.assembly ;
    for (integer n = 0; n < 17; n = n + 1) if (puts && \dut.word_number == n) assembly[64*n +: 64] <= \dut.beats.read_data ;
    {assembly_failed, assembly_place} <= puts ? {\dut.word_failed , \dut.places.read_data } : {\dut.assembly_failed , \dut.assembly_place };
    {strip, strip_failed, next_place} <= offers ? {\dut.assembly , \dut.assembly_failed , \dut.assembly_place } : {\dut.strip , \dut.strip_failed , place};
    word_valid <= rst_n && (reads || (\dut.word_valid && !puts));
    assembled <= rst_n && (puts ? \dut.word_last : \dut.assembled && !offers);
    next_valid <= rst_n && (offers || (valid && !take));
  end
  always @* begin
    if (!was) begin
      assert (ask_ready == (in_flight != 32));
      assert (\dut.firsts.given == {rst_n, ask, request_ready && !more_valid, asks, ask_address});
      assert (\dut.mores.given == {rst_n, goes_on, request_ready && more_valid, burst_slot});
      assert (\dut.bursts.given == {rst_n, moved, data_valid && data_last, more_valid, more_valid ? more_slot : first_slot});
      assert (\dut.firsts.room >= 32 && \dut.mores.room >= 32 && \dut.bursts.room >= 64);
      assert (request_valid == (more_valid || first_valid));
      if (!more_valid) assert (request_address == first_address && request_beats == 4);
      assert (\dut.beats.write == data_valid && \dut.places.write == ask && \dut.beats.read == reads && \dut.places.read == reads);
      if (data_valid) assert (\dut.beats.write_address == {burst_slot, \dut.beat + (rest ? 5'd4 : 5'd0)} && \dut.beats.write_data == data);
      if (ask) assert (\dut.places.write_address == asks && \dut.places.write_data == ask_place);
      if (reads) assert (\dut.beats.read_address == {slot, \dut.number } && \dut.places.read_address == slot);
      assert (lines == expected);
    end else begin
      assert (\dut.asked == asked && \dut.taken == taken && \dut.complete [any] == is_complete && \dut.failed [any] == has_failed);
      assert ({\dut.sum_slot , \dut.sum_address } == {sum_slot, sum_address});
      if (more_valid && more_slot == any) begin
        if (wrote_address || read_address) assert (request_address == address);
        if (wrote_total || read_address) assert (request_beats == any_total - 10'd4);
      end
      // A clock later, as Yosys may read totals a clock ahead, into a register that is free at first.
      if (\dut.failed [slot]) assert (\dut.last );
      else if (more_valid && more_slot == slot) assert (\dut.last == (\dut.number + 5'd1 == known_total));
      assert ({\dut.beat , \dut.number } == {beat, number});
      assert ({\dut.total , \dut.burst_failed } == {next_total, burst_failed});
      assert ({\dut.word_number , \dut.word_last , \dut.word_failed } == {word_number, word_last, word_failed});
      assert (\dut.assembly == assembly && {\dut.assembly_failed , \dut.assembly_place } == {assembly_failed, assembly_place});
      assert (\dut.strip == strip && {\dut.strip_failed , place} == {strip_failed, next_place});
      assert ({\dut.word_valid , \dut.assembled , valid} == {word_valid, assembled, next_valid});
    end
  end
endmodule
