// Every signal between the parts of the decode unit, and its ports, goes to its own place: requests to the list of those in flight and to jobs, jobs by way of
// tiles and references to samples and answers, LOAD's results to all, reads to who asked, and a block's record to the trace. 4 x 4 blocks, depth 12, 64 bits.
//
// Clauses: none: the order of decoding (docs/pipeline.md)
// Engine: bmc 1
// Complete: no state; the parts may give anything.
// Fault: hmlfc_decode_unit.sv / .a_valid(window_valid[0]) / .a_valid(window_valid[1])
// Fault: hmlfc_decode_unit.sv / s_request_tready = requests_ready && list_ready / s_request_tready = requests_ready
// Fault: hmlfc_decode_unit.sv / accessed, loading, !idle, reading / accessed, loading, idle, reading
// Fault: hmlfc_decode_unit.sv / .tiles_id(job.id) / .tiles_id(flow.job.id)
// Fault: hmlfc_decode_unit.sv / trace_fy_b} = {done_pending.ix_b, done_pending.iy_b / trace_fy_b} = {done_pending.ix_a, done_pending.iy_b

// In the place of the parts: what they are given, and any outputs.
module hmlfc_activity #(parameter integer CHANNELS = 0, parameter integer PARTS = 0) (input logic clk, input logic rst_n, input logic [4:0] offered, input
  logic [3:0] busy, output logic active);
  (* anyseq *) logic [0:0] any;
  assign {active} = any;
  wire [9:0] given = {rst_n, offered, busy};
endmodule

module hmlfc_answer #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0) (input logic clk, input logic rst_n, input logic [3:0] depth, input
  logic chroma_444, input logic in_valid, input logic [5:0] in_error, input logic [207:0] in_sample, input logic in_has_residual, input logic [223:0]
  in_residual, input logic out_ready, input logic [46:0] in_job, output logic in_ready, output logic chroma_spoiled, output logic out_valid, output logic
  [767:0] out_data, output logic [5:0] out_error, output logic out_last);
  (* anyseq *) logic [777:0] any;
  assign {in_ready, chroma_spoiled, out_valid, out_data, out_error, out_last} = any;
  wire [493:0] given = {rst_n, depth, chroma_444, in_valid, in_error, in_sample, in_has_residual, in_residual, out_ready, in_job};
endmodule

module hmlfc_compose #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0, parameter integer TRACE = 0) (input logic clk, input logic rst_n,
  input logic [3:0] depth, input logic in_valid, input logic [223:0] in_residual, input logic a_valid, input logic [5:0] a_error, input logic [349:0]
  a_window, input logic b_valid, input logic [5:0] b_error, input logic [349:0] b_window, input logic out_ready, input logic [101:0] in_pending, output logic
  in_ready, output logic a_ready, output logic b_ready, output logic out_valid, output logic [5:0] out_error, output logic [207:0] out_sample, output logic
  [223:0] out_residual, output logic [223:0] out_reference, output logic [207:0] out_prediction, output logic [101:0] out_pending);
  (* anyseq *) logic [975:0] any;
  assign {in_ready, a_ready, b_ready, out_valid, out_error, out_sample, out_residual, out_reference, out_prediction, out_pending} = any;
  wire [1046:0] given = {rst_n, depth, in_valid, in_residual, a_valid, a_error, a_window, b_valid, b_error, b_window, out_ready, in_pending};
endmodule

module hmlfc_control #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0, parameter integer DATA_BITS = 0) (input logic clk, input logic
  rst_n, input logic s_axil_awvalid, input logic [11:0] s_axil_awaddr, input logic s_axil_wvalid, input logic [31:0] s_axil_wdata, input logic [3:0]
  s_axil_wstrb, input logic s_axil_bready, input logic s_axil_arvalid, input logic [11:0] s_axil_araddr, input logic s_axil_rready, input logic idle, input
  logic reading, input logic stray, input logic block_done, input logic answered, input logic [5:0] answer_error, input logic [63:0] answered_request, input
  logic stalled, input logic beat, input logic request_ready, input logic data_valid, input logic [63:0] data, input logic data_last, input logic data_error,
  output logic s_axil_awready, output logic s_axil_wready, output logic s_axil_bvalid, output logic [1:0] s_axil_bresp, output logic s_axil_arready, output
  logic s_axil_rvalid, output logic [31:0] s_axil_rdata, output logic [1:0] s_axil_rresp, output logic loading, output logic enable, output logic [5:0]
  load_error, output logic flush, output logic [983:0] levels, output logic request_valid, output logic [39:0] request_address, output logic [9:0]
  request_beats, output logic [750:0] stream);
  (* anyseq *) logic [1835:0] any;
  assign {s_axil_awready, s_axil_wready, s_axil_bvalid, s_axil_bresp, s_axil_arready, s_axil_rvalid, s_axil_rdata, s_axil_rresp, loading, enable, load_error,
    flush, levels, request_valid, request_address, request_beats, stream} = any;
  wire [210:0] given = {rst_n, s_axil_awvalid, s_axil_awaddr, s_axil_wvalid, s_axil_wdata, s_axil_wstrb, s_axil_bready, s_axil_arvalid, s_axil_araddr,
    s_axil_rready, idle, reading, stray, block_done, answered, answer_error, answered_request, stalled, beat, request_ready, data_valid, data, data_last,
    data_error};
endmodule

module hmlfc_images #(parameter integer TRACE = 0) (input logic clk, input logic write, input logic [6:0] write_id, input logic [6:0] tiles_id, input logic
  [6:0] disparity_id, input logic [6:0] references_id, input logic [6:0] place_id, input logic [383:0] write_image, output logic [43:0] disparity_tile, output
  logic [19:0] place, output logic [45:0] tiles, output logic [273:0] references);
  (* anyseq *) logic [383:0] any;
  assign {disparity_tile, place, tiles, references} = any;
  wire [419:0] given = {write, write_id, tiles_id, disparity_id, references_id, place_id, write_image};
endmodule

module hmlfc_skid_buffer #(parameter integer WIDTH = 0) (input logic clk, input logic rst_n, input logic in_valid, input logic [92:0] in_data, input logic
  out_ready, output logic in_ready, output logic out_valid, output logic [92:0] out_data);
  (* anyseq *) logic [94:0] any;
  assign {in_ready, out_valid, out_data} = any;
  wire [95:0] given = {rst_n, in_valid, in_data, out_ready};
endmodule

module hmlfc_read_port #(parameter integer CLIENTS = 0, parameter integer DATA_BITS = 0, parameter integer ADDRESS_BITS = 0, parameter integer OUTSTANDING =
  0) (input logic clk, input logic rst_n, input logic [10:0] request_valid, input logic [439:0] request_address, input logic [109:0] request_beats, input
  logic m_axi_arready, input logic m_axi_rvalid, input logic [63:0] m_axi_rdata, input logic [1:0] m_axi_rresp, input logic m_axi_rlast, output logic [10:0]
  request_ready, output logic [10:0] data_valid, output logic [63:0] data, output logic data_last, output logic data_error, output logic reading, output logic
  stray, output logic m_axi_arvalid, output logic [39:0] m_axi_araddr, output logic [7:0] m_axi_arlen, output logic [2:0] m_axi_arsize, output logic [1:0]
  m_axi_arburst, output logic m_axi_rready);
  (* anyseq *) logic [144:0] any;
  assign {request_ready, data_valid, data, data_last, data_error, reading, stray, m_axi_arvalid, m_axi_araddr, m_axi_arlen, m_axi_arsize, m_axi_arburst,
    m_axi_rready} = any;
  wire [630:0] given = {rst_n, request_valid, request_address, request_beats, m_axi_arready, m_axi_rvalid, m_axi_rdata, m_axi_rresp, m_axi_rlast};
endmodule

module hmlfc_references #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0, parameter integer DATA_BITS = 0, parameter integer CACHE_STRIPS =
  0) (input logic clk, input logic rst_n, input logic flush, input logic in_valid, input logic in_has_residual, input logic [223:0] in_residual, input logic
  out_ready, input logic [1:0] window_ready, input logic [1:0] request_ready, input logic [1:0] data_valid, input logic [63:0] data, input logic data_last,
  input logic data_error, input logic [750:0] stream, input logic [273:0] in_image, input logic [104:0] in_flow, output logic in_ready, output logic
  out_valid, output logic [223:0] out_residual, output logic [1:0] window_valid, output logic [11:0] window_error, output logic [699:0] window, output logic
  [1:0] request_valid, output logic [79:0] request_address, output logic [19:0] request_beats, output logic [101:0] out_pending);
  (* anyseq *) logic [1143:0] any;
  assign {in_ready, out_valid, out_residual, window_valid, window_error, window, request_valid, request_address, request_beats, out_pending} = any;
  wire [1430:0] given = {rst_n, flush, in_valid, in_has_residual, in_residual, out_ready, window_ready, request_ready, data_valid, data, data_last,
    data_error, stream, in_image, in_flow};
endmodule

module hmlfc_fifo #(parameter integer WIDTH = 0, parameter integer DEPTH = 0) (input logic clk, input logic rst_n, input logic in_valid, input logic [63:0]
  in_data, input logic out_ready, output logic in_ready, output logic out_valid, output logic [63:0] out_data, output logic [9:0] count);
  (* anyseq *) logic [75:0] any;
  assign {in_ready, out_valid, out_data, count} = any;
  wire [66:0] given = {rst_n, in_valid, in_data, out_ready};
endmodule

module hmlfc_requests (input logic clk, input logic rst_n, input logic enable, input logic [5:0] load_error, input logic flush, input logic s_valid, input
  logic [63:0] s_data, input logic s_last, input logic view_done, input logic [7:0] view_keys, input logic job_ready, input logic chroma_spoiled, input logic
  finished_valid, input logic [3:0] finished_slot, input logic [750:0] stream, output logic s_ready, output logic view_start, output logic [9:0] view_row,
  output logic [9:0] view_col, output logic [3:0] view_slot, output logic job_valid, output logic [46:0] job);
  (* anyseq *) logic [73:0] any;
  assign {s_ready, view_start, view_row, view_col, view_slot, job_valid, job} = any;
  wire [841:0] given = {rst_n, enable, load_error, flush, s_valid, s_data, s_last, view_done, view_keys, job_ready, chroma_spoiled, finished_valid,
    finished_slot, stream};
endmodule

module hmlfc_tile_stores #(parameter integer BLOCK_LOG2 = 0, parameter integer MAX_DEPTH = 0, parameter integer DATA_BITS = 0, parameter integer TILE_CONTEXTS
  = 0, parameter integer RESIDUAL_LOADERS = 0, parameter integer OTHER_LOADERS = 0) (input logic clk, input logic rst_n, input logic flush, input logic
  in_valid, input logic [43:0] disparity_first_tile, input logic out_ready, input logic [7:0] request_ready, input logic [7:0] data_valid, input logic [63:0]
  data, input logic data_last, input logic data_error, input logic [750:0] stream, input logic [46:0] in_job, input logic [45:0] in_image, output logic
  in_ready, output logic [6:0] disparity_id, output logic out_valid, output logic out_has_residual, output logic [223:0] out_residual, output logic [7:0]
  request_valid, output logic [319:0] request_address, output logic [79:0] request_beats, output logic [104:0] out_flow);
  (* anyseq *) logic [746:0] any;
  assign {in_ready, disparity_id, out_valid, out_has_residual, out_residual, request_valid, request_address, request_beats, out_flow} = any;
  wire [973:0] given = {rst_n, flush, in_valid, disparity_first_tile, out_ready, request_ready, data_valid, data, data_last, data_error, stream, in_job,
    in_image};
endmodule

module hmlfc_view (input logic clk, input logic rst_n, input logic [983:0] levels, input logic start, input logic [9:0] view_row, input logic [9:0] view_col,
  input logic [750:0] stream, output logic done, output logic [7:0] keys, output logic write, output logic [2:0] write_level, output logic [383:0]
  write_image);
  (* anyseq *) logic [396:0] any;
  assign {done, keys, write, write_level, write_image} = any;
  wire [1756:0] given = {rst_n, levels, start, view_row, view_col, stream};
endmodule

module prove_decode_unit (
  input logic clk, input logic rst_n, input logic request_tvalid, input logic [63:0] request_tdata, input logic request_tlast, input logic response_tready,
    input logic arready, input logic rvalid, input logic [63:0] rdata, input logic [1:0] rresp, input logic rlast, input logic rid, input logic awvalid, input
    logic [11:0] awaddr, input logic wvalid, input logic [31:0] wdata, input logic [3:0] wstrb, input logic bready, input logic arvalid, input logic [11:0]
    araddr, input logic rready
);
  logic s_request_tready, m_response_tvalid, m_response_tlast, m_axi_arvalid, m_axi_arid, m_axi_rready, s_axil_awready, s_axil_wready, s_axil_bvalid,
    s_axil_arready, s_axil_rvalid, active, trace_valid, trace_key, trace_motion, trace_negative, trace_has_residual;
  logic [767:0] m_response_tdata;
  logic [5:0] m_response_tuser, trace_error;
  logic [39:0] m_axi_araddr;
  logic [7:0] m_axi_arlen;
  logic [2:0] m_axi_arsize, trace_fx_a, trace_fy_a, trace_fx_b, trace_fy_b;
  logic [1:0] m_axi_arburst, s_axil_bresp, s_axil_rresp, trace_plane, trace_references;
  logic [31:0] s_axil_rdata;
  logic [3:0] trace_level;
  logic [14:0] trace_bx, trace_by;
  logic [11:0] trace_row, trace_col;
  logic [8:0] trace_ix_a, trace_iy_a, trace_ix_b, trace_iy_b;
  logic [223:0] trace_residual, trace_reference;
  logic [207:0] trace_prediction, trace_sample;
  hmlfc_decode_unit #(.BLOCK_LOG2(2), .MAX_DEPTH(12), .AXI_DATA_BITS(64), .OUTSTANDING(4), .TILE_CONTEXTS(2), .TILE_LOADERS(4), .CACHE_STRIPS(64), .TRACE(1)) dut (
    .clk(clk), .rst_n(rst_n), .s_request_tvalid(request_tvalid), .s_request_tdata(request_tdata), .s_request_tlast(request_tlast),
      .m_response_tready(response_tready), .m_axi_arready(arready), .m_axi_rvalid(rvalid), .m_axi_rdata(rdata), .m_axi_rresp(rresp), .m_axi_rlast(rlast),
      .m_axi_rid(rid), .s_axil_awvalid(awvalid), .s_axil_awaddr(awaddr), .s_axil_wvalid(wvalid), .s_axil_wdata(wdata), .s_axil_wstrb(wstrb),
      .s_axil_bready(bready), .s_axil_arvalid(arvalid), .s_axil_araddr(araddr), .s_axil_rready(rready), .s_request_tready(s_request_tready),
      .m_response_tvalid(m_response_tvalid), .m_response_tdata(m_response_tdata), .m_response_tuser(m_response_tuser), .m_response_tlast(m_response_tlast),
      .m_axi_arvalid(m_axi_arvalid), .m_axi_araddr(m_axi_araddr), .m_axi_arlen(m_axi_arlen), .m_axi_arsize(m_axi_arsize), .m_axi_arburst(m_axi_arburst),
      .m_axi_arid(m_axi_arid), .m_axi_rready(m_axi_rready), .s_axil_awready(s_axil_awready), .s_axil_wready(s_axil_wready), .s_axil_bvalid(s_axil_bvalid),
      .s_axil_bresp(s_axil_bresp), .s_axil_arready(s_axil_arready), .s_axil_rvalid(s_axil_rvalid), .s_axil_rdata(s_axil_rdata), .s_axil_rresp(s_axil_rresp),
      .active(active), .trace_valid(trace_valid), .trace_level(trace_level), .trace_plane(trace_plane), .trace_bx(trace_bx), .trace_by(trace_by),
      .trace_row(trace_row), .trace_col(trace_col), .trace_key(trace_key), .trace_motion(trace_motion), .trace_negative(trace_negative),
      .trace_references(trace_references), .trace_ix_a(trace_ix_a), .trace_iy_a(trace_iy_a), .trace_fx_a(trace_fx_a), .trace_fy_a(trace_fy_a),
      .trace_ix_b(trace_ix_b), .trace_iy_b(trace_iy_b), .trace_fx_b(trace_fx_b), .trace_fy_b(trace_fy_b), .trace_has_residual(trace_has_residual),
      .trace_residual(trace_residual), .trace_reference(trace_reference), .trace_prediction(trace_prediction), .trace_sample(trace_sample),
      .trace_error(trace_error));
  (* hierconn *) wire [0:0] \dut.activity.any ; (* hierconn *) wire [9:0] \dut.activity.given ;
  (* hierconn *) wire [777:0] \dut.answers.any ; (* hierconn *) wire [493:0] \dut.answers.given ;
  (* hierconn *) wire [975:0] \dut.compose.any ; (* hierconn *) wire [1046:0] \dut.compose.given ;
  (* hierconn *) wire [1835:0] \dut.control.any ; (* hierconn *) wire [210:0] \dut.control.given ;
  (* hierconn *) wire [383:0] \dut.images.any ; (* hierconn *) wire [419:0] \dut.images.given ;
  (* hierconn *) wire [94:0] \dut.jobs.any ; (* hierconn *) wire [95:0] \dut.jobs.given ;
  (* hierconn *) wire [144:0] \dut.port.any ; (* hierconn *) wire [630:0] \dut.port.given ;
  (* hierconn *) wire [1143:0] \dut.references.any ; (* hierconn *) wire [1430:0] \dut.references.given ;
  (* hierconn *) wire [75:0] \dut.requested.any ; (* hierconn *) wire [66:0] \dut.requested.given ;
  (* hierconn *) wire [73:0] \dut.requests.any ; (* hierconn *) wire [841:0] \dut.requests.given ;
  (* hierconn *) wire [746:0] \dut.tiles.any ; (* hierconn *) wire [973:0] \dut.tiles.given ;
  (* hierconn *) wire [396:0] \dut.view.any ; (* hierconn *) wire [1756:0] \dut.view.given ;
  wire activity_active;
  assign {activity_active} = \dut.activity.any ;
  wire answers_in_ready, answers_chroma_spoiled, answers_out_valid, answers_out_last;
  wire [767:0] answers_out_data;
  wire [5:0] answers_out_error;
  assign {answers_in_ready, answers_chroma_spoiled, answers_out_valid, answers_out_data, answers_out_error, answers_out_last} = \dut.answers.any ;
  wire compose_in_ready, compose_a_ready, compose_b_ready, compose_out_valid;
  wire [5:0] compose_out_error;
  wire [207:0] compose_out_sample, compose_out_prediction;
  wire [223:0] compose_out_residual, compose_out_reference;
  wire [101:0] compose_out_pending;
  assign {compose_in_ready, compose_a_ready, compose_b_ready, compose_out_valid, compose_out_error, compose_out_sample, compose_out_residual,
    compose_out_reference, compose_out_prediction, compose_out_pending} = \dut.compose.any ;
  wire control_s_axil_awready, control_s_axil_wready, control_s_axil_bvalid, control_s_axil_arready, control_s_axil_rvalid, control_loading, control_enable,
    control_flush, control_request_valid;
  wire [1:0] control_s_axil_bresp, control_s_axil_rresp;
  wire [31:0] control_s_axil_rdata;
  wire [5:0] control_load_error;
  wire [983:0] control_levels;
  wire [39:0] control_request_address;
  wire [9:0] control_request_beats;
  wire [750:0] control_stream;
  assign {control_s_axil_awready, control_s_axil_wready, control_s_axil_bvalid, control_s_axil_bresp, control_s_axil_arready, control_s_axil_rvalid,
    control_s_axil_rdata, control_s_axil_rresp, control_loading, control_enable, control_load_error, control_flush, control_levels, control_request_valid,
    control_request_address, control_request_beats, control_stream} = \dut.control.any ;
  wire [43:0] images_disparity_tile;
  wire [19:0] images_place;
  wire [45:0] images_tiles;
  wire [273:0] images_references;
  assign {images_disparity_tile, images_place, images_tiles, images_references} = \dut.images.any ;
  wire jobs_in_ready, jobs_out_valid;
  wire [92:0] jobs_out_data;
  assign {jobs_in_ready, jobs_out_valid, jobs_out_data} = \dut.jobs.any ;
  wire [10:0] port_request_ready, port_data_valid;
  wire [63:0] port_data;
  wire port_data_last, port_data_error, port_reading, port_stray, port_m_axi_arvalid, port_m_axi_rready;
  wire [39:0] port_m_axi_araddr;
  wire [7:0] port_m_axi_arlen;
  wire [2:0] port_m_axi_arsize;
  wire [1:0] port_m_axi_arburst;
  assign {port_request_ready, port_data_valid, port_data, port_data_last, port_data_error, port_reading, port_stray, port_m_axi_arvalid, port_m_axi_araddr,
    port_m_axi_arlen, port_m_axi_arsize, port_m_axi_arburst, port_m_axi_rready} = \dut.port.any ;
  wire references_in_ready, references_out_valid;
  wire [223:0] references_out_residual;
  wire [1:0] references_window_valid, references_request_valid;
  wire [11:0] references_window_error;
  wire [699:0] references_window;
  wire [79:0] references_request_address;
  wire [19:0] references_request_beats;
  wire [101:0] references_out_pending;
  assign {references_in_ready, references_out_valid, references_out_residual, references_window_valid, references_window_error, references_window,
    references_request_valid, references_request_address, references_request_beats, references_out_pending} = \dut.references.any ;
  wire requested_in_ready, requested_out_valid;
  wire [63:0] requested_out_data;
  wire [9:0] requested_count;
  assign {requested_in_ready, requested_out_valid, requested_out_data, requested_count} = \dut.requested.any ;
  wire requests_s_ready, requests_view_start, requests_job_valid;
  wire [9:0] requests_view_row, requests_view_col;
  wire [3:0] requests_view_slot;
  wire [46:0] requests_job;
  assign {requests_s_ready, requests_view_start, requests_view_row, requests_view_col, requests_view_slot, requests_job_valid, requests_job} =
    \dut.requests.any ;
  wire tiles_in_ready, tiles_out_valid, tiles_out_has_residual;
  wire [6:0] tiles_disparity_id;
  wire [223:0] tiles_out_residual;
  wire [7:0] tiles_request_valid;
  wire [319:0] tiles_request_address;
  wire [79:0] tiles_request_beats;
  wire [104:0] tiles_out_flow;
  assign {tiles_in_ready, tiles_disparity_id, tiles_out_valid, tiles_out_has_residual, tiles_out_residual, tiles_request_valid, tiles_request_address,
    tiles_request_beats, tiles_out_flow} = \dut.tiles.any ;
  wire view_done, view_write;
  wire [7:0] view_keys;
  wire [2:0] view_write_level;
  wire [383:0] view_write_image;
  assign {view_done, view_keys, view_write, view_write_level, view_write_image} = \dut.view.any ;

  hmlfc_pkg::pending_t done;
  hmlfc_pkg::flow_t    flow;
  hmlfc_pkg::job_t     job;
  assign done = compose_out_pending;
  assign flow = tiles_out_flow;
  assign job = requests_job;
  wire         asked = request_tvalid && requests_s_ready && requested_in_ready;
  wire         answered = answers_out_valid && response_tready;
  wire         idle = !requested_out_valid;
  wire         block_done = compose_out_valid && answers_in_ready;
  wire         accessed = !control_s_axil_awready || !control_s_axil_wready || control_s_axil_bvalid || control_s_axil_rvalid;
  wire [65:0]  read = {port_data, port_data_last, port_data_error};
  wire [3:0]   depth = control_stream[741:738];
  wire         chroma_444 = control_stream[737];
  always @* begin
    // Requests, those in flight and their views.
    assert (\dut.requested.given == {rst_n, asked, request_tdata, answered});
    assert (\dut.requests.given == {rst_n, control_enable, control_load_error, control_flush, request_tvalid && requested_in_ready, request_tdata, request_tlast,
                                    view_done, view_keys, jobs_in_ready, answers_chroma_spoiled, block_done, done.job.id[6:3], control_stream});
    assert (\dut.view.given == {rst_n, control_levels, requests_view_start, requests_view_row, requests_view_col, control_stream});
    assert (\dut.images.given == {view_write, requests_view_slot, view_write_level, job.id, tiles_disparity_id, flow.job.id, done.job.id, view_write_image});
    // Jobs, their records, references and samples.
    assert (\dut.jobs.given == {rst_n, requests_job_valid, requests_job, images_tiles, tiles_in_ready});
    assert (\dut.tiles.given == {rst_n, control_flush, jobs_out_valid, images_disparity_tile, references_in_ready, port_request_ready[8:1],
                                 port_data_valid[8:1], read, control_stream, jobs_out_data});
    assert (\dut.references.given == {rst_n, control_flush, tiles_out_valid, tiles_out_has_residual, tiles_out_residual, compose_in_ready, compose_b_ready,
                                      compose_a_ready, port_request_ready[10:9], port_data_valid[10:9], read, control_stream, images_references,
                                      tiles_out_flow});
    assert (\dut.compose.given == {rst_n, depth, references_out_valid, references_out_residual, references_window_valid[0], references_window_error[5:0],
                                   references_window[349:0], references_window_valid[1], references_window_error[11:6], references_window[699:350],
                                   answers_in_ready, references_out_pending});
    assert (\dut.answers.given == {rst_n, depth, chroma_444, compose_out_valid, compose_out_error, compose_out_sample, done.has_residual,
                                   compose_out_residual, response_tready, done.job});
    // Reads, registers and the clock.
    assert (\dut.port.given == {rst_n, references_request_valid, tiles_request_valid, control_request_valid, references_request_address,
                                tiles_request_address, control_request_address, references_request_beats, tiles_request_beats, control_request_beats,
                                arready, rvalid, rdata, rresp, rlast});
    assert (\dut.control.given == {rst_n, awvalid, awaddr, wvalid, wdata, wstrb, bready, arvalid, araddr, rready, idle, port_reading, port_stray, block_done,
                                   answered, answers_out_error, requested_out_data, answers_out_valid && !response_tready, rvalid && port_m_axi_rready,
                                   port_request_ready[0], port_data_valid[0], read});
    assert (\dut.activity.given == {rst_n, request_tvalid, rvalid, awvalid, wvalid, arvalid, accessed, control_loading, !idle, port_reading});
    // The unit's ports.
    assert (s_request_tready == (requests_s_ready && requested_in_ready) && active == activity_active);
    assert ({m_response_tvalid, m_response_tdata, m_response_tuser, m_response_tlast} == {answers_out_valid, answers_out_data, answers_out_error, answers_out_last});
    assert ({m_axi_arvalid, m_axi_araddr, m_axi_arlen, m_axi_arsize, m_axi_arburst, m_axi_arid, m_axi_rready} ==
            {port_m_axi_arvalid, port_m_axi_araddr, port_m_axi_arlen, port_m_axi_arsize, port_m_axi_arburst, 1'b0, port_m_axi_rready});
    assert ({s_axil_awready, s_axil_wready, s_axil_bvalid, s_axil_bresp, s_axil_arready} ==
            {control_s_axil_awready, control_s_axil_wready, control_s_axil_bvalid, control_s_axil_bresp, control_s_axil_arready});
    assert ({s_axil_rvalid, s_axil_rdata, s_axil_rresp} == {control_s_axil_rvalid, control_s_axil_rdata, control_s_axil_rresp});
    assert ({trace_valid, trace_level, trace_plane, trace_bx, trace_by} ==
            {block_done, 1'b0, done.job.id[2:0], done.job.plane, 2'd0, done.job.bx, 2'd0, done.job.by});
    assert ({trace_row, trace_col, trace_error} == {2'd0, images_place[19:10], 2'd0, images_place[9:0], compose_out_error});
    assert ({trace_key, trace_motion, trace_negative, trace_has_residual} == {done.key, done.motion, done.negative, done.has_residual});
    assert (trace_references == 2'(done.motion) + 2'(done.motion && done.two));
    assert ({trace_ix_a, trace_iy_a, trace_fx_a, trace_fy_a} == {done.ix_a, done.iy_a, done.fx_a, done.fy_a});
    assert ({trace_ix_b, trace_iy_b, trace_fx_b, trace_fy_b} == {done.ix_b, done.iy_b, done.fx_b, done.fy_b});
    assert ({trace_residual, trace_reference, trace_prediction, trace_sample} ==
            {compose_out_residual, compose_out_reference, compose_out_prediction, compose_out_sample});
  end
endmodule
