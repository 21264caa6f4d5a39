/* Puts the scene together from its pieces. */
#ifndef SB_STREAM_PIECES_H
#define SB_STREAM_PIECES_H

#include "stream/scene.h"

/* A zero-initialised struct is empty. */
typedef struct sb_pieces {
    int64_t scene_id, total; /* of the scene whose pieces arrive; total 0: none */
    int32_t piece_count, received;
    unsigned char *bytes, *seen; /* seen: one flag per piece */
    int64_t complete_id;         /* of the newest complete scene */
    bool has_scene;
    sb_live_scene scene; /* the newest complete scene; valid until the next one is complete */
} sb_pieces;

/* Adds one piece. *complete: whether pieces->scene is now another scene. A piece of another scene begins that scene.
   SB_BAD_INPUT if all pieces are there and do not form a valid scene, SB_FAILED if memory runs out; the pieces are then
   forgotten. */
sb_status sb_pieces_add(sb_pieces *pieces, const sb_scene_piece_message *piece, bool *complete);

/* Frees the scene and zeroes all. */
void sb_pieces_free(sb_pieces *pieces);

#endif
