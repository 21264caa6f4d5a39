/* The passes of the deviatoric stress correction (sim/terms/stress_correction.h). */
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"
#include "sim/terms/stress_correction.h"

/* A symmetric tensor without trace: xx, yy, xy, xz, yz. */
enum { XX, YY, XY, XZ, YZ, PARTS };

static void strain_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    const int d = sim->constant.dimension;
    const double whole = sim->scene->numerics.stress_correction;
    for (size_t i = group->first; i < group->end; i++) {
        double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            const double factor = -p.slope * sim->space.quantum / (double)sim->constant.rest_density;
            const sb_vec3 x = p.offset;
            xx += factor * x.x * x.x, xy += factor * x.x * x.y, xz += factor * x.x * x.z;
            yy += factor * x.y * x.y, yz += factor * x.y * x.z, zz += factor * x.z * x.z;
        }
        const double mean = (xx + yy + zz) / d, share = (double)sb_stress_share(sim, (float)whole, (float)mean);
        const double off = -share / mean;
        const bool corrected = (sim->needs.images || sim->work.wall_pairs.count[i] == 0) && share > 0;
        sim->work.strain_xx[i] = corrected ? (float)(share + off * xx) : 0;
        sim->work.strain[i] = corrected ? (sb_f4){d == 2 ? 0 : (float)(share + off * yy), (float)(off * xy),
                                                  (float)(off * xz), (float)(off * yz)}
                                        : (sb_f4){0};
    }
}

void sb_plain_strain(sb_sim *sim)
{
    sb_each_group(sim, strain_group, NULL);
}

/* Adds a tensor times a weight: xx is carried by the record, the other parts are in `rest`. */
static void add(const sb_sim *sim, const sb_f4 *rest, uint32_t entry, double weight, double sum[PARTS])
{
    sum[XX] += weight * (double)sb_carried_value(sim->state.position[entry]);
    for (int part = 0; part < 4; part++) sum[YY + part] += weight * (double)rest[entry][part];
}

static void stress_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        double sum[PARTS] = {0}, weights = (double)SB_SLOPE_OWN * (double)sim->work.pairs.unit;
        const double density = (double)sim->work.density[i],
                     q = (double)sim->state.velocity[i][3] / (density * density);
        add(sim, sim->work.strain, (uint32_t)i, weights, sum);
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            add(sim, sim->work.strain, p.other, p.slope, sum);
            weights += p.slope;
        }
        const double factor = q / weights;
        sim->work.stress_xx[i] = (float)(factor * sum[XX]);
        sim->work.stress[i] = (sb_f4){(float)(factor * sum[YY]), (float)(factor * sum[XY]), (float)(factor * sum[XZ]),
                                      (float)(factor * sum[YZ])};
    }
}

void sb_plain_stress(sb_sim *sim)
{
    sb_each_group(sim, stress_group, NULL);
}

static void correct_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    const double dt = sim->state.time_step;
    for (size_t i = group->first; i < group->end; i++) {
        sb_vec3 change = {0};
        for (size_t k = 0; k < sb_pair_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            double s[PARTS] = {0};
            add(sim, sim->work.stress, (uint32_t)i, 1, s);
            add(sim, sim->work.stress, p.other, 1, s);
            const sb_vec3 x = p.offset;
            const sb_vec3 push =
                sb_vec(s[XX] * x.x + s[XY] * x.y + s[XZ] * x.z, s[XY] * x.x + s[YY] * x.y + s[YZ] * x.z,
                       s[XZ] * x.x + s[YZ] * x.y - (s[XX] + s[YY]) * x.z);
            change = sb_madd(change, -dt * p.slope, push);
        }
        sim->work.corrected[i] = sim->state.velocity[i] + (sb_f4){(float)change.x, (float)change.y, (float)change.z, 0};
    }
}

int sb_plain_correct(sb_sim *sim)
{
    sb_each_group(sim, correct_group, NULL);
    return 0;
}
