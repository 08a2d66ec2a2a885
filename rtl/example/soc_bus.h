/* What the program of soc.sv knows of its system. */
#ifndef SOC_BUS_H
#define SOC_BUS_H

#include <stddef.h>
#include <stdint.h>

/* Memory from bus address 0 on. */
uint8_t* soc_memory(void);
size_t soc_memory_bytes(void);

/* A register of the view unit. */
uint32_t soc_bus_read(uint32_t offset);
void soc_bus_write(uint32_t offset, uint32_t value);

/* Bring bytes of this memory to the unit, and bytes that it has written here (hmlfc_driver.h): for
 * a system in which both see the same memory, nothing. */
void soc_clean(void* context, const void* from, size_t bytes);
void soc_invalidate(void* context, const void* from, size_t bytes);

/* Returns when the interrupt is high, or after that many clocks. */
void soc_sleep(unsigned clocks);

/* The program. */
int soc_main(const char* stream, unsigned row, unsigned col, const char* out);

#endif
