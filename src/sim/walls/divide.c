/* Static boundary particles of one of several ranks: those that the particles of its domain may meet. Each rank keeps a
   share of all of them, from which the ranks supply each other, so that each cell has the content and the order that it
   has in one rank.

   If the model has them all, the shares are parts of their order by keys, and what a rank receives, one rank after
   another, is in this order. If the model has those of some slabs, that is the share. What a rank then receives of a
   body is in the order of one rank, in which a cell has one body after another, and then the images beyond periodic
   sides, in the order of their originals. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/search/sort.h"
#include "sim/walls/normals.h"
#include "sim/walls/walls.h"

#include <string.h>

/* A boundary particle on its way to another rank. */
typedef struct passenger {
    sb_record record;
    sb_f4 normal;
    uint32_t body, unused[3];
} passenger;

/* Buffers, and the new static set. */
typedef struct delivery {
    passenger *out, *in;
    size_t sent, arrived;
    sb_wall_set set;
} delivery;

void sb_walls_share_free(sb_wall_share *share)
{
    sb_free(share->cut);
    sb_free(share->record);
    sb_free(share->body);
    sb_free(share->facing);
    *share = (sb_wall_share){.cut = NULL};
}

static int allocate(sb_record **record, uint32_t **body, uint32_t **facing, size_t count)
{
    *record = sb_alloc_untouched(count, sizeof **record);
    *body = sb_alloc_untouched(count, sizeof **body);
    *facing = sb_alloc_untouched(count, sizeof **facing);
    return *record && *body && *facing ? 0 : -1;
}

/* Takes an equal share of a set that has all boundary particles. */
static void take_equal(const sb_sim *sim, const sb_wall_set *set, sb_wall_share *share)
{
    const size_t from = set->count * (size_t)sim->ranks->rank / (size_t)sim->ranks->count;
    memcpy(share->record, set->record + from, share->count * sizeof *share->record);
    memcpy(share->body, set->body + from, share->count * sizeof *share->body);
    memcpy(share->facing, set->facing + from, share->count * sizeof *share->facing);
}

/* Takes what is not marked, and takes the marks away. */
static void take_own(sb_wall_set *set, sb_wall_share *share)
{
    size_t at = 0;
    for (size_t i = 0; i < set->count; i++) {
        if (!(set->body[i] & SB_WALL_MARK)) {
            share->record[at] = set->record[i];
            share->body[at] = set->body[i];
            share->facing[at++] = set->facing[i];
        }
        set->body[i] &= ~(SB_WALL_MARK | SB_WALL_IMAGE);
    }
}

int sb_walls_share(sb_sim *sim)
{
    sb_wall_set *set = &sim->walls.set[SB_STATIC];
    sb_wall_share *share = &sim->walls.share;
    if (!sim->domains || sim->needs.foam || sim->needs.dynamic_walls) return 0;
    const size_t ranks = (size_t)sim->ranks->count, own = (size_t)sim->ranks->rank;
    const bool divided = sim->model->walls.divided;
    if (!divided) share->count = set->count * (own + 1) / ranks - set->count * own / ranks;
    for (size_t i = 0; i < set->count && divided; i++) share->count += !(set->body[i] & SB_WALL_MARK);
    share->cut = sb_alloc(ranks + 1, sizeof *share->cut); /* of no domains */
    if (!share->cut || allocate(&share->record, &share->body, &share->facing, share->count) != 0) return -1;
    if (divided)
        take_own(set, share);
    else
        take_equal(sim, set, share);
    return 0;
}

/* The end of the share's particles in the cell of particle `first`. */
static size_t cell_end(const sb_sim *sim, size_t first)
{
    const sb_wall_share *share = &sim->walls.share;
    const uint64_t code = sb_cell_code(share->record[first], sim->space.shift);
    size_t end = first + 1;
    while (end < share->count && sb_cell_code(share->record[end], sim->space.shift) == code) end++;
    return end;
}

/* Sets domains->row to the numbers of particles that go to each rank. */
static void count_passengers(sb_sim *sim)
{
    sb_domains *d = sim->domains;
    int rank[SB_RANKS_MAX];
    memset(d->row, 0, (size_t)d->ranks->count * sizeof *d->row);
    for (size_t first = 0, end; first < sim->walls.share.count; first = end) {
        end = cell_end(sim, first);
        const size_t readers = sb_domains_readers(sim, sim->walls.share.record[first], rank);
        for (size_t k = 0; k < readers; k++) d->row[rank[k]] += end - first;
    }
}

/* Fills the buffer, rank after rank. */
static void board(const sb_sim *sim, delivery *v)
{
    const sb_wall_share *share = &sim->walls.share;
    const sb_domains *d = sim->domains;
    passenger *place[SB_RANKS_MAX], *next = v->out;
    int rank[SB_RANKS_MAX];
    for (int r = 0; r < d->ranks->count; next += d->row[r++]) place[r] = next;
    for (size_t first = 0, end; first < share->count; first = end) {
        end = cell_end(sim, first);
        const size_t readers = sb_domains_readers(sim, share->record[first], rank);
        for (size_t k = 0; k < readers; k++)
            for (size_t i = first; i < end; i++)
                *place[rank[k]]++ = (passenger){.record = share->record[i],
                                                .normal = sim->walls.normals.normal[share->facing[i]],
                                                .body = share->body[i]};
    }
}

/* Sends the buffer's parts and receives those of the other ranks, one after another. */
static void travel(sb_sim *sim, delivery *v)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count, own = (size_t)d->ranks->rank;
    size_t sends = 0, receives = 0;
    passenger *from = v->out, *to = v->in;
    for (size_t r = 0; r < ranks; r++) {
        const size_t leave = d->row[r], come = d->column[r];
        if (r == own && leave > 0) memcpy(to, from, leave * sizeof *to);
        if (r != own && leave > 0) d->send[sends++] = (sb_parcel){(int)r, from, leave * sizeof *from};
        if (r != own && come > 0) d->receive[receives++] = (sb_parcel){(int)r, to, come * sizeof *to};
        from += leave, to += come;
    }
    sb_ranks_start(d->ranks, d->send, sends, d->receive, receives);
    sb_ranks_finish(d->ranks);
}

typedef uint64_t sort_key(const sb_sim *sim, const passenger *one);

static uint64_t body_of(const sb_sim *sim, const passenger *one)
{
    (void)sim;
    return one->body & ~SB_WALL_IMAGE;
}

static uint64_t original_of(const sb_sim *sim, const passenger *one)
{
    return one->body & SB_WALL_IMAGE ? sb_space_key(&sim->space, sb_space_wrap(&sim->space, one->record)) : 0;
}

static uint64_t is_image(const sb_sim *sim, const passenger *one)
{
    (void)sim;
    return one->body & SB_WALL_IMAGE ? 1 : 0;
}

/* Sorts those that have arrived by a key of so many bits, stably. Returns 0, or -1 without memory. */
static int sort_arrived(const sb_sim *sim, sort_key *key, int bits, delivery *v)
{
    const size_t n = v->arrived;
    uint64_t *words = sb_alloc_untouched(n, sizeof *words), *other = sb_alloc_untouched(n, sizeof *words);
    passenger *sorted = sb_alloc_untouched(n, sizeof *sorted);
    for (size_t i = 0; words && i < n; i++) words[i] = sb_sort_word(key(sim, &v->in[i]), i);
    const uint64_t *order =
        words && other && sorted ? sb_sort(words, other, n, SB_INDEX_BITS, SB_INDEX_BITS + bits) : NULL;
    for (size_t i = 0; order && i < n; i++) sorted[i] = v->in[sb_word_index(order[i])];
    const int status = order ? 0 : -1;
    if (order) {
        sb_free(v->in);
        v->in = sorted;
        sorted = NULL;
    }
    sb_free(sorted);
    sb_free(words);
    sb_free(other);
    return status;
}

/* Puts those of a cell into the order of one rank, after which they are sorted by cells. Returns 0, or -1 without
   memory. */
static int sort_cells(const sb_sim *sim, delivery *v)
{
    int bits = 1;
    while (sim->model->body_count >> bits) bits++;
    if (sort_arrived(sim, body_of, bits, v) != 0) return -1;
    if (!sim->space.repeats) return 0;
    return sort_arrived(sim, original_of, sim->space.key_bits, v) != 0 || sort_arrived(sim, is_image, 1, v) != 0 ? -1
                                                                                                                 : 0;
}

/* Makes the static set of those that have arrived. Returns 0, or -1 without memory. */
static int settle_in(sb_sim *sim, delivery *v)
{
    sb_wall_set *set = &v->set, *old = &sim->walls.set[SB_STATIC];
    const bool by_slabs = sim->model->walls.divided;
    if (by_slabs && sort_cells(sim, v) != 0) return -1;
    set->count = v->arrived;
    for (size_t i = 0; i < set->count; i++) {
        set->record[i] = v->in[i].record;
        set->body[i] = v->in[i].body & ~SB_WALL_IMAGE;
        if (sb_wall_normals_index(&sim->walls.normals, v->in[i].normal, &set->facing[i]) != 0) return -1;
    }
    if (by_slabs ? sb_walls_table(set, &sim->space) != 0
                 : sb_cells_build(&set->cells, set->record, set->count, sim->space.shift) != 0)
        return -1;
    if (sb_walls_near_build(set, &sim->space) != 0) return -1;
    const sb_wall_set made = *set;
    *set = *old;
    *old = made;
    return 0;
}

static void end_delivery(delivery *v)
{
    sb_free(v->out);
    sb_free(v->in);
    sb_free(v->set.record);
    sb_free(v->set.body);
    sb_free(v->set.facing);
    sb_free(v->set.near);
    sb_cells_free(&v->set.cells);
}

sb_status sb_walls_divide(sb_sim *sim, sb_error *error)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count;
    uint64_t *cut = sim->walls.share.cut;
    if (!cut || memcmp(cut, d->cut, (ranks + 1) * sizeof *cut) == 0) return SB_OK;
    delivery v = {.sent = 0};
    count_passengers(sim);
    sb_domains_swap_row(d);
    for (size_t r = 0; r < ranks; r++) {
        v.sent += d->row[r];
        v.arrived += d->column[r];
    }
    v.out = sb_alloc_untouched(v.sent, sizeof *v.out);
    v.in = sb_alloc_untouched(v.arrived, sizeof *v.in);
    bool failed = allocate(&v.set.record, &v.set.body, &v.set.facing, v.arrived) != 0 || !v.out || !v.in;
    sb_status status = sb_domains_agree(sim, failed ? sb_fail_memory(error, "boundary particles") : SB_OK, error);
    if (status == SB_OK) {
        board(sim, &v);
        travel(sim, &v);
        failed = settle_in(sim, &v) != 0;
        status = sb_domains_agree(sim, failed ? sb_fail_memory(error, "boundary particles") : SB_OK, error);
        memcpy(cut, d->cut, (ranks + 1) * sizeof *cut);
    }
    end_delivery(&v);
    return status;
}
