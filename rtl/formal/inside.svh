// Signals inside the module of a proof, by their names from there: one to be read, one that equals a port or an expression, two that are the same.
`define SEEN(width, name) (* hierconn *) wire [width-1:0] name ;
`define PORT(width, port, name) (* hierconn *) wire [width-1:0] name ; always @* assert (port == name );
`define LINK(width, one, other) (* hierconn *) wire [width-1:0] one , other ; always @* assert (one == other );

// Any one block that enters with `put` while none is followed, until it leaves with `take`: `followed`, of `width` bits, and how many are `ahead` of it, of
// `held` in all. In the runs of a mutant it is the first.
`ifdef HMLFC_BASE_CASE
`define ANY_BLOCK wire follow = 1'b1;
`else
`define ANY_BLOCK (* anyseq *) logic follow;
`endif
`define FOLLOW(width, entry) \
  `ANY_BLOCK \
  logic             started = 1'b0; \
  logic [2:0]       held, ahead; \
  logic             following; \
  logic [width-1:0] followed; \
  wire  [2:0]       rest = held - {2'd0, take}; \
  always @(posedge clk) begin \
    started <= 1'b1; \
    held <= rst_n ? rest + {2'd0, put} : 3'd0; \
    if (put && follow && !following) {ahead, followed} <= {rest, entry}; \
    else if (take) ahead <= ahead - 3'd1; \
    following <= rst_n && (following ? !(take && ahead == 0) : put && follow); \
  end
