// Each output of the modules inside reaches the inputs that it is for, and the parser's ports. What a tile brings is kept as it came until the next one;
// a mask is taken in its state alone, with its bits passed, from the mode read in MODES and the field at the position; an error or the last step ends in
// FINISH, when all is written. BLOCK_LOG2 = 2, 2 contexts.
//
// Clauses: TIL-1 to TIL-3
// Engine: bmc 2
// Cut: tile_mask vector_bounds tile_vectors tile_headers
// Complete: one step, from any state.
// Fault: hmlfc_residual_parser.sv / bits <= parse_bits / bits <= parse_bits + 1'b1
// Fault: hmlfc_residual_parser.sv / if (state == MOTION_MASK) motion_mask <= mask; / motion_mask <= mask; if (0) state <= IDLE;
// Fault: hmlfc_residual_parser.sv / position > bits || ((motion_mask / position >= bits || ((motion_mask
// Fault: hmlfc_residual_parser.sv / predictive ? field[3:2] : field[1:0] / field[1:0]
`include "hmlfc_tables.svh"
`define IS(width, a, b) (* hierconn *) wire [width-1:0] b ; always @* assert (a == b );
`define SEE(width, b) (* hierconn *) wire [width-1:0] b ;
module prove_residual_parser (
  input logic clk, input logic rst_n, input logic parse_valid, input logic parse_context, input logic [8:0] parse_info, input logic [5:0] parse_error,
  input logic parse_empty, input logic [5:0] parse_skew, input logic [17:0] parse_bits, input logic [1023:0] window
);
  localparam logic [3:0] IDLE = 4'd0, MODES = 4'd1, MOTION_MASK = 4'd2, RESIDUAL_MASK = 4'd3, CHECK = 4'd4, FINISH = 4'd12;
  (* anyconst *) logic [750:0] stream_bits;
  hmlfc_pkg::config_t stream;
  assign stream = stream_bits;
  logic        parse_ready, head_write, vector_write, entry_write, loaded_valid, loaded_context, loaded_keep;
  logic [1:0]  read_enable;
  logic [19:0] read_word;
  logic [5:0]  head_error, vector_number, entry_number;
  logic [63:0] head_motion, head_residual;
  logic [17:0] vector_data;
  logic [47:0] entry_data;
  hmlfc_residual_parser #(.BLOCK_LOG2(2), .CONTEXTS(2), .CONTEXT_WORDS(512), .WINDOW_BITS(512), .SKEW_BITS(6)) dut (
    .clk(clk), .rst_n(rst_n), .stream(stream_bits), .parse_valid(parse_valid), .parse_ready(parse_ready), .parse_context(parse_context),
    .parse_info(parse_info), .parse_error(parse_error), .parse_empty(parse_empty), .parse_skew(parse_skew), .parse_bits(parse_bits),
    .read_enable(read_enable), .read_word(read_word), .window(window), .head_write(head_write), .head_error(head_error), .head_motion(head_motion),
    .head_residual(head_residual), .vector_write(vector_write), .vector_number(vector_number), .vector_data(vector_data), .entry_write(entry_write),
    .entry_number(entry_number), .entry_data(entry_data), .loaded_valid(loaded_valid), .loaded_context(loaded_context), .loaded_keep(loaded_keep));

  `SEE(4, \dut.state )
  `SEE(1, \dut.context_number )
  `SEE(1, \dut.predictive )
  `SEE(4, \dut.rows )
  `SEE(4, \dut.columns )
  `SEE(6, \dut.skew )
  `SEE(18, \dut.bits )
  `SEE(18, \dut.position )
  `SEE(6, \dut.error )
  `SEE(1, \dut.fresh )
  `SEE(6, \dut.shift )
  `SEE(1, \dut.held )
  `SEE(64, \dut.motion_mask )
  `SEE(64, \dut.residual_mask )
  `SEE(2, \dut.motion_mode )
  `SEE(2, \dut.residual_mode )
  `SEE(80, \dut.mask_field )
  `SEE(64, \dut.masks.mask )
  `SEE(64, \dut.masks.in_plane )
  `SEE(7, \dut.masks.bits )
  wire [142:0] near = window[142:0];
  wire [79:0]  field = 80'(near >> \dut.shift );

  // Wiring: no one reads more than 127 bits of the window of vertical components.
  `IS(4, \dut.columns , \dut.masks.columns )
  `IS(4, \dut.rows , \dut.masks.rows )
  `IS(2, (\dut.state == MOTION_MASK ? \dut.motion_mode : \dut.residual_mode ), \dut.masks.mode )
  `IS(80, \dut.mask_field , \dut.masks.field )
  `IS(32, field[31:0], \dut.bounds.field )
  `IS(7, stream.window, \dut.bounds.search_window )
  `IS(18, \dut.position , \dut.bounds.position )
  `IS(18, \dut.bits , \dut.bounds.bits )
  `IS(7, stream.window, \dut.vectors.search_window )
  `IS(18, \dut.position , \dut.vectors.position )
  `IS(1, vector_write, \dut.vectors.vector_write )
  `IS(6, vector_number, \dut.vectors.vector_number )
  `IS(18, vector_data, \dut.vectors.vector_data )
  `IS(4, stream.depth, \dut.headers.depth )
  `IS(1, stream.features.residual_step, \dut.headers.steps )
  `IS(6, \dut.skew , \dut.headers.skew )
  `IS(18, \dut.bits , \dut.headers.bits )
  `IS(32, field[31:0], \dut.headers.field )
  `IS(18, \dut.position , \dut.headers.position )
  `IS(1, entry_write, \dut.headers.entry_write )
  `IS(6, entry_number, \dut.headers.entry_number )
  `IS(48, entry_data, \dut.headers.entry_data )
  `SEE(1024, \dut.vectors.window )

  // The tile, the modes, and where the masks end.
  logic         stepped = 1'b0;
  logic [3:0]   was_state;
  logic         overran, left_plane, took, read_modes, masked, refused;
  logic [38:0]  tile, given;
  logic [63:0]  was_motion, was_residual, was_mask;
  logic [3:0]   modes;
  logic [17:0]  after_modes, after_mask;
  wire [38:0]   kept = {\dut.predictive , \dut.rows , \dut.columns , \dut.skew , \dut.bits , 6'd0};
  wire          takes = \dut.state == IDLE && parse_valid;
  wire          in_mask = \dut.state == MOTION_MASK || \dut.state == RESIDUAL_MASK;
  wire          outside = ((\dut.motion_mask | \dut.residual_mask ) & ~\dut.masks.in_plane ) != 0;
  always @(posedge clk) begin
    stepped <= rst_n;
    was_state <= \dut.state ;
    took <= takes;
    refused <= parse_empty || parse_error != 0;
    given <= {parse_info, parse_skew, parse_bits, 6'd0};
    tile <= kept;
    read_modes <= \dut.state == MODES && \dut.fresh ;
    modes <= {\dut.predictive ? field[3:2] : field[1:0], \dut.predictive ? field[1:0] : 2'd0};
    after_modes <= \dut.position + (\dut.predictive ? 18'd4 : 18'd2);
    masked <= in_mask && (!\dut.masks.mode [1] || \dut.held );
    {was_motion, was_residual, was_mask} <= {\dut.motion_mask , \dut.residual_mask , \dut.masks.mask };
    after_mask <= \dut.position + \dut.masks.bits ;
    overran <= \dut.state == CHECK && (\dut.position > \dut.bits );
    left_plane <= \dut.state == CHECK && outside;
  end
  always @* begin
    assert (\dut.vectors.window [126:0] == window[126:0] && \dut.vectors.window [638:512] == window[638:512]);
    assert (parse_ready == (\dut.state == IDLE) && head_write == (\dut.state == FINISH) && loaded_valid == head_write);
    assert (head_error == \dut.error && head_motion == \dut.motion_mask && head_residual == \dut.residual_mask );
    assert (loaded_context == \dut.context_number && loaded_keep == (\dut.error != HMLFC_ERROR_BUS_ERROR));
    if (stepped) begin
      assert (kept == (took ? given : tile));
      if (took) begin
        assert (\dut.position == 0 && \dut.motion_mask == 0 && \dut.residual_mask == 0);
        assert (\dut.state == (refused ? FINISH : MODES));
      end else begin
        assert (\dut.motion_mask == (masked && was_state == MOTION_MASK ? was_mask : was_motion));
        assert (\dut.residual_mask == (masked && was_state == RESIDUAL_MASK ? was_mask : was_residual));
      end
      if (read_modes) assert ({\dut.residual_mode , \dut.motion_mode } == modes && \dut.position == after_modes && \dut.state == MOTION_MASK);
      if (masked) assert (\dut.position == after_mask && \dut.state == (was_state == MOTION_MASK ? RESIDUAL_MASK : CHECK));
      if (overran || left_plane) begin
        assert (\dut.state == FINISH && \dut.error == (overran ? HMLFC_ERROR_TILE_OVERRUN : HMLFC_ERROR_MASK_OUTSIDE));
      end
      if (was_state == CHECK && !overran && !left_plane && \dut.state == FINISH) assert (\dut.motion_mask == 0 && \dut.residual_mask == 0);
    end
  end
endmodule
