/* Warns of gaps that walls do not resolve: two surfaces that face each other across a place where water can be, and are
   too close for the water between them. The pressure in such a gap is wrong or missing, so the forces on both bodies
   are unreliable. */
#include "base/memory.h"
#include "geometry/model/walls.h"

#include <stdio.h>

/* In spacings: narrower gaps count as contact. A ray starts SKIN before the surface. */
static const double CONTACT = 0.05, SKIN = 1e-3;

/* Cosine between two normals of surfaces that face each other. */
static const double FACING = -0.9;

/* Fraction of a face beside gaps from which its body's force counts as affected: the accuracy of a face's load beside
   wider gaps. */
static const double SHARE = 0.03;

/* Cosine from which a moving body approaches along the gap: its width at t = 0 does not matter. */
static const double ALONG = 0.5;

/* A body's particles are counted in six faces, by the axis and sign nearest to their normal. */
enum { FACES = 6, WARNINGS_MAX = 8 };

/* A body, or an image of it beyond a periodic side, near the body whose gaps are searched. */
typedef struct other {
    size_t body;
    sb_vec3 shift; /* m, of the ray, from the image to the body itself */
} other;

/* What the ray of one boundary particle meets. */
typedef struct hit {
    double width; /* m; INFINITY: no gap */
    size_t body;
} hit;

/* The gaps between two bodies. */
typedef struct pair {
    double width; /* m, the narrowest; INFINITY: none */
    sb_vec3 place;
    uint64_t found[FACES]; /* particles of the first body's faces */
} pair;

/* The same on its way between ranks, with the index of the pair. */
typedef struct message {
    uint64_t index;
    pair found;
} message;

typedef struct search {
    const sb_scene *scene;
    const sb_model_space *space;
    sb_model *model;
    bool first;         /* of ranks that have parts of the boundary particles, this is rank 0 */
    double limit;       /* m */
    sb_vec3 *min, *max; /* m, extent of each body's surface */
    other *near;
    size_t near_count;
    hit *hits;        /* per boundary particle of the present body */
    pair *pairs;      /* bodies x bodies: gaps that rays of the first body found */
    uint64_t *totals; /* FACES per body */
} search;

/* Moves a coordinate across a periodic side into the domain. Returns false if it is outside of a domain that does not
   repeat. */
static bool into_domain(double *x, double min, double max, bool repeats)
{
    if (repeats) *x -= (max - min) * floor((*x - min) / (max - min));
    return repeats || (*x > min && *x < max);
}

/* Whether water can be at the point: inside the domain and outside of all bodies. */
static bool is_open(const search *s, sb_vec3 at)
{
    const sb_model *model = s->model;
    if (!into_domain(&at.x, model->min.x, model->max.x, sb_scene_repeats(s->scene, 0)) ||
        !into_domain(&at.z, model->min.z, model->max.z, false) ||
        (model->dimensions == 3 && !into_domain(&at.y, model->min.y, model->max.y, sb_scene_repeats(s->scene, 1))))
        return false;
    for (size_t b = 0; b < s->space->count; b++)
        if (s->space->solid[b] && model->bodies[b].mesh.triangle_count > 0 && sb_solid_contains(s->space->solid[b], at))
            return false;
    return true;
}

/* Whether the gap between two bodies changes its width as one of them moves. */
static bool moves_along(const search *s, size_t a, size_t b, sb_vec3 normal)
{
    const int of[2] = {s->model->bodies[a].wavemaker, s->model->bodies[b].wavemaker};
    if (of[0] == of[1]) return false;
    for (int k = 0; k < 2; k++)
        if (of[k] >= 0 && fabs(sb_dot(s->scene->wavemakers[of[k]].direction, normal)) > ALONG) return true;
    return false;
}

/* Casts a ray from the face of a body into the water. */
static hit cast(const search *s, size_t body, size_t particle)
{
    const double skin = SKIN * s->model->spacing, offset = s->scene->numerics.wall_offset * s->model->spacing;
    const sb_vec3 normal = s->model->wall_normal[particle];
    const sb_vec3 from = sb_madd(s->model->wall_position[particle], offset + skin, normal);
    const hit none = {(double)INFINITY, SIZE_MAX};
    hit nearest = none;
    sb_vec3 meets = normal;
    for (size_t k = 0; k < s->near_count; k++) {
        const other *o = &s->near[k];
        const sb_vec3 start = sb_add(from, o->shift);
        const double way = sb_solid_raycast(s->space->solid[o->body], start, normal, s->limit);
        if (!(way > 0 && way + skin < nearest.width)) continue;
        nearest = (hit){way + skin, o->body};
        sb_solid_distance(s->space->solid[o->body], sb_madd(start, way, normal), skin, NULL, &meets);
    }
    if (!(nearest.width < s->limit * (1 - 1e-6)) || nearest.width < CONTACT * s->model->spacing ||
        sb_dot(meets, normal) > FACING || moves_along(s, body, nearest.body, normal))
        return none;
    return is_open(s, sb_madd(from, 0.5 * nearest.width - skin, normal)) ? nearest : none;
}

/* Collects the bodies, and images of them, that rays of a body can meet. */
static int find_near(search *s, size_t body, size_t *capacity)
{
    const sb_model *model = s->model;
    const sb_vec3 more = sb_vec(s->limit, s->limit, s->limit);
    const sb_vec3 min = sb_sub(s->min[body], more), max = sb_add(s->max[body], more);
    const int along[2] = {sb_scene_repeats(s->scene, 0), sb_scene_repeats(s->scene, 1)};
    s->near_count = 0;
    for (size_t b = 0; b < model->body_count; b++)
        for (int y = -along[1]; s->space->solid[b] && y <= along[1]; y++)
            for (int x = -along[0]; x <= along[0]; x++) {
                const sb_vec3 shift = sb_vec(x * (model->max.x - model->min.x), y * (model->max.y - model->min.y), 0);
                const sb_vec3 low = sb_add(min, shift), high = sb_add(max, shift);
                if (low.x > s->max[b].x || low.y > s->max[b].y || low.z > s->max[b].z || high.x < s->min[b].x ||
                    high.y < s->min[b].y || high.z < s->min[b].z)
                    continue;
                if (sb_grow((void **)&s->near, capacity, s->near_count + 1, sizeof *s->near) != 0) return -1;
                s->near[s->near_count++] = (other){b, shift};
            }
    return 0;
}

/* Whether this rank searches from a particle. Each has all of moving bodies. */
static bool is_own(const search *s, size_t body, size_t particle)
{
    const sb_model *model = s->model;
    if (!model->walls.divided) return true;
    return model->bodies[body].wavemaker < 0 ? model->walls.of[particle] == SB_WALL_OWN : s->first;
}

static void search_body(search *s, size_t index)
{
    const sb_model_body *body = &s->model->bodies[index];
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t i = 0; i < body->count; i++)
        if (is_own(s, index, body->begin + i)) s->hits[i] = cast(s, index, body->begin + i);
    for (size_t i = 0; i < body->count; i++) {
        if (!is_own(s, index, body->begin + i)) continue;
        const int face = sb_model_direction_of(s->model->wall_normal[body->begin + i]);
        s->totals[FACES * index + (size_t)face]++;
        if (!isfinite(s->hits[i].width)) continue;
        pair *p = &s->pairs[index * s->model->body_count + s->hits[i].body];
        p->found[face]++;
        if (s->hits[i].width >= p->width) continue;
        const double offset = s->scene->numerics.wall_offset * s->model->spacing;
        p->width = s->hits[i].width;
        p->place = sb_madd(s->model->wall_position[body->begin + i], offset + 0.5 * p->width,
                           s->model->wall_normal[body->begin + i]);
    }
}

static bool affects(const search *s, size_t body, const pair *p)
{
    for (size_t f = 0; f < FACES; f++)
        if (p->found[f] > 0 && (double)p->found[f] >= SHARE * (double)s->totals[FACES * body + f]) return true;
    return false;
}

static sb_status warn(const search *s, size_t a, size_t b, const pair *p, sb_error *error)
{
    const sb_model_body *bodies = s->model->bodies;
    char between[2 * SB_NAME_MAX + 64];
    if (a == b)
        snprintf(between, sizeof between, "body \"%s\": two of its surfaces face each other", bodies[a].name);
    else
        snprintf(between, sizeof between, "bodies \"%s\" and \"%s\" face each other", bodies[a].name, bodies[b].name);
    return sb_model_warn(
        s->model, error,
        "%s across a gap of about %.2g m near (%.4g, %.4g, %.4g), and walls resolve gaps of %.3g m (%g times "
        "the spacing) or more: %s unreliable; expected a closed or a wider gap, or a resolution of %.2g m "
        "or less",
        between, p->width, p->place.x, p->place.y, p->place.z, s->limit, s->limit / s->model->spacing,
        a == b ? "the force on it is" : "the forces on both are", p->width * s->model->spacing / s->limit);
}

static sb_status report(search *s, sb_error *error)
{
    const size_t count = s->model->body_count;
    size_t reported = 0;
    sb_status status = SB_OK;
    for (size_t a = 0; a < count; a++)
        for (size_t b = a; b < count && status == SB_OK; b++) {
            const pair *ab = &s->pairs[a * count + b], *ba = &s->pairs[b * count + a];
            const pair *p = ab->width <= ba->width ? ab : ba;
            if (!affects(s, a, ab) && !affects(s, b, ba)) continue;
            for (int k = 0; k < 2; k++) {
                double *gap = &s->model->bodies[k ? b : a].gap;
                if (*gap == 0 || p->width < *gap) *gap = p->width;
            }
            if (reported++ < WARNINGS_MAX) status = warn(s, a, b, p, error);
        }
    if (reported > WARNINGS_MAX && status == SB_OK)
        status =
            sb_model_warn(s->model, error, "%zu more pairs of bodies face each other across gaps of less than %.3g m",
                          reported - WARNINGS_MAX, s->limit);
    return status;
}

static void find_extents(search *s)
{
    for (size_t b = 0; b < s->model->body_count; b++) {
        const sb_mesh *mesh = s->space->mesh[b];
        for (size_t v = 0; mesh && v < mesh->vertex_count; v++) {
            s->min[b] = v == 0 ? mesh->vertices[v] : sb_min(s->min[b], mesh->vertices[v]);
            s->max[b] = v == 0 ? mesh->vertices[v] : sb_max(s->max[b], mesh->vertices[v]);
        }
    }
}

static int search_all(search *s)
{
    const size_t count = s->model->body_count;
    size_t most = 0, capacity = 0;
    for (size_t b = 0; b < count; b++) most = s->model->bodies[b].count > most ? s->model->bodies[b].count : most;
    s->min = sb_alloc(count, sizeof *s->min);
    s->max = sb_alloc(count, sizeof *s->max);
    s->hits = sb_alloc(most, sizeof *s->hits);
    s->pairs = sb_alloc(count * count, sizeof *s->pairs);
    s->totals = sb_alloc(count * FACES, sizeof *s->totals);
    if (!s->min || !s->max || !s->hits || !s->pairs || !s->totals) return -1;
    for (size_t k = 0; k < count * count; k++) s->pairs[k].width = (double)INFINITY;
    find_extents(s);
    for (size_t b = 0; b < count; b++) {
        if (s->model->bodies[b].count == 0 || !s->space->solid[b]) continue;
        if (find_near(s, b, &capacity) != 0) return -1;
        search_body(s, b);
    }
    return 0;
}

/* ---- several ranks ---- */

/* Lists the pairs of bodies with gaps. Returns 0, or -1 without memory. */
static int list_pairs(const search *s, message **list, size_t *count)
{
    const size_t bodies = s->model->body_count;
    size_t capacity = 0;
    for (size_t k = 0; k < bodies * bodies; k++) {
        if (isinf(s->pairs[k].width)) continue;
        if (sb_grow((void **)list, &capacity, *count + 1, sizeof **list) != 0) return -1;
        (*list)[(*count)++] = (message){k, s->pairs[k]};
    }
    return 0;
}

/* Adds what a rank has found. The ranks are in the order of the particles: of equal gaps the first counts. */
static void add_found(search *s, const message *one)
{
    pair *p = &s->pairs[one->index];
    for (int f = 0; f < FACES; f++) p->found[f] += one->found.found[f];
    if (one->found.width >= p->width) return;
    p->width = one->found.width;
    p->place = one->found.place;
}

/* Makes the search of this rank that of all. */
static sb_status join(search *s, const sb_model_team *team, sb_status before, sb_error *error)
{
    const size_t bodies = s->model->body_count;
    message *own = NULL;
    void *all = NULL;
    size_t count = 0, all_count = 0;
    sb_status status = before;
    if (status == SB_OK && list_pairs(s, &own, &count) != 0) status = sb_fail_memory(error, "gaps between bodies");
    status = sb_team_collect(team, status, own, count, sizeof *own, &all, &all_count, error);
    sb_free(own);
    if (status != SB_OK) return status;
    sb_ranks_add(team->ranks, s->totals, bodies * FACES);
    for (size_t k = 0; k < bodies * bodies; k++) s->pairs[k] = (pair){.width = (double)INFINITY};
    for (size_t k = 0; k < all_count; k++) add_found(s, (const message *)all + k);
    sb_free(all);
    return SB_OK;
}

sb_status sb_model_warn_gaps(const sb_scene *scene, const sb_model_team *team, const sb_model_space *space,
                             sb_status before, sb_model *model, sb_error *error)
{
    const double resolved = scene->numerics.walls == SB_WALLS_IMAGES ? SB_GAP_IMAGES : SB_GAP_PARTICLES;
    search s = {.scene = scene, .space = space, .model = model, .limit = resolved * model->spacing};
    s.first = team && sb_ranks_own(team->ranks) == 0;
    sb_status status = before;
    if (status == SB_OK && search_all(&s) != 0) status = sb_fail_memory(error, "gaps between bodies");
    if (team) status = join(&s, team, status, error);
    if (status == SB_OK) status = report(&s, error);
    sb_free(s.min);
    sb_free(s.max);
    sb_free(s.near);
    sb_free(s.hits);
    sb_free(s.pairs);
    sb_free(s.totals);
    return status;
}
