/* The passes of explicit accelerations: eddy viscosity, viscosity and drag. */
#include "sim/passes/reference/pairs.h"
#include "sim/passes/reference/reference.h"
#include "sim/step/settle.h"
#include "sim/terms/turbulence.h"

#include <math.h>

/* Distance (m) from the wall at the nearest boundary particle. */
static double wall_distance(const sb_sim *sim, size_t i)
{
    double nearest = (double)INFINITY, distance = (double)INFINITY;
    sb_one_wall walls[SB_PLAIN_WALLS_MAX];
    const size_t count = sb_plain_walls(sim, i, walls);
    for (const sb_one_wall *wall = walls; wall < walls + count; wall++) {
        const double square = sb_dot(wall->offset, wall->offset);
        if (square >= nearest) continue;
        nearest = square;
        distance = sb_norm(wall->normal) > 0 ? fabs(sb_dot(wall->offset, wall->normal)) : sqrt(square);
    }
    return fmax(distance * sim->space.quantum - sim->scene->numerics.wall_offset * (double)sim->constant.spacing, 0);
}

static double determinant(double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Solves m x = b by Cramer's rule. */
static void solve(double m[3][3], const double b[3], double x[3])
{
    for (int column = 0; column < 3; column++) {
        double with[3][3];
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) with[r][c] = c == column ? b[r] : m[r][c];
        x[column] = determinant(with) / determinant(m);
    }
}

bool sb_plain_gradient(const sb_sim *sim, const sb_indices *around, size_t i, double gradient[3][3])
{
    const bool flat = sim->constant.dimension == 2;
    double place[3][3] = {{0}}, velocity[3][3] = {{0}};
    for (size_t k = 0; k < sb_direct_count(sim, i); k++) {
        const sb_one_pair p = sb_pair_at(sim, around, i, k);
        const sb_f4 v = sim->state.velocity[i] - sim->state.velocity[p.other];
        const double x[3] = {p.offset.x, p.offset.y, p.offset.z};
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                place[a][b] -= p.slope * x[a] * x[b];
                velocity[a][b] -= p.slope * (double)v[a] * x[b];
            }
    }
    const double scale = (place[0][0] + place[1][1] + place[2][2]) / (flat ? 2 : 3);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) place[a][b] = scale > 0 ? place[a][b] / scale : 0;
    if (flat) place[1][1] = 1;
    const bool corrected = determinant(place) > (double)SB_THINNEST;
    for (int a = 0; a < 3; a++) {
        if (corrected) solve(place, velocity[a], gradient[a]);
        for (int b = 0; b < 3; b++)
            gradient[a][b] = corrected ? gradient[a][b] / (scale * sim->space.quantum)
                                       : velocity[a][b] / (double)sim->work.density[i];
    }
    return corrected;
}

/* |S| of particle i in 1/s. */
static double strain_rate(const sb_sim *sim, const sb_indices *around, size_t i)
{
    double gradient[3][3], square = 0;
    sb_plain_gradient(sim, around, i, gradient);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) square += 0.5 * pow(gradient[a][b] + gradient[b][a], 2);
    return sqrt(square);
}

static void eddy_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    const double longest = sim->scene->numerics.smagorinsky * (double)sim->constant.spacing;
    for (size_t i = group->first; i < group->end; i++) {
        const double length = fmin((double)SB_KARMAN * wall_distance(sim, i), longest);
        sim->work.eddy[i] = (float)(length * length * strain_rate(sim, &around, i));
    }
}

sb_status sb_plain_strain_rate(sb_sim *sim, sb_error *error)
{
    (void)error;
    sb_each_group(sim, eddy_group, NULL);
    return SB_OK;
}

/* Shear stress of a smooth wall over rho u^2 [Werner & Wengle 1991]. */
static double wall_law(double reynolds)
{
    return fmax(1 / reynolds, 0.0246 / pow(reynolds, 0.25));
}

sb_vec3 sb_plain_drag(const sb_sim *sim, size_t i, const sb_one_wall *wall, const sb_wall_drag *law)
{
    sb_vec3 all = {0};
    const double approach = sb_dot(wall->velocity, wall->offset);
    if (law->friction > 0 && approach < 0) {
        const double weight =
            (sb_dot(wall->offset, wall->offset) + (double)law->epsilon) * (double)sim->work.density[i];
        all = sb_scale(wall->offset, (double)law->friction * approach * wall->slope / weight);
    }
    const double height = sb_dot(wall->normal, wall->offset);
    const sb_vec3 along = sb_madd(wall->velocity, -sb_dot(wall->normal, wall->velocity), wall->normal);
    const double speed = sb_norm(along);
    if (!law->shear || !(height > 0) || !(speed > 0)) return all;
    const double distance = fmax(height - (double)law->offset, (double)law->nearest) * (double)law->quantum;
    const double stress = wall_law(speed * distance / (double)law->viscosity) * speed / (double)law->rest_density;
    return sb_madd(all, stress * wall->slope * height, along);
}

/* -sum_j m Pi_ij grad W_ij. */
static sb_vec3 viscous_part(const sb_sim *sim, const sb_indices *around, size_t i, const sb_viscous *f)
{
    sb_vec3 sum = {0};
    for (size_t k = 0; k < sb_direct_count(sim, i); k++) {
        const sb_one_pair p = sb_pair_at(sim, around, i, k);
        const sb_vec3 v = sb_sub(sb_vector_of(sim->state.velocity[i]), sb_vector_of(sim->state.velocity[p.other]));
        const double approach = sb_dot(v, p.offset), r2 = sb_dot(p.offset, p.offset);
        const double densities = (double)sim->work.density[i] + (double)sb_carried_value(sim->state.position[p.other]);
        double factor = (double)f->physical + (approach < 0 ? (double)f->artificial : 0);
        if (sim->work.eddy) factor += (double)f->eddy * ((double)sim->work.eddy[i] + (double)sim->work.eddy[p.other]);
        factor *= approach * p.slope * (double)f->inverse_quantum / ((r2 + (double)f->epsilon) * densities);
        sum = sb_madd(sum, factor, p.offset);
    }
    return sum;
}

/* As sb_work.wall_body; with periodic sides never a single body. */
static uint32_t body_of(const sb_sim *sim, const sb_one_wall *walls, size_t count)
{
    if (count == 0) return SB_WALL_NONE;
    const uint32_t first = sb_wall_body(sim, walls[0].entry);
    bool same = !sim->space.repeats;
    for (size_t k = 0; k < count; k++) same = same && sb_wall_body(sim, walls[k].entry) == first;
    return same ? first : SB_WALL_SEVERAL;
}

typedef struct all_terms {
    const sb_viscous *viscous;
    const sb_wall_drag *law;
} all_terms;

static void forces_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const all_terms *terms = arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        sb_vec3 a = sb_vec(0, 0, -(double)sim->constant.gravity), drag = {0};
        if (sim->policy->holds_wave) a.x += (double)sb_settle_wave_acceleration(sim, sim->state.position[i]);
        if (terms->viscous->on) a = sb_add(a, viscous_part(sim, &around, i, terms->viscous));
        if (sim->needs.images) a = sb_add(a, sb_vector_of(sim->work.image_push[i]));
        sb_one_wall walls[SB_PLAIN_WALLS_MAX];
        const size_t count = terms->law->on ? sb_plain_walls(sim, i, walls) : 0;
        for (size_t k = 0; k < count; k++) drag = sb_add(drag, sb_plain_drag(sim, i, &walls[k], terms->law));
        if (count > 0) sim->work.wall_drag[i] = (sb_f4){(float)drag.x, (float)drag.y, (float)drag.z, 0};
        if (sim->work.wall_body) sim->work.wall_body[i] = body_of(sim, walls, count);
        const sb_vec3 change = sb_scale(sb_add(a, drag), sim->state.time_step);
        sim->work.predicted[i] = sim->state.velocity[i] + (sb_f4){(float)change.x, (float)change.y, (float)change.z, 0};
    }
}

sb_status sb_plain_forces(sb_sim *sim, const sb_viscous *viscous, const sb_wall_drag *law, sb_error *error)
{
    (void)error;
    sb_each_group(sim, forces_group, &(all_terms){viscous, law});
    return SB_OK;
}

typedef struct between {
    const sb_f4 *field;
    float factor;
    sb_f4 *out;
} between;

static void differences_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const between *of = arguments;
    sb_indices around;
    sb_indices_of(sim, group, &around);
    for (size_t i = group->first; i < group->end; i++) {
        sb_vec3 sum = {0};
        for (size_t k = 0; k < sb_direct_count(sim, i); k++) {
            const sb_one_pair p = sb_pair_at(sim, &around, i, k);
            const sb_vec3 off = sb_sub(sb_vector_of(of->field[i]), sb_vector_of(of->field[p.other]));
            sum = sb_madd(sum, -p.slope / sim->space.quantum * (double)of->factor, off);
        }
        of->out[i] += (sb_f4){(float)sum.x, (float)sum.y, (float)sum.z, 0};
    }
}

void sb_plain_differences(sb_sim *sim, const sb_f4 *field, float factor, sb_f4 *out)
{
    sb_each_group(sim, differences_group, &(between){field, factor, out});
}
