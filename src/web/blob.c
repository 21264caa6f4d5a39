#include "web/blob.h"

#include "base/memory.h"

#include <string.h>

sb_web_blob *sb_web_blob_create(size_t size)
{
    sb_web_blob *blob = sb_alloc(1, sizeof *blob);
    if (!blob) return NULL;
    *blob = (sb_web_blob){.references = 1, .size = size, .bytes = sb_alloc(size, 1)};
    if (blob->bytes) return blob;
    sb_free(blob);
    return NULL;
}

sb_web_blob *sb_web_blob_keep(sb_web_blob *blob)
{
    blob->references++;
    return blob;
}

void sb_web_blob_release(sb_web_blob *blob)
{
    if (!blob || --blob->references > 0) return;
    sb_free(blob->bytes);
    sb_free(blob);
}

static unsigned char *put(unsigned char *at, uint64_t bits, int bytes)
{
    for (int i = 0; i < bytes; i++) *at++ = (unsigned char)(bits >> (8 * i));
    return at;
}

unsigned char *sb_web_put_name(unsigned char *at, const char name[5])
{
    for (int i = 0; i < 4; i++) *at++ = (unsigned char)name[i];
    return at;
}

unsigned char *sb_web_put_u32(unsigned char *at, uint32_t value)
{
    return put(at, value, 4);
}

unsigned char *sb_web_put_f32(unsigned char *at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put(at, bits, 4);
}

unsigned char *sb_web_put_f64(unsigned char *at, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put(at, bits, 8);
}
