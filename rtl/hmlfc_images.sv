// The table of images: of each of the views that are held, one image a level. Entry {view, level}.
//
// Written by hmlfc_view; four read ports, combinational.
module hmlfc_images #(
    localparam int ID_BITS = hmlfc_pkg::VIEW_BITS + 3
) (
    input logic clk,
    input logic write,
    input logic [ID_BITS-1:0] write_id,
    input hmlfc_pkg::image_t write_image,
    input logic [ID_BITS-1:0] id_0,
    input logic [ID_BITS-1:0] id_1,
    input logic [ID_BITS-1:0] id_2,
    input logic [ID_BITS-1:0] id_3,
    output hmlfc_pkg::image_t image_0,
    output hmlfc_pkg::image_t image_1,
    output hmlfc_pkg::image_t image_2,
    output hmlfc_pkg::image_t image_3
);
  logic [hmlfc_pkg::IMAGE_BITS-1:0] table_of_images[1<<ID_BITS];
  always_ff @(posedge clk) if (write) table_of_images[write_id] <= write_image;
  assign image_0 = table_of_images[id_0];
  assign image_1 = table_of_images[id_1];
  assign image_2 = table_of_images[id_2];
  assign image_3 = table_of_images[id_3];
endmodule
