/* The golden model in lock-step with a device in a simulation: the C side of hmlfc_checker.sv,
 * which calls it through DPI-C. Plain C99, without svdpi.h. docs/checker.md leads through its use.
 *
 * Vectors of values have the layout of svLogicVecVal: for each 32 bits the word aval, then bval; a
 * bit with bval = 1 is unknown (x or z). Value i has the bits [16 * i, 16 * i + 15] in two's
 * complement. `clock` only names the moment in messages. */
#ifndef HMLFC_CHECKER_H
#define HMLFC_CHECKER_H

#ifdef __cplusplus
extern "C" {
#endif

/* Bits of an answer's vector: three lanes one after the other, each of B * B samples row by row. */
#define HMLFC_CHECKER_ANSWER_BITS 3072

/* Bits of a stage record's vector: residual, reference, prediction and sample, 1024 bits each. */
#define HMLFC_CHECKER_STAGE_BITS 4096

/* Begins to check a device with blocks of 2^block_log2 samples that decodes the stream in file
 * `stream`; `device` is its capability file. Returns the checker's number, from 1 on, or 0 on
 * failure, which hmlfc_checker_text(0) explains. */
int hmlfc_checker_open(const char* stream, const char* device, int block_log2);

/* What the last call with this number has to say, in lines; empty for nothing. Valid until the next
 * call. */
const char* hmlfc_checker_text(int checker);

/* The device has taken a request: plane 0 Y, 1 Co, 2 Cg or 3 RGB, stop level s of DEC-1. `tag`
 * counts where the capability file says "tagged". Returns the number of new differences, as
 * the next functions do. */
int hmlfc_checker_request(int checker, long long clock, int row, int col, int plane, int block_x,
                          int block_y, int stop_level, int tag);

/* The device has answered. `samples` has HMLFC_CHECKER_ANSWER_BITS bits. */
int hmlfc_checker_answer(int checker, long long clock, int tag, int status,
                         const unsigned* samples);

/* The device shows stages of a block at a level: `row` and `col` of the image in the level's grid.
 * Bits 0 to 3 of `shown`: the block has a residual, a reference, a prediction, samples. With a
 * status `error` other than 0 nothing but the place has a meaning. `values` has
 * HMLFC_CHECKER_STAGE_BITS bits. */
int hmlfc_checker_stage(int checker, long long clock, int row, int col, int plane, int block_x,
                        int block_y, int level, int error, int shown, const unsigned* values);

/* A handshake, a place or a status of `where` is unknown ("request", "answer" or "stage"), which is
 * a difference. */
int hmlfc_checker_unknown(int checker, long long clock, const char* where);

/* The device was reset: it answers none of the requests that it had taken. */
void hmlfc_checker_reset(int checker, long long clock);

/* The end of the simulation, after which the text has the statistics. With `complete` 1 requests
 * without an answer are a difference; 0 where the simulation was stopped. Returns the number of all
 * differences, or -1 where nothing at all was compared. A second call does
 * nothing and returns 0. */
int hmlfc_checker_end(int checker, long long clock, int complete);

/* What the golden model answers: returns the status and writes HMLFC_CHECKER_ANSWER_BITS bits. For
 * stand-ins of a device; it changes nothing of the checker. */
int hmlfc_checker_expected(int checker, int row, int col, int plane, int block_x, int block_y,
                           int stop_level, unsigned* samples);

#ifdef __cplusplus
}
#endif

#endif
