/* Cuts bodies with a plane. */
#include "render/slice/section.h"

#include "base/memory.h"
#include "render/slice/solid.h"

#include <math.h>
#include <stdio.h>

sb_status sb_solids_create(const sb_model *model, sb_solids *solids, sb_error *error)
{
    size_t total = 0;
    for (size_t b = 0; b < model->body_count; b++) total += model->bodies[b].mesh.triangle_count;
    sb_solids made = {.list = sb_alloc(model->body_count, sizeof *made.list),
                      .corners = sb_alloc(total, sizeof *made.corners)};
    if (!made.list || !made.corners) {
        sb_solids_free(&made);
        return sb_fail_memory(error, "the bodies of a slice");
    }
    size_t next = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_mesh *mesh = &model->bodies[b].mesh;
        if (mesh->triangle_count == 0) continue;
        struct sb_solid *solid = &made.list[made.count++];
        *solid = (struct sb_solid){.body = b,
                                   .first = next,
                                   .count = mesh->triangle_count,
                                   .open = mesh->open_surface,
                                   .terrain = model->bodies[b].role == SB_ROLE_TERRAIN};
        snprintf(solid->name, sizeof solid->name, "%s", model->bodies[b].name);
        for (size_t t = 0; t < mesh->triangle_count; t++, next++)
            for (int k = 0; k < 3; k++) made.corners[next][k] = mesh->vertices[mesh->triangles[t][k]];
    }
    *solids = made;
    return SB_OK;
}

void sb_solids_free(sb_solids *solids)
{
    sb_free(solids->list);
    sb_free(solids->corners);
    *solids = (sb_solids){0};
}

/* The point at which an edge passes the plane, from its lower end, so that both triangles of the edge have the same. */
static void pass(const sb_plane *plane, sb_vec3 p, sb_vec3 q, double at_p, double at_q, double out[2])
{
    if (at_p > at_q) {
        const sb_vec3 other = p;
        const double at_other = at_p;
        p = q;
        q = other;
        at_p = at_q;
        at_q = at_other;
    }
    const sb_vec3 at = sb_madd(p, at_p / (at_p - at_q), sb_sub(q, p)), from = sb_sub(at, plane->point);
    out[0] = sb_dot(from, plane->across);
    out[1] = sb_dot(from, plane->over);
}

/* A corner in the plane counts as before it, so that neighbouring triangles agree. */
static bool cut_triangle(const sb_plane *plane, const sb_vec3 corners[3], sb_vec3 moved, sb_section_piece *piece)
{
    sb_vec3 at[3];
    double off[3];
    for (int k = 0; k < 3; k++) {
        at[k] = sb_add(corners[k], moved);
        off[k] = sb_dot(sb_sub(at[k], plane->point), plane->normal);
    }
    int found = 0;
    for (int k = 0; k < 3 && found < 2; k++)
        if ((off[k] >= 0) != (off[(k + 1) % 3] >= 0))
            pass(plane, at[k], at[(k + 1) % 3], off[k], off[(k + 1) % 3], piece->end[found++]);
    if (found < 2) return false;
    /* Along normal x outside, the inside is on the left. */
    const sb_vec3 outside = sb_cross(sb_sub(at[1], at[0]), sb_sub(at[2], at[0]));
    const sb_vec3 along = sb_cross(plane->normal, outside);
    const double a = piece->end[1][0] - piece->end[0][0], b = piece->end[1][1] - piece->end[0][1];
    if (a * sb_dot(along, plane->across) + b * sb_dot(along, plane->over) >= 0) return true;
    for (int k = 0; k < 2; k++) {
        const double other = piece->end[0][k];
        piece->end[0][k] = piece->end[1][k];
        piece->end[1][k] = other;
    }
    return true;
}

sb_status sb_section_cut(sb_section *section, const sb_solids *solids, const sb_plane *plane, const sb_frame *frame,
                         sb_error *error)
{
    section->count = 0;
    if (sb_grow((void **)&section->first, &section->body_capacity, solids->count + 1, sizeof *section->first) != 0)
        return sb_fail_memory(error, "a slice");
    for (size_t s = 0; s < solids->count; s++) {
        const struct sb_solid *solid = &solids->list[s];
        const sb_vec3 moved = sb_frame_displacement(frame, solid->body, solid->name);
        section->first[s] = section->count;
        for (size_t t = solid->first; t < solid->first + solid->count; t++) {
            sb_section_piece piece;
            if (!cut_triangle(plane, solids->corners[t], moved, &piece)) continue;
            if (sb_grow((void **)&section->pieces, &section->capacity, section->count + 1, sizeof piece) != 0)
                return sb_fail_memory(error, "a slice");
            section->pieces[section->count++] = piece;
        }
    }
    section->first[solids->count] = section->count;
    return SB_OK;
}

void sb_section_free(sb_section *section)
{
    sb_free(section->pieces);
    sb_free(section->first);
    *section = (sb_section){0};
}
