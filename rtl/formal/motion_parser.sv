// Each step of the parser of motion tiles, from any state, is the one that MOT-3 and MOT-4 want: the head of 9 bits and its checks, each entry of the
// palette, the end of the indices within the record; then the entry of the context is written, once. The length of the indices is that of the tile's
// motion blocks, by hmlfc_bise_bits, which may answer anything here (proof bise_bits).
// Tiles of sides in [1, 128]. BLOCK_LOG2 = 2, CONTEXTS = 4, CONTEXT_WORDS = 64, WINDOW_BITS = 128, SKEW_BITS = 6.
//
// Clauses: MOT-3, MOT-4
// Engine: bmc 3
// Cut: bise_bits
// Complete: one step from any state.
// Fault: hmlfc_motion_parser.sv / position + P'(9) > bits / P'(8) > bits
// Fault: hmlfc_motion_parser.sv / if (number == palette_size) state / if (number >= 3'd6) state
// Fault: hmlfc_motion_parser.sv / has_y ? P'(explicit_bits) / has_x ? P'(explicit_bits)
// Fault: hmlfc_motion_parser.sv / position + P'(total) > bits / P'(total) > bits
module prove_motion_parser #(
  parameter integer BLOCK_LOG2 = 2,
  parameter integer CONTEXTS = 4,
  parameter integer CONTEXT_WORDS = 64,
  parameter integer WINDOW_BITS = 128,
  parameter integer SKEW_BITS = 6
) (
  input logic clk, input logic rst_n, input logic parse_valid, input logic [1:0] parse_context, input logic [16:0] parse_info,
  input logic [5:0] parse_error, input logic parse_empty, input logic [5:0] parse_skew, input logic [17:0] parse_bits,
  input logic [WINDOW_BITS-1:0] window
);
  (* anyconst *) logic [750:0] stream_bits;
  hmlfc_pkg::config_t stream;
  hmlfc_pkg::motion_t entry, right;
  assign stream = stream_bits;
  logic        parse_ready, read_enable, head_write, palette_write, loaded_valid, loaded_keep;
  logic [7:0]  read_word;
  logic [5:0]  head_error, head_columns, head_level_code;
  logic [2:0]  head_block_log2, head_palette_size, palette_number;
  logic [13:0] head_total;
  logic [17:0] head_position;
  logic [32:0] palette_entry;
  logic [1:0]  loaded_context;
  assign entry = palette_entry;
  hmlfc_motion_parser #(.BLOCK_LOG2(BLOCK_LOG2), .CONTEXTS(CONTEXTS), .CONTEXT_WORDS(CONTEXT_WORDS), .WINDOW_BITS(WINDOW_BITS), .SKEW_BITS(SKEW_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .parse_valid(parse_valid), .parse_ready(parse_ready), .parse_context(parse_context),
    .parse_info(parse_info), .parse_error(parse_error), .parse_empty(parse_empty), .parse_skew(parse_skew), .parse_bits(parse_bits),
    .read_enable(read_enable), .read_word(read_word), .window(window), .head_write(head_write), .head_error(head_error),
    .head_block_log2(head_block_log2), .head_columns(head_columns), .head_palette_size(head_palette_size), .head_level_code(head_level_code),
    .head_total(head_total), .head_position(head_position), .palette_write(palette_write), .palette_number(palette_number),
    .palette_entry(palette_entry), .loaded_valid(loaded_valid), .loaded_context(loaded_context), .loaded_keep(loaded_keep));
  (* hierconn *) wire [2:0] \dut.state ;
  (* hierconn *) wire [1:0] \dut.context_number ;
  (* hierconn *) wire \dut.keyed ;
  (* hierconn *) wire [7:0] \dut.height ;
  (* hierconn *) wire [7:0] \dut.width ;
  (* hierconn *) wire [5:0] \dut.skew ;
  (* hierconn *) wire [17:0] \dut.bits ;
  (* hierconn *) wire [17:0] \dut.position ;
  (* hierconn *) wire [5:0] \dut.error ;
  (* hierconn *) wire \dut.fresh ;
  (* hierconn *) wire [5:0] \dut.shift ;
  (* hierconn *) wire [1:0] \dut.motion_block ;
  (* hierconn *) wire [2:0] \dut.palette_size ;
  (* hierconn *) wire [2:0] \dut.number ;
  (* hierconn *) wire [3:0] \dut.explicit_bits ;
  (* hierconn *) wire [3:0] \dut.sizing ;
  (* hierconn *) wire [7:0] \dut.columns ;
  (* hierconn *) wire [7:0] \dut.rows ;
  (* hierconn *) wire [10:0] \dut.size.count ;
  (* hierconn *) wire [5:0] \dut.size.level_code ;
  localparam logic [2:0] IDLE = 0, EMPTY = 1, HEAD = 2, ENTRY = 3, INDICES = 4, FINISH = 5;
  localparam logic [5:0] TILE_OVERRUN = 19, BAD_MODE = 21, BUS_ERROR = 27;

  // MOT-3: an entry, from its first bit on.
  wire        two = stream.features.two_references;
  wire        shared = stream.features.shared_disparity;
  wire [31:0] field = 32'(window >> \dut.shift );
  logic [31:0] rest;
  logic [17:0] length;
  function automatic [11:0] signed_field(input [31:0] from, input [3:0] size);
    signed_field = '0;
    for (integer k = 0; k < 12; k = k + 1) if (size != 0) signed_field[k] = k < size ? from[k] : from[size-1];
  endfunction
  always @* begin
    right = '0;
    rest = field;
    length = 18'd4;
    if (two) {right.reference_set, rest, length} = {rest[2:0], rest >> 3, 18'd7};
    right.choice = rest[3:0];
    rest = rest >> 4;
    if (!\dut.keyed ) {right.negative, rest, length} = {rest[0], rest >> 1, length + 18'd1};
    if (right.choice == 10 || right.choice == 11) begin
      right.explicit_x = signed_field(rest, \dut.explicit_bits );
      rest = rest >> \dut.explicit_bits ;
      length = length + 18'(\dut.explicit_bits );
    end
    if (right.choice == 11) begin
      right.explicit_y = signed_field(rest, \dut.explicit_bits );
      length = length + 18'(\dut.explicit_bits );
    end
    right.used = right.choice <= 11 && (shared || right.choice == 0 || right.choice == 11);
    if (\dut.state == EMPTY) begin  // MOT-4
      right = '0;
      right.used = 1'b1;
      right.reference_set = 3'(two);
      right.choice = !\dut.keyed ? 4'd0 : shared ? 4'd1 : 4'd11;
    end
  end

  wire [42:0] kept = {\dut.context_number , \dut.keyed , \dut.height , \dut.width , \dut.skew , \dut.bits };
  wire [35:0] found = {\dut.error , \dut.position , \dut.number , \dut.explicit_bits , \dut.palette_size , \dut.motion_block };
  wire        reads = \dut.state == HEAD || \dut.state == ENTRY;
  logic [42:0] next_kept;
  logic [5:0]  next_error;
  logic [17:0] next_position;
  logic [2:0]  next_number, next_state;
  logic [8:0]  next_head;
  always @* begin
    {next_kept, next_error, next_position, next_number, next_head, next_state} = {kept, found, \dut.state };
    case (\dut.state )
      IDLE: if (parse_valid) begin
        next_kept = {parse_context, parse_info, parse_skew, parse_bits};
        {next_error, next_position, next_number, next_head[4:0]} = {parse_error, 26'd0};
        next_state = parse_error != 0 ? FINISH : parse_empty ? EMPTY : HEAD;
      end
      EMPTY: next_state = FINISH;
      HEAD: if (\dut.fresh ) begin
        {next_head, next_position, next_state} = {field[8:0], 18'd9, ENTRY};
        if (field[8:5] > 12 || 3'd2 + field[1:0] < BLOCK_LOG2) {next_error, next_state} = {BAD_MODE, FINISH};
        if (\dut.bits < 9) {next_error, next_state} = {TILE_OVERRUN, FINISH};
      end
      ENTRY: if (\dut.fresh ) begin
        {next_position, next_number} = {\dut.position + length, 3'(\dut.number + 3'd1)};
        if (\dut.number == \dut.palette_size ) next_state = INDICES;
      end
      INDICES: if (\dut.sizing == 0) begin
        if (32'(\dut.bits ) < 32'(\dut.position ) + 32'(head_total)) next_error = TILE_OVERRUN;
        next_state = FINISH;
      end
      default: next_state = IDLE;
    endcase
    if (!rst_n) next_state = IDLE;
  end

  // Motion blocks of a side, of 4 to 32 samples.
  function automatic [7:0] blocks(input [7:0] side, input [1:0] log2);
    blocks = 8'((32'(side) + (32'd4 << log2) - 1) >> (3'd2 + log2));
  endfunction
  logic        was = 1'b0;
  logic [42:0] was_kept;
  logic [35:0] was_found;
  logic [15:0] was_sides;
  logic [10:0] was_count;
  logic [5:0]  was_shift;
  logic [3:0]  was_sizing;
  logic [2:0]  was_state;
  logic        was_fresh;
  wire [17:0]  at = \dut.position + 18'(\dut.skew );
  always @(posedge clk) begin
    was <= 1'b1;
    {was_kept, was_found, was_state} <= {next_kept, next_error, next_position, next_number, next_head, next_state};
    was_fresh <= reads && !\dut.fresh ;
    was_sides <= {blocks(\dut.width , \dut.motion_block ), blocks(\dut.height , \dut.motion_block )};
    was_count <= 11'(\dut.columns ) * 11'(\dut.rows );
    {was_shift, was_sizing} <= {at[5:0], \dut.state == HEAD ? 4'b1111 : {1'b0, \dut.sizing [3:1]}};
  end
  always @* begin
    assume (parse_info[7:0] >= 1 && parse_info[7:0] <= 128 && parse_info[15:8] >= 1 && parse_info[15:8] <= 128);
    if (!was) begin
      assume (\dut.state <= FINISH && \dut.width >= 1 && \dut.width <= 128 && \dut.height >= 1 && \dut.height <= 128);
      assume (\dut.position <= 265 && (\dut.state != HEAD || \dut.position == 0) && (\dut.state != ENTRY || \dut.explicit_bits <= 12));
    end
    assert (parse_ready == (\dut.state == IDLE) && head_write == (\dut.state == FINISH) && loaded_valid == head_write);
    assert (read_enable && read_word == {\dut.context_number , at[11:6]});
    assert (head_error == \dut.error && head_block_log2 == 3'd2 + \dut.motion_block && head_palette_size == \dut.palette_size && head_position == at);
    // least_code(palette_size + 1): 1, 2, 3, 4, 5, 6, 8 levels have the codes 0 to 6.
    assert (head_level_code == (\dut.palette_size == 7 ? 6'd6 : {3'd0, \dut.palette_size }) && \dut.size.level_code == head_level_code);
    assert (head_columns == \dut.columns [5:0] && loaded_context == \dut.context_number && loaded_keep == (\dut.error != BUS_ERROR));
    assert (palette_write == (\dut.state == EMPTY || (\dut.state == ENTRY && \dut.fresh )) && palette_number == \dut.number );
    if (palette_write) assert (entry == right);
    if (was) begin
      assert ({kept, found, \dut.state } == {was_kept, was_found, was_state});
      if (reads) assert (\dut.fresh == was_fresh && \dut.shift == was_shift);
      // The sides, in the next clock their product, and the length two clocks later: of the head's last clock, four bits of `sizing`.
      assert ({\dut.columns , \dut.rows } == was_sides && \dut.size.count == was_count && \dut.sizing == was_sizing);
    end
  end
endmodule
