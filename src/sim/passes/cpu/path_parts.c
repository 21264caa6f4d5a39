#include "sim/passes/cpu/path_parts.h"

SB_MULTIVERSION
uint32_t sb_about_edges(const sb_near *near, const sb_near_facet *f, sb_f4 at, float above, sb_half_angle *angle)
{
    uint32_t edge = f->edge;
    float least = INFINITY;
    for (uint32_t k = 0; k < f->edges; k++) {
        const float inside = sb_within_edge(&near->edges[f->edge + k], at);
        angle[k] = sb_half_angle_of(inside, above);
        if (inside >= least) continue;
        least = inside;
        edge = f->edge + k;
    }
    return edge;
}

/* exp(-t^2) = e */
static float error_function(float t, float e)
{
    const float tail = sb_erf_tail(fabsf(t), e);
    return t < 0 ? tail - 1 : 1 - tail;
}

float sb_past_edge(sb_half_angle i, sb_half_angle j, float sign, float transition, float di[2], float dj[2],
                   bool *before)
{
    const float t = 2 * (i.c * j.c + sign * i.s * j.s) / transition;
    di[0] = di[1] = dj[0] = dj[1] = 0;
    *before &= t >= 0;
    if (t > SB_TRANSITION_ENDS) return 1;
    if (t < -SB_TRANSITION_ENDS) return 0;
    const float e = expf(-t * t), slope = e / (1.7724539f * transition);
    const float to_i = slope / (i.rho + 1e-6f * transition), to_j = slope / (j.rho + 1e-6f * transition);
    di[0] = to_i * (i.c * j.c - sign * i.s * j.s);
    di[1] = to_i * (i.s * j.c + sign * i.c * j.s);
    dj[0] = to_j * (j.c * i.c - sign * j.s * i.s);
    dj[1] = to_j * (j.s * i.c + sign * j.c * i.s);
    return 0.5f + 0.5f * error_function(t, e);
}

static const sb_weight WHOLE = {.value = 1}, NONE = {.value = 0};

SB_MULTIVERSION
sb_weight sb_at_facet(const sb_weigher *w, size_t a, sb_other_end j, bool *meets)
{
    const sb_near_facet *f = &w->near->facet[a];
    const float hi = w->at->above[a], hj = j.above;
    const bool front = f->both ? hi * hj > 0 : hi > 0 && hj > 0;
    if (!front && (f->edges == 0 || (hi < 0 && hj < 0))) return NONE;
    sb_weight all = WHOLE;
    *meets &= front;
    /* One end behind the plane: the path goes round the edge that this end is nearest to, and before the others. */
    const uint32_t round = hi * hj < 0 ? (hi < 0 ? w->at->edge[a] : j.edge) : UINT32_MAX;
    const sb_f4 normal = f->plane * (sb_f4){1, 1, 1, 0};
    for (uint32_t k = 0; k < f->edges && all.value >= SB_WEIGHT_LEAST; k++) {
        const bool before = round != UINT32_MAX && f->edge + k != round;
        const float ti = before && hi < 0 ? -1 : 1, tj = before && hj < 0 ? -1 : 1;
        sb_half_angle one = w->at->angle[f->edge + k], other = j.angle[k];
        one.c *= ti;
        other.c *= tj;
        if (w->near->edges[f->edge + k].bend == SB_BEND_CONCAVE) {
            if (f->edge + k == round || one.c * other.c < one.s * other.s) return NONE;
            continue;
        }
        float di[2], dj[2];
        const float value = sb_past_edge(one, other, -1, w->transition, di, dj, meets);
        if (value == 1) continue;
        const sb_f4 inward = w->near->edges[f->edge + k].inward * (sb_f4){1, 1, 1, 0};
        sb_multiply_weight(&all, value, inward * sb_splat(di[0]) + normal * sb_splat(ti * di[1]),
                           inward * sb_splat(dj[0]) + normal * sb_splat(tj * dj[1]));
    }
    return all.value < SB_WEIGHT_LEAST ? NONE : all;
}
