/* The C side of soc.sv (DPI-C): memory, and the program as a coroutine that stops at each access.
 */
#include "soc_bus.h"

#include <string.h>
#include <svdpi.h>
#include <ucontext.h>

enum { MEMORY_BYTES = 64 << 20, STACK_BYTES = 1 << 20, BEAT_BYTES = 16 };
enum { WAIT, READ, WRITE, END };

static uint8_t memory[MEMORY_BYTES];
static struct {
  ucontext_t simulation, program;
  char stream[4096], out[4096];
  unsigned row, col;
  int kind; /* of what the program wants */
  uint32_t address, write_data, read_data;
  int irq;
} soc;
static char stack[STACK_BYTES];

uint8_t* soc_memory(void) { return memory; }

size_t soc_memory_bytes(void) { return MEMORY_BYTES; }

static void want(int kind) {
  soc.kind = kind;
  swapcontext(&soc.program, &soc.simulation);
}

uint32_t soc_bus_read(uint32_t offset) {
  soc.address = offset;
  want(READ);
  return soc.read_data;
}

void soc_bus_write(uint32_t offset, uint32_t value) {
  soc.address = offset;
  soc.write_data = value;
  want(WRITE);
}

void soc_clean(void* context, const void* from, size_t bytes) {
  (void)context, (void)from, (void)bytes;
}

void soc_invalidate(void* context, const void* from, size_t bytes) {
  (void)context, (void)from, (void)bytes;
}

void soc_sleep(unsigned clocks) {
  for (unsigned i = 0; i < clocks && !soc.irq; ++i) want(WAIT);
}

static void run_program(void) {
  const int code = soc_main(soc.stream, soc.row, soc.col, soc.out);
  for (;;) {
    soc.write_data = (uint32_t)code;
    want(END);
  }
}

/* --- Called by soc.sv ------------------------------------------------------------------------ */

void soc_start(const char* stream, int row, int col, const char* out) {
  strncpy(soc.stream, stream, sizeof soc.stream - 1);
  strncpy(soc.out, out, sizeof soc.out - 1);
  soc.row = (unsigned)row;
  soc.col = (unsigned)col;
  getcontext(&soc.program);
  soc.program.uc_stack.ss_sp = stack;
  soc.program.uc_stack.ss_size = sizeof stack;
  makecontext(&soc.program, run_program, 0);
}

int soc_step(svBit irq, const svBitVecVal* read_data, svBitVecVal* address,
             svBitVecVal* write_data) {
  soc.irq = irq;
  soc.read_data = *read_data;
  swapcontext(&soc.simulation, &soc.program);
  *address = soc.address;
  *write_data = soc.write_data;
  return soc.kind;
}

/* Past the end memory reads as 0 and keeps nothing. */
void soc_read_beat(long long address, svBitVecVal* data) {
  memset(data, 0, BEAT_BYTES);
  if (address <= MEMORY_BYTES - BEAT_BYTES) memcpy(data, memory + address, BEAT_BYTES);
}

void soc_write_beat(long long address, const svBitVecVal* data, const svBitVecVal* strobes) {
  const uint8_t* bytes = (const uint8_t*)data;
  if (address > MEMORY_BYTES - BEAT_BYTES) return;
  for (int i = 0; i < BEAT_BYTES; ++i) {
    if ((*strobes >> i & 1) != 0) memory[address + i] = bytes[i];
  }
}
