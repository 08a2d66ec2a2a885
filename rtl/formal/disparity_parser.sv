// Each step of the parser of disparities, from any state, is the one that MOT-6 wants: the head of 18 bits, its level code checked, the length of
// the values, their end within the record; then the entry is written, once. The length is that of the grid blocks of the tile, by hmlfc_bise_bits,
// which may answer anything here (proof bise_bits): it has their count and the level code for the two clocks that it takes.
// Tiles of sides in [1, 128]. CONTEXTS = 4, CONTEXT_WORDS = 256, WINDOW_BITS = 128, SKEW_BITS = 6.
//
// Clauses: MOT-6
// Engine: bmc 4
// Cut: bise_bits
// Complete: one step from any state.
// Fault: hmlfc_disparity_parser.sv / P'(18) > bits / P'(17) > bits
// Fault: hmlfc_disparity_parser.sv / if (sized) state / state
// Fault: hmlfc_disparity_parser.sv / rows <= (height + grid_mask) / rows <= (width + grid_mask)
// Fault: hmlfc_disparity_parser.sv / parse_error != 0 || parse_empty ? / parse_error != 0 ?
module prove_disparity_parser #(
  parameter integer CONTEXTS = 4,
  parameter integer CONTEXT_WORDS = 256,
  parameter integer WINDOW_BITS = 128,
  parameter integer SKEW_BITS = 6
) (
  input logic clk, input logic rst_n, input logic parse_valid, input logic [1:0] parse_context, input logic [15:0] parse_info,
  input logic [5:0] parse_error, input logic parse_empty, input logic [5:0] parse_skew, input logic [17:0] parse_bits,
  input logic [WINDOW_BITS-1:0] window
);
  (* anyconst *) logic [750:0] stream_bits;
  hmlfc_pkg::config_t stream;
  assign stream = stream_bits;
  logic        parse_ready, read_enable, loaded_valid, loaded_keep;
  logic [9:0]  read_word;
  logic [5:0]  head_error, head_columns, head_level_code;
  logic [12:0] head_least;
  logic [13:0] head_total;
  logic [17:0] head_position;
  logic [1:0]  loaded_context;
  hmlfc_disparity_parser #(.CONTEXTS(CONTEXTS), .CONTEXT_WORDS(CONTEXT_WORDS), .WINDOW_BITS(WINDOW_BITS), .SKEW_BITS(SKEW_BITS)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .parse_valid(parse_valid), .parse_ready(parse_ready), .parse_context(parse_context),
    .parse_info(parse_info), .parse_error(parse_error), .parse_empty(parse_empty), .parse_skew(parse_skew), .parse_bits(parse_bits),
    .read_enable(read_enable), .read_word(read_word), .window(window), .head_error(head_error), .head_least(head_least), .head_columns(head_columns),
    .head_level_code(head_level_code), .head_total(head_total), .head_position(head_position), .loaded_valid(loaded_valid),
    .loaded_context(loaded_context), .loaded_keep(loaded_keep));
  (* hierconn *) wire [2:0] \dut.state ;
  (* hierconn *) wire [1:0] \dut.context_number ;
  (* hierconn *) wire [7:0] \dut.height ;
  (* hierconn *) wire [7:0] \dut.width ;
  (* hierconn *) wire [5:0] \dut.skew ;
  (* hierconn *) wire [17:0] \dut.bits ;
  (* hierconn *) wire [5:0] \dut.error ;
  (* hierconn *) wire \dut.fresh ;
  (* hierconn *) wire [4:0] \dut.code ;
  (* hierconn *) wire [12:0] \dut.least ;
  (* hierconn *) wire [7:0] \dut.columns ;
  (* hierconn *) wire [7:0] \dut.rows ;
  (* hierconn *) wire [10:0] \dut.size.count ;
  (* hierconn *) wire [5:0] \dut.size.level_code ;
  localparam logic [2:0] IDLE = 0, HEAD = 1, SIZE = 2, VALUES = 3, FINISH = 4;
  localparam logic [5:0] TILE_OVERRUN = 19, BAD_LEVELS = 22, BUS_ERROR = 27;

  // What stands in the registers that a step keeps, and what it changes.
  wire [57:0] kept = {\dut.context_number , \dut.height , \dut.width , \dut.skew , \dut.bits };
  wire [23:0] found = {\dut.error , \dut.code , \dut.least };
  wire [17:0] field = 18'(window >> \dut.skew );
  wire        waits = \dut.state == HEAD && !\dut.fresh ;
  logic [57:0] next_kept;
  logic [23:0] next_found;
  logic [2:0]  next_state;
  logic        any_state;  // SIZE ends when the length is there
  always @* begin
    {next_kept, next_found, next_state, any_state} = {kept, found, \dut.state , 1'b0};
    case (\dut.state )
      IDLE: if (parse_valid) begin
        next_kept = {parse_context, parse_info, parse_skew, parse_bits};
        next_found = {parse_error, 18'd0};
        next_state = parse_error == 0 && !parse_empty ? HEAD : FINISH;
      end
      HEAD: if (!waits) begin
        next_found[17:0] = field;
        next_state = SIZE;
        if (\dut.bits >= 18 && field[17:13] > 27) {next_found[23:18], next_state} = {BAD_LEVELS, FINISH};
        if (\dut.bits < 18) {next_found[23:18], next_state} = {TILE_OVERRUN, FINISH};
      end
      SIZE: any_state = 1'b1;
      VALUES: begin
        if (32'(\dut.bits ) < 32'd18 + 32'(head_total)) next_found[23:18] = TILE_OVERRUN;
        next_state = FINISH;
      end
      default: next_state = IDLE;
    endcase
    if (!rst_n) next_state = IDLE;
  end

  // Grid blocks of a side.
  wire [2:0] grid = stream.disparity_grid_log2;
  function automatic [5:0] blocks(input [7:0] side, input [2:0] log2);
    blocks = 6'((32'(side) + (32'd1 << log2) - 1) >> log2);
  endfunction
  wire [5:0] across = blocks(\dut.width , grid);
  wire [5:0] down = blocks(\dut.height , grid);

  logic [2:0]  clocks = 3'd0;
  logic [57:0] was_kept;
  logic [23:0] was_found;
  logic [2:0]  was_state, state_1, state_2;
  logic        was_any, was_waiting;
  logic [10:0] was_count;
  always @(posedge clk) begin
    if (clocks != 7) clocks <= clocks + 3'd1;
    {was_kept, was_found, was_state} <= {next_kept, next_found, next_state};
    {was_any, was_waiting} <= {any_state && rst_n, waits};
    {state_2, state_1} <= {state_1, \dut.state };
    was_count <= 11'(\dut.columns ) * 11'(\dut.rows );
  end
  always @* begin
    assume (grid >= 2 && grid <= 5 && parse_info[7:0] >= 1 && parse_info[7:0] <= 128 && parse_info[15:8] >= 1 && parse_info[15:8] <= 128);
    if (clocks == 0) assume (\dut.state <= FINISH && \dut.width >= 1 && \dut.width <= 128 && \dut.height >= 1 && \dut.height <= 128);
    assert (parse_ready == (\dut.state == IDLE) && loaded_valid == (\dut.state == FINISH));
    assert (read_enable && read_word == {\dut.context_number , 8'd0});  // the skew is less than a word
    assert (head_error == \dut.error && head_least == \dut.least && head_level_code == {1'b0, \dut.code } && head_position == 18'd18 + \dut.skew );
    assert (loaded_context == \dut.context_number && loaded_keep == (\dut.error != BUS_ERROR));
    if (clocks != 0) begin
      assert ({kept, found} == {was_kept, was_found});
      assert (was_any ? \dut.state == SIZE || \dut.state == VALUES : \dut.state == was_state);
      if (\dut.state == HEAD) assert (\dut.fresh == was_waiting);
      // When the head has come, the sides are there; its code and their product are, in the next clock, and the length two clocks later.
      if (state_1 != IDLE && \dut.state != IDLE) assert (\dut.columns == across && \dut.rows == down);
      assert (\dut.size.count == was_count && \dut.size.level_code == {1'b0, \dut.code });
    end
    if (clocks >= 3 && \dut.state == VALUES) assert (state_1 == SIZE && state_2 == SIZE);
    assert (head_columns == \dut.columns [5:0]);
  end
endmodule
