/* Allocates heap memory, with failures on request for tests. */
#include "base/memory.h"

#include <malloc.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static atomic_long countdown;

void sb_memory_fail_at(long n)
{
    atomic_store(&countdown, n);
}

bool sb_memory_fail_pending(void)
{
    return atomic_load(&countdown) > 0;
}

static int must_fail(void)
{
    return atomic_load_explicit(&countdown, memory_order_relaxed) > 0 && atomic_fetch_sub(&countdown, 1) == 1;
}

void *sb_alloc_untouched(size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX - 64 || must_fail()) return NULL;
    return aligned_alloc(64, (bytes + 64) / 64 * 64);
}

void *sb_alloc(size_t count, size_t size)
{
    void *pointer = sb_alloc_untouched(count, size);
    if (pointer) memset(pointer, 0, count * size);
    return pointer;
}

void sb_memory_return_blocks(void)
{
    mallopt(M_MMAP_THRESHOLD, 1 << 20); /* by default the threshold grows with each freed block, up to 32 MB */
}

void sb_free(void *pointer)
{
    free(pointer);
}

int sb_lengthen(void **array, size_t count, size_t capacity, size_t size)
{
    void *longer = sb_alloc_untouched(capacity, size);
    if (!longer) return -1;
    if (*array) memcpy(longer, *array, count * size);
    sb_free(*array);
    *array = longer;
    return 0;
}

int sb_grow(void **array, size_t *capacity, size_t needed, size_t size)
{
    if (needed <= *capacity) return 0;
    size_t wanted = *capacity < 16 ? 16 : *capacity;
    while (wanted < needed) {
        if (wanted > SIZE_MAX / 2) return -1;
        wanted *= 2;
    }
    if (sb_lengthen(array, *capacity, wanted, size) != 0) return -1;
    *capacity = wanted;
    return 0;
}

char *sb_strdup(const char *text)
{
    if (!text) return NULL;
    size_t bytes = strlen(text) + 1;
    char *copy = sb_alloc_untouched(bytes, 1);
    if (copy) memcpy(copy, text, bytes);
    return copy;
}

size_t sb_memory_peak(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (size_t)usage.ru_maxrss * 1024 : 0;
}
