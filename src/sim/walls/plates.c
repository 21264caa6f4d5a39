/* The surface before each push-plate of a divided paddle. */
#include "base/memory.h"
#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/walls/absorber.h"

#include <math.h>

void sb_plate_find(const sb_sim *sim, size_t body, sb_absorber *a)
{
    const sb_model_body *of = &sim->model->bodies[body];
    const sb_wavemaker_use *use = &sim->scene->wavemakers[of->wavemaker];
    sb_plate_row row;
    a->plate = of->plate;
    a->plates = sb_scene_plates(sim->scene, use, &row);
    a->side[0] = row.axis == 0;
    a->side[1] = row.axis == 1;
    a->from[0] = row.from;
    a->from[1] = row.to;
}

/* Weight across a plate at u plates from the row's beginning: a B-spline two plates wide. At the row's ends it has its
   mirror image, so that its integral over the row is 1/2 for each plate. */
static double across(double u, size_t plate, const sb_absorber *a, bool repeats)
{
    const double n = (double)a->plates, middle = (double)plate + 0.5;
    if (repeats) return sb_column_weight(2 * remainder(u - middle, n));
    double weight = sb_column_weight(2 * (u - middle));
    if (plate == 0) weight += sb_column_weight(2 * (-u - middle));
    if (plate + 1 == a->plates) weight += sb_column_weight(2 * (2 * n - u - middle));
    return weight;
}

/* Adds a particle to the columns of the plates near it. moving: the first plate. */
static void add(const sb_moving_body *moving, sb_vec3 at, double width, bool repeats, sb_exact *sums)
{
    const sb_absorber *a = moving->absorber;
    const double along = at.x * a->side[0] + at.y * a->side[1], n = (double)a->plates;
    double u = (along - a->from[0]) / (a->from[1] - a->from[0]) * n;
    if (repeats) u -= n * floor(u / n); /* water may have passed a periodic side within the step */
    if (!(u >= 0 && u <= n)) return;
    const long middle = (long)fmin(floor(u), n - 1), count = (long)a->plates;
    const long near = repeats && count < 3 ? count : 3; /* each plate once */
    for (long k = middle - 1; k < middle - 1 + near; k++) {
        if (!repeats && (k < 0 || k >= count)) continue;
        const size_t plate = (size_t)((k + count) % count);
        const sb_moving_body *one = &moving[plate];
        const double from = one->absorber->face + one->displacement + one->absorber->distance;
        const double ahead = (sb_dot(at, one->direction) - from) / width;
        if (fabs(ahead) < 2) sb_exact_add(&sums[plate], sb_column_weight(ahead) * across(u, plate, a, repeats));
    }
}

/* Depths of the still water before the plates of a row, which are known at the start. A plate with less than a layer of
   water faces land. Still water has its own depth before each plate, over any bed, and an initial wave is known; boxes
   of water may stand higher before one plate than before another, and all then have the mean depth of those with
   water. */
static void note_still(const sb_sim *sim, sb_moving_body *row, size_t count)
{
    double sum = 0;
    size_t wet = 0;
    if (row->absorber->known) return;
    for (size_t k = 0; k < count; k++) {
        sb_absorber *a = row[k].absorber;
        const bool water = a->depth >= sim->model->spacing;
        const double pitch = (a->from[1] - a->from[0]) / (double)count, from = a->from[0] + (double)k * pitch;
        a->still = water ? a->depth - sb_absorber_raised(sim, &row[k], from, from + pitch) : 0;
        a->known = true;
        sum += a->still;
        wet += water;
    }
    if (!sb_absorber_boxed(sim, row)) return;
    for (size_t k = 0; k < count; k++)
        if (row[k].absorber->still != 0) row[k].absorber->still = sum / (double)wet;
}

int sb_plates_measure(sb_sim *sim, sb_moving_body *moving)
{
    const sb_absorber *a = moving->absorber;
    const size_t count = a->plates, n = sim->state.n;
    const double width = 0.5 * a->distance, pitch = (a->from[1] - a->from[0]) / (double)count;
    const bool repeats = sb_absorber_repeats(sim->scene, a) && count > 1;
    sb_exact *sums = sb_alloc(count, sizeof *sums);
    bool enough = sums != NULL;
#pragma omp parallel reduction(&& : enough)
    {
        sb_exact *own = sums ? sb_alloc(count, sizeof *own) : NULL;
        enough = own != NULL;
#pragma omp for schedule(static) nowait
        for (size_t i = 0; i < n; i++)
            if (own) add(moving, sb_space_position(&sim->space, sim->state.position[i]), width, repeats, own);
        if (own) sb_sums_merge(sums, own, count);
        sb_free(own);
    }
    enough = sim->exchange->agree(sim, enough ? SB_OK : SB_FAILED, NULL) == SB_OK;
    if (enough) {
        sim->exchange->sum(sim, sums, count);
        const double volume = (double)sim->constant.mass / (double)sim->constant.rest_density;
        for (size_t k = 0; k < count; k++)
            moving[k].absorber->depth = 2 * sb_exact_value(&sums[k]) * volume / (width * pitch);
        note_still(sim, moving, count);
    }
    sb_free(sums);
    return enough ? 0 : -1;
}
