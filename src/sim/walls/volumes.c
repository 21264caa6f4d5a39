/* Wall volumes psi of boundary particles [A12] (docs/method.md, M16, and with images M16a), and images beyond periodic
   sides. */
#include "base/memory.h"
#include "physics/kernels/wall_volume.h"
#include "sim/simulation.h"
#include "sim/walls/normals.h"
#include "sim/walls/walls.h"
#include "sim/wcsph/boundary.h"

#include <math.h>

/* kernel: sum_k W_bk. curvature: sum_k W_bk (x_k - x_b).n_b / h, without the far face of a thin wall. */
typedef struct sums {
    double kernel, curvature;
} sums;

/* Adds the sums at one position: that of boundary particle b, or of an image of it. */
static void add_sums(const sb_sim *sim, const sb_wall_set *set, sb_record at, size_t b, bool only_own, sums *s)
{
    const double h = (double)sim->constant.support, quantum = sim->space.quantum;
    const int layers = sim->constant.dimension == 2 ? 0 : 1;
    const uint64_t code = sb_cell_code(at, sim->space.shift);
    const sb_f4 normal = sb_wall_normal(sim, set, b);
    for (int dz = -1; dz <= 1; dz++)
        for (int dy = -layers; dy <= layers; dy++)
            for (int dx = -1; dx <= 1; dx++) {
                int64_t cell = sb_cells_find(&set->cells, code + sb_cell_step(dx, dy, dz));
                if (cell < 0) continue;
                for (uint32_t k = set->cells.begin[cell]; k < set->cells.begin[cell + 1]; k++) {
                    if (only_own && set->body[k] != set->body[b] &&
                        sb_model_whole(sim->model, set->body[k]) != sb_model_whole(sim->model, set->body[b]))
                        continue;
                    sb_f4 d = sb_offset(at, set->record[k]);
                    double r2 = (double)d[0] * (double)d[0] + (double)d[1] * (double)d[1] + (double)d[2] * (double)d[2];
                    const double w =
                        sb_kernel_value(sim->scene->numerics.kernel, sim->constant.dimension, h, sqrt(r2) * quantum);
                    s->kernel += w;
                    if (sb_wall_curvature_includes((double)sb_sum3(normal * sb_wall_normal(sim, set, k))))
                        s->curvature -= w * (double)sb_sum3(normal * d) * quantum / h;
                }
            }
}

int sb_wall_volumes(const sb_sim *sim, sb_wall_set *set, bool only_own)
{
    for (size_t i = 0; i < set->count; i++) sb_carry(&set->record[i], sim->constant.mass);
    if (sim->needs.dynamic_walls) return 0;
    float *psi = sb_alloc_untouched(set->count, sizeof *psi);
    if (!psi) return -1;
    const sb_numerics *n = &sim->scene->numerics;
    /* With images they only weigh the drag of walls: its sums then give the area of a wall, at edges, too. */
    const bool of_lattice = sim->needs.images;
    const double gamma =
        of_lattice ? sb_wall_gamma(n->kernel, sim->constant.dimension, n->support, n->wall_offset, n->wall_spacing) : 1;
    const double scale = gamma * (double)sim->constant.rest_density;
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t i = 0; i < set->count; i++) {
        sb_record image[SB_IMAGES_MAX];
        sums s = {0};
        add_sums(sim, set, set->record[i], i, only_own, &s);
        int images = sim->space.repeats ? sb_space_images(&sim->space, set->record[i], image) : 0;
        for (int k = 0; k < images; k++) add_sums(sim, set, image[k], i, only_own, &s);
        psi[i] = (float)(scale / s.kernel * (of_lattice ? sb_wall_curvature_factor(s.curvature / s.kernel) : 1));
    }
    for (size_t i = 0; i < set->count; i++) sb_carry(&set->record[i], psi[i]);
    sb_free(psi);
    return 0;
}

int sb_wall_images(sb_wall_set *set, const sb_space *space, uint32_t mark)
{
    sb_record image[SB_IMAGES_MAX];
    const size_t own = set->count;
    size_t all = own;
    for (size_t i = 0; i < own; i++) all += (size_t)sb_space_images(space, set->record[i], image);
    if (sb_lengthen((void **)&set->record, own, all, sizeof *set->record) != 0 ||
        sb_lengthen((void **)&set->body, own, all, sizeof *set->body) != 0 ||
        sb_lengthen((void **)&set->facing, own, all, sizeof *set->facing) != 0)
        return -1;
    if (set->number && sb_lengthen((void **)&set->number, own, all, sizeof *set->number) != 0) return -1;
    for (size_t i = 0; i < own; i++) {
        int images = sb_space_images(space, set->record[i], image);
        for (int k = 0; k < images; k++) {
            set->record[set->count] = image[k];
            if (set->number) set->number[set->count] = set->number[i] | SB_BOUNDARY_IMAGE;
            set->body[set->count] = set->body[i] | mark;
            set->facing[set->count++] = set->facing[i];
        }
    }
    return 0;
}
