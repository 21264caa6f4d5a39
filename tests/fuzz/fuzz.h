/* Functions that the fuzz targets share. A target is a file that defines LLVMFuzzerTestOneInput. In the preset fuzz,
   libFuzzer calls it; in all other builds replay.c calls it with the committed inputs. */
#ifndef SB_TESTS_FUZZ_H
#define SB_TESTS_FUZZ_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Aborts the program if the condition is false, which the fuzzer records as a finding. */
#define FUZZ_CHECK(condition)                                                                                          \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                                    \
            abort();                                                                                                   \
        }                                                                                                              \
    } while (0)

/* Writes the bytes to a file of that name in a folder of this process, which is removed when the process ends. Returns
   its path, which is valid until the next call. */
const char *fuzz_save(const char *name, const uint8_t *data, size_t size);

/* Applies a sequence of edits to bytes (size at least 1). Each edit consists of an offset (two bytes, low byte first),
   a length, and as many bytes to write there. */
void fuzz_edit(uint8_t *bytes, size_t size, const uint8_t *edits, size_t left);

/* Corrects the head and the checksums of an archive (base/archive.h), up to the first section whose length is wrong. */
void fuzz_repair(uint8_t *bytes, size_t size, const char *kind, uint32_t version);

/* Checks the requirements of every error: the status of a failure, and one line without control characters. */
void fuzz_check_refusal(sb_status status, const sb_error *error);

#endif
