/* Draws text with a stroke font. */
#include "render/overlay/font.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Strokes of ' ' to '~'. A stroke is a sequence of points of two characters each: x (0..8) and y (0..f; the base line
   is at 3, small letters end at 9, capitals at c). Blanks separate strokes. A '~' before a stroke makes it a smooth
   curve through its points. */
static const char *const glyphs[] = {
    "",                                        /* space */
    "0c06 0304141303",                         /* ! */
    "0c0a 2c2a",                               /* " */
    "131c 535c 0a6a 0565",                     /* # */
    "~6b4c2c0b09284766644323 ~0423 3d32",      /* $ */
    "036c ~1c0b1a2b1c ~5544536455",            /* % */
    "~632a3c4a0604133366",                     /* & */
    "0c0a",                                    /* ' */
    "~2d0a0522",                               /* ( */
    "~0d2a2502",                               /* ) */
    "0a48 084a 2b27",                          /* * */
    "0666 3339",                               /* + */
    "1302",                                    /* , */
    "0747",                                    /* - */
    "0304141303",                              /* . */
    "026c",                                    /* / */
    "~2c3c5a553323050a2c",                     /* 0 */
    "1a3c33",                                  /* 1 */
    "~0a1b3c5b6a583603 0363",                  /* 2 */
    "~0b1c4c6b694828 ~28486765432304",         /* 3 */
    "535c0666",                                /* 4 */
    "6c0c08 ~08295967654323 ~2304",            /* 5 */
    "~5b3c1a0806143354656758391806",           /* 6 */
    "0c6c23",                                  /* 7 */
    "~3c1b1938595b3c ~3807051433546567 ~6738", /* 8 */
    "~14335567695b3c1b0a0817365769",           /* 9 */
    "0304141303 0809191808",                   /* : */
    "0809191808 1301",                         /* ; */
    "590653",                                  /* < */
    "0868 0565",                               /* = */
    "095603",                                  /* > */
    "~0b2c4c6a593736 3334444333",              /* ? */
    "~3c1b090614335466695b3c 3737",            /* @ */
    "033c63 1656",                             /* A */
    "43030c3c 0848 ~3c5b5948 ~48676543",       /* B */
    "~6b4c2c1b090614234364",                   /* C */
    "33030c3c ~3c5b69665433",                  /* D */
    "63030c6c 0858",                           /* E */
    "030c6c 0858",                             /* F */
    "~6b4c2c1b090614234364 646737",            /* G */
    "030c 636c 0868",                          /* H */
    "030c",                                    /* I */
    "5c55 ~5544331304",                        /* J */
    "030c 6c07 2963",                          /* K */
    "0c0363",                                  /* L */
    "030c376c63",                              /* M */
    "030c636c",                                /* N */
    "~3c1b090614335466695b3c",                 /* O */
    "030c4c ~4c6b6847 4707",                   /* P */
    "~3c1b090614335466695b3c 4572",            /* Q */
    "030c4c ~4c6b6847 4707 3763",              /* R */
    "~6b4c2c0b09284766644323 ~2304",           /* S */
    "0c6c 3c33",                               /* T */
    "0c06 ~0614335466 666c",                   /* U */
    "0c336c",                                  /* V */
    "0c234a638c",                              /* W */
    "036c 0c63",                               /* X */
    "0c376c 3733",                             /* Y */
    "0c6c0363",                                /* Z */
    "2d0d0222",                                /* [ */
    "0c62",                                    /* \ */
    "0d2d2202",                                /* ] */
    "0a2c4a",                                  /* ^ */
    "0262",                                    /* _ */
    "0c1a",                                    /* ` */
    "~5739190705133355 5953",                  /* a */
    "0c03 ~0729495755432305",                  /* b */
    "~5839190705133354",                       /* c */
    "5c53 ~5739190705133355",                  /* d */
    "0656 ~564839190705133354",                /* e */
    "~4c3c2b29 2923 0939",                     /* f */
    "~5739190705133355 5952 ~52402001",        /* g */
    "0c03 ~07294957 5753",                     /* h */
    "0903 0b0c",                               /* i */
    "2922 ~221000 2b2c",                       /* j */
    "0c03 4905 1653",                          /* k */
    "0c05 ~051323",                            /* l */
    "0903 ~07193947 4743 ~47597987 8783",      /* m */
    "0903 ~07294957 5753",                     /* n */
    "~391806143354665839",                     /* o */
    "0900 ~0729495755432305",                  /* p */
    "5950 ~5739190705133355",                  /* q */
    "0903 ~07182939",                          /* r */
    "~4839190817364544331304",                 /* s */
    "1b14 ~142333 0939",                       /* t */
    "0905 ~05133355 5953",                     /* u */
    "093369",                                  /* v */
    "0923486389",                              /* w */
    "0953 0359",                               /* x */
    "0933 6910",                               /* y */
    "09590353",                                /* z */
    "3d2c28172622 2231",                       /* { */
    "0d02",                                    /* | */
    "0d1c182716 1612 1202",                    /* } */
    "~0718364758",                             /* ~ */
};

static const double base = 3, capital = 9; /* units: the base line, and a capital's height */
static const double gap = 2.6, blank = 4;  /* units between letters, and of a space */

enum { POINTS = 24, BENDS = 6 };

static int digit(char c)
{
    return c <= '9' ? c - '0' : c - 'a' + 10;
}

/* Returns the next character's glyph, NULL at the end. The continuation bytes of UTF-8 characters are skipped. */
static const char *next_glyph(const char **text)
{
    while (((unsigned char)**text & 0xC0) == 0x80) ++*text;
    unsigned char c = (unsigned char)**text;
    if (c == 0) return NULL;
    ++*text;
    return glyphs[c >= ' ' && c <= '~' ? c - ' ' : '?' - ' '];
}

static double glyph_advance(const char *glyph)
{
    if (!*glyph) return blank;
    int widest = 0;
    for (const char *at = glyph; *at;) {
        if (*at == ' ' || *at == '~') {
            at++;
            continue;
        }
        widest = digit(*at) > widest ? digit(*at) : widest;
        at += 2;
    }
    return widest + gap;
}

double sb_font_width(const char *text, double height)
{
    double units = 0;
    for (const char *glyph; (glyph = next_glyph(&text)) != NULL;) units += glyph_advance(glyph);
    return units > 0 ? (units - gap) * height / capital : 0;
}

/* Distance of each pixel to the nearest stroke, on a rectangle of the image, px. */
struct field {
    int x0, y0, width, height;
    float *distance;
};

static void draw_segment(struct field *field, double ax, double ay, double bx, double by, double radius)
{
    int x_low = (int)floor(fmin(ax, bx) - radius) - field->x0;
    int x_high = (int)ceil(fmax(ax, bx) + radius) - field->x0;
    int y_low = (int)floor(fmin(ay, by) - radius) - field->y0;
    int y_high = (int)ceil(fmax(ay, by) + radius) - field->y0;
    double dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
    for (int y = y_low > 0 ? y_low : 0; y <= y_high && y < field->height; y++)
        for (int x = x_low > 0 ? x_low : 0; x <= x_high && x < field->width; x++) {
            double px = x + field->x0 + 0.5 - ax, py = y + field->y0 + 0.5 - ay;
            double s = square > 0 ? (px * dx + py * dy) / square : 0;
            s = s < 0 ? 0 : s > 1 ? 1 : s;
            float far = (float)hypot(px - s * dx, py - s * dy);
            float *here = &field->distance[y * field->width + x];
            *here = far < *here ? far : *here;
        }
}

/* Catmull-Rom interpolation between the middle two of four numbers. */
static double bend(double a, double b, double c, double d, double s)
{
    return b + 0.5 * s * (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a)));
}

static void draw_stroke(struct field *field, double (*points)[2], int count, int smooth, double radius)
{
    if (count == 1 || !smooth) {
        for (int i = 0; i + 1 < count || i == 0; i++)
            draw_segment(field, points[i][0], points[i][1], points[count > 1 ? i + 1 : 0][0],
                         points[count > 1 ? i + 1 : 0][1], radius);
        return;
    }
    int closed = points[0][0] == points[count - 1][0] && points[0][1] == points[count - 1][1];
    for (int i = 0; i + 1 < count; i++) {
        const double *b = points[i], *c = points[i + 1];
        const double *a = i > 0 ? points[i - 1] : closed ? points[count - 2] : b;
        const double *d = i + 2 < count ? points[i + 2] : closed ? points[1] : c;
        double from[2] = {b[0], b[1]};
        for (int k = 1; k <= BENDS; k++) {
            double s = (double)k / BENDS;
            double to[2] = {bend(a[0], b[0], c[0], d[0], s), bend(a[1], b[1], c[1], d[1], s)};
            draw_segment(field, from[0], from[1], to[0], to[1], radius);
            from[0] = to[0];
            from[1] = to[1];
        }
    }
}

static void draw_glyph(struct field *field, const char *glyph, double x, double y, double unit, double radius)
{
    while (*glyph) {
        int smooth = *glyph == '~', count = 0;
        double points[POINTS][2] = {{0}};
        for (glyph += smooth; *glyph && *glyph != ' ' && count < POINTS; glyph += 2, count++) {
            points[count][0] = x + unit * digit(glyph[0]);
            points[count][1] = y - unit * (digit(glyph[1]) - base);
        }
        draw_stroke(field, points, count, smooth, radius);
        glyph += *glyph == ' ';
    }
}

static void blend(unsigned char *pixel, const float rgb[3], double alpha)
{
    for (int c = 0; c < 3; c++) pixel[c] = (unsigned char)(pixel[c] + alpha * (255 * (double)rgb[c] - pixel[c]) + 0.5);
}

sb_status sb_font_draw(sb_image *image, double x, double y, double height, const float rgb[3], const char *text,
                       sb_error *error)
{
    static const float dark[3] = {0.02f, 0.05f, 0.09f};
    double unit = height / capital, pen = 0.55 * unit < 0.6 ? 0.6 : 0.55 * unit;
    double rim = pen + 0.30 * height, radius = rim + 1;
    struct field field = {.x0 = (int)floor(x - radius), .y0 = (int)floor(y - height - 2 * unit - radius)};
    int right = (int)ceil(x + sb_font_width(text, height) + radius);
    int bottom = (int)ceil(y + base * unit + radius);
    field.x0 = field.x0 > 0 ? field.x0 : 0;
    field.y0 = field.y0 > 0 ? field.y0 : 0;
    field.width = (right < image->width ? right : image->width) - field.x0;
    field.height = (bottom < image->height ? bottom : image->height) - field.y0;
    if (field.width <= 0 || field.height <= 0) return SB_OK;
    size_t count = (size_t)field.width * (size_t)field.height;
    field.distance = sb_alloc(count, sizeof *field.distance);
    if (!field.distance) return sb_fail_memory(error, "text in a picture");
    for (size_t i = 0; i < count; i++) field.distance[i] = (float)(radius + 1);
    for (const char *glyph; (glyph = next_glyph(&text)) != NULL;) {
        draw_glyph(&field, glyph, x, y, unit, radius);
        x += unit * glyph_advance(glyph);
    }
    for (size_t i = 0; i < count; i++) {
        double far = (double)field.distance[i];
        if (far >= rim) continue;
        size_t row = (size_t)field.y0 + i / (size_t)field.width;
        size_t column = (size_t)field.x0 + i % (size_t)field.width;
        unsigned char *pixel = image->rgb + 3 * (row * (size_t)image->width + column);
        double shade = (rim - far) / (rim - pen), ink = pen + 0.5 - far;
        blend(pixel, dark, 0.5 * (shade > 1 ? 1 : shade * shade));
        blend(pixel, rgb, ink < 0 ? 0 : ink > 1 ? 1 : ink);
    }
    sb_free(field.distance);
    return SB_OK;
}
