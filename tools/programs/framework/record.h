/* The record of a finished run: lines "key: value" in a file of its folder. */
#ifndef SB_COMMON_RECORD_H
#define SB_COMMON_RECORD_H

#include <stddef.h>

#define SB_RECORD_NAME "record.txt"

/* The value of a key; "": none. */
void sb_record_recall(const char *folder, const char *key, char *value, size_t size);

#endif
