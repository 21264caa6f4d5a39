/* All heap memory of the project passes here, so that one place counts it and a test can make it fail. */
#ifndef SB_BASE_MEMORY_H
#define SB_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

/* count * size zeroed bytes, 64-byte aligned; NULL when there is no memory or the product overflows.
   count or size 0 gives a valid pointer to free. */
void *sb_alloc(size_t count, size_t size);

/* As sb_alloc, but the bytes are not touched: pages come into being when first written. */
void *sb_alloc_untouched(size_t count, size_t size);

/* From now on blocks of a megabyte and more go back to the system when freed, instead of staying for later ones that
   may never come. Once, before the first allocation. */
void sb_memory_return_blocks(void);

/* Frees what sb_alloc or sb_grow returned; NULL is fine. */
void sb_free(void *pointer);

/* Makes *array (NULL at first) hold at least `needed` elements of `size` bytes, doubling *capacity;
   the contents are kept. Returns 0, or -1 without memory, the array being as it was. */
int sb_grow(void **array, size_t *capacity, size_t needed, size_t size);

/* A copy of text; NULL without memory or when text is NULL. */
char *sb_strdup(const char *text);

/* The n-th allocation from now fails, once (n >= 1); 0 turns that off. For tests. */
void sb_memory_fail_at(long n);

/* Whether the failure asked for is still to come. */
bool sb_memory_fail_pending(void);

/* Bytes the process may still take: what the machine has without swapping (MemAvailable), its control group allows,
   and its own limit of address space leaves. 0 when unknown. */
size_t sb_memory_available(void);

/* Highest resident size of the process so far, in bytes. */
size_t sb_memory_peak(void);

#endif
