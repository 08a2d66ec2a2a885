// SPDX-License-Identifier: BSD-3-Clause
// Types that the modules of the decode unit share. Field names are those of the specification.
package hmlfc_pkg;

  localparam int VIEWS = 16;         // views held, a power of two; half of them where a tree has over four levels
  localparam int VIEW_BITS = $clog2(VIEWS);
  localparam int LEVELS = 8;         // levels of a tree this unit takes: tree_height <= 7
  localparam int ADDRESS_BITS = 40;  // byte addresses of the read master
  localparam int TILE_BITS = 44;     // tile numbers (IDX-2) within the unit's limits
  localparam int BLOCK_BITS = 13;    // block columns and rows: 16384 samples in blocks of 2
  localparam int GRID_BITS = 10;     // rows and columns of images: 1024
  localparam int STRIP_BYTES = 128;  // of a strip's place in the reference area
  localparam int STRIP_HEAD_HALVES = 5;  // of 16 bits: width and base of each quarter of 16 samples
  localparam int STRIP_HALVES_BITS = 6;  // of a strip there are at most 61
  localparam int POSITION_BITS = 18; // bit positions in a tile record (section 11), with its skew

  // Widths of the structures below, for memories of them. hmlfc_widths checks them.
  localparam int LEVEL_BITS = 123;
  localparam int IMAGE_TILES_BITS = TILE_BITS + 2;
  localparam int IMAGE_REFERENCES_BITS = 4 * ADDRESS_BITS + 114;
  localparam int IMAGE_BITS = 2 * GRID_BITS + TILE_BITS + IMAGE_TILES_BITS + IMAGE_REFERENCES_BITS;
  localparam int JOB_BITS = VIEW_BITS + 43;
  localparam int MOTION_BITS = 33;
  localparam int FLOW_BITS = JOB_BITS + 58;
  localparam int PENDING_BITS = JOB_BITS + 55;
  localparam int READ_REQUEST_BITS = ADDRESS_BITS + 11;
  localparam int READ_RESPONSE_BITS = 4;
  localparam int DESCRIPTOR_BITS = 2 * ADDRESS_BITS + 4 * BLOCK_BITS + 96;

  // What a store keeps (hmlfc_tile_store), and the bits of what it is told about a tile.
  localparam int RESIDUAL_TILES = 0;
  localparam int MOTION_TILES = 1;     // of predictive images
  localparam int DISPARITY_TILES = 2;  // motion tiles of reference images
  localparam int TILE_INFO_BITS = 17;

  // What a client asks of hmlfc_read_port: whole beats from a beat-aligned address. It holds until `ready`.
  typedef struct packed {
    logic valid;
    logic [ADDRESS_BITS-1:0] address;
    logic [9:0] beats;  // [1, 1023]
  } read_request_t;

  // What the client gets, next to the beat itself, which goes to all clients.
  typedef struct packed {
    logic ready;  // the request is taken
    logic valid;  // the beat is for this client
    logic last;   // it ends the request
    logic error;  // SLVERR or DECERR
  } read_response_t;

  // Bits of feature_flags (EXT-1).
  typedef struct packed {
    logic balanced_groups;
    logic level_keys;
    logic lossy_keys;
    logic chroma_motion;
    logic two_references;
    logic shared_disparity;
    logic subpel_vectors;
    logic motion_tiles;
    logic residual_step;
  } features_t;

  // Size of a plane: samples, blocks, tiles (STR-6), strips of the reference area.
  typedef struct packed {
    logic [14:0] width;
    logic [14:0] height;
    logic [13:0] blocks_x;
    logic [13:0] blocks_y;
    logic [10:0] tiles_x;
    logic [10:0] strips_x;
    logic [21:0] first_tile;  // of the plane among the tiles of an image (IDX-2)
  } plane_t;

  // A motion plane (MOT-1).
  typedef struct packed {
    logic [14:0] width;
    logic [14:0] height;
    logic [9:0] tiles_x;
    logic [21:0] first_tile;
  } motion_plane_t;

  // What LOAD found out about the stream; constant while blocks are decoded.
  typedef struct packed {
    features_t features;
    logic [3:0] depth;
    logic chroma_444;
    logic [2:0] tree_height;
    logic [6:0] window;
    logic [1:0] vector_precision;
    logic [2:0] disparity_precision;
    logic [2:0] motion_tile_log2;
    logic [2:0] disparity_grid_log2;
    logic signed [7:0] row_scale;
    logic [10:0] rows;
    logic [10:0] cols;
    logic [7:0] cluster_rows;
    logic [7:0] cluster_cols;
    plane_t luma;
    plane_t chroma;
    logic [21:0] first_tile_cg;
    motion_plane_t motion_luma;
    motion_plane_t motion_chroma;  // with chroma_motion
    logic [21:0] tiles_per_image;
    logic [33:0] luma_bytes;       // of a plane Y in the reference area
    logic [33:0] chroma_bytes;     // of a plane Co or Cg
    logic [33:0] reference_bytes;  // of the three planes of a reference image
    logic [ADDRESS_BITS-1:0] root_address;
    logic [ADDRESS_BITS-1:0] group_address;
    logic [ADDRESS_BITS-5:0] group_records;
    logic [ADDRESS_BITS-1:0] tile_address;
    logic [ADDRESS_BITS-1:0] tile_bytes;
  } config_t;

  // One level of the tree, as LOAD derives it.
  typedef struct packed {
    logic [10:0] rows;
    logic [10:0] cols;
    logic [7:0] ref_rows;
    logic [7:0] ref_cols;
    logic [10:0] group_rows;
    logic [10:0] group_cols;
    logic keyed;
    logic [21:0] first_image;
    logic [ADDRESS_BITS-1:0] reference_address;  // of its first reference image
  } level_t;

  // What each stage needs of one requested image of the tree: where its tiles begin,
  typedef struct packed {
    logic keyed;
    logic is_reference;                      // it is the reference image of its reference group
    logic [TILE_BITS-1:0] first_tile;
  } image_tiles_t;

  // and its references K0 to K3 (MOT-7).
  typedef struct packed {
    logic keyed;
    logic is_reference;
    logic [ADDRESS_BITS-1:0] address_0;      // plane Y of K0 in the reference area
    logic [ADDRESS_BITS-1:0] address_1;
    logic [ADDRESS_BITS-1:0] address_2;
    logic [ADDRESS_BITS-1:0] address_3;
    logic signed [9:0] cols_0;               // ck - c of MOT-8
    logic signed [9:0] cols_1;
    logic signed [9:0] cols_2;
    logic signed [9:0] cols_3;
    logic signed [17:0] rows_0;              // row_scale * (rk - r)
    logic signed [17:0] rows_1;
    logic signed [17:0] rows_2;
    logic signed [17:0] rows_3;
  } image_references_t;

  typedef struct packed {
    logic [GRID_BITS-1:0] row;
    logic [GRID_BITS-1:0] col;
    image_tiles_t tiles;
    logic [TILE_BITS-1:0] disparity_tile;    // first tile of K0
    image_references_t references;
  } image_t;

  // One block of one plane of one image: a block of one level (DEC-3).
  typedef struct packed {
    logic [VIEW_BITS+2:0] id;       // of its view in the table of images, and its level: {view, level}
    logic [1:0] plane;
    logic [BLOCK_BITS-1:0] bx;
    logic [BLOCK_BITS-1:0] by;
    logic first;          // no parent: DEC-1 begins here
    logic last;           // the result of the plane
    logic rgb;            // for a request for RGB
    logic residuals;      // for a request for residuals (DEC-4): no parent
    logic answer;         // the request is answered after it
    logic tlast;
    logic [5:0] error;    // known before decoding: bad_request, or that of LOAD
  } job_t;

  // How a block is predicted, as its entry in the stream says (MOT-3, TIL-7).
  typedef struct packed {
    logic used;                       // the state is one with motion
    logic negative;                   // sign -
    logic [2:0] reference_set;        // MOT-7
    logic [3:0] choice;               // MOT-5
    logic signed [11:0] explicit_x;
    logic signed [11:0] explicit_y;
  } motion_t;

  // A block in flight through the tile stores.
  typedef struct packed {
    job_t job;
    logic residual_asked;             // it has a context in the store of residual tiles
    logic [4:0] residual_context;
    logic motion_asked;
    logic [1:0] motion_context;
    logic disparity_asked;
    logic [1:0] disparity_context;
    motion_t motion;
    logic signed [12:0] disparity;
  } flow_t;

  // A block whose samples are made from what it waits for: windows of references, residuals.
  typedef struct packed {
    job_t job;
    logic key;              // a block of a key image: its window is the samples (DEC-2)
    logic base_zero;        // EXT-5
    logic motion;
    logic negative;
    logic two;              // references
    logic first_from_b;     // the first reference comes through cache B
    logic has_residual;
    logic [8:0] ix_a;       // whole samples, then eighths, of the first and the second reference
    logic [8:0] iy_a;
    logic [2:0] fx_a;
    logic [2:0] fy_a;
    logic [8:0] ix_b;
    logic [8:0] iy_b;
    logic [2:0] fx_b;
    logic [2:0] fy_b;
  } pending_t;

  // Blocks of a plane, both ends included.
  typedef struct packed {
    logic [BLOCK_BITS-1:0] first_x;
    logic [BLOCK_BITS-1:0] last_x;
    logic [BLOCK_BITS-1:0] first_y;
    logic [BLOCK_BITS-1:0] last_y;
  } rectangle_t;

  // What a descriptor of the view queue asks for.
  typedef struct packed {
    logic [31:0] tag;
    logic refused;                        // a field is outside its interval
    logic failed;                         // it could not be read, and its tag is 0
    logic [11:0] row;
    logic [11:0] col;
    logic [3:0] stop_level;
    logic [2:0] format;
    logic residuals;                      // residuals of a reference image, as strips; `format` is the plane
    rectangle_t blocks;
    logic [2:0] end_column;               // in its block, of the rectangle's last column
    logic [2:0] end_row;
    logic [ADDRESS_BITS-1:0] destination;
    logic [23:0] pitch;                   // bytes
    logic [ADDRESS_BITS-1:0] bitmap;      // 0: none
  } view_t;

  // Formats of a descriptor; 0 to 2 are samples of a plane.
  localparam logic [2:0] FORMAT_RGB888 = 3'd4;
  localparam logic [2:0] FORMAT_RGB101010 = 3'd5;
  localparam logic [2:0] FORMAT_RGB161616 = 3'd6;

  // Where the writer puts a block, and what ends with it.
  typedef struct packed {
    logic has_block;                      // there is a block; else only `tile_ends` counts
    logic tile_ends;                      // the last position in a tile of which the rectangle has blocks
    logic [2:0] tile_x;                   // of the block in its tile
    logic [2:0] tile_y;
    logic [21:0] tile;                    // number of its tile, row by row of those of the rectangle
    logic [2:0] end_column;               // in the block, of the rectangle
    logic [2:0] end_row;
    logic [ADDRESS_BITS-1:0] address;     // of the block's first pixel
  } place_t;

endpackage
