#include "stream/pieces.h"

#include "base/memory.h"

#include <string.h>

static void forget(sb_pieces *pieces)
{
    sb_free(pieces->bytes);
    sb_free(pieces->seen);
    pieces->bytes = pieces->seen = NULL;
    pieces->total = 0;
    pieces->received = pieces->piece_count = 0;
}

static sb_status begin(sb_pieces *pieces, const sb_scene_piece_message *piece)
{
    forget(pieces);
    pieces->bytes = sb_alloc_untouched((size_t)piece->total, 1); /* forged pieces cost no memory until they arrive */
    pieces->seen = sb_alloc((size_t)piece->piece_count, 1);
    if (!pieces->bytes || !pieces->seen) {
        forget(pieces);
        return SB_FAILED;
    }
    pieces->scene_id = piece->scene_id;
    pieces->total = piece->total;
    pieces->piece_count = piece->piece_count;
    return SB_OK;
}

static sb_status finish(sb_pieces *pieces, bool *complete)
{
    sb_live_scene scene;
    const sb_status status = sb_live_scene_decode(pieces->bytes, (size_t)pieces->total, &scene, NULL);
    if (status == SB_OK) {
        sb_live_scene_free(&pieces->scene);
        pieces->scene = scene;
        pieces->complete_id = pieces->scene_id;
        pieces->has_scene = *complete = true;
    }
    forget(pieces);
    return status;
}

sb_status sb_pieces_add(sb_pieces *pieces, const sb_scene_piece_message *piece, bool *complete)
{
    *complete = false;
    if (pieces->has_scene && piece->scene_id == pieces->complete_id) return SB_OK;
    if (piece->scene_id != pieces->scene_id || piece->total != pieces->total) {
        const sb_status status = begin(pieces, piece);
        if (status != SB_OK) return status;
    }
    if (pieces->seen[piece->piece]) return SB_OK;
    memcpy(pieces->bytes + piece->offset, piece->data, (size_t)piece->count);
    pieces->seen[piece->piece] = 1;
    return ++pieces->received == pieces->piece_count ? finish(pieces, complete) : SB_OK;
}

void sb_pieces_free(sb_pieces *pieces)
{
    forget(pieces);
    sb_live_scene_free(&pieces->scene);
    *pieces = (sb_pieces){0};
}
