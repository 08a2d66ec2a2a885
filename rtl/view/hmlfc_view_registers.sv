// SPDX-License-Identifier: BSD-3-Clause
`include "hmlfc_register_map.svh"
`default_nettype none

// The registers of the view queue: an AXI4-Lite subordinate of 32 bits (docs/view_unit.md). All its outputs but
// `s_axil_*ready` and those of fields are registered; address bits 1:0 do not matter.
//
// enable, disable_queue, drain, abort_view, reset_unit   one clock each for a 1 written to its bit of CONTROL
// resetting                             fields have their values after reset; accesses go on
// status, consumer                      what STATUS and CONSUMER report
// irq_changes                           `irq` is another one in the next clock
// events                                bits of INTERRUPT_STATUS that are set in this clock; one that is cleared in the
// same clock is set
module hmlfc_view_registers #(
    localparam int ADDRESS_BITS = hmlfc_pkg::ADDRESS_BITS
) (
    input logic clk,
    input logic rst_n,

    input logic s_axil_awvalid,
    output logic s_axil_awready,
    input logic [11:0] s_axil_awaddr,
    input logic s_axil_wvalid,
    output logic s_axil_wready,
    input logic [31:0] s_axil_wdata,
    input logic [3:0] s_axil_wstrb,
    output logic s_axil_bvalid,
    input logic s_axil_bready,
    input logic s_axil_arvalid,
    output logic s_axil_arready,
    input logic [11:0] s_axil_araddr,
    output logic s_axil_rvalid,
    input logic s_axil_rready,
    output logic [31:0] s_axil_rdata,

    output logic enable,
    output logic disable_queue,
    output logic drain,
    output logic abort_view,
    output logic reset_unit,
    input logic resetting,
    output logic [23:0] watchdog,
    output logic [ADDRESS_BITS-1:0] ring_base,
    output logic [ADDRESS_BITS-1:0] status_base,
    output logic [15:0] ring_size,
    output logic [15:0] producer,
    input logic [15:0] consumer,
    input logic [7:0] status,
    input logic [4:0] events,
    output logic irq,
    output logic irq_changes
);

  // Write channel: address and data are accepted one by one, and used when both have arrived.
  logic address_held, data_held;
  logic [9:0] write_word;
  logic [31:0] write_data, mask;
  assign s_axil_awready = !address_held;
  assign s_axil_wready = !data_held;
  wire write = address_held && data_held && !s_axil_bvalid;
  always_ff @(posedge clk) begin
    if (s_axil_awready) write_word <= s_axil_awaddr[11:2];
    if (s_axil_wready) begin
      write_data <= s_axil_wdata;
      mask <= {{8{s_axil_wstrb[3]}}, {8{s_axil_wstrb[2]}}, {8{s_axil_wstrb[1]}}, {8{s_axil_wstrb[0]}}};
    end
    if (!rst_n) begin
      address_held <= 1'b0;
      data_held <= 1'b0;
      s_axil_bvalid <= 1'b0;
    end else begin
      address_held <= !write && (address_held || s_axil_awvalid);
      data_held <= !write && (data_held || s_axil_wvalid);
      s_axil_bvalid <= write || (s_axil_bvalid && !s_axil_bready);
    end
  end

  // Fields. Bits of addresses and sizes that are not there are 0, whatever is written.
  logic [4:0] interrupt_status, interrupt_enable;
  wire [31:0] written = write_data & mask;
  wire irq_next = (interrupt_status & interrupt_enable) != 0;
  assign irq_changes = irq != irq_next;
  always_ff @(posedge clk) begin
    {reset_unit, abort_view, drain, disable_queue, enable} <= rst_n && write && write_word == HMLFC_WORD_VIEW_CONTROL ?
        written[4:0] : 5'd0;
    interrupt_status <= (interrupt_status & ~(write && write_word == HMLFC_WORD_INTERRUPT_STATUS ? written[4:0] :
        5'd0)) | events;
    irq <= irq_next;
    if (write) begin
      unique case (write_word)
        HMLFC_WORD_INTERRUPT_ENABLE: interrupt_enable <= (interrupt_enable & ~mask[4:0]) | written[4:0];
        HMLFC_WORD_RING_SIZE: ring_size <= (ring_size & ~mask[15:0]) | written[15:0];
        HMLFC_WORD_RING_BASE: ring_base[31:0] <= ((ring_base[31:0] & ~mask) | written) & HMLFC_REG_RING_BASE_MASK[31:0];
        HMLFC_WORD_RING_BASE + 10'd1: ring_base[ADDRESS_BITS-1:32] <= (ring_base[ADDRESS_BITS-1:32] & ~mask[7:0]) |
            written[7:0];
        HMLFC_WORD_STATUS_BASE: status_base[31:0] <= ((status_base[31:0] & ~mask) | written) &
            HMLFC_REG_STATUS_BASE_MASK[31:0];
        HMLFC_WORD_STATUS_BASE + 10'd1: status_base[ADDRESS_BITS-1:32] <= (status_base[ADDRESS_BITS-1:32] &
            ~mask[7:0]) | written[7:0];
        HMLFC_WORD_PRODUCER: producer <= (producer & ~mask[15:0]) | written[15:0];
        HMLFC_WORD_WATCHDOG: watchdog <= (watchdog & ~mask[23:0]) | written[23:0];
        default: ;
      endcase
    end
    if (!rst_n || resetting) begin
      interrupt_status <= '0;
      interrupt_enable <= '0;
      irq <= 1'b0;
      ring_size <= '0;
      ring_base <= '0;
      status_base <= '0;
      producer <= '0;
      watchdog <= '0;
    end
  end

  // Read channel.
  assign s_axil_arready = !s_axil_rvalid;
  wire read = s_axil_arvalid && s_axil_arready;
  always_ff @(posedge clk) begin
    if (read) begin
      unique case (s_axil_araddr[11:2])
        HMLFC_WORD_VIEW_ID: s_axil_rdata <= HMLFC_REG_VIEW_ID_RESET;
        HMLFC_WORD_VIEW_STATUS: s_axil_rdata <= {24'd0, status};
        HMLFC_WORD_INTERRUPT_STATUS: s_axil_rdata <= {27'd0, interrupt_status};
        HMLFC_WORD_INTERRUPT_ENABLE: s_axil_rdata <= {27'd0, interrupt_enable};
        HMLFC_WORD_RING_SIZE: s_axil_rdata <= {16'd0, ring_size};
        HMLFC_WORD_RING_BASE: s_axil_rdata <= ring_base[31:0];
        HMLFC_WORD_RING_BASE + 10'd1: s_axil_rdata <= 32'(ring_base[ADDRESS_BITS-1:32]);
        HMLFC_WORD_STATUS_BASE: s_axil_rdata <= status_base[31:0];
        HMLFC_WORD_STATUS_BASE + 10'd1: s_axil_rdata <= 32'(status_base[ADDRESS_BITS-1:32]);
        HMLFC_WORD_PRODUCER: s_axil_rdata <= {16'd0, producer};
        HMLFC_WORD_CONSUMER: s_axil_rdata <= {16'd0, consumer};
        HMLFC_WORD_WATCHDOG: s_axil_rdata <= {8'd0, watchdog};
        default: s_axil_rdata <= '0;
      endcase
    end
    if (!rst_n) s_axil_rvalid <= 1'b0;
    else s_axil_rvalid <= read || (s_axil_rvalid && !s_axil_rready);
  end

endmodule

`default_nettype wire
