/* Allocates all heap memory of the project, so that a test can make any allocation fail. */
#ifndef SB_BASE_MEMORY_H
#define SB_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

/* Returns count * size zeroed bytes, 64-byte aligned, or NULL if memory runs out or the product overflows. A count or
   size of 0 gives a valid pointer, which must be freed. */
void *sb_alloc(size_t count, size_t size);

/* As sb_alloc, but the bytes are not initialised: the system assigns each page when it is first written. */
void *sb_alloc_untouched(size_t count, size_t size);

/* Makes freed blocks of a megabyte or more return to the system at once, instead of being kept for later allocations.
   Called once, before the first allocation. */
void sb_memory_return_blocks(void);

/* Frees memory that sb_alloc or sb_grow returned. NULL has no effect. */
void sb_free(void *pointer);

/* Enlarges *array (NULL at first) to at least `needed` elements of `size` bytes by doubling *capacity. The contents are
   kept. Returns 0, or -1 if memory runs out; the array is then unchanged. */
int sb_grow(void **array, size_t *capacity, size_t needed, size_t size);

/* Moves the first `count` elements of `size` bytes of *array into one of `capacity` elements. Returns 0, or -1 if
   memory runs out; the array is then unchanged. */
int sb_lengthen(void **array, size_t count, size_t capacity, size_t size);

/* Returns a copy of text; NULL if memory runs out or text is NULL. */
char *sb_strdup(const char *text);

/* Makes the n-th allocation from now fail, once (n >= 1); 0 turns this off. For tests. */
void sb_memory_fail_at(long n);

/* Returns whether the failure that sb_memory_fail_at requested has not occurred yet. */
bool sb_memory_fail_pending(void);

/* Returns the bytes that the process can still allocate: the least of the memory that the machine has without swapping
   (MemAvailable), of the rest of its control group's limit, and of the rest of its address-space limit. 0: unknown. */
size_t sb_memory_available(void);

/* Fraction of the available memory that no scene may plan to use: estimates are rough, and other programs grow. */
#define SB_MEMORY_SPARE 0.2

/* Returns the highest resident size of the process so far, in bytes. */
size_t sb_memory_peak(void);

#endif
