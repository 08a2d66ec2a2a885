/* Registers, rings and descriptors of the view unit (docs/view_unit.md). */
#include <string.h>

#include "hmlfc_internal.h"
#include "hmlfc_registers.h"

enum { DESCRIPTOR_BYTES = 64, STATUS_BYTES = 16, RESIDUAL_FORMAT = 8 };
#define ADDRESS_END ((uint64_t)1 << 40)

static uint32_t read_register(const struct hmlfc_unit* unit, uint32_t offset) {
  return unit->io.read(unit->io.context, offset);
}

static void write_register(const struct hmlfc_unit* unit, uint32_t offset, uint32_t value) {
  unit->io.write(unit->io.context, offset, value);
}

static void write_pair(const struct hmlfc_unit* unit, uint32_t offset, uint64_t value) {
  write_register(unit, offset, (uint32_t)(value & 0xffffffffu));
  write_register(unit, offset + 4, (uint32_t)(value >> 32));
}

static void store(uint8_t* to, uint64_t value, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) to[i] = (uint8_t)(value >> (8 * i) & 0xff);
}

/* Lets time pass for what a register will say. */
static int let_pass(const struct hmlfc_unit* unit) {
  if (unit->io.wait(unit->io.context) != 0) return HMLFC_TIMEOUT;
  return (read_register(unit, HMLFC_REG_VIEW_STATUS) & HMLFC_REG_VIEW_STATUS_HUNG_MASK) != 0
             ? HMLFC_TIMEOUT
             : HMLFC_OK;
}

/* Waits until a register's bits of `mask` are 0. */
static int wait_for_zero(const struct hmlfc_unit* unit, uint32_t offset, uint32_t mask) {
  while ((read_register(unit, offset) & mask) != 0) {
    if (let_pass(unit) != HMLFC_OK) return HMLFC_TIMEOUT;
  }
  return HMLFC_OK;
}

static void clean(const struct hmlfc_unit* unit, const void* from, size_t bytes) {
  if (unit->io.clean != NULL) unit->io.clean(unit->io.context, from, bytes);
}

static void invalidate(const struct hmlfc_unit* unit, const void* from, size_t bytes) {
  if (unit->io.invalidate != NULL) unit->io.invalidate(unit->io.context, from, bytes);
}

/* Whether the unit can read these bytes, and `behind` more, from a multiple of `alignment` on. */
static int is_place(uint64_t bus, uint64_t bytes, unsigned alignment, unsigned behind) {
  return bus % alignment == 0 && bus < ADDRESS_END && bytes < ADDRESS_END &&
         bus + bytes + behind <= ADDRESS_END;
}

static int is_area(const struct hmlfc_buffer* area, const struct hmlfc_stream* stream) {
  return is_place(area->bus, area->bytes, HMLFC_STRIP_BYTES, 0) &&
         area->bytes >= stream->area_bytes;
}

/* The status ring lies behind the ring of descriptors. */
static size_t status_offset(const struct hmlfc_unit* unit, unsigned place) {
  return HMLFC_RING_BYTES(unit->ring_size, DESCRIPTOR_BYTES) + (size_t)place * STATUS_BYTES;
}

int hmlfc_unit_open(struct hmlfc_unit* unit, const struct hmlfc_io* io,
                    const struct hmlfc_buffer* rings, unsigned ring_size) {
  uint32_t parameters;
  int code;
  if (ring_size == 0 || ring_size > 32768 || (ring_size & (ring_size - 1)) != 0 ||
      rings->bus % HMLFC_CACHE_LINE != 0 || rings->bytes < HMLFC_RINGS_BYTES(ring_size) ||
      rings->bus >= ADDRESS_END || rings->bytes > ADDRESS_END - rings->bus) {
    return HMLFC_BAD_ARGUMENT;
  }
  memset(unit, 0, sizeof *unit);
  unit->io = *io;
  unit->rings = *rings;
  unit->ring_size = (uint16_t)ring_size;
  if (read_register(unit, HMLFC_REG_VIEW_ID) != HMLFC_REG_VIEW_ID_RESET) return HMLFC_NO_UNIT;
  code = hmlfc_unit_reset(unit);
  if (code != HMLFC_OK) return code;
  if (read_register(unit, HMLFC_REG_ID) != HMLFC_REG_ID_RESET) return HMLFC_NO_UNIT;
  parameters = read_register(unit, HMLFC_REG_PARAMETERS);
  unit->limits.grid_side = 1024;
  unit->limits.view_side = 16384;
  unit->limits.tree_height = 7;
  unit->limits.block_log2 = (uint8_t)((parameters & HMLFC_REG_PARAMETERS_BLOCK_LOG2_MASK) >>
                                      HMLFC_REG_PARAMETERS_BLOCK_LOG2_SHIFT);
  unit->limits.depth = (uint8_t)((parameters & HMLFC_REG_PARAMETERS_MAX_DEPTH_MASK) >>
                                 HMLFC_REG_PARAMETERS_MAX_DEPTH_SHIFT);
  unit->beat = (uint8_t)((parameters & HMLFC_REG_PARAMETERS_BEAT_BYTES_MASK) >>
                         HMLFC_REG_PARAMETERS_BEAT_BYTES_SHIFT);
  return HMLFC_OK;
}

int hmlfc_unit_reset(struct hmlfc_unit* unit) {
  const struct hmlfc_buffer* rings = &unit->rings;
  write_register(unit, HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_RESET_MASK);
  if (wait_for_zero(unit, HMLFC_REG_VIEW_STATUS, HMLFC_REG_VIEW_STATUS_RESETTING_MASK) !=
      HMLFC_OK) {
    return HMLFC_TIMEOUT;
  }
  unit->producer = 0;
  unit->taken = 0;
  memset(rings->cpu, 0, HMLFC_RINGS_BYTES(unit->ring_size));
  clean(unit, rings->cpu, HMLFC_RINGS_BYTES(unit->ring_size));
  invalidate(unit, rings->cpu, HMLFC_RINGS_BYTES(unit->ring_size));
  HMLFC_BARRIER_OUT();
  write_pair(unit, HMLFC_REG_RING_BASE, rings->bus);
  write_pair(unit, HMLFC_REG_STATUS_BASE, rings->bus + status_offset(unit, 0));
  write_register(unit, HMLFC_REG_RING_SIZE, unit->ring_size);
  write_register(unit, HMLFC_REG_WATCHDOG, unit->watchdog);
  hmlfc_unit_resume(unit);
  return HMLFC_OK;
}

void hmlfc_unit_set_watchdog(struct hmlfc_unit* unit, uint32_t clocks) {
  unit->watchdog = clocks;
  write_register(unit, HMLFC_REG_WATCHDOG, clocks);
}

int hmlfc_unit_load(struct hmlfc_unit* unit, const struct hmlfc_stream* stream, uint64_t stream_bus,
                    const struct hmlfc_buffer* area) {
  const unsigned alignment = unit->beat < 16 ? 16 : unit->beat;
  uint32_t status;
  if (!is_place(stream_bus, stream->bytes, alignment, 15u + unit->beat) || !is_area(area, stream)) {
    return HMLFC_BAD_ARGUMENT;
  }
  clean(unit, stream->file, stream->bytes);
  clean(unit, area->cpu, area->bytes);
  HMLFC_BARRIER_OUT();
  write_pair(unit, HMLFC_REG_STREAM_BASE, stream_bus);
  write_pair(unit, HMLFC_REG_STREAM_BYTES, stream->bytes);
  write_pair(unit, HMLFC_REG_REFERENCE_BASE, area->bus);
  write_register(unit, HMLFC_REG_CONTROL, HMLFC_REG_CONTROL_LOAD_MASK);
  if (wait_for_zero(unit, HMLFC_REG_STATUS, HMLFC_REG_STATUS_LOADING_MASK) != HMLFC_OK) {
    return HMLFC_TIMEOUT;
  }
  status = read_register(unit, HMLFC_REG_STATUS);
  return (int)((status & HMLFC_REG_STATUS_LOAD_ERROR_MASK) >> HMLFC_REG_STATUS_LOAD_ERROR_SHIFT);
}

int hmlfc_unit_give(struct hmlfc_unit* unit, const struct hmlfc_descriptor* d) {
  uint8_t* at = unit->rings.cpu + (size_t)(unit->producer % unit->ring_size) * DESCRIPTOR_BYTES;
  if ((uint16_t)(unit->producer - unit->taken) == unit->ring_size) return HMLFC_RING_FULL;
  if (((d->row | d->col) >> 12) != 0 || ((d->stop_level | d->format) >> 4) != 0) {
    return HMLFC_BAD_ARGUMENT;
  }
  memset(at, 0, DESCRIPTOR_BYTES);
  store(at, d->tag, 4);
  store(at + 4,
        (uint32_t)d->row | (uint32_t)d->col << 12 | (uint32_t)d->stop_level << 24 |
            (uint32_t)d->format << 28,
        4);
  store(at + 8, d->x, 2);
  store(at + 10, d->y, 2);
  store(at + 12, d->width, 2);
  store(at + 14, d->height, 2);
  store(at + 16, d->destination, 8);
  store(at + 24, d->pitch, 4);
  store(at + 32, d->bitmap, 8);
  clean(unit, at, DESCRIPTOR_BYTES);
  HMLFC_BARRIER_OUT();
  ++unit->producer;
  write_register(unit, HMLFC_REG_PRODUCER, unit->producer);
  return HMLFC_OK;
}

int hmlfc_unit_take(struct hmlfc_unit* unit, struct hmlfc_status* status) {
  const size_t offset = status_offset(unit, unit->taken % unit->ring_size);
  const uint8_t* at = unit->rings.cpu + offset;
  if ((uint16_t)read_register(unit, HMLFC_REG_CONSUMER) == unit->taken) return HMLFC_NOTHING_DONE;
  HMLFC_BARRIER_IN();
  invalidate(unit, at - offset % HMLFC_CACHE_LINE, HMLFC_CACHE_LINE);
  status->tag = hmlfc_load32(at);
  status->result = at[4];
  status->first_error = at[5];
  status->blocks = hmlfc_load32(at + 8);
  status->writes = hmlfc_load32(at + 12);
  ++unit->taken;
  return HMLFC_OK;
}

int hmlfc_unit_wait(struct hmlfc_unit* unit, struct hmlfc_status* status) {
  int code;
  if (unit->taken == unit->producer) return HMLFC_NOTHING_DONE;
  while ((code = hmlfc_unit_take(unit, status)) == HMLFC_NOTHING_DONE) {
    if (let_pass(unit) != HMLFC_OK) return HMLFC_TIMEOUT;
  }
  return code;
}

void hmlfc_unit_enable_events(struct hmlfc_unit* unit, uint32_t events) {
  write_register(unit, HMLFC_REG_INTERRUPT_ENABLE, events);
}

uint32_t hmlfc_unit_events(struct hmlfc_unit* unit) {
  const uint32_t events = read_register(unit, HMLFC_REG_INTERRUPT_STATUS);
  write_register(unit, HMLFC_REG_INTERRUPT_STATUS, events);
  return events;
}

int hmlfc_unit_drain(struct hmlfc_unit* unit) {
  write_register(unit, HMLFC_REG_VIEW_CONTROL,
                 HMLFC_REG_VIEW_CONTROL_ENABLE_MASK | HMLFC_REG_VIEW_CONTROL_DRAIN_MASK);
  return wait_for_zero(unit, HMLFC_REG_VIEW_STATUS,
                       HMLFC_REG_VIEW_STATUS_DRAINING_MASK | HMLFC_REG_VIEW_STATUS_ENABLED_MASK);
}

int hmlfc_unit_abort(struct hmlfc_unit* unit) {
  write_register(unit, HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ABORT_MASK);
  return wait_for_zero(unit, HMLFC_REG_VIEW_STATUS,
                       HMLFC_REG_VIEW_STATUS_ABORTING_MASK | HMLFC_REG_VIEW_STATUS_ENABLED_MASK);
}

void hmlfc_unit_resume(struct hmlfc_unit* unit) {
  write_register(unit, HMLFC_REG_VIEW_CONTROL, HMLFC_REG_VIEW_CONTROL_ENABLE_MASK);
}

/* --- Residual references --------------------------------------------------------------------- */

/* What is taken off the ring so that the next descriptor fits, or the last one is done. `code` is
 * what went wrong before. */
static int take_residuals(struct hmlfc_unit* unit, uint64_t* failed, int code) {
  struct hmlfc_status status;
  const int waited = hmlfc_unit_wait(unit, &status);
  if (waited != HMLFC_OK) return waited;
  *failed += status.blocks;
  if (code != HMLFC_OK || status.result <= HMLFC_BLOCK_ERRORS) return code;
  return status.result == HMLFC_REFUSED ? HMLFC_WAS_REFUSED : HMLFC_BUS_ERROR;
}

/* The descriptor of plane `p` of reference image number `group` of a level, in the area's order. */
static struct hmlfc_descriptor residuals_of(const struct hmlfc_stream* s, unsigned l,
                                            uint64_t group, unsigned p, uint64_t area_bus) {
  const uint32_t group_cols = s->levels[l].group_cols;
  const uint32_t group_row = (uint32_t)(group / group_cols);
  const uint32_t group_col = (uint32_t)(group % group_cols);
  struct hmlfc_descriptor d;
  uint32_t row, col;
  hmlfc_reference_image(s, l, group_row, group_col, &row, &col);
  for (unsigned i = 0; i < l; ++i) {
    row *= s->cluster_rows;
    col *= s->cluster_cols;
  }
  memset(&d, 0, sizeof d);
  d.tag = (uint32_t)group;
  d.row = (uint16_t)row;
  d.col = (uint16_t)col;
  d.stop_level = (uint8_t)l;
  d.format = (uint8_t)(RESIDUAL_FORMAT + p);
  d.width = (uint16_t)s->planes[p].width;
  d.height = (uint16_t)s->planes[p].height;
  d.pitch = s->planes[p].strips_x * HMLFC_STRIP_BYTES;
  d.destination = area_bus + hmlfc_area_offset(s, l, group_row, group_col, p);
  return d;
}

int hmlfc_unit_fill_residuals(struct hmlfc_unit* unit, const struct hmlfc_stream* stream,
                              const struct hmlfc_buffer* area, uint64_t* failed) {
  int code = HMLFC_OK;
  *failed = 0;
  if (unit->taken != unit->producer) return HMLFC_BUSY;
  if (!is_area(area, stream)) return HMLFC_BAD_ARGUMENT;
  for (unsigned l = stream->tree_height + 1u; l-- > 0;) {
    const struct hmlfc_level* level = &stream->levels[l];
    const uint64_t planes = (uint64_t)level->group_rows * level->group_cols * HMLFC_PLANES;
    if (level->keyed || !level->is_read) continue;
    for (uint64_t i = 0; i < planes && code == HMLFC_OK; ++i) {
      const struct hmlfc_descriptor d =
          residuals_of(stream, l, i / HMLFC_PLANES, (unsigned)(i % HMLFC_PLANES), area->bus);
      if ((uint16_t)(unit->producer - unit->taken) == unit->ring_size) {
        code = take_residuals(unit, failed, code);
      }
      if (code == HMLFC_OK) code = hmlfc_unit_give(unit, &d);
    }
  }
  while (code != HMLFC_TIMEOUT && unit->taken != unit->producer) {
    code = take_residuals(unit, failed, code);
  }
  if (code == HMLFC_TIMEOUT) hmlfc_unit_reset(unit);
  return code;
}
