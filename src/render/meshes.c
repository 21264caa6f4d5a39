/* Uploads the bodies' meshes and draws their faces, edges and depths. */
#include "render/meshes.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/outline.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* One corner of a triangle. The alpha of its colour is 0 for a plain colour and 255 for the colours of terrain. */
struct corner {
    float position[3];
    signed char normal[4];
    unsigned char color[4];
};

struct part {
    char name[SB_NAME_MAX];
    size_t body; /* index in the model, and so in a frame */
    bool moves, one_sided, terrain;
    float line_alpha;
    GLint first_corner, first_line;
    GLsizei corners, line_ends;
};

struct sb_meshes {
    sb_vec3 origin;
    size_t part_count;
    struct part *parts;
    GLuint face_array, face_buffer, line_array, line_buffer;
    GLuint face_program, depth_program, line_program;
    GLuint speckles; /* a periodic texture of smooth noise, 64 random values on a side */
};

static const double crease = 32; /* degrees */

static const char face_vertex[] = "layout(location = 0) in vec3 position;\n"
                                  "layout(location = 1) in vec3 normal;\n"
                                  "layout(location = 2) in vec4 color;\n"
                                  "uniform mat4 clip;\n"
                                  "uniform vec3 shift;\n"
                                  "uniform vec4 cut;\n" /* places with cut . (place, 1) < 0 are not drawn */
                                  "out vec3 place, slope;\n"
                                  "out vec4 paint;\n"
                                  "void main() {\n"
                                  "  place = position + shift;\n"
                                  "  slope = normal;\n"
                                  "  paint = color;\n"
                                  "  gl_Position = clip * vec4(place, 1.0);\n"
                                  "  gl_ClipDistance[0] = dot(cut, vec4(place, 1.0));\n"
                                  "}\n";

/* The faces' colour and normal; the alpha of the colour is the kind of the body. Light is added by sb_compose_draw.
   Terrain without a colour in the scene: sand around the still-water level, grass above it, rock where it is steep, and
   a coarse noise that gives large slopes a texture. */
static const char face_fragment[] =
    "in vec3 place, slope;\n"
    "in vec4 paint;\n"
    "layout(location = 0) out vec4 color;\n"
    "layout(location = 1) out vec4 facing;\n"
    "uniform vec3 eye;\n"
    "uniform float sea_level, unit, kind;\n"
    "uniform sampler2D speckles;\n"
    "float noise(vec2 p) { return texture(speckles, p / 64.0).x - 0.5; }\n"
    "vec3 ground(vec3 n) {\n"
    "  float speckle = noise(place.xy / unit) + 0.5 * noise(place.yx / (0.31 * unit));\n"
    "  float h = (place.z - sea_level) / unit + 0.15 * speckle;\n"
    "  vec3 c = mix(vec3(0.30, 0.29, 0.24), vec3(0.60, 0.52, 0.37), smoothstep(-0.9, 0.05, h));\n"
    "  c = mix(c, vec3(0.235, 0.30, 0.125), smoothstep(0.75, 1.25, h));\n"
    "  c = mix(c, vec3(0.16, 0.22, 0.09), smoothstep(1.3, 3.0, h));\n"
    "  c = mix(c, vec3(0.34, 0.31, 0.27), smoothstep(0.72, 0.55, n.z));\n"
    "  return c * (1.0 + 0.22 * speckle);\n"
    "}\n"
    "void main() {\n"
    "  vec3 n = normalize(slope);\n"
    "  if (dot(n, eye - place) < 0.0) n = -n;\n"
    "  vec3 albedo = paint.a > 0.5 ? ground(n) : paint.rgb * paint.rgb;\n"
    "  color = vec4(sqrt(clamp(albedo, 0.0, 1.0)), kind);\n"
    "  facing = vec4(n, 0.0);\n"
    "}\n";

static const char line_vertex[] = "layout(location = 0) in vec3 position;\n"
                                  "uniform mat4 view, projection;\n"
                                  "uniform vec3 shift;\n"
                                  "uniform vec4 cut;\n"
                                  "out float depth;\n"
                                  "void main() {\n"
                                  "  vec4 e = view * vec4(position + shift, 1.0);\n"
                                  "  depth = -e.z;\n"
                                  "  e.xyz *= 0.9985;\n" /* in front of the faces it bounds */
                                  "  gl_Position = projection * e;\n"
                                  "  gl_ClipDistance[0] = dot(cut, vec4(position + shift, 1.0));\n"
                                  "}\n";

static const char line_fragment[] = "in float depth;\n"
                                    "out vec4 color;\n"
                                    "uniform float alpha, fade;\n"
                                    "void main() { color = vec4(0.05, 0.07, 0.09, alpha * exp(-depth * fade)); }\n";

static const char depth_fragment[] = "void main() {}\n";

static void paint_of(const sb_model_body *body, unsigned char paint[4])
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
    paint_of(body, paint);
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

static sb_status make_programs(sb_meshes *meshes, sb_error *error)
{
    sb_status status = sb_program_create("faces", face_vertex, NULL, face_fragment, &meshes->face_program, error);
    if (status == SB_OK)
        status = sb_program_create("shadow", face_vertex, NULL, depth_fragment, &meshes->depth_program, error);
    if (status == SB_OK)
        status = sb_program_create("edges", line_vertex, NULL, line_fragment, &meshes->line_program, error);
    return status;
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
    if (status == SB_OK) status = make_programs(made, error);
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
    sb_gl.DeleteTextures(1, &meshes->speckles);
    sb_gl.DeleteProgram(meshes->face_program);
    sb_gl.DeleteProgram(meshes->depth_program);
    sb_gl.DeleteProgram(meshes->line_program);
    sb_free(meshes->parts);
    sb_free(meshes);
}

static void set_shift(GLuint program, const struct part *part, const sb_frame *frame)
{
    float shift[3] = {0, 0, 0};
    if (frame) relative(shift, sb_frame_displacement(frame, part->body, part->name), sb_vec(0, 0, 0));
    sb_uniform_vec3(program, "shift", shift);
}

static void multiply(const float a[16], const float b[16], float out[16])
{
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            float sum = 0;
            for (int k = 0; k < 4; k++) sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
}

void sb_meshes_draw_depth(const sb_meshes *meshes, const float clip[16])
{
    sb_gl.UseProgram(meshes->depth_program);
    sb_uniform_mat4(meshes->depth_program, "clip", clip);
    sb_gl.BindVertexArray(meshes->face_array);
    for (size_t i = 0; i < meshes->part_count; i++) {
        /* One-sided bodies are transparent from behind, so they cast no shadow. */
        if (meshes->parts[i].moves || meshes->parts[i].one_sided) continue;
        set_shift(meshes->depth_program, &meshes->parts[i], NULL);
        sb_gl.DrawArrays(GL_TRIANGLES, meshes->parts[i].first_corner, meshes->parts[i].corners);
    }
}

/* Cuts off what lies before the plane of a slice. */
static void begin_cut(const sb_meshes *meshes, const sb_view *view, GLuint program)
{
    if (!view->cuts) return;
    const sb_vec3 n = view->cut_normal;
    sb_gl.Enable(GL_CLIP_DISTANCE0);
    sb_uniform_vec4(program, "cut", -n.x, -n.y, -n.z, view->cut_at - sb_dot(n, meshes->origin));
}

static void end_cut(const sb_view *view)
{
    if (view->cuts) sb_gl.Disable(GL_CLIP_DISTANCE0);
}

void sb_meshes_draw_faces(const sb_meshes *meshes, const sb_light *light, const sb_view *view, const sb_frame *frame)
{
    GLuint program = meshes->face_program;
    float matrix[16], clip[16];
    sb_view_matrix(view, meshes->origin, matrix);
    multiply(view->projection, matrix, clip);
    sb_gl.UseProgram(program);
    sb_light_bind(light, view, program);
    sb_uniform_mat4(program, "clip", clip);
    sb_uniform_texture(program, "speckles", 0, meshes->speckles);
    begin_cut(meshes, view, program);
    sb_uniform_float(program, "sea_level", light->sea_level - meshes->origin.z);
    /* The height over which terrain changes from sand to grass scales with the scene: 10 m at a plant, centimetres in a
       flume. */
    sb_uniform_float(program, "unit", light->size / 175);
    sb_gl.Enable(GL_DEPTH_TEST);
    sb_gl.DepthFunc(GL_LESS);
    sb_gl.CullFace(GL_BACK);
    sb_gl.BindVertexArray(meshes->face_array);
    for (size_t i = 0; i < meshes->part_count; i++) {
        const struct part *part = &meshes->parts[i];
        /* Tanks and walls are transparent from behind, so that the water in them is visible. */
        if (part->one_sided)
            sb_gl.Enable(GL_CULL_FACE);
        else
            sb_gl.Disable(GL_CULL_FACE);
        set_shift(program, part, frame);
        sb_uniform_float(program, "kind", part->terrain ? SB_MESHES_TERRAIN : SB_MESHES_BODY);
        sb_gl.DrawArrays(GL_TRIANGLES, part->first_corner, part->corners);
    }
    sb_gl.Disable(GL_CULL_FACE);
    end_cut(view);
}

void sb_meshes_draw_edges(const sb_meshes *meshes, const sb_view *view, const sb_frame *frame)
{
    GLuint program = meshes->line_program;
    float matrix[16];
    sb_view_matrix(view, meshes->origin, matrix);
    sb_gl.UseProgram(program);
    sb_uniform_mat4(program, "view", matrix);
    sb_uniform_mat4(program, "projection", view->projection);
    sb_uniform_float(program, "fade", 1.2 / view->far);
    begin_cut(meshes, view, program);
    sb_gl.Enable(GL_DEPTH_TEST);
    sb_gl.DepthFunc(GL_LEQUAL);
    sb_gl.DepthMask(GL_FALSE);
    sb_gl.Enable(GL_LINE_SMOOTH);
    sb_gl.Enable(GL_BLEND);
    sb_gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    sb_gl.LineWidth(1.3f);
    sb_gl.BindVertexArray(meshes->line_array);
    for (size_t i = 0; i < meshes->part_count; i++) {
        sb_uniform_float(program, "alpha", (double)meshes->parts[i].line_alpha);
        set_shift(program, &meshes->parts[i], frame);
        sb_gl.DrawArrays(GL_LINES, meshes->parts[i].first_line, meshes->parts[i].line_ends);
    }
    end_cut(view);
    sb_gl.Disable(GL_BLEND);
    sb_gl.Disable(GL_LINE_SMOOTH);
    sb_gl.DepthMask(GL_TRUE);
}
