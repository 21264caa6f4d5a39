/* Interpolates the water to a plane. */
#include "render/slice/plane_field.h"

#include "base/memory.h"

#include <string.h>

static const double range_spacings = 2; /* within which particles count */
static const double nodes_max = 4e6;

struct sb_plane_particle {
    float a, b, off; /* m along the plane's axes and its normal */
    float velocity[2], value;
};

/* Particles near the plane, sorted into square cells with the side of the range. */
struct cells {
    double low[2], range;
    size_t n[2];
};

sb_status sb_plane_field_lay(sb_plane_field *field, const double low[2], const double high[2], double spacing,
                             sb_error *error)
{
    double cell = 0.5 * spacing, total;
    for (;; cell *= 1.25) {
        total = 1;
        for (int k = 0; k < 2; k++) total *= floor(fmax(high[k] - low[k], 0) / cell) + 2;
        if (total <= nodes_max) break;
    }
    field->cell = cell;
    for (int k = 0; k < 2; k++) {
        field->low[k] = low[k];
        field->n[k] = (size_t)floor(fmax(high[k] - low[k], 0) / cell) + 2;
    }
    if (sb_grow((void **)&field->node, &field->node_capacity, (size_t)total, sizeof *field->node) != 0 ||
        sb_grow((void **)&field->solid, &field->solid_capacity, (size_t)total, sizeof *field->solid) != 0)
        return sb_fail_memory(error, "a slice");
    memset(field->solid, 0, (size_t)total * sizeof *field->solid);
    return SB_OK;
}

/* The particle relative to the plane. False: it is too far away, or not finite. */
static bool place(const sb_plane *plane, const sb_frame *frame, const struct cells *cells, size_t i,
                  struct sb_plane_particle *out, size_t *cell)
{
    const float *p = frame->position + 3 * i;
    const sb_vec3 from = sb_sub(sb_add(frame->origin, sb_vec((double)p[0], (double)p[1], (double)p[2])), plane->point);
    const double off = sb_dot(from, plane->normal);
    if (!sb_density_counts(p) || !(fabs(off) < cells->range)) return false;
    const double a = sb_dot(from, plane->across), b = sb_dot(from, plane->over);
    const double column = (a - cells->low[0]) / cells->range, row = (b - cells->low[1]) / cells->range;
    if (!(column >= 0 && row >= 0 && column < (double)cells->n[0] && row < (double)cells->n[1])) return false;
    *cell = (size_t)row * cells->n[0] + (size_t)column;
    *out =
        (struct sb_plane_particle){.a = (float)(a - cells->low[0]), .b = (float)(b - cells->low[1]), .off = (float)off};
    return true;
}

/* Sorts the particles near the plane by cells, each cell in the order of the frame. */
static sb_status sort(sb_plane_field *field, const sb_plane *plane, const sb_frame *frame, const float *values,
                      const struct cells *cells, sb_error *error)
{
    const size_t count = cells->n[0] * cells->n[1];
    struct sb_plane_particle particle;
    size_t cell;
    if (sb_grow((void **)&field->first, &field->first_capacity, count + 2, sizeof *field->first) != 0)
        return sb_fail_memory(error, "a slice");
    memset(field->first, 0, (count + 2) * sizeof *field->first);
    for (size_t i = 0; i < frame->count; i++)
        if (place(plane, frame, cells, i, &particle, &cell)) field->first[cell + 2]++;
    for (size_t c = 2; c < count + 2; c++) field->first[c] += field->first[c - 1];
    if (sb_grow((void **)&field->near, &field->near_capacity, field->first[count + 1], sizeof *field->near) != 0)
        return sb_fail_memory(error, "a slice");
    for (size_t i = 0; i < frame->count; i++) {
        if (!place(plane, frame, cells, i, &particle, &cell)) continue;
        const float *v = frame->velocity + 3 * i;
        const sb_vec3 velocity = sb_vec((double)v[0], (double)v[1], (double)v[2]);
        particle.velocity[0] = (float)sb_dot(velocity, plane->across);
        particle.velocity[1] = (float)sb_dot(velocity, plane->over);
        particle.value = values[i];
        field->near[field->first[cell + 1]++] = particle;
    }
    return SB_OK;
}

/* Weighted sums over the particles around a node: weight, offset, products of offsets, and for each of the three fields
   its value and its products with the offset. Offsets are in units of the range. */
struct sums {
    float weight, offset[3], square[6], field[3], product[3][3];
};

static void add(struct sums *s, const struct sb_plane_particle *p, float a, float b, float inverse)
{
    const float x[3] = {(p->a - a) * inverse, (p->b - b) * inverse, p->off * inverse};
    const float near = 1 - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    if (!(near > 0)) return;
    const float w = near * near * near, f[3] = {p->velocity[0], p->velocity[1], p->value};
    s->weight += w;
    for (int k = 0; k < 3; k++) {
        s->offset[k] += w * x[k];
        s->field[k] += w * f[k];
        for (int j = 0; j < 3; j++) s->product[k][j] += w * f[k] * x[j];
    }
    static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; k++) s->square[k] += w * x[row[k]] * x[column[k]];
}

/* Finds c = M^-1 m for the covariance M of the offsets with the mean m. The mean of a field minus c . covariance(field,
   offset) is then the linear fit's value at the node. A small diagonal keeps directions without particles out. */
static void solve(const struct sums *s, double c[3])
{
    double m[3], q[6], cofactor[6];
    for (int k = 0; k < 3; k++) m[k] = (double)s->offset[k] / (double)s->weight;
    for (int k = 0; k < 6; k++) q[k] = (double)s->square[k] / (double)s->weight;
    for (int k = 0; k < 3; k++) q[k] += 1e-6 - m[k] * m[k];
    q[3] -= m[0] * m[1];
    q[4] -= m[0] * m[2];
    q[5] -= m[1] * m[2];
    cofactor[0] = q[1] * q[2] - q[5] * q[5];
    cofactor[1] = q[0] * q[2] - q[4] * q[4];
    cofactor[2] = q[0] * q[1] - q[3] * q[3];
    cofactor[3] = q[4] * q[5] - q[3] * q[2];
    cofactor[4] = q[3] * q[5] - q[4] * q[1];
    cofactor[5] = q[3] * q[4] - q[5] * q[0];
    const double determinant = q[0] * cofactor[0] + q[3] * cofactor[3] + q[4] * cofactor[4];
    const double scale = determinant > 0 ? 1 / determinant : 0;
    c[0] = scale * (cofactor[0] * m[0] + cofactor[3] * m[1] + cofactor[4] * m[2]);
    c[1] = scale * (cofactor[3] * m[0] + cofactor[1] * m[1] + cofactor[5] * m[2]);
    c[2] = scale * (cofactor[4] * m[0] + cofactor[5] * m[1] + cofactor[2] * m[2]);
}

static float ramp(float low, float high, float x)
{
    const float t = (x - low) / (high - low), s = t < 0 ? 0 : t > 1 ? 1 : t;
    return s * s * (3 - 2 * s);
}

/* full: the sum of weights within water. */
static void evaluate(const struct sums *s, float full, sb_plane_sample *out)
{
    float value[3];
    double c[3];
    if (!(s->weight > 1e-5f)) {
        out->velocity[0] = out->velocity[1] = NAN;
        out->value = 0;
        return;
    }
    const double fitted = (double)ramp(0.06f, 0.12f, s->weight / full);
    solve(s, c);
    for (int k = 0; k < 3; k++) {
        const double mean = (double)(s->field[k] / s->weight);
        double change = 0;
        for (int j = 0; j < 3; j++)
            change += c[j] * ((double)(s->product[k][j] / s->weight) - mean * (double)(s->offset[j] / s->weight));
        value[k] = (float)(mean - fitted * change);
    }
    out->velocity[0] = value[0];
    out->velocity[1] = value[1];
    out->value = value[2] > 0 ? value[2] < 1 ? value[2] : 1 : 0;
}

static void gather(const sb_plane_field *field, const struct cells *cells, double a, double b, float full,
                   sb_plane_sample *out)
{
    const double column = (a - cells->low[0]) / cells->range, row = (b - cells->low[1]) / cells->range;
    const size_t i = (size_t)column, j = (size_t)row; /* at least 1: the cells begin a range before the grid */
    const float x = (float)(a - cells->low[0]), y = (float)(b - cells->low[1]), inverse = (float)(1 / cells->range);
    struct sums sums = {0};
    for (size_t r = j - 1; r <= j + 1 && r < cells->n[1]; r++) {
        const size_t *first = field->first + r * cells->n[0];
        const size_t end = i + 2 < cells->n[0] ? i + 2 : cells->n[0];
        for (size_t k = first[i - 1]; k < first[end]; k++) add(&sums, &field->near[k], x, y, inverse);
    }
    evaluate(&sums, full, out);
}

/* The density ends at the domain's sides and floor, beyond which the grid of the density continues it: it is limited by
   a ramp as wide as a cell of the field, so that interpolation between its nodes places the end there. */
static float density_at(const sb_density *density, const sb_frame *frame, const sb_plane *plane, double a, double b,
                        double cell)
{
    const sb_vec3 at = sb_sub(sb_plane_at(plane, a, b), frame->origin);
    const float p[3] = {(float)at.x, (float)at.y, (float)at.z};
    float share = density->sided ? (p[2] - density->floor) / (float)cell + 0.5f : 1;
    for (int k = 0; k < 2 && density->sided; k++) {
        const float inside = fminf(p[k] - density->side_min[k], density->side_max[k] - p[k]);
        share = fminf(share, inside / (float)cell + 0.5f);
    }
    const float here = sb_density_at(density, p[0], p[1], p[2]);
    return share >= 1 ? here : fminf(here, share > 0 ? share : 0);
}

/* Moves a place of the plane half a spacing into the domain. The particles beside a side or the floor lie in one row
   there, from which the field cannot be continued outwards. */
static void keep_within(const sb_density *density, const sb_frame *frame, const sb_plane *plane, double *a, double *b)
{
    const double half = 0.5 * frame->spacing;
    const sb_vec3 at = sb_sub(sb_plane_at(plane, *a, *b), frame->origin);
    sb_vec3 inside = at;
    if (!density->sided) return;
    inside.x = fmin(fmax(at.x, (double)density->side_min[0] + half), (double)density->side_max[0] - half);
    inside.y = fmin(fmax(at.y, (double)density->side_min[1] + half), (double)density->side_max[1] - half);
    inside.z = fmax(at.z, (double)density->floor + half);
    const sb_vec3 moved = sb_sub(inside, at);
    *a += sb_dot(moved, plane->across);
    *b += sb_dot(moved, plane->over);
}

sb_status sb_plane_field_fill(sb_plane_field *field, const sb_plane *plane, const sb_frame *frame, const float *values,
                              const sb_density *density, int threads, sb_error *error)
{
    struct cells cells = {.range = range_spacings * frame->spacing};
    for (int k = 0; k < 2; k++) {
        cells.low[k] = field->low[k] - 1.5 * cells.range;
        cells.n[k] = (size_t)((double)field->n[k] * field->cell / cells.range) + 4;
    }
    sb_status status = sort(field, plane, frame, values, &cells, error);
    if (status != SB_OK) return status;
    /* The integral of (1 - q^2)^3 over the ball, or over the disc of a scene of two dimensions, per particle. */
    const double r = range_spacings, pi = 3.14159265358979323846;
    const float full = (float)(density->slice ? pi / 4 * r * r : 64 * pi / 315 * r * r * r);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 8)
    for (size_t j = 0; j < field->n[1]; j++)
        for (size_t i = 0; i < field->n[0]; i++) {
            const double a = field->low[0] + (double)i * field->cell, b = field->low[1] + (double)j * field->cell;
            const size_t at = j * field->n[0] + i;
            sb_plane_sample *node = &field->node[at];
            *node = (sb_plane_sample){.velocity = {NAN, NAN},
                                      .density = density_at(density, frame, plane, a, b, field->cell)};
            node->solid = field->solid[at];
            if (!(node->density > 0.1f)) continue;
            double inner[2] = {a, b};
            keep_within(density, frame, plane, &inner[0], &inner[1]);
            gather(field, &cells, inner[0], inner[1], full, node);
        }
    return SB_OK;
}

sb_plane_sample sb_plane_field_at(const sb_plane_field *field, double a, double b)
{
    const double x = (a - field->low[0]) / field->cell, y = (b - field->low[1]) / field->cell;
    sb_plane_sample sample = {.velocity = {NAN, NAN}};
    if (field->n[0] < 2 || field->n[1] < 2 || !(x >= 0 && y >= 0)) return sample;
    if (x > (double)(field->n[0] - 1) || y > (double)(field->n[1] - 1)) return sample;
    const size_t i = x < (double)(field->n[0] - 1) ? (size_t)x : field->n[0] - 2;
    const size_t j = y < (double)(field->n[1] - 1) ? (size_t)y : field->n[1] - 2;
    const float s = (float)(x - (double)i), t = (float)(y - (double)j);
    float known = 0, velocity[2] = {0, 0}, value = 0;
    for (size_t c = 0; c < 4; c++) {
        const sb_plane_sample *node = &field->node[(j + c / 2) * field->n[0] + i + c % 2];
        const float w = (c % 2 ? s : 1 - s) * (c / 2 ? t : 1 - t);
        sample.density += w * node->density;
        sample.solid += w * node->solid;
        if (!(node->velocity[0] == node->velocity[0])) continue; /* NaN */
        known += w;
        velocity[0] += w * node->velocity[0];
        velocity[1] += w * node->velocity[1];
        value += w * node->value;
    }
    if (!(known > 0)) {
        sample.density = 0;
        return sample;
    }
    sample.velocity[0] = velocity[0] / known;
    sample.velocity[1] = velocity[1] / known;
    sample.value = value / known;
    return sample;
}

void sb_plane_field_free(sb_plane_field *field)
{
    sb_free(field->node);
    sb_free(field->near);
    sb_free(field->first);
    sb_free(field->solid);
    *field = (sb_plane_field){0};
}
