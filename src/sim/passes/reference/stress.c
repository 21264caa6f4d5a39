/* The passes of the deviatoric stress correction (sim/terms/stress_correction.h). */
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"
#include "sim/terms/stress_correction.h"

#include <math.h>
#include <string.h>

/* A symmetric tensor without trace: xx, yy, xy, xz, yz. */
enum { XX, YY, XY, XZ, YZ, PARTS };

/* The q of particle i, which its record carries. */
static double unknown_of(const sb_sim *sim, size_t i)
{
    return (double)sb_carried_value(sim->state.position[i]);
}

static void deviator_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    const int d = sim->constant.dimension;
    const double per = sim->space.quantum / (double)sim->constant.rest_density;
    for (size_t i = group->first; i < group->end; i++) {
        double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0, squares = 0;
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            const double factor = per * p.slope * (unknown_of(sim, i) + unknown_of(sim, p.other)) / 2;
            const sb_vec3 x = p.offset;
            xx += factor * x.x * x.x, xy += factor * x.x * x.y, xz += factor * x.x * x.z;
            yy += factor * x.y * x.y, yz += factor * x.y * x.z, zz += factor * x.z * x.z;
            squares -= per * p.slope * sb_dot(x, x);
        }
        const double mean = (xx + yy + zz) / d, t = squares / d;
        const double c = (double)sb_stress_factor(sim, (float)t);
        sim->work.deviator_xx[i] = (float)(c * (xx - mean));
        sim->work.deviator[i] =
            (sb_f4){d == 2 ? 0 : (float)(c * (yy - mean)), (float)(c * xy), (float)(c * xz), (float)(c * yz)};
    }
}

void sb_plain_deviator(sb_sim *sim)
{
    sb_each_group(sim, deviator_group, NULL);
}

/* The tensor of an entry, reflected by a path: xx is carried by the record, the other parts are in `rest`. */
static void tensor_of(const sb_sim *sim, const sb_indices *around, const sb_f4 *rest, uint32_t entry, uint32_t path,
                      double t[3][3])
{
    const double xx = (double)sb_carried_value(sim->state.position[entry]);
    const double yy = (double)rest[entry][0], xy = (double)rest[entry][1], xz = (double)rest[entry][2],
                 yz = (double)rest[entry][3];
    const double plain[3][3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, -xx - yy}};
    const sb_vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double r[3][3]; /* columns: the images of the unit vectors */
    for (int k = 0; k < 3; k++) {
        const sb_vec3 image = sb_image_vector(around, path, unit[k]);
        r[0][k] = image.x, r[1][k] = image.y, r[2][k] = image.z;
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            t[a][b] = 0;
            for (int c = 0; c < 3; c++)
                for (int d = 0; d < 3; d++) t[a][b] += r[a][c] * plain[c][d] * r[b][d];
        }
}

/* Adds a tensor times a weight. */
static void add(const sb_sim *sim, const sb_indices *around, const sb_f4 *rest, uint32_t entry, uint32_t path,
                double weight, double sum[PARTS])
{
    double t[3][3];
    tensor_of(sim, around, rest, entry, path, t);
    sum[XX] += weight * t[0][0];
    sum[YY] += weight * t[1][1];
    sum[XY] += weight * t[0][1];
    sum[XZ] += weight * t[0][2];
    sum[YZ] += weight * t[1][2];
}

static void average_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        double sum[PARTS] = {0}, weights = (double)SB_ROOT_MAX * SB_ROOT_MAX * (double)sim->work.pairs.unit;
        add(sim, &around, sim->work.deviator, (uint32_t)i, 0, weights, sum);
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            add(sim, &around, sim->work.deviator, p.other, p.path, p.slope, sum);
            weights += p.slope;
        }
        sim->work.stress_xx[i] = (float)(sum[XX] / weights);
        sim->work.stress[i] = (sb_f4){(float)(sum[YY] / weights), (float)(sum[XY] / weights),
                                      (float)(sum[XZ] / weights), (float)(sum[YZ] / weights)};
    }
}

void sb_plain_mean_deviator(sb_sim *sim)
{
    sb_each_group(sim, average_group, NULL);
}

/* -m (S_i + S_j) grad W of one pair. */
static sb_vec3 correction(const sb_sim *sim, const sb_indices *around, size_t i, const sb_one_pair *p)
{
    double s[PARTS] = {0};
    add(sim, around, sim->work.stress, (uint32_t)i, 0, 1, s);
    add(sim, around, sim->work.stress, p->other, p->path, 1, s);
    const sb_vec3 x = p->offset;
    return sb_scale(sb_vec(s[XX] * x.x + s[XY] * x.y + s[XZ] * x.z, s[XY] * x.x + s[YY] * x.y + s[YZ] * x.z,
                           s[XZ] * x.x + s[YZ] * x.y - (s[XX] + s[YY]) * x.z),
                    -p->slope);
}

static void correct_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        sb_vec3 sum = {0};
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            sum = sb_add(sum, correction(sim, &around, i, &p));
        }
        const sb_vec3 change = sb_scale(sum, sim->state.time_step);
        sim->work.corrected[i] = sim->state.velocity[i] + (sb_f4){(float)change.x, (float)change.y, (float)change.z, 0};
    }
}

static void strain_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    const int d = sim->constant.dimension;
    for (size_t i = group->first; i < group->end; i++) {
        double g[3][3];
        const double on = sb_plain_gradient(sim, &around, i, g) ? 1 : 0, mean = (g[0][0] + g[1][1] + g[2][2]) / d;
        sim->work.deviator_xx[i] = (float)(on * (g[0][0] - mean));
        sim->work.deviator[i] =
            (sb_f4){d == 2 ? 0 : (float)(on * (g[1][1] - mean)), (float)(on * (g[0][1] + g[1][0]) / 2),
                    (float)(on * (g[0][2] + g[2][0]) / 2), (float)(on * (g[1][2] + g[2][1]) / 2)};
    }
}

void sb_plain_strain(sb_sim *sim)
{
    sb_each_group(sim, strain_group, NULL);
}

/* The force of the correction has the same sums, with S in the place of L. */
static void strained_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        double sum = 0;
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            sum -= sb_dot(correction(sim, &around, i, &p), p.offset) / 2;
        }
        sim->work.strained[i] = (float)(sum * sim->space.quantum);
    }
}

void sb_plain_strained(sb_sim *sim)
{
    sb_each_group(sim, strained_group, NULL);
}

/* The reactions of the walls to the correction by images. */
static void push_walls(sb_sim *sim, const sb_group *group)
{
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
        for (size_t k = sb_direct_count(sim, i); k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            if (p.slope == 0) continue;
            sb_plain_reflect(sim, &around, p.path, at, correction(sim, &around, i, &p), sim->work.stress_force);
        }
    }
}

int sb_plain_correct(sb_sim *sim)
{
    sb_each_group(sim, correct_group, NULL);
    memset(sim->work.stress_force, 0, sim->model->body_count * SB_FORCE_VALUES * sizeof *sim->work.stress_force);
    for (size_t g = 0; g < sim->groups.count; g++) push_walls(sim, &sim->groups.group[g]);
    return 0;
}
