#include "app/commands/preview_marks.h"

#include "render/overlay/labels.h"

#include <math.h>
#include <stdio.h>

static const float body_color[3] = {0.93f, 0.88f, 0.78f}, maker_color[3] = {1.0f, 0.55f, 0.15f},
                   gauge_color[3] = {0.35f, 0.95f, 0.55f}, probe_color[3] = {1.0f, 0.45f, 0.75f},
                   plane_color[3] = {0.75f, 0.60f, 1.0f}, runup_color[3] = {1.0f, 0.88f, 0.30f},
                   sponge_color[3] = {0.45f, 0.75f, 1.0f}, domain_color[3] = {0.78f, 0.83f, 0.88f};

/* What all marks of one picture share. The first failure ends the drawing. */
typedef struct drawing {
    const sb_scene *scene;
    const sb_model *model;
    const sb_view *view;
    sb_image *image;
    sb_labels labels;
    sb_status status;
    sb_error *error;
} drawing;

static void name(drawing *d, sb_vec3 at, const float rgb[3], const char *text)
{
    if (d->status == SB_OK) d->status = sb_labels_add(&d->labels, d->image, d->view, at, rgb, text, d->error);
}

/* Names the kind too: a body and a gauge may have the same name. */
static void name_place(drawing *d, sb_vec3 at, const float rgb[3], const char *kind, const char *text)
{
    char both[2 * SB_NAME_MAX];
    snprintf(both, sizeof both, "%s %s", kind, text);
    name(d, at, rgb, both);
}

static void line(drawing *d, sb_vec3 from, sb_vec3 to, const float rgb[3])
{
    sb_labels_line(d->image, d->view, from, to, rgb);
}

static void mark_domain(drawing *d)
{
    const sb_vec3 a = d->model->min, b = d->model->max;
    const bool flat = d->model->dimensions == 2;
    for (int corner = 0; corner < 8; corner++) {
        const sb_vec3 from = sb_vec(corner & 1 ? b.x : a.x, flat ? 0 : corner & 2 ? b.y : a.y, corner & 4 ? b.z : a.z);
        if (flat && corner & 2) continue;
        if (!(corner & 1)) line(d, from, sb_vec(b.x, from.y, from.z), domain_color);
        if (!(corner & 2) && !flat) line(d, from, sb_vec(from.x, b.y, from.z), domain_color);
        if (!(corner & 4)) line(d, from, sb_vec(from.x, from.y, b.z), domain_color);
    }
}

/* The part of a body's box that is within the domain. False: there is none. */
static bool visible_box(const drawing *d, const sb_model_body *body, sb_vec3 *low, sb_vec3 *high)
{
    const sb_mesh *mesh = &body->mesh;
    if (mesh->vertex_count == 0) return false;
    *low = *high = mesh->vertices[0];
    for (size_t v = 1; v < mesh->vertex_count; v++) {
        *low = sb_min(*low, mesh->vertices[v]);
        *high = sb_max(*high, mesh->vertices[v]);
    }
    *low = sb_max(*low, d->model->min);
    *high = sb_min(*high, d->model->max);
    if (d->model->dimensions == 2) low->y = high->y = 0;
    return low->x <= high->x && low->y <= high->y && low->z <= high->z;
}

/* The highest vertex of a terrain near a corner of the domain, where its name covers little. */
static sb_vec3 ground_place(const drawing *d, const sb_mesh *mesh, sb_vec3 low, sb_vec3 high)
{
    const double x = low.x + 0.1 * (high.x - low.x), y = low.y + 0.12 * (high.y - low.y);
    double least = (double)INFINITY;
    sb_vec3 at = low;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        const double away = hypot(mesh->vertices[v].x - x, mesh->vertices[v].y - y);
        if (!(away < least)) continue;
        least = away;
        at = mesh->vertices[v];
    }
    if (d->model->dimensions == 2) at.y = 0;
    return sb_min(sb_max(at, low), high);
}

static void mark_wavemaker(drawing *d, const sb_model_body *body, sb_vec3 from)
{
    const sb_wavemaker_use *use = &d->scene->wavemakers[body->wavemaker];
    const sb_vec3 size = sb_sub(d->model->max, d->model->min);
    const double length = fmin(0.12 * fmax(size.x, d->model->dimensions == 2 ? 0 : size.y), 0.7 * size.z);
    const sb_vec3 to = sb_madd(from, length, use->direction);
    const sb_vec3 side =
        fabs(use->direction.z) > 0.9 ? sb_vec(1, 0, 0) : sb_vec(-use->direction.y, use->direction.x, 0);
    const sb_vec3 up = sb_vec(0, 0, fabs(use->direction.z) > 0.9 ? 0 : 1);
    char text[2 * SB_NAME_MAX];
    line(d, from, to, maker_color);
    for (int k = -1; k <= 1; k += 2) {
        const sb_vec3 back = sb_madd(to, -0.25 * length, use->direction);
        line(d, to, sb_madd(back, k * 0.12 * length, side), maker_color);
        line(d, to, sb_madd(back, k * 0.12 * length, up), maker_color);
    }
    if (use->law.height > 0)
        snprintf(text, sizeof text, "%s: %s, H = %.3g m", use->name, use->law.kind->name, use->law.height);
    else
        snprintf(text, sizeof text, "%s: %s", use->name, use->law.kind->name);
    name(d, to, maker_color, text);
}

/* The outline of each sponge at the still level, and a line up where it begins. */
static void mark_sponges(drawing *d)
{
    const bool flat = d->model->dimensions == 2;
    for (size_t k = 0; k < d->scene->sponge_count; k++) {
        const sb_sponge *sponge = &d->scene->sponges[k];
        sb_vec3 a = d->model->min, b = d->model->max;
        const double begin = sponge->end + (sponge->side % 2 ? -sponge->length : sponge->length);
        double *const from = sponge->side / 2 == 0 ? &a.x : &a.y, *const to = sponge->side / 2 == 0 ? &b.x : &b.y;
        if (flat) a.y = b.y = 0;
        if (sponge->side % 2)
            *from = fmax(begin, *from);
        else
            *to = fmin(begin, *to);
        a.z = b.z = d->scene->sea.present ? d->scene->sea.level : d->model->max.z;
        line(d, a, sb_vec(b.x, a.y, a.z), sponge_color);
        line(d, sb_vec(a.x, b.y, a.z), b, sponge_color);
        line(d, a, sb_vec(a.x, b.y, a.z), sponge_color);
        line(d, sb_vec(b.x, a.y, a.z), b, sponge_color);
        const sb_vec3 foot = sb_vec(sponge->side / 2 == 0 ? begin : 0.5 * (a.x + b.x),
                                    sponge->side / 2 == 1 ? begin : 0.5 * (a.y + b.y), d->model->min.z);
        line(d, foot, sb_vec(foot.x, foot.y, d->model->max.z), sponge_color);
        name_place(d, sb_vec(foot.x, foot.y, d->model->max.z), sponge_color, "sponge", sponge->name);
    }
}

static void mark_bodies(drawing *d, bool names)
{
    for (size_t b = 0; b < d->model->body_count; b++) {
        const sb_model_body *body = &d->model->bodies[b];
        sb_vec3 low, high;
        if (!visible_box(d, body, &low, &high)) continue;
        const sb_vec3 middle = sb_scale(sb_add(low, high), 0.5);
        const bool ground = body->role == SB_ROLE_TERRAIN;
        if (body->plate > 0) continue;
        if (body->wavemaker >= 0) mark_wavemaker(d, body, middle);
        if (!names) continue;
        name(d, ground ? ground_place(d, &body->mesh, low, high) : sb_vec(middle.x, middle.y, high.z), body_color,
             body->name);
    }
}

static void mark_points(drawing *d)
{
    const sb_measure_settings *measure = &d->scene->measure;
    const double low = d->model->min.z, high = d->model->max.z;
    for (size_t i = 0; i < measure->gauge_count; i++) {
        const sb_gauge *gauge = &measure->gauges[i];
        const sb_vec3 top = sb_vec(gauge->x, gauge->y, low + 0.92 * (high - low));
        line(d, sb_vec(gauge->x, gauge->y, low), top, gauge_color);
        name_place(d, top, gauge_color, "gauge", gauge->name);
    }
    for (size_t i = 0; i < measure->probe_count; i++)
        name_place(d, measure->probes[i].at, probe_color, "probe", measure->probes[i].name);
}

static void mark_planes(drawing *d)
{
    const sb_measure_settings *measure = &d->scene->measure;
    for (size_t i = 0; i < measure->plane_count; i++) {
        const sb_flow_plane *p = &measure->planes[i];
        const sb_vec3 a = sb_vec(p->ax, p->ay, p->z_min), b = sb_vec(p->bx, p->by, p->z_min);
        const sb_vec3 up = sb_vec(0, 0, p->z_max - p->z_min);
        line(d, a, b, plane_color);
        line(d, sb_add(a, up), sb_add(b, up), plane_color);
        line(d, a, sb_add(a, up), plane_color);
        line(d, b, sb_add(b, up), plane_color);
        name_place(d, sb_add(sb_scale(sb_add(a, b), 0.5), up), plane_color, "plane", p->name);
    }
    for (size_t i = 0; i < measure->runup_count; i++) {
        const sb_runup_line *r = &measure->runups[i];
        const double z = d->model->max.z;
        line(d, sb_vec(r->ax, r->ay, z), sb_vec(r->bx, r->by, z), runup_color);
        name_place(d, sb_vec(r->bx, r->by, z), runup_color, "run-up", r->name);
    }
}

sb_status sb_preview_marks(const sb_scene *scene, const sb_model *model, unsigned marks, const sb_view *view,
                           sb_image *image, size_t *left_out, sb_error *error)
{
    drawing d = {.scene = scene, .model = model, .view = view, .image = image, .error = error};
    mark_domain(&d);
    if (marks & SB_MARK_PLACES) mark_sponges(&d);
    if (marks & SB_MARK_PLACES) mark_planes(&d);
    mark_bodies(&d, marks & SB_MARK_BODIES);
    if (marks & SB_MARK_PLACES) mark_points(&d);
    *left_out = d.labels.left_out;
    return d.status;
}

void sb_preview_facets(const sb_model *model, const sb_view *view, sb_image *image)
{
    static const float outline[3] = {0.35f, 0.85f, 0.95f};
    for (size_t f = 0; f < model->facets.count; f++) {
        const sb_facet *facet = &model->facets.facets[f];
        for (uint32_t e = facet->edge; e < facet->edge + facet->edges; e++) {
            const sb_facet_edge *edge = &model->facets.edges[e];
            const sb_vec3 middle = sb_scale(sb_add(edge->from, edge->to), 0.5);
            /* Facets that face away are behind the body. */
            if (model->dimensions == 3 && sb_dot(facet->normal, sb_sub(view->eye, middle)) < 0) continue;
            sb_labels_line(image, view, edge->from, edge->to, outline);
        }
    }
}
