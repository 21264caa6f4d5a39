/* Particles that move to another domain. They are handed over before the sort, which puts them into their places: the
   order in which they arrive has no effect. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/walls/walls.h"

#include <string.h>

/* The rank in whose domain particle i is. */
static int owner_of(const sb_sim *sim, size_t i)
{
    const uint64_t key = sb_space_key(&sim->space, sb_space_wrap(&sim->space, sim->state.position[i]));
    return sb_domains_owns(sim->domains, key) ? sim->ranks->rank : sb_domains_owner(sim->domains, key);
}

/* Sets first[b] to the number of migrants in the blocks of particles before b. Returns the number of all migrants. */
static size_t count_migrants(const sb_sim *sim, size_t *first)
{
    const size_t blocks = sb_blocks(sim);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        size_t found = 0;
        for (size_t i = b * SB_BLOCK; i < sb_block_end(sim, b); i++) found += owner_of(sim, i) != sim->ranks->rank;
        first[b + 1] = found;
    }
    for (size_t b = 0; b < blocks; b++) first[b + 1] += first[b];
    return first[blocks];
}

/* Lists the migrants in the order of the particles. */
static void list_migrants(sb_sim *sim, const size_t *first)
{
    const size_t blocks = sb_blocks(sim);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        sb_migrant *next = sim->domains->migrant + first[b];
        if (first[b + 1] == first[b]) continue;
        for (size_t i = b * SB_BLOCK; i < sb_block_end(sim, b); i++) {
            const int owner = owner_of(sim, i);
            if (owner != sim->ranks->rank) *next++ = (sb_migrant){(uint32_t)i, owner};
        }
    }
}

/* Finds the migrants. Returns 0, or -1 without memory. */
static int find_migrants(sb_sim *sim, size_t *count)
{
    sb_domains *d = sim->domains;
    size_t *first = sb_alloc(sb_blocks(sim) + 1, sizeof *first);
    int status = first ? 0 : -1;
    *count = 0;
    if (status == 0) {
        const size_t found = count_migrants(sim, first);
        status = sb_grow((void **)&d->migrant, &d->migrant_capacity, found, sizeof *d->migrant);
        if (status == 0) {
            list_migrants(sim, first);
            *count = found;
        }
    }
    sb_free(first);
    return status;
}

/* Bytes of all fields of a particle. */
static size_t particle_bytes(const sb_state *state)
{
    size_t bytes = 0;
    for (const sb_state_field *f = sb_state_fields; f->name; f++)
        if (sb_state_entries(state, f)) bytes += f->size;
    return bytes;
}

static char *entry_of(const sb_state *state, const sb_state_field *f, size_t i)
{
    return (char *)sb_state_entries(state, f) + i * f->size;
}

/* Writes a particle's fields one after another. */
static char *pack(const sb_state *state, size_t i, char *to)
{
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        if (!sb_state_entries(state, f)) continue;
        memcpy(to, entry_of(state, f, i), f->size);
        to += f->size;
    }
    return to;
}

static const char *unpack(sb_state *state, size_t i, const char *from)
{
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        if (!sb_state_entries(state, f)) continue;
        memcpy(entry_of(state, f, i), from, f->size);
        from += f->size;
    }
    return from;
}

static void copy_particle(sb_state *state, size_t to, size_t from)
{
    for (const sb_state_field *f = sb_state_fields; f->name; f++)
        if (sb_state_entries(state, f)) memcpy(entry_of(state, f, to), entry_of(state, f, from), f->size);
}

/* Packs the migrants for each rank, and makes the parcels. Returns their number. */
static size_t make_parcels(sb_sim *sim, size_t count, size_t bytes)
{
    sb_domains *d = sim->domains;
    char *place[SB_RANKS_MAX], *next = d->out;
    size_t parcels = 0;
    for (int r = 0; r < d->ranks->count; r++) {
        place[r] = next;
        if (d->row[r] > 0) d->send[parcels++] = (sb_parcel){r, next, d->row[r] * bytes};
        next += d->row[r] * bytes;
    }
    for (size_t k = 0; k < count; k++) {
        char **at = &place[d->migrant[k].to];
        *at = pack(&sim->state, d->migrant[k].particle, *at);
    }
    return parcels;
}

/* Puts the last particles into the places of the migrants, which are in order. */
static void close_gaps(sb_sim *sim, size_t count)
{
    const sb_migrant *migrant = sim->domains->migrant;
    size_t end = sim->state.n, last = count;
    for (size_t k = 0; k < last; k++) {
        while (last > k && migrant[last - 1].particle + 1 == end) end--, last--;
        if (k < last) copy_particle(&sim->state, migrant[k].particle, --end);
    }
    sim->state.n = end;
}

/* Sends the migrants and appends those that come. */
static void hand_over(sb_sim *sim, size_t count, size_t arrivals, size_t bytes)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count;
    const size_t sends = make_parcels(sim, count, bytes);
    size_t receives = 0;
    char *next = d->in;
    for (size_t r = 0; r < ranks; r++) {
        const size_t size = d->column[r] * bytes;
        if (size > 0) d->receive[receives++] = (sb_parcel){(int)r, next, size};
        next += size;
    }
    sb_ranks_start(d->ranks, d->send, sends, d->receive, receives);
    close_gaps(sim, count);
    sb_ranks_finish(d->ranks);
    const char *from = d->in;
    for (size_t k = 0; k < arrivals; k++) from = unpack(&sim->state, sim->state.n + k, from);
    sim->state.n += arrivals;
}

/* Room for the particles, all entries and the bytes that are sent. Returns 0, or -1 without memory. */
static int reserve(sb_sim *sim, size_t count, size_t arrivals, size_t bytes)
{
    sb_domains *d = sim->domains;
    sb_state *state = &sim->state;
    const size_t needed = state->n - count + arrivals;
    if (sb_grow((void **)&d->out, &d->out_capacity, count * bytes, 1) != 0 ||
        sb_grow((void **)&d->in, &d->in_capacity, arrivals * bytes, 1) != 0)
        return -1;
    if (needed <= state->owned) return 0;
    if (sb_state_grow(state, state->n, needed + needed / 32 + 64) != 0) return -1;
    return sb_work_create(&sim->work, &sim->needs, state->owned, state->capacity); /* nothing in it is alive */
}

sb_status sb_domains_migrate(sb_sim *sim, sb_error *error)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count, bytes = particle_bytes(&sim->state);
    size_t count = 0, arrivals = 0;
    sb_domains_land(sim);
    if (d->recut) memcpy(d->cut, d->next, (ranks + 1) * sizeof *d->cut);
    d->recut = false;
    int failed = find_migrants(sim, &count);
    memset(d->row, 0, ranks * sizeof *d->row);
    for (size_t k = 0; k < count; k++) d->row[d->migrant[k].to]++;
    sb_domains_swap_row(d);
    for (size_t r = 0; r < ranks; r++) arrivals += d->column[r];
    if (failed == 0) failed = reserve(sim, count, arrivals, bytes);
    const sb_status status =
        sb_domains_agree(sim, failed ? sb_fail_memory(error, "particles that arrive") : SB_OK, error);
    if (status != SB_OK) return status;
    hand_over(sim, count, arrivals, bytes);
    return sb_walls_divide(sim, error);
}
