/* Images of the particles within a support radius of a periodic side, one domain length away. Every pass over
   neighbours reads them. They have their own cells, so that the order and the cells of the fluid particles are the same
   as without images. */
#include "sim/exchange/images.h"

#include "base/memory.h"
#include "sim/exchange/exchange.h"
#include "sim/search/around.h"
#include "sim/search/sort.h"

#include <string.h>

int sb_ghosts_reserve(sb_sim *sim, size_t halo, size_t images)
{
    sb_state *state = &sim->state;
    const size_t owned = state->n + halo, all = owned + images;
    if (owned <= state->owned && all <= state->capacity) return 0;
    if (owned > state->owned && sb_state_grow(state, state->n, owned + halo / 8 + 64) != 0) return -1;
    if (all > state->capacity && sb_state_lengthen(state, owned, all + images / 8 + 64) != 0) return -1;
    return sb_work_create(&sim->work, &sim->needs, state->owned, state->capacity); /* nothing in it is alive */
}

static int reserve(sb_sim *sim, size_t images)
{
    sb_ghosts *g = &sim->ghosts;
    if (sb_grow((void **)&g->of, &g->of_capacity, images, sizeof *g->of) != 0 ||
        sb_grow((void **)&g->words, &g->words_capacity, images, sizeof *g->words) != 0 ||
        sb_grow((void **)&g->other, &g->other_capacity, images, sizeof *g->other) != 0)
        return -1;
    return sb_ghosts_reserve(sim, g->halo, images);
}

/* Originals: the owned particles and the halo, in the order of all particles. */
static size_t originals(const sb_sim *sim)
{
    return sim->state.n + sim->ghosts.halo;
}

/* The entry of the k-th original. */
SB_INLINE size_t original(const sb_sim *sim, size_t k)
{
    const size_t lower = sim->ghosts.lower, n = sim->state.n;
    return k < lower ? n + k : k < lower + n ? k - lower : k;
}

static size_t block_end(size_t block, size_t count)
{
    return (block + 1) * SB_BLOCK < count ? (block + 1) * SB_BLOCK : count;
}

/* Sets first[b] to the number of images of the blocks of originals before b. Returns the number of all images. */
static size_t count_images(const sb_sim *sim, size_t *first, size_t blocks)
{
    const size_t count = originals(sim);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        sb_record image[SB_IMAGES_MAX];
        size_t found = 0;
        for (size_t k = b * SB_BLOCK; k < block_end(b, count); k++)
            found += (size_t)sb_space_images(&sim->space, sim->state.position[original(sim, k)], image);
        first[b + 1] = found;
    }
    for (size_t b = 0; b < blocks; b++) first[b + 1] += first[b];
    return first[blocks];
}

/* Makes the images in the order of their originals, each with the original's entry in the last lane, and the words to
   sort them by. */
static void make_images(sb_sim *sim, const size_t *first, size_t blocks, sb_record *made)
{
    const size_t count = originals(sim);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        sb_record image[SB_IMAGES_MAX];
        size_t at = first[b];
        for (size_t k = b * SB_BLOCK; k < block_end(b, count); k++) {
            const size_t from = original(sim, k);
            int images = sb_space_images(&sim->space, sim->state.position[from], image);
            for (int m = 0; m < images; m++, at++) {
                made[at] = image[m];
                made[at][3] = (uint32_t)from;
                sim->ghosts.words[at] = sb_sort_word(sb_space_key(&sim->space, image[m]), at);
            }
        }
    }
}

static void place(sb_sim *sim, const uint64_t *sorted, const sb_record *made)
{
    const size_t count = sim->ghosts.count;
    sb_record *position = sim->state.position + sb_images_first(sim);
#pragma omp parallel for schedule(static)
    for (size_t g = 0; g < count; g++) {
        sb_record ghost = made[sb_word_index(sorted[g])];
        sim->ghosts.of[g] = ghost[3];
        ghost[3] = 0;
        position[g] = ghost;
    }
}

/* Returns 0, or -1 without memory. */
static int build(sb_sim *sim, const size_t *first, size_t blocks, size_t count)
{
    sb_ghosts *g = &sim->ghosts;
    if (reserve(sim, count) != 0) return -1;
    sb_record *made = sim->work.images;
    make_images(sim, first, blocks, made);
    const uint64_t *sorted = sb_sort(g->words, g->other, count, SB_INDEX_BITS, SB_INDEX_BITS + sim->space.key_bits);
    if (!sorted) return -1;
    g->count = count;
    place(sim, sorted, made);
    return sb_cells_build(&g->cells, sim->state.position + sb_images_first(sim), count, sim->space.shift);
}

sb_status sb_images_make(sb_sim *sim, sb_error *error)
{
    if (!sim->space.repeats) return SB_OK;
    sim->ghosts.count = sim->ghosts.cells.count = 0;
    const size_t blocks = (originals(sim) + SB_BLOCK - 1) / SB_BLOCK;
    size_t *first = sb_alloc(blocks + 1, sizeof *first);
    if (!first) return sb_fail_memory(error, "ghosts");
    const size_t count = count_images(sim, first, blocks);
    sb_status status = SB_OK;
    if (count >= (size_t)1 << SB_INDEX_BITS)
        status = sb_fail(error, SB_FAILED, "%zu images beyond periodic sides: expected fewer than 2^%d", count,
                         SB_INDEX_BITS);
    else if (count > 0 && build(sim, first, blocks, count) != 0)
        status = sb_fail_memory(error, "ghosts");
    sb_free(first);
    return status;
}

/* The value of an entry: owned, or of the halo. */
SB_INLINE const void *value_of(const sb_halo *halo, size_t n, uint32_t entry)
{
    return entry < n ? (const char *)halo->owned + entry * halo->owned_stride
                     : (const char *)halo->ghosts + (entry - n) * halo->ghost_stride;
}

static void refresh_4(const sb_sim *sim, const sb_halo *halo)
{
    const size_t n = sim->state.n, count = sim->ghosts.count;
    const uint32_t *of = sim->ghosts.of;
    char *images = (char *)halo->ghosts + sim->ghosts.halo * halo->ghost_stride;
#pragma omp parallel for schedule(static)
    for (size_t g = 0; g < count; g++) memcpy(images + g * halo->ghost_stride, value_of(halo, n, of[g]), 4);
}

static void refresh_16(const sb_sim *sim, const sb_halo *halo)
{
    const size_t n = sim->state.n, count = sim->ghosts.count;
    const uint32_t *of = sim->ghosts.of;
    sb_f4 *images = (sb_f4 *)halo->ghosts + sim->ghosts.halo;
#pragma omp parallel for schedule(static)
    for (size_t g = 0; g < count; g++) images[g] = *(const sb_f4 *)value_of(halo, n, of[g]);
}

void sb_images_refresh(const sb_sim *sim, const sb_halo *halo)
{
    if (sim->ghosts.count == 0 || halo->without_images) return;
    (halo->size == 4 ? refresh_4 : refresh_16)(sim, halo);
}
