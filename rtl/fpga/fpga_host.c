/* Decodes a view on the board: the program of rtl/example over a serial port (fpga_commands.sv).
 *   fpga_host PORT STREAM ROW COL OUT.ppm [SECONDS]
 * SECONDS: how long the board may take to answer, [10, 36000], by tens; 10
 * without. A simulation takes longer.
 * The memory here and the board's are two: what the driver cleans goes to the board, what it
 * invalidates comes from there, and each transfer's CRC is compared. */
#define _DEFAULT_SOURCE
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include "hmlfc_driver.h"
#include "soc_bus.h"

enum { MEMORY_BYTES = 1 << 16, PIECE = 1024, LEAST_STATUS = 3 };

static uint8_t memory[MEMORY_BYTES];
static int port;
static int patience = 1; /* times 10 s */

static void give_up(const char* what) {
  fprintf(stderr, "fpga_host: %s\n", what);
  exit(LEAST_STATUS);
}

static void send(const uint8_t* from, size_t count) {
  while (count > 0) {
    const ssize_t done = write(port, from, count);
    if (done <= 0) give_up("the port does not take bytes");
    from += done;
    count -= (size_t)done;
  }
}

static void receive(uint8_t* to, size_t count) {
  for (int waits = 0; count > 0;) {
    const ssize_t done = read(port, to, count);
    if (done < 0 || (done == 0 && ++waits >= patience)) {
      give_up("the board does not answer; is it configured, and the port right?");
    }
    to += done;
    count -= (size_t)done;
  }
}

/* Sends one command, and bytes that follow it, takes bytes before its answer, and returns that. */
static uint32_t command(char letter, size_t address, uint32_t value, const uint8_t* from,
                        uint8_t* to) {
  uint8_t head[8] = {(uint8_t)letter};
  for (int i = 0; i < 3; ++i) head[1 + i] = (uint8_t)(address >> (8 * i));
  for (int i = 0; i < 4; ++i) head[4 + i] = (uint8_t)(value >> (8 * i));
  send(head, sizeof head);
  if (from != NULL) send(from, value);
  if (to != NULL) receive(to, value);
  receive(head, 4);
  return head[0] | head[1] << 8 | head[2] << 16 | (uint32_t)head[3] << 24;
}

uint8_t* soc_memory(void) { return memory; }

size_t soc_memory_bytes(void) { return MEMORY_BYTES; }

uint32_t soc_bus_read(uint32_t offset) { return command('r', offset, 0, NULL, NULL); }

void soc_bus_write(uint32_t offset, uint32_t value) {
  if (command('w', offset, value, NULL, NULL) != value) give_up("a register was lost");
}

/* Pieces that the board has already are not sent. */
void soc_clean(void* context, const void* from, size_t bytes) {
  const uint8_t* at = from;
  (void)context;
  for (size_t count; bytes > 0; at += count, bytes -= count) {
    const size_t place = (size_t)(at - memory);
    uint32_t crc;
    count = bytes < PIECE ? bytes : PIECE;
    crc = hmlfc_crc32c(at, count, 0);
    if (command('C', place, (uint32_t)count, NULL, NULL) == crc) continue;
    if (command('W', place, (uint32_t)count, at, NULL) != crc) give_up("the board got other bytes");
  }
}

void soc_invalidate(void* context, const void* from, size_t bytes) {
  const size_t place = (size_t)((const uint8_t*)from - memory);
  (void)context;
  if (command('R', place, (uint32_t)bytes, NULL, memory + place) !=
      hmlfc_crc32c(memory + place, bytes, 0)) {
    give_up("other bytes came than the board sent");
  }
}

/* What comes next, asks. */
void soc_sleep(unsigned clocks) { (void)clocks; }

int main(int argc, char** argv) {
  struct termios settings;
  if (argc != 6 && argc != 7) give_up("usage: fpga_host PORT STREAM ROW COL OUT.ppm [SECONDS]");
  if (argc == 7) patience = atoi(argv[6]) / 10;
  port = open(argv[1], O_RDWR | O_NOCTTY);
  if (port < 0 || tcgetattr(port, &settings) != 0) give_up("the port does not open");
  cfmakeraw(&settings);
  cfsetspeed(&settings, B1000000);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 100; /* tenths of a second */
  if (tcsetattr(port, TCSAFLUSH, &settings) != 0) give_up("the port does not take 1 MBd");
  return soc_main(argv[2], (unsigned)atoi(argv[3]), (unsigned)atoi(argv[4]), argv[5]);
}
