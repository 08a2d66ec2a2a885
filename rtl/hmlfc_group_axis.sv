// Reference groups of one row or column of a level's images (STR-3, STR-4, EXT-3, MOT-7).
//
// `start` takes a place among `count` images, in reference groups of `size`; about 140 clocks later `done` is high for one clock when
// the results are valid: its group and that group's reference image, the neighbouring group of MOT-7 on the side of `at` and its
// reference image's place, and the place of the parent in the next level. They hold until the next start.
module hmlfc_group_axis (
    input logic clk,
    input logic rst_n,
    input logic start,
    input logic [9:0] at,
    input logic [10:0] count,
    input logic [7:0] size,
    input logic [10:0] groups,
    input logic balanced,
    input logic [7:0] cluster,
    output logic done,
    output logic [10:0] group,
    output logic [9:0] reference_at,
    output logic [10:0] next_group,
    output logic [9:0] next_reference_at,
    output logic [9:0] parent
);

  typedef enum logic [2:0] {
    IDLE,
    PARENT,
    GROUP,
    BEGIN,       // of the reference group
    END,
    NEXT_BEGIN,  // of its neighbour
    NEXT_END
  } state_t;
  state_t state;

  // The begin of reference group g, for the states that need one; the division is done in every state.
  logic [10:0] begins;
  logic [10:0] first;
  always_comb begin
    case (state)
      BEGIN: begins = group;
      END: begins = group + 11'd1;
      NEXT_BEGIN: begins = next_group;
      default: begins = next_group + 11'd1;
    endcase
  end
  wire [18:0] even_begin = 19'(begins) * 19'(size);

  logic [21:0] dividend, divisor, quotient;
  always_comb begin
    case (state)
      PARENT: begin
        dividend = 22'(at);
        divisor = 22'(cluster);
      end
      GROUP: begin
        dividend = balanced ? (22'(at) + 22'd1) * 22'(groups) - 22'd1 : 22'(at);
        divisor = balanced ? 22'(count) : 22'(size);
      end
      default: begin
        dividend = 22'(begins) * 22'(count);
        divisor = 22'(groups);
      end
    endcase
  end
  logic started, divided, divider_idle;
  wire divide_start = state != IDLE && !started && divider_idle;
  hmlfc_divide #(
      .WIDTH(22)
  ) divide (
      .clk,
      .rst_n,
      .start(divide_start),
      .dividend,
      .divisor,
      .idle(divider_idle),
      .done(divided),
      .quotient
  );

  wire [10:0] begin_at = balanced ? quotient[10:0] : even_begin > 19'(count) ? count : even_begin[10:0];
  // The reference image of a reference group from `first` to before `begin_at`.
  wire [10:0] middle = first + ((begin_at - first - 11'd1) >> 1);
  wire up = at >= reference_at ? group + 11'd1 < groups : group == 0;

  always_ff @(posedge clk) begin
    done <= 1'b0;
    if (state != IDLE && divider_idle) started <= 1'b1;
    if (divided) begin
      started <= 1'b0;
      case (state)
        PARENT: begin
          parent <= quotient[9:0];
          state <= GROUP;
        end
        GROUP: begin
          group <= quotient[10:0];
          state <= BEGIN;
        end
        BEGIN: begin
          first <= begin_at;
          state <= END;
        end
        END: begin
          reference_at <= middle[9:0];
          state <= NEXT_BEGIN;
        end
        NEXT_BEGIN: begin
          first <= begin_at;
          state <= NEXT_END;
        end
        default: begin
          next_reference_at <= middle[9:0];
          done <= 1'b1;
          state <= IDLE;
        end
      endcase
    end
    if (start) begin
      state <= PARENT;
      started <= 1'b0;
    end
    if (!rst_n) begin
      state <= IDLE;
      started <= 1'b0;
      done <= 1'b0;
    end
  end
  assign next_group = groups == 11'd1 ? group : up ? group + 11'd1 : group - 11'd1;

endmodule
