/* The state of strips in checkpoints and in the state hash. */
#include "offshore/save.h"
#include "base/hash.h"
#include "sim/sea/strip.h"

#include <math.h>

/* Reals of a station that outlive a step; the last ones only beside a line of a grid. */
enum { REALS = 7, WITHOUT_LINE = 3 };

static size_t reals_of(const sb_strip_side *s, const sb_outgoing *o, double reals[REALS])
{
    const double all[REALS] = {o->share, o->filtered, o->rate, o->smooth, o->smooth_rate, o->part, o->part_rate};
    memcpy(reals, all, sizeof all);
    return s->far > 0 ? REALS : WITHOUT_LINE;
}

void sb_strip_save(const sb_sim *sim, sb_archive_out *out)
{
    if (!sim->strip) return;
    if (sb_sea_grid(sim->strip->sea)) sb_offshore_save(sb_sea_grid(sim->strip->sea), out);
    if (sb_sea_maps(sim->strip->sea)) sb_offshore_maps_save(sb_sea_maps(sim->strip->sea), out);
    sb_put_flag(out, sim->strip->known);
    sb_put_count(out, sim->state.next_id);
    sb_put_list(out, &sim->state.crossing, sizeof sim->state.crossing / sizeof(double), sizeof(double));
    for (size_t k = 0; k < sim->strip->count; k++) {
        const sb_strip_side *s = &sim->strip->side[k];
        for (size_t n = 0; n < s->stations; n++) {
            double reals[REALS];
            const size_t count = reals_of(s, &s->station[n], reals);
            sb_put_list(out, reals, count, sizeof *reals);
        }
        sb_put_list(out, s->row_count, s->columns, sizeof *s->row_count);
        sb_put_list(out, s->owed, s->columns * s->rows, sizeof *s->owed);
        sb_put_list(out, s->correction, s->columns * s->rows, sizeof *s->correction);
    }
}

static void load_side(sb_strip_side *s, sb_archive_in *in)
{
    for (size_t n = 0; n < s->stations; n++) {
        sb_outgoing *o = &s->station[n];
        double reals[REALS] = {0};
        sb_take_list(in, reals, s->far > 0 ? REALS : WITHOUT_LINE, sizeof *reals);
        *o = (sb_outgoing){.share = reals[0],
                           .filtered = reals[1],
                           .rate = reals[2],
                           .smooth = reals[3],
                           .smooth_rate = reals[4],
                           .part = reals[5],
                           .part_rate = reals[6]};
        for (int r = 0; r < REALS; r++)
            if (!isfinite(reals[r])) sb_archive_refuse(in, "the outgoing wave of a side is not finite");
    }
    sb_take_list(in, s->row_count, s->columns, sizeof *s->row_count);
    sb_take_list(in, s->owed, s->columns * s->rows, sizeof *s->owed);
    sb_take_list(in, s->correction, s->columns * s->rows, sizeof *s->correction);
    for (size_t c = 0; c < s->columns; c++)
        if (s->row_count[c] < 0 || (size_t)s->row_count[c] > s->rows) {
            sb_archive_refuse(in, "%d rows of particles at a side, expected 0 to %zu", s->row_count[c], s->rows);
            s->row_count[c] = 0;
        }
    for (size_t k = 0; k < s->columns * s->rows; k++)
        if (!isfinite(s->owed[k]) || isinf(s->correction[k]))
            sb_archive_refuse(in, "a row of particles at a side has no finite values");
}

void sb_strip_load(sb_sim *sim, sb_archive_in *in)
{
    if (!sim->strip) return;
    if (sb_sea_grid(sim->strip->sea)) sb_offshore_load(sb_sea_grid(sim->strip->sea), in);
    if (sb_sea_maps(sim->strip->sea)) sb_offshore_maps_load(sb_sea_maps(sim->strip->sea), in);
    sim->strip->known = sb_take_flag(in);
    sim->state.next_id = (uint32_t)sb_take_count(in, UINT32_MAX);
    sb_take_list(in, &sim->state.crossing, sizeof sim->state.crossing / sizeof(double), sizeof(double));
    for (size_t k = 0; k < sim->strip->count; k++) load_side(&sim->strip->side[k], in);
    sim->strip->held_count = 0;
}

uint64_t sb_strip_hash(const sb_sim *sim, uint64_t hash)
{
    if (!sim->strip) return hash;
    if (sb_sea_grid(sim->strip->sea)) hash = sb_offshore_hash(sb_sea_grid(sim->strip->sea), hash);
    hash = sb_hash(hash, &sim->state.next_id, sizeof sim->state.next_id);
    hash = sb_hash(hash, &sim->state.ledger.sea, sizeof sim->state.ledger.sea);
    hash = sb_hash(hash, &sim->state.crossing, sizeof sim->state.crossing);
    for (size_t k = 0; k < sim->strip->count; k++) {
        const sb_strip_side *s = &sim->strip->side[k];
        for (size_t n = 0; n < s->stations; n++) {
            double reals[REALS];
            const size_t count = reals_of(s, &s->station[n], reals);
            hash = sb_hash(hash, reals, count * sizeof *reals);
        }
        hash = sb_hash(hash, s->row_count, s->columns * sizeof *s->row_count);
        hash = sb_hash(hash, s->owed, s->columns * s->rows * sizeof *s->owed);
        hash = sb_hash(hash, s->correction, s->columns * s->rows * sizeof *s->correction);
    }
    return hash;
}
