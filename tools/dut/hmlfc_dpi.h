/* The golden model for SystemVerilog, through DPI-C: plain C99, without svdpi.h.
 *
 *   import "DPI-C" function chandle hmlfc_dpi_open(input string path, output int status);
 *   import "DPI-C" function int hmlfc_dpi_field(input chandle stream, input string name);
 *   import "DPI-C" function int hmlfc_dpi_block(input chandle stream,
 *       input int row, input int col, input int plane, input int block_x, input int block_y,
 *       input int stop_level, output int samples[64]);
 *   import "DPI-C" function int hmlfc_dpi_stage(input chandle stream,
 *       input int row, input int col, input int plane, input int block_x, input int block_y,
 *       input int level, input string stage, output int values[64]);
 *   import "DPI-C" function void hmlfc_dpi_close(input chandle stream);
 *
 * testbench/dpi/ is an example. Statuses are the numbers of annex A of the specification, as those
 * of the decode unit's answers: 0 for success. */
#ifndef HMLFC_DPI_H
#define HMLFC_DPI_H

#ifdef __cplusplus
extern "C" {
#endif

/* Opens the stream in the file `path`. Null on failure; *status is then the error, or -1 where the
 * file cannot be read. */
void* hmlfc_dpi_open(const char* path, int* status);

/* The header field `name` (FIL-1): "rows", "cols", "width", "height", "depth", "chroma_format",
 * "block_log2" or "tree_height"; -1 for other names. */
int hmlfc_dpi_field(void* stream, const char* name);

/* Decodes one block of plane 0 Y, 1 Co or 2 Cg at stop level s of DEC-1: B * B samples row by row
 * at the front of `samples`, which has room for 64. Returns the status. */
int hmlfc_dpi_block(void* stream, int row, int col, int plane, int block_x, int block_y,
                    int stop_level, int* samples);

/* The values of one stage of the block at a level of its tree: "parent", "reference", "prediction",
 * "residual" or "sample". Returns their number, B * B; 0 where the block has no such stage there;
 * minus the status where it does not decode. */
int hmlfc_dpi_stage(void* stream, int row, int col, int plane, int block_x, int block_y, int level,
                    const char* stage, int* values);

/* Ends the use of `stream`; null is allowed. */
void hmlfc_dpi_close(void* stream);

#ifdef __cplusplus
}
#endif

#endif
