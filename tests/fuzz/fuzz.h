/* What the fuzz targets share. A target is LLVMFuzzerTestOneInput in a file of its own: libFuzzer
   drives it in the preset fuzz, replay.c runs the committed inputs in every other build. */
#ifndef SB_TESTS_FUZZ_H
#define SB_TESTS_FUZZ_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the program, which counts as a finding. */
#define FUZZ_CHECK(condition)                                                                                          \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                                    \
            abort();                                                                                                   \
        }                                                                                                              \
    } while (0)

/* Writes the bytes to a file of that name in a folder of this process; its path, valid until the
   next call. The folder goes when the process ends. */
const char *fuzz_save(const char *name, const uint8_t *data, size_t size);

/* Changes bytes (at least one) as a row of edits says, each of an offset (two bytes, low one first), a length and so
   many bytes to put there. */
void fuzz_edit(uint8_t *bytes, size_t size, const uint8_t *edits, size_t left);

/* Makes the head and the checksums of an archive (base/archive.h) right, as far as its sections hang together. */
void fuzz_repair(uint8_t *bytes, size_t size, const char *kind, uint32_t version);

/* Checks what every refusal promises: a failure's status, and one line without control characters. */
void fuzz_check_refusal(sb_status status, const sb_error *error);

#endif
