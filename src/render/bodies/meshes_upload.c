/* Uploads the bodies' meshes. */
#include "base/memory.h"
#include "base/random.h"
#include "render/bodies/meshes.h"
#include "render/bodies/meshes_parts.h"
#include "render/bodies/outline.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

static const double crease = 32; /* degrees */

void sb_meshes_paint(const sb_model_body *body, unsigned char paint[4])
{
    static const float concrete[3] = {0.80f, 0.79f, 0.76f}, steel[3] = {0.52f, 0.57f, 0.62f};
    const float *color = body->color;
    paint[3] = 0;
    if (color[0] < 0 || color[1] < 0 || color[2] < 0) {
        paint[3] = body->role == SB_ROLE_TERRAIN ? 255 : 0;
        color = body->wavemaker >= 0 ? steel : concrete;
    }
    for (int i = 0; i < 3; i++) paint[i] = (unsigned char)(255 * (color[i] < 1 ? color[i] : 1) + 0.5f);
}

static void relative(float out[3], sb_vec3 at, sb_vec3 origin)
{
    out[0] = (float)(at.x - origin.x);
    out[1] = (float)(at.y - origin.y);
    out[2] = (float)(at.z - origin.z);
}

/* The vertices of all bodies, collected before they are uploaded to OpenGL. */
struct upload {
    struct corner *corners;
    size_t corner_count, corner_capacity;
    float (*ends)[3];
    size_t end_count, end_capacity;
};

static sb_status gather(const sb_model_body *body, sb_vec3 origin, struct upload *upload, struct part *part,
                        sb_error *error)
{
    const sb_mesh *mesh = &body->mesh;
    sb_outline outline;
    sb_status status = sb_outline_create(mesh, crease, &outline, error);
    if (status != SB_OK) return status;
    size_t corners = upload->corner_count + 3 * mesh->triangle_count;
    size_t ends = upload->end_count + 2 * outline.edge_count;
    if (sb_grow((void **)&upload->corners, &upload->corner_capacity, corners, sizeof *upload->corners) != 0 ||
        sb_grow((void **)&upload->ends, &upload->end_capacity, ends, sizeof *upload->ends) != 0) {
        sb_outline_free(&outline);
        return sb_fail_memory(error, "meshes to draw");
    }
    snprintf(part->name, sizeof part->name, "%s", body->name);
    part->moves = body->wavemaker >= 0;
    part->one_sided = mesh->open_surface && body->role != SB_ROLE_TERRAIN;
    part->terrain = body->role == SB_ROLE_TERRAIN;
    part->line_alpha = body->role == SB_ROLE_TERRAIN ? 0.25f : 0.75f;
    part->first_corner = (GLint)upload->corner_count;
    part->first_line = (GLint)upload->end_count;
    part->corners = (GLsizei)(corners - upload->corner_count);
    part->line_ends = (GLsizei)(ends - upload->end_count);
    unsigned char paint[4];
    sb_meshes_paint(body, paint);
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
        struct corner *corner = &upload->corners[upload->corner_count++];
        relative(corner->position, mesh->vertices[mesh->triangles[i / 3][i % 3]], origin);
        for (int a = 0; a < 3; a++) corner->normal[a] = (signed char)lrintf(127 * outline.normals[i][a]);
        corner->normal[3] = 0;
        memcpy(corner->color, paint, 4);
    }
    for (size_t i = 0; i < 2 * outline.edge_count; i++)
        relative(upload->ends[upload->end_count++], mesh->vertices[outline.edges[i / 2][i % 2]], origin);
    sb_outline_free(&outline);
    return SB_OK;
}

static void send(sb_meshes *meshes, const struct upload *upload)
{
    sb_gl.GenVertexArrays(1, &meshes->face_array);
    sb_gl.GenBuffers(1, &meshes->face_buffer);
    sb_gl.BindVertexArray(meshes->face_array);
    sb_gl.BindBuffer(GL_ARRAY_BUFFER, meshes->face_buffer);
    sb_gl.BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(upload->corner_count * sizeof *upload->corners), upload->corners,
                     GL_STATIC_DRAW);
    const GLsizei stride = sizeof(struct corner);
    sb_attribute(0, 3, GL_FLOAT, GL_FALSE, stride, 0);
    sb_attribute(1, 3, GL_BYTE, GL_TRUE, stride, offsetof(struct corner, normal));
    sb_attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offsetof(struct corner, color));
    for (GLuint i = 0; i < 3; i++) sb_gl.EnableVertexAttribArray(i);
    sb_gl.GenVertexArrays(1, &meshes->line_array);
    sb_gl.GenBuffers(1, &meshes->line_buffer);
    sb_gl.BindVertexArray(meshes->line_array);
    sb_gl.BindBuffer(GL_ARRAY_BUFFER, meshes->line_buffer);
    sb_gl.BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(upload->end_count * sizeof *upload->ends), upload->ends,
                     GL_STATIC_DRAW);
    sb_attribute(0, 3, GL_FLOAT, GL_FALSE, 0, 0);
    sb_gl.BindVertexArray(0);
}

/* Makes a texture of random values on a periodic grid with smooth interpolation between them. */
static sb_status make_speckles(sb_meshes *meshes, sb_error *error)
{
    enum { LATTICE = 64, FINE = 4, SIDE = LATTICE * FINE };
    unsigned char *texels = sb_alloc((size_t)SIDE * SIDE, 1);
    if (!texels) return sb_fail_memory(error, "the ground's pattern");
    for (unsigned y = 0; y < SIDE; y++)
        for (unsigned x = 0; x < SIDE; x++) {
            unsigned i = x / FINE, j = y / FINE, right = (i + 1) % LATTICE;
            unsigned row = j * LATTICE, next = (j + 1) % LATTICE * LATTICE;
            double s = (double)(x % FINE) / FINE, t = (double)(y % FINE) / FINE;
            s *= s * (3 - 2 * s);
            t *= t * (3 - 2 * t);
            double low = (1 - s) * sb_random(7, row + i) + s * sb_random(7, row + right);
            double high = (1 - s) * sb_random(7, next + i) + s * sb_random(7, next + right);
            texels[y * SIDE + x] = (unsigned char)(255 * ((1 - t) * low + t * high) + 0.5);
        }
    meshes->speckles = sb_texture_create(GL_R8, SIDE, SIDE, GL_RED, GL_UNSIGNED_BYTE, texels, GL_LINEAR);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    sb_free(texels);
    return SB_OK;
}

sb_status sb_meshes_create(const sb_model *model, sb_vec3 origin, sb_meshes **meshes, sb_error *error)
{
    struct upload upload = {0};
    sb_meshes *made = sb_alloc(1, sizeof *made);
    sb_status status = SB_OK;
    if (made) made->parts = sb_alloc(model->body_count, sizeof *made->parts);
    if (!made || !made->parts) {
        status = sb_fail_memory(error, "meshes to draw");
        goto done;
    }
    made->origin = origin;
    for (size_t i = 0; i < model->body_count; i++) {
        if (model->bodies[i].mesh.triangle_count == 0) continue;
        struct part *part = &made->parts[made->part_count];
        part->body = i;
        status = gather(&model->bodies[i], origin, &upload, part, error);
        if (status != SB_OK) goto done;
        made->part_count++;
    }
    send(made, &upload);
    status = make_speckles(made, error);
    if (status == SB_OK) status = sb_meshes_make_programs(made, error);
    if (status != SB_OK) goto done;
    *meshes = made;
    made = NULL;
done:
    sb_free(upload.corners);
    sb_free(upload.ends);
    sb_meshes_destroy(made);
    return status;
}

void sb_meshes_destroy(sb_meshes *meshes)
{
    if (!meshes) return;
    sb_gl.DeleteVertexArrays(1, &meshes->face_array);
    sb_gl.DeleteVertexArrays(1, &meshes->line_array);
    sb_gl.DeleteBuffers(1, &meshes->face_buffer);
    sb_gl.DeleteBuffers(1, &meshes->line_buffer);
    sb_gl.DeleteBuffers(1, &meshes->color_buffer);
    sb_gl.DeleteTextures(1, &meshes->speckles);
    sb_free(meshes->parts);
    sb_free(meshes);
}

void sb_meshes_recolor(sb_meshes *meshes, const unsigned char *colors, size_t corners)
{
    if (meshes->color_buffer == 0) sb_gl.GenBuffers(1, &meshes->color_buffer);
    sb_gl.BindVertexArray(meshes->face_array);
    sb_gl.BindBuffer(GL_ARRAY_BUFFER, meshes->color_buffer);
    sb_gl.BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(4 * corners), colors, GL_STREAM_DRAW);
    sb_attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, 0);
    sb_gl.BindVertexArray(0);
}
