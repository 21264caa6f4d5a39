/* Writes pictures as PNG files. Only this file and png_memory.c call libpng. The pixels are compressed by libdeflate,
   which takes less than half of the time of zlib for a smaller file. */
#include "render/image/image.h"

#include "base/file.h"
#include "base/memory.h"

#include <errno.h>
#include <libdeflate.h>
#include <png.h>
#include <setjmp.h>
#include <string.h>

/* libpng reports an error to a callback that must not return. */
struct reporter {
    jmp_buf jump;
    char text[200];
};

static void on_error(png_structp png, png_const_charp text)
{
    struct reporter *reporter = png_get_error_ptr(png);
    snprintf(reporter->text, sizeof reporter->text, "%s", text);
    longjmp(reporter->jump, 1);
}

static void on_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

/* The first chunk after the header is a text chunk by which a run recognises its own pictures. */
static const char software[] = "Software", own_name[] = "shorebreak";

bool sb_png_is_own(const char *start, size_t length)
{
    char mark[sizeof software + sizeof own_name];
    memcpy(mark, software, sizeof software);
    memcpy(mark + sizeof software, own_name, sizeof own_name);
    return length >= 8 && memcmp(start, "\x89PNG\r\n\x1a\n", 8) == 0 && memmem(start, length, mark, sizeof mark - 1);
}

/* The rows of a PNG, each behind a byte for "no filter", as one zlib stream. NULL without memory; free with sb_free. */
static unsigned char *compress(const sb_image *image, size_t *length)
{
    enum { LEVEL = 1 }; /* higher ones make the file 5 % smaller and take half as long again */
    const size_t stride = 3 * (size_t)image->width, height = (size_t)image->height, size = (stride + 1) * height;
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(LEVEL);
    unsigned char *rows = sb_alloc_untouched(size, 1), *packed = NULL;
    const size_t room = compressor ? libdeflate_zlib_compress_bound(compressor, size) : 0;
    if (rows && compressor) packed = sb_alloc_untouched(room, 1);
    for (size_t y = 0; packed && y < height; y++) {
        rows[y * (stride + 1)] = PNG_FILTER_VALUE_NONE;
        memcpy(rows + y * (stride + 1) + 1, image->rgb + y * stride, stride);
    }
    if (packed) *length = libdeflate_zlib_compress(compressor, rows, size, packed, room);
    if (compressor) libdeflate_free_compressor(compressor);
    sb_free(rows);
    return packed;
}

/* Writes the picture. Returns 1 when all is written, 0 after an error. */
static int write_chunks(png_structp png, png_infop info, FILE *stream, const sb_image *image,
                        const unsigned char *packed, size_t length, struct reporter *reporter)
{
    static const png_byte data[] = "IDAT", end[] = "IEND";
    if (setjmp(reporter->jump)) return 0;
    png_init_io(png, stream);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_text mark = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = (char *)software, .text = (char *)own_name};
    png_set_text(png, info, &mark, 1);
    png_write_info(png, info);
    png_write_chunk(png, data, packed, length);
    png_write_chunk(png, end, NULL, 0);
    return 1;
}

sb_status sb_png_write(const char *path, const sb_image *image, sb_error *error)
{
    if (!image->rgb) return sb_fail(error, SB_BAD_INPUT, "%.500s: an empty picture cannot be written", path);
    size_t length = 0;
    unsigned char *packed = compress(image, &length);
    if (!packed) return sb_fail_memory(error, path);
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) {
        sb_free(packed);
        return status;
    }
    struct reporter reporter = {.text = "out of memory"};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &reporter, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    int written = info && write_chunks(png, info, file.stream, image, packed, length, &reporter);
    png_destroy_write_struct(png ? &png : NULL, info ? &info : NULL);
    sb_free(packed);
    if (written) return sb_atomic_commit(&file, 0, error);
    const int reason = ferror(file.stream) ? errno : 0;
    sb_atomic_abort(&file);
    return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", path, reason ? strerror(reason) : reporter.text);
}
