/* Foam of a frame: particles of spray, foam and bubbles, for pictures and files. */
#ifndef SB_FRAME_FOAM_H
#define SB_FRAME_FOAM_H

#include <stddef.h>
#include <stdint.h>

typedef enum sb_foam_kind {
    SB_FOAM_SPRAY,   /* in the air */
    SB_FOAM_FLOATS,  /* at the surface of the water */
    SB_FOAM_BUBBLES, /* below it */
    SB_FOAM_KINDS
} sb_foam_kind;

/* One entry (or 3 floats) per particle; positions are relative to the frame's origin. A zeroed struct is empty. */
typedef struct sb_frame_foam {
    size_t count;
    float *position; /* m */
    float *velocity; /* m/s */
    float *life;     /* left, over foam.lifetime: 1 or less */
    uint32_t *id;    /* of the run: no number is used twice */
    uint8_t *kind;   /* sb_foam_kind */
} sb_frame_foam;

#endif
