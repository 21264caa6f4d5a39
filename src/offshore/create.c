#include "base/memory.h"
#include "offshore/dispersion.h"
#include "offshore/paddle.h"
#include "offshore/state.h"

#include <math.h>
#include <omp.h>

bool sb_offshore_flat(const sb_offshore *offshore)
{
    return offshore->options.rows == 1;
}

static size_t stride_of(const sb_offshore_options *o)
{
    return (o->columns + 2 * SB_OFFSHORE_BEYOND + 7) / 8 * 8;
}

static size_t lines_of(const sb_offshore_options *o)
{
    return o->rows == 1 ? 1 : o->rows + 2 * SB_OFFSHORE_BEYOND;
}

/* Arrays of one value per cell. */
enum { ARRAYS = 13 };

size_t sb_offshore_bytes(const sb_offshore_options *options)
{
    const size_t cells = stride_of(options) * lines_of(options);
    const size_t scratch = stride_of(options) * SB_OFFSHORE_ROWS * (size_t)omp_get_max_threads();
    return (cells * ARRAYS + scratch) * sizeof(double) +
           (options->dispersion ? cells * 2 * sizeof(double) + sb_offshore_dispersion_bytes(cells) : 0);
}

size_t sb_offshore_held(const sb_offshore *offshore)
{
    return sb_offshore_bytes(&offshore->options);
}

static sb_status check(const sb_offshore_options *o, sb_error *error)
{
    if (o->columns < 2 || o->rows < 1)
        return sb_fail(error, SB_BAD_INPUT, "offshore: %zu x %zu cells, expected at least 2 x 1", o->columns, o->rows);
    if (!(o->cell > 0) || !isfinite(o->cell))
        return sb_fail(error, SB_BAD_INPUT, "offshore: cell of %g m, expected > 0", o->cell);
    if (!(o->gravity > 0) || !(o->manning >= 0) || !(o->dry_depth >= 0))
        return sb_fail(error, SB_BAD_INPUT, "offshore: gravity %g, manning %g, dry depth %g, expected > 0, >= 0, >= 0",
                       o->gravity, o->manning, o->dry_depth);
    for (int s = 0; s < (o->rows == 1 ? 2 : SB_OFFSHORE_SIDES); s++) {
        if (o->side[s] == SB_OFFSHORE_GIVEN && !o->given)
            return sb_fail(error, SB_BAD_INPUT, "offshore: side %d is given, expected a function that gives it", s);
        if (o->side[s] == SB_OFFSHORE_PADDLE && !o->paddle)
            return sb_fail(error, SB_BAD_INPUT, "offshore: side %d is a paddle, expected a law of its motion", s);
        if (o->side[s] == SB_OFFSHORE_PERIODIC && o->side[s ^ 1] != SB_OFFSHORE_PERIODIC)
            return sb_fail(error, SB_BAD_INPUT, "offshore: side %d is periodic, expected the opposite side too", s);
    }
    return SB_OK;
}

static sb_status allocate(sb_offshore *made, sb_error *error)
{
    double **arrays[ARRAYS + 2] = {&made->bed,       &made->now.h,     &made->now.hu,  &made->now.hv,   &made->before.h,
                                   &made->before.hu, &made->before.hv, &made->stage.h, &made->stage.hu, &made->stage.hv,
                                   &made->surface,   &made->u,         &made->v,       &made->force_x,  &made->force_y};
    const size_t count = made->options.dispersion ? ARRAYS + 2 : ARRAYS;
    for (size_t k = 0; k < count; k++) {
        *arrays[k] = sb_alloc(made->cells, sizeof(double));
        if (!*arrays[k]) return sb_fail_memory(error, "the depth-averaged model");
    }
    made->scratch_threads = omp_get_max_threads();
    made->scratch = sb_alloc((size_t)made->scratch_threads * SB_OFFSHORE_ROWS * made->stride, sizeof(double));
    made->line_speed = sb_alloc(made->lines, sizeof(double));
    made->line_repaired = sb_alloc(made->lines, sizeof(double));
    made->edge = sb_alloc(2 * (made->lines + made->stride), sizeof(double));
    if (!made->scratch || !made->line_speed || !made->line_repaired || !made->edge)
        return sb_fail_memory(error, "the depth-averaged model");
    if (!made->options.dispersion) return SB_OK;
    return sb_offshore_dispersion_create(made, &made->dispersion, error);
}

static sb_status copy_in(sb_offshore *made, const double *bed, const double *depth, const double *hu, const double *hv,
                         sb_error *error)
{
    const sb_offshore_options *o = &made->options;
    double deepest = 0;
    for (size_t j = 0; j < o->rows; j++)
        for (size_t i = 0; i < o->columns; i++) {
            const size_t from = j * o->columns + i, to = made->origin + j * made->stride + i;
            const double h = depth[from], qx = hu ? hu[from] : 0, qy = hv && o->rows > 1 ? hv[from] : 0;
            if (!isfinite(bed[from]) || !isfinite(h) || !isfinite(qx) || !isfinite(qy) || h < 0)
                return sb_fail(
                    error, SB_BAD_INPUT,
                    "offshore: column %zu, row %zu: bed %g m, depth %g m, momentum (%g, %g), expected finite "
                    "values and a depth >= 0",
                    i, j, bed[from], h, qx, qy);
            made->bed[to] = bed[from];
            made->now.h[to] = h;
            made->now.hu[to] = h > 0 ? qx : 0;
            made->now.hv[to] = h > 0 ? qy : 0;
            deepest = fmax(deepest, h);
        }
    if (!(o->dry_depth > 0)) made->options.dry_depth = fmin(1e-3, deepest > 0 ? 1e-5 * deepest : 1e-3);
    return SB_OK;
}

/* The bed beyond a side is that of the edge, or of the opposite side if periodic. Rows first, then whole columns. */
static void extend_bed(sb_offshore *made)
{
    const sb_offshore_options *o = &made->options;
    const bool around_x = o->side[0] == SB_OFFSHORE_PERIODIC, around_y = o->side[2] == SB_OFFSHORE_PERIODIC;
    for (size_t j = 0; j < o->rows; j++) {
        double *row = made->bed + made->origin + j * made->stride;
        for (size_t k = 1; k <= SB_OFFSHORE_BEYOND; k++) {
            row[-(ptrdiff_t)k] = around_x ? row[o->columns - k] : row[0];
            row[o->columns - 1 + k] = around_x ? row[k - 1] : row[o->columns - 1];
        }
    }
    if (o->rows == 1) return;
    for (size_t i = 0; i < made->stride; i++)
        for (size_t k = 1; k <= SB_OFFSHORE_BEYOND; k++) {
            double *column = made->bed + SB_OFFSHORE_BEYOND * made->stride + i;
            const size_t last = o->rows - 1;
            *(column - k * made->stride) = column[around_y ? (o->rows - k) * made->stride : 0];
            column[(last + k) * made->stride] = column[around_y ? (k - 1) * made->stride : last * made->stride];
        }
}

sb_status sb_offshore_create(const sb_offshore_options *options, const double *bed, const double *depth,
                             const double *hu, const double *hv, sb_offshore **offshore, sb_error *error)
{
    sb_status status = check(options, error);
    if (status != SB_OK) return status;
    sb_offshore *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the depth-averaged model");
    made->options = *options;
    made->stride = stride_of(options);
    made->lines = lines_of(options);
    made->cells = made->stride * made->lines;
    made->origin = (options->rows == 1 ? 0 : SB_OFFSHORE_BEYOND * made->stride) + SB_OFFSHORE_BEYOND;
    status = allocate(made, error);
    if (status == SB_OK) status = copy_in(made, bed, depth, hu, hv, error);
    if (status != SB_OK) {
        made->options.paddle = NULL;
        sb_offshore_destroy(made);
        return status;
    }
    extend_bed(made);
    for (size_t k = 0; k < made->cells; k++) {
        made->before.h[k] = made->now.h[k];
        made->before.hu[k] = made->now.hu[k];
        made->before.hv[k] = made->now.hv[k];
    }
    made->first = sb_offshore_find_balance(made).now;
    *offshore = made;
    return SB_OK;
}

void sb_offshore_destroy(sb_offshore *offshore)
{
    if (!offshore) return;
    double *const arrays[] = {offshore->bed,        offshore->now.h,         offshore->now.hu,    offshore->now.hv,
                              offshore->before.h,   offshore->before.hu,     offshore->before.hv, offshore->stage.h,
                              offshore->stage.hu,   offshore->stage.hv,      offshore->surface,   offshore->u,
                              offshore->v,          offshore->force_x,       offshore->force_y,   offshore->scratch,
                              offshore->line_speed, offshore->line_repaired, offshore->edge};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) sb_free(arrays[k]);
    sb_offshore_dispersion_destroy(offshore->dispersion);
    sb_offshore_paddle_destroy(offshore->options.paddle);
    sb_free(offshore);
}
