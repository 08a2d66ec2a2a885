/* Registers (docs/hardware.md): offsets in bytes, masks and lowest bits of fields, values after
 * reset. Of 64 bits HMLFC_REG_NAME is the low word, HMLFC_REG_NAME_HIGH the high one. Generated
 * by rtl/kit/generate.py from rtl/registers.json and rtl/view_registers.json: change those, not
 * this file. */
#ifndef HMLFC_REGISTERS_H
#define HMLFC_REGISTERS_H

/* ID, read: says that this is a decode unit: "HMLF" in memory */
#define HMLFC_REG_ID 0x000u
#define HMLFC_REG_ID_RESET 0x464c4d48u
#define HMLFC_REG_ID_MASK 0xffffffffu
/* the number */
#define HMLFC_REG_ID_ID_SHIFT 0
#define HMLFC_REG_ID_ID_MASK 0xffffffffu

/* PARAMETERS, read: parameters of this unit, after reset those of the defaults */
#define HMLFC_REG_PARAMETERS 0x004u
#define HMLFC_REG_PARAMETERS_RESET 0x00001082u
#define HMLFC_REG_PARAMETERS_MASK 0x0000ffffu
/* a block has 2^BLOCK_LOG2 samples a side */
#define HMLFC_REG_PARAMETERS_BLOCK_LOG2_SHIFT 0
#define HMLFC_REG_PARAMETERS_BLOCK_LOG2_MASK 0x0000000fu
/* greatest depth of a stream */
#define HMLFC_REG_PARAMETERS_MAX_DEPTH_SHIFT 4
#define HMLFC_REG_PARAMETERS_MAX_DEPTH_MASK 0x000000f0u
/* bytes of a beat of the read master */
#define HMLFC_REG_PARAMETERS_BEAT_BYTES_SHIFT 8
#define HMLFC_REG_PARAMETERS_BEAT_BYTES_MASK 0x0000ff00u

/* CONTROL, write: each 1 written is a command; reads as 0 */
#define HMLFC_REG_CONTROL 0x008u
#define HMLFC_REG_CONTROL_RESET 0x00000000u
#define HMLFC_REG_CONTROL_MASK 0x00000007u
/* read the header */
#define HMLFC_REG_CONTROL_LOAD_SHIFT 0
#define HMLFC_REG_CONTROL_LOAD_MASK 0x00000001u
/* zero the counters and the first error */
#define HMLFC_REG_CONTROL_CLEAR_SHIFT 1
#define HMLFC_REG_CONTROL_CLEAR_MASK 0x00000002u
/* let requests wait until the next LOAD */
#define HMLFC_REG_CONTROL_DISABLE_SHIFT 2
#define HMLFC_REG_CONTROL_DISABLE_MASK 0x00000004u

/* STATUS, read: state of the unit */
#define HMLFC_REG_STATUS 0x00cu
#define HMLFC_REG_STATUS_RESET 0x00000004u
#define HMLFC_REG_STATUS_MASK 0x00003f0fu
/* the last LOAD succeeded and no DISABLE came since */
#define HMLFC_REG_STATUS_READY_SHIFT 0
#define HMLFC_REG_STATUS_READY_MASK 0x00000001u
/* LOAD is in progress */
#define HMLFC_REG_STATUS_LOADING_SHIFT 1
#define HMLFC_REG_STATUS_LOADING_MASK 0x00000002u
/* no request and no read is in flight */
#define HMLFC_REG_STATUS_IDLE_SHIFT 2
#define HMLFC_REG_STATUS_IDLE_MASK 0x00000004u
/* a beat came for which no burst was in flight, kept until reset */
#define HMLFC_REG_STATUS_STRAY_SHIFT 3
#define HMLFC_REG_STATUS_STRAY_MASK 0x00000008u
/* error of the last LOAD, 0 for none */
#define HMLFC_REG_STATUS_LOAD_ERROR_SHIFT 8
#define HMLFC_REG_STATUS_LOAD_ERROR_MASK 0x00003f00u

/* STREAM_BASE, read, write: byte address of the stream's first byte, a multiple of 16 */
#define HMLFC_REG_STREAM_BASE 0x010u
#define HMLFC_REG_STREAM_BASE_HIGH 0x014u
#define HMLFC_REG_STREAM_BASE_RESET 0x0000000000000000ull
#define HMLFC_REG_STREAM_BASE_MASK 0x000000ffffffffffull
/* the bits above are 0, whatever is written */
#define HMLFC_REG_STREAM_BASE_ADDRESS_SHIFT 0
#define HMLFC_REG_STREAM_BASE_ADDRESS_MASK 0x000000ffffffffffull

/* STREAM_BYTES, read, write: size of the file */
#define HMLFC_REG_STREAM_BYTES 0x018u
#define HMLFC_REG_STREAM_BYTES_HIGH 0x01cu
#define HMLFC_REG_STREAM_BYTES_RESET 0x0000000000000000ull
#define HMLFC_REG_STREAM_BYTES_MASK 0xffffffffffffffffull
/* the size in bytes */
#define HMLFC_REG_STREAM_BYTES_BYTES_SHIFT 0
#define HMLFC_REG_STREAM_BYTES_BYTES_MASK 0xffffffffffffffffull

/* REFERENCE_BASE, read, write: byte address of the reference area, a multiple of 16 */
#define HMLFC_REG_REFERENCE_BASE 0x020u
#define HMLFC_REG_REFERENCE_BASE_HIGH 0x024u
#define HMLFC_REG_REFERENCE_BASE_RESET 0x0000000000000000ull
#define HMLFC_REG_REFERENCE_BASE_MASK 0x000000ffffffffffull
/* the bits above are 0, whatever is written */
#define HMLFC_REG_REFERENCE_BASE_ADDRESS_SHIFT 0
#define HMLFC_REG_REFERENCE_BASE_ADDRESS_MASK 0x000000ffffffffffull

/* ERROR, read: first error of an answer since CLEAR */
#define HMLFC_REG_ERROR 0x030u
#define HMLFC_REG_ERROR_RESET 0x00000000u
#define HMLFC_REG_ERROR_MASK 0x0000003fu
/* its number, 0 for none */
#define HMLFC_REG_ERROR_NUMBER_SHIFT 0
#define HMLFC_REG_ERROR_NUMBER_MASK 0x0000003fu

/* ERROR_ADDRESS, read: `tdata` of the request that had it */
#define HMLFC_REG_ERROR_ADDRESS 0x038u
#define HMLFC_REG_ERROR_ADDRESS_HIGH 0x03cu
#define HMLFC_REG_ERROR_ADDRESS_RESET 0x0000000000000000ull
#define HMLFC_REG_ERROR_ADDRESS_MASK 0xffffffffffffffffull
/* the request */
#define HMLFC_REG_ERROR_ADDRESS_REQUEST_SHIFT 0
#define HMLFC_REG_ERROR_ADDRESS_REQUEST_MASK 0xffffffffffffffffull

/* BLOCKS, read: blocks of one plane of one level decoded; a request that is refused counts as one
 * */
#define HMLFC_REG_BLOCKS 0x040u
#define HMLFC_REG_BLOCKS_HIGH 0x044u
#define HMLFC_REG_BLOCKS_RESET 0x0000000000000000ull
#define HMLFC_REG_BLOCKS_MASK 0xffffffffffffffffull
/* the count since CLEAR */
#define HMLFC_REG_BLOCKS_COUNT_SHIFT 0
#define HMLFC_REG_BLOCKS_COUNT_MASK 0xffffffffffffffffull

/* CYCLES, read: clocks with a request in flight */
#define HMLFC_REG_CYCLES 0x048u
#define HMLFC_REG_CYCLES_HIGH 0x04cu
#define HMLFC_REG_CYCLES_RESET 0x0000000000000000ull
#define HMLFC_REG_CYCLES_MASK 0xffffffffffffffffull
/* the count since CLEAR */
#define HMLFC_REG_CYCLES_COUNT_SHIFT 0
#define HMLFC_REG_CYCLES_COUNT_MASK 0xffffffffffffffffull

/* STALLS, read: clocks in which an answer waited for ready */
#define HMLFC_REG_STALLS 0x050u
#define HMLFC_REG_STALLS_HIGH 0x054u
#define HMLFC_REG_STALLS_RESET 0x0000000000000000ull
#define HMLFC_REG_STALLS_MASK 0xffffffffffffffffull
/* the count since CLEAR */
#define HMLFC_REG_STALLS_COUNT_SHIFT 0
#define HMLFC_REG_STALLS_COUNT_MASK 0xffffffffffffffffull

/* BYTES_READ, read: bytes of the read master's beats */
#define HMLFC_REG_BYTES_READ 0x058u
#define HMLFC_REG_BYTES_READ_HIGH 0x05cu
#define HMLFC_REG_BYTES_READ_RESET 0x0000000000000000ull
#define HMLFC_REG_BYTES_READ_MASK 0xffffffffffffffffull
/* the count since CLEAR */
#define HMLFC_REG_BYTES_READ_COUNT_SHIFT 0
#define HMLFC_REG_BYTES_READ_COUNT_MASK 0xffffffffffffffffull

/* REQUESTS, read: answers given */
#define HMLFC_REG_REQUESTS 0x060u
#define HMLFC_REG_REQUESTS_HIGH 0x064u
#define HMLFC_REG_REQUESTS_RESET 0x0000000000000000ull
#define HMLFC_REG_REQUESTS_MASK 0xffffffffffffffffull
/* the count since CLEAR */
#define HMLFC_REG_REQUESTS_COUNT_SHIFT 0
#define HMLFC_REG_REQUESTS_COUNT_MASK 0xffffffffffffffffull

/* VIEW_ID, read: says that this is a view unit: "HMLQ" in memory */
#define HMLFC_REG_VIEW_ID 0x800u
#define HMLFC_REG_VIEW_ID_RESET 0x514c4d48u
#define HMLFC_REG_VIEW_ID_MASK 0xffffffffu
/* the number */
#define HMLFC_REG_VIEW_ID_ID_SHIFT 0
#define HMLFC_REG_VIEW_ID_ID_MASK 0xffffffffu

/* VIEW_CONTROL, write: each 1 written is a command; reads as 0 */
#define HMLFC_REG_VIEW_CONTROL 0x804u
#define HMLFC_REG_VIEW_CONTROL_RESET 0x00000000u
#define HMLFC_REG_VIEW_CONTROL_MASK 0x0000000fu
/* begin descriptors */
#define HMLFC_REG_VIEW_CONTROL_ENABLE_SHIFT 0
#define HMLFC_REG_VIEW_CONTROL_ENABLE_MASK 0x00000001u
/* begin no other descriptor */
#define HMLFC_REG_VIEW_CONTROL_DISABLE_SHIFT 1
#define HMLFC_REG_VIEW_CONTROL_DISABLE_MASK 0x00000002u
/* DISABLE when the ring is empty */
#define HMLFC_REG_VIEW_CONTROL_DRAIN_SHIFT 2
#define HMLFC_REG_VIEW_CONTROL_DRAIN_MASK 0x00000004u
/* end the descriptor under way, and DISABLE */
#define HMLFC_REG_VIEW_CONTROL_ABORT_SHIFT 3
#define HMLFC_REG_VIEW_CONTROL_ABORT_MASK 0x00000008u

/* VIEW_STATUS, read: state of the queue */
#define HMLFC_REG_VIEW_STATUS 0x808u
#define HMLFC_REG_VIEW_STATUS_RESET 0x00000010u
#define HMLFC_REG_VIEW_STATUS_MASK 0x0000003fu
/* descriptors begin */
#define HMLFC_REG_VIEW_STATUS_ENABLED_SHIFT 0
#define HMLFC_REG_VIEW_STATUS_ENABLED_MASK 0x00000001u
/* a descriptor is under way */
#define HMLFC_REG_VIEW_STATUS_RUNNING_SHIFT 1
#define HMLFC_REG_VIEW_STATUS_RUNNING_MASK 0x00000002u
/* DRAIN has not ended */
#define HMLFC_REG_VIEW_STATUS_DRAINING_SHIFT 2
#define HMLFC_REG_VIEW_STATUS_DRAINING_MASK 0x00000004u
/* ABORT has not ended */
#define HMLFC_REG_VIEW_STATUS_ABORTING_SHIFT 3
#define HMLFC_REG_VIEW_STATUS_ABORTING_MASK 0x00000008u
/* the ring is empty */
#define HMLFC_REG_VIEW_STATUS_EMPTY_SHIFT 4
#define HMLFC_REG_VIEW_STATUS_EMPTY_MASK 0x00000010u
/* a status could not be written, kept until reset */
#define HMLFC_REG_VIEW_STATUS_STATUS_LOST_SHIFT 5
#define HMLFC_REG_VIEW_STATUS_STATUS_LOST_MASK 0x00000020u

/* INTERRUPT_STATUS, read, write: events; a 1 written clears its bit */
#define HMLFC_REG_INTERRUPT_STATUS 0x80cu
#define HMLFC_REG_INTERRUPT_STATUS_RESET 0x00000000u
#define HMLFC_REG_INTERRUPT_STATUS_MASK 0x0000000fu
/* a descriptor is done */
#define HMLFC_REG_INTERRUPT_STATUS_DONE_SHIFT 0
#define HMLFC_REG_INTERRUPT_STATUS_DONE_MASK 0x00000001u
/* one is done with another result than 0, or STATUS_LOST was set */
#define HMLFC_REG_INTERRUPT_STATUS_ERROR_SHIFT 1
#define HMLFC_REG_INTERRUPT_STATUS_ERROR_MASK 0x00000002u
/* the ring has become empty */
#define HMLFC_REG_INTERRUPT_STATUS_EMPTY_SHIFT 2
#define HMLFC_REG_INTERRUPT_STATUS_EMPTY_MASK 0x00000004u
/* DRAIN or ABORT has ended */
#define HMLFC_REG_INTERRUPT_STATUS_STOPPED_SHIFT 3
#define HMLFC_REG_INTERRUPT_STATUS_STOPPED_MASK 0x00000008u

/* INTERRUPT_ENABLE, read, write: `irq` is high while an event with its bit here is not cleared */
#define HMLFC_REG_INTERRUPT_ENABLE 0x810u
#define HMLFC_REG_INTERRUPT_ENABLE_RESET 0x00000000u
#define HMLFC_REG_INTERRUPT_ENABLE_MASK 0x0000000fu
/* as above */
#define HMLFC_REG_INTERRUPT_ENABLE_DONE_SHIFT 0
#define HMLFC_REG_INTERRUPT_ENABLE_DONE_MASK 0x00000001u
/* as above */
#define HMLFC_REG_INTERRUPT_ENABLE_ERROR_SHIFT 1
#define HMLFC_REG_INTERRUPT_ENABLE_ERROR_MASK 0x00000002u
/* as above */
#define HMLFC_REG_INTERRUPT_ENABLE_EMPTY_SHIFT 2
#define HMLFC_REG_INTERRUPT_ENABLE_EMPTY_MASK 0x00000004u
/* as above */
#define HMLFC_REG_INTERRUPT_ENABLE_STOPPED_SHIFT 3
#define HMLFC_REG_INTERRUPT_ENABLE_STOPPED_MASK 0x00000008u

/* RING_SIZE, read, write: size of both rings */
#define HMLFC_REG_RING_SIZE 0x814u
#define HMLFC_REG_RING_SIZE_RESET 0x00000000u
#define HMLFC_REG_RING_SIZE_MASK 0x0000ffffu
/* a power of two up to 32768 */
#define HMLFC_REG_RING_SIZE_DESCRIPTORS_SHIFT 0
#define HMLFC_REG_RING_SIZE_DESCRIPTORS_MASK 0x0000ffffu

/* RING_BASE, read, write: byte address of the ring of descriptors, a multiple of 64 */
#define HMLFC_REG_RING_BASE 0x818u
#define HMLFC_REG_RING_BASE_HIGH 0x81cu
#define HMLFC_REG_RING_BASE_RESET 0x0000000000000000ull
#define HMLFC_REG_RING_BASE_MASK 0x000000ffffffffc0ull
/* the other bits are 0, whatever is written */
#define HMLFC_REG_RING_BASE_ADDRESS_SHIFT 6
#define HMLFC_REG_RING_BASE_ADDRESS_MASK 0x000000ffffffffc0ull

/* STATUS_BASE, read, write: byte address of the status ring, a multiple of 16 */
#define HMLFC_REG_STATUS_BASE 0x820u
#define HMLFC_REG_STATUS_BASE_HIGH 0x824u
#define HMLFC_REG_STATUS_BASE_RESET 0x0000000000000000ull
#define HMLFC_REG_STATUS_BASE_MASK 0x000000fffffffff0ull
/* the other bits are 0, whatever is written */
#define HMLFC_REG_STATUS_BASE_ADDRESS_SHIFT 4
#define HMLFC_REG_STATUS_BASE_ADDRESS_MASK 0x000000fffffffff0ull

/* PRODUCER, read, write: descriptors given so far, modulo 2^16; descriptor n lies at place n mod
 * RING_SIZE */
#define HMLFC_REG_PRODUCER 0x828u
#define HMLFC_REG_PRODUCER_RESET 0x00000000u
#define HMLFC_REG_PRODUCER_MASK 0x0000ffffu
/* the count */
#define HMLFC_REG_PRODUCER_COUNT_SHIFT 0
#define HMLFC_REG_PRODUCER_COUNT_MASK 0x0000ffffu

/* CONSUMER, read: descriptors done so far, modulo 2^16 */
#define HMLFC_REG_CONSUMER 0x82cu
#define HMLFC_REG_CONSUMER_RESET 0x00000000u
#define HMLFC_REG_CONSUMER_MASK 0x0000ffffu
/* the count */
#define HMLFC_REG_CONSUMER_COUNT_SHIFT 0
#define HMLFC_REG_CONSUMER_COUNT_MASK 0x0000ffffu

#endif
