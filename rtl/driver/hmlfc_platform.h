/* What the driver needs of the processor; define the macros before, where these do not suit yours.
 *
 * HMLFC_BARRIER_OUT() stands between stores to memory and the write of a register that lets the
 * unit read them: rings and their base, stream and LOAD, descriptor and PRODUCER.
 * HMLFC_BARRIER_IN() stands between the read of a register that says that the unit has stored
 * something and the loads of it: CONSUMER and the status, and what the caller reads then.
 * Both order normal memory against device memory for the domain that the unit is in, and hold the
 * compiler back. Neither waits for an access to end.
 *
 * HMLFC_CACHE_LINE: bytes of the longest line of any cache in the way, a power of two from 64. */
#ifndef HMLFC_PLATFORM_H
#define HMLFC_PLATFORM_H

#ifndef HMLFC_CACHE_LINE
#define HMLFC_CACHE_LINE 64
#endif

#ifndef HMLFC_BARRIER_OUT
#if defined(__aarch64__)
#define HMLFC_BARRIER_OUT() __asm__ __volatile__("dmb oshst" : : : "memory")
#define HMLFC_BARRIER_IN() __asm__ __volatile__("dmb oshld" : : : "memory")
#elif defined(__arm__)
#define HMLFC_BARRIER_OUT() __asm__ __volatile__("dmb osh" : : : "memory")
#define HMLFC_BARRIER_IN() __asm__ __volatile__("dmb osh" : : : "memory")
#elif defined(__riscv)
#define HMLFC_BARRIER_OUT() __asm__ __volatile__("fence w, o" : : : "memory")
#define HMLFC_BARRIER_IN() __asm__ __volatile__("fence i, r" : : : "memory")
#elif defined(__x86_64__) || defined(__i386__)
#define HMLFC_BARRIER_OUT() __asm__ __volatile__("" : : : "memory")
#define HMLFC_BARRIER_IN() __asm__ __volatile__("" : : : "memory")
#else
#error "define HMLFC_BARRIER_OUT() and HMLFC_BARRIER_IN() for this processor"
#endif
#endif

#endif
