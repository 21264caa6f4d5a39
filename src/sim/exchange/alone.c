/* A simulation without other domains. Ghost particles at periodic sides: images of the particles within a support
   radius of such a side, one domain length away. Every pass over neighbours reads them. They have their own cells, so
   that the order and the cells of the fluid particles are the same as without ghosts. */
#include "base/memory.h"
#include "sim/exchange/exchange.h"
#include "sim/search/sort.h"

#include <string.h>

/* Makes room for `beyond` entries after the fluid particles. Returns 0, or -1 without memory. */
static int make_room(sb_sim *sim, size_t beyond)
{
    sb_state *state = &sim->state;
    if (state->n + beyond <= state->capacity) return 0;
    const size_t capacity = state->n + beyond + beyond / 8 + 64;
    if (sb_state_lengthen(state, state->n, capacity) != 0) return -1;
    return sb_work_create(&sim->work, &sim->needs, state->owned, capacity); /* nothing in it is alive */
}

static int reserve(sb_sim *sim, size_t ghosts)
{
    sb_ghosts *g = &sim->ghosts;
    if (sb_grow((void **)&g->of, &g->of_capacity, ghosts, sizeof *g->of) != 0 ||
        sb_grow((void **)&g->words, &g->words_capacity, ghosts, sizeof *g->words) != 0 ||
        sb_grow((void **)&g->other, &g->other_capacity, ghosts, sizeof *g->other) != 0)
        return -1;
    return make_room(sim, ghosts);
}

/* Sets first[b] to the number of ghosts of the blocks before b. Returns the number of all ghosts. */
static size_t count_images(const sb_sim *sim, size_t *first)
{
    const size_t blocks = sb_blocks(sim);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        sb_record image[SB_IMAGES_MAX];
        size_t found = 0;
        for (size_t i = b * SB_BLOCK; i < sb_block_end(sim, b); i++)
            found += (size_t)sb_space_images(&sim->space, sim->state.position[i], image);
        first[b + 1] = found;
    }
    for (size_t b = 0; b < blocks; b++) first[b + 1] += first[b];
    return first[blocks];
}

/* Makes the images in the order of their originals, each with the original's index in the last lane, and the words to
   sort them by. */
static void make_images(sb_sim *sim, const size_t *first, sb_record *made)
{
    const size_t blocks = sb_blocks(sim);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        sb_record image[SB_IMAGES_MAX];
        size_t at = first[b];
        for (size_t i = b * SB_BLOCK; i < sb_block_end(sim, b); i++) {
            int images = sb_space_images(&sim->space, sim->state.position[i], image);
            for (int k = 0; k < images; k++, at++) {
                made[at] = image[k];
                made[at][3] = (uint32_t)i;
                sim->ghosts.words[at] = sb_sort_word(sb_space_key(&sim->space, image[k]), at);
            }
        }
    }
}

static void place(sb_sim *sim, const uint64_t *sorted, const sb_record *made)
{
    const size_t count = sim->ghosts.count;
    sb_record *position = sim->state.position + sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t g = 0; g < count; g++) {
        sb_record ghost = made[sb_word_index(sorted[g])];
        sim->ghosts.of[g] = ghost[3];
        ghost[3] = 0;
        position[g] = ghost;
    }
}

/* Returns 0, or -1 without memory. */
static int build(sb_sim *sim, const size_t *first, size_t count)
{
    sb_ghosts *g = &sim->ghosts;
    if (reserve(sim, count) != 0) return -1;
    sb_record *made = sim->work.images;
    make_images(sim, first, made);
    const uint64_t *sorted = sb_sort(g->words, g->other, count, SB_INDEX_BITS, SB_INDEX_BITS + sim->space.key_bits);
    if (!sorted) return -1;
    g->count = count;
    place(sim, sorted, made);
    return sb_cells_build(&g->cells, sim->state.position + sim->state.n, count, sim->space.shift);
}

static sb_status make_ghosts(sb_sim *sim, sb_error *error)
{
    if (!sim->space.repeats) return SB_OK;
    sim->ghosts.count = 0;
    size_t *first = sb_alloc(sb_blocks(sim) + 1, sizeof *first);
    if (!first) return sb_fail_memory(error, "ghosts");
    const size_t count = count_images(sim, first);
    sb_status status = SB_OK;
    if (count >= (size_t)1 << SB_INDEX_BITS)
        status = sb_fail(error, SB_FAILED, "%zu images beyond periodic sides: expected fewer than 2^%d", count,
                         SB_INDEX_BITS);
    else if (count > 0 && build(sim, first, count) != 0)
        status = sb_fail_memory(error, "ghosts");
    sb_free(first);
    return status;
}

static void refresh_4(const sb_halo *halo, const uint32_t *of, size_t count)
{
#pragma omp parallel for schedule(static)
    for (size_t g = 0; g < count; g++)
        memcpy((char *)halo->ghosts + g * halo->ghost_stride, (const char *)halo->owned + of[g] * halo->owned_stride,
               4);
}

static void refresh_16(const sb_halo *halo, const uint32_t *of, size_t count)
{
    const sb_f4 *owned = halo->owned;
    sb_f4 *ghosts = halo->ghosts;
#pragma omp parallel for schedule(static)
    for (size_t g = 0; g < count; g++) ghosts[g] = owned[of[g]];
}

static void refresh(const sb_sim *sim, const sb_halo *halo)
{
    if (sim->ghosts.count == 0) return;
    (halo->size == 4 ? refresh_4 : refresh_16)(halo, sim->ghosts.of, sim->ghosts.count);
}

static void sum(const sb_sim *sim, sb_exact *values, size_t count)
{
    (void)sim, (void)values, (void)count;
}

static void sum_counts(const sb_sim *sim, uint64_t *values, size_t count)
{
    (void)sim, (void)values, (void)count;
}

static double largest(const sb_sim *sim, double value)
{
    (void)sim;
    return value;
}

static bool any(const sb_sim *sim, bool flag)
{
    (void)sim;
    return flag;
}

const sb_exchange sb_exchange_alone = {
    .name = "alone",
    .make_ghosts = make_ghosts,
    .refresh = refresh,
    .sum = sum,
    .count = sum_counts,
    .largest = largest,
    .any = any,
};
