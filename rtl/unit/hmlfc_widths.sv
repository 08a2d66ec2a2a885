// SPDX-License-Identifier: BSD-3-Clause
`default_nettype none

// Stops elaboration where a width in hmlfc_pkg is not that of its structure. It has no logic.
module hmlfc_widths;

  hmlfc_pkg::level_t level;
  hmlfc_pkg::image_tiles_t image_tiles;
  hmlfc_pkg::image_references_t image_references;
  hmlfc_pkg::image_t image;
  hmlfc_pkg::job_t job;
  hmlfc_pkg::motion_t motion;
  hmlfc_pkg::flow_t flow;
  hmlfc_pkg::pending_t pending;
  hmlfc_pkg::read_request_t read_request;
  hmlfc_pkg::read_response_t read_response;
  hmlfc_pkg::view_t descriptor;

`ifndef __ICARUS__  // version 11 has no elaboration tasks
  if ($bits(level) != hmlfc_pkg::LEVEL_BITS) begin : check_level
    $error("hmlfc_pkg: LEVEL_BITS is not the width of level_t");
  end
  if ($bits(image_tiles) != hmlfc_pkg::IMAGE_TILES_BITS) begin : check_image_tiles
    $error("hmlfc_pkg: IMAGE_TILES_BITS is not the width of image_tiles_t");
  end
  if ($bits(image_references) != hmlfc_pkg::IMAGE_REFERENCES_BITS) begin : check_image_references
    $error("hmlfc_pkg: IMAGE_REFERENCES_BITS is not the width of image_references_t");
  end
  if ($bits(image) != hmlfc_pkg::IMAGE_BITS) begin : check_image
    $error("hmlfc_pkg: IMAGE_BITS is not the width of image_t");
  end
  if ($bits(job) != hmlfc_pkg::JOB_BITS) begin : check_job $error("hmlfc_pkg: JOB_BITS is not the width of job_t"); end
  if ($bits(motion) != hmlfc_pkg::MOTION_BITS) begin : check_motion
    $error("hmlfc_pkg: MOTION_BITS is not the width of motion_t");
  end
  if ($bits(flow) != hmlfc_pkg::FLOW_BITS) begin : check_flow
    $error("hmlfc_pkg: FLOW_BITS is not the width of flow_t");
  end
  if ($bits(read_request) != hmlfc_pkg::READ_REQUEST_BITS) begin : check_read_request
    $error("hmlfc_pkg: READ_REQUEST_BITS is not the width of read_request_t");
  end
  if ($bits(read_response) != hmlfc_pkg::READ_RESPONSE_BITS) begin : check_read_response
    $error("hmlfc_pkg: READ_RESPONSE_BITS is not the width of read_response_t");
  end
  if ($bits(descriptor) != hmlfc_pkg::DESCRIPTOR_BITS) begin : check_descriptor
    $error("hmlfc_pkg: DESCRIPTOR_BITS is not the width of view_t");
  end
  if ($bits(pending) != hmlfc_pkg::PENDING_BITS) begin : check_pending
    $error("hmlfc_pkg: PENDING_BITS is not the width of pending_t");
  end
`endif

endmodule

`default_nettype wire
