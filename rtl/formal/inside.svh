// Signals inside the module of a proof, by their names from there: one to be read, one that equals a port or an expression, two that are the same.
`define SEEN(width, name) (* hierconn *) wire [width-1:0] name ;
`define PORT(width, port, name) (* hierconn *) wire [width-1:0] name ; always @* assert (port == name );
`define LINK(width, one, other) (* hierconn *) wire [width-1:0] one , other ; always @* assert (one == other );
