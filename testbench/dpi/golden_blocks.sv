/// An example of a SystemVerilog bench that calls the golden model (hmlfc_dpi.h): decodes every
/// block of one plane of one view, level by level, and checks that the sample of each level is the
/// parent of the level below. Run with +stream=FILE +row=R +col=C +plane=P.
module golden_blocks;
  import "DPI-C" function chandle hmlfc_dpi_open(input string path, output int status);
  import "DPI-C" function int hmlfc_dpi_field(input chandle stream, input string name);
  import "DPI-C" function int hmlfc_dpi_block(input chandle stream,
      input int row, input int col, input int plane, input int block_x, input int block_y,
      input int stop_level, output int samples[64]);
  import "DPI-C" function int hmlfc_dpi_stage(input chandle stream,
      input int row, input int col, input int plane, input int block_x, input int block_y,
      input int level, input string stage, output int values[64]);
  import "DPI-C" function void hmlfc_dpi_close(input chandle stream);

  chandle stream;
  string path;
  int status, row, col, plane, columns, rows, side, halved, errors, blocks;
  int samples[64];
  int parents[64];

  /// Blocks along a side of `size` pixels (STR-2, STR-6).
  function int block_count(input int size);
    block_count = ((halved != 0 ? (size + 1) / 2 : size) + side - 1) / side;
  endfunction

  /// One block: the samples of stop level 1 must be the parent of level 0.
  task check_block(input int block_x, input int block_y);
    status = hmlfc_dpi_block(stream, row, col, plane, block_x, block_y, 0, samples);
    if (status != 0) $display("block %0d,%0d: error %0d", block_x, block_y, status);
    else begin
      $write("block %0d,%0d:", block_x, block_y);
      for (int i = 0; i < side * side; i++) $write(" %0d", samples[i]);
      $write("\n");
    end
    if (status == 0 && hmlfc_dpi_field(stream, "tree_height") > 0) begin
      status = hmlfc_dpi_block(stream, row, col, plane, block_x, block_y, 1, samples);
      if (hmlfc_dpi_stage(stream, row, col, plane, block_x, block_y, 0, "parent", parents) > 0)
        for (int i = 0; i < side * side; i++) if (samples[i] != parents[i]) errors++;
    end
    blocks++;
  endtask

  initial begin
    if (!$value$plusargs("stream=%s", path)) $fatal(1, "+stream=FILE is missing");
    if (!$value$plusargs("row=%d", row)) row = 0;
    if (!$value$plusargs("col=%d", col)) col = 0;
    if (!$value$plusargs("plane=%d", plane)) plane = 0;
    stream = hmlfc_dpi_open(path, status);
    if (status != 0) $display("error %0d", status);
    else begin
      side = 1 << hmlfc_dpi_field(stream, "block_log2");
      halved = (plane != 0 && hmlfc_dpi_field(stream, "chroma_format") == 0) ? 1 : 0;
      columns = block_count(hmlfc_dpi_field(stream, "width"));
      rows = block_count(hmlfc_dpi_field(stream, "height"));
      for (int y = 0; y < rows; y++) for (int x = 0; x < columns; x++) check_block(x, y);
      $display("%0d blocks, %0d errors", blocks, errors);
      hmlfc_dpi_close(stream);
    end
    $finish;
  end
endmodule
