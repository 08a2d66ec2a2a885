// Each of the four reads of the table of images gives, of any entry, the fields that were written to it last. With
// TRACE its place, too.
//
// Clauses: none: the order of decoding (docs/pipeline.md)
// Engine: bmc 3
// Memories: arrays
// Complete: what an entry holds is all the state there is.
module prove_images #(
  parameter integer TRACE = 1
) (
  input logic clk, input logic write, input logic [hmlfc_pkg::VIEW_BITS+2:0] write_id,
      input logic [hmlfc_pkg::IMAGE_BITS-1:0] write_image,
  input logic [hmlfc_pkg::VIEW_BITS+2:0] tiles_id, input logic [hmlfc_pkg::VIEW_BITS+2:0] disparity_id,
  input logic references_read, input logic [hmlfc_pkg::VIEW_BITS+2:0] references_id,
      input logic [hmlfc_pkg::VIEW_BITS+2:0] place_id
);
  hmlfc_pkg::image_t image;
  logic [hmlfc_pkg::IMAGE_TILES_BITS-1:0] tiles;
  logic [hmlfc_pkg::TILE_BITS-1:0] disparity_tile;
  logic [hmlfc_pkg::IMAGE_REFERENCES_BITS-1:0] references;
  logic [2*hmlfc_pkg::GRID_BITS-1:0] place;
  // The entry that is watched.
  (* anyconst *) logic [hmlfc_pkg::VIEW_BITS+2:0] id;
  (* anyconst *) logic shallow;  // levels 0 to 3, or the first half of the views
  localparam integer VIEW_BIT = hmlfc_pkg::VIEW_BITS + 2;
  always @* begin
    assume (!(shallow ? write_id[2] : write_id[VIEW_BIT]) && !(shallow ? tiles_id[2] : tiles_id[VIEW_BIT]));
    assume (!(shallow ? disparity_id[2] : disparity_id[VIEW_BIT]) && !(shallow ? id[2] : id[VIEW_BIT]));
    assume (!(shallow ? references_id[2] : references_id[VIEW_BIT]) && !(shallow ? place_id[2] : place_id[VIEW_BIT]));
  end
  hmlfc_images #(.TRACE(TRACE)) dut (
    .clk(clk), .shallow(shallow), .write(write), .write_id(write_id), .write_image(write_image), .tiles_id(tiles_id),
    .tiles(tiles), .disparity_id(disparity_id), .disparity_tile(disparity_tile), .references_read(references_read),
    .references_id(references_id), .references(references), .place_id(place_id), .place(place));

  logic is_written = 1'b0;
  logic [hmlfc_pkg::IMAGE_BITS-1:0] written;
  assign image = written;
  logic is_read = 1'b0;  // after it was written, and nothing else since
  hmlfc_pkg::image_t read_image;
  logic [hmlfc_pkg::IMAGE_BITS-1:0] read_bits;
  assign read_image = read_bits;
  always @(posedge clk) begin
    if (write && write_id == id) {is_written, written} <= {1'b1, write_image};
    if (references_read) {is_read, read_bits} <= {is_written && references_id == id, written};
  end
  always @* if (write) assume (!references_read || write_id != references_id);  // hmlfc_view writes before jobs come
  always @* if (is_written) begin
    if (tiles_id == id) assert (tiles == image.tiles);
    if (disparity_id == id) assert (disparity_tile == image.disparity_tile);
    if (is_read) assert (references == read_image.references);
    if (place_id == id) assert (place == (TRACE != 0 ? {image.row, image.col} : 20'd0));
  end
endmodule
