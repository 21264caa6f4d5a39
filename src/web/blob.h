/* Bytes that several responses share: made once, then constant, freed with the last reference. One thread only. */
#ifndef SB_WEB_BLOB_H
#define SB_WEB_BLOB_H

#include <stddef.h>
#include <stdint.h>

typedef struct sb_web_blob {
    size_t references, size;
    unsigned char *bytes;
} sb_web_blob;

/* Returns a blob of zeroed bytes with one reference, or NULL without memory. */
sb_web_blob *sb_web_blob_create(size_t size);
sb_web_blob *sb_web_blob_keep(sb_web_blob *blob);
/* NULL has no effect. */
void sb_web_blob_release(sb_web_blob *blob);

/* Write the four letters of a record's name, or a number, low byte first, and return the place behind. */
unsigned char *sb_web_put_name(unsigned char *at, const char name[5]);
unsigned char *sb_web_put_u32(unsigned char *at, uint32_t value);
unsigned char *sb_web_put_f32(unsigned char *at, float value);
unsigned char *sb_web_put_f64(unsigned char *at, double value);

#endif
