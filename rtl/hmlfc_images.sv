// The table of images: of each of the two views that are held, one image a level. Entry {view, level}.
//
// Written by hmlfc_view; four read ports, combinational.
module hmlfc_images (
    input logic clk,
    input logic write,
    input logic [3:0] write_id,
    input hmlfc_pkg::image_t write_image,
    input logic [3:0] id_0,
    input logic [3:0] id_1,
    input logic [3:0] id_2,
    input logic [3:0] id_3,
    output hmlfc_pkg::image_t image_0,
    output hmlfc_pkg::image_t image_1,
    output hmlfc_pkg::image_t image_2,
    output hmlfc_pkg::image_t image_3
);
  logic [hmlfc_pkg::IMAGE_BITS-1:0] table_of_images[16];
  always_ff @(posedge clk) if (write) table_of_images[write_id] <= write_image;
  assign image_0 = table_of_images[id_0];
  assign image_1 = table_of_images[id_1];
  assign image_2 = table_of_images[id_2];
  assign image_3 = table_of_images[id_3];
endmodule
