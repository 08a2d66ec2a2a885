// Any one block that enters with `put` while none is followed, until it leaves with `take`: `followed`, of `width` bits,
// and how many are `ahead` of it, of `held` in all.
`define FOLLOW(width, entry) \
  (* anyseq *) logic follow; \
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
