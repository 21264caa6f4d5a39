/* Draws the bodies' faces, edges and depths. */
#include "render/bodies/meshes.h"

#include "render/bodies/meshes_parts.h"

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
                                    "uniform float alpha, fade, solid;\n"
                                    "uniform vec2 clip;\n"
                                    "uniform sampler2D surface, cover;\n"
                                    "void main() {\n"
                                    "  ivec2 p = ivec2(gl_FragCoord.xy);\n"
                                    "  float w = texelFetch(surface, p, 0).x;\n"
                                    "  bool wet = w > 0.0 && (solid > 0.5 || texelFetch(cover, p, 0).x > 0.5);\n"
                                    "  if (wet && gl_FragCoord.z > 0.5 + 0.5 * (clip.x + clip.y / w)) discard;\n"
                                    "  color = vec4(0.05, 0.07, 0.09, alpha * exp(-depth * fade));\n"
                                    "}\n";

static const char depth_fragment[] = "void main() {}\n";

sb_status sb_meshes_make_programs(sb_meshes *meshes, sb_error *error)
{
    sb_status status = sb_program_create("faces", face_vertex, NULL, face_fragment, &meshes->face_program, error);
    if (status == SB_OK)
        status = sb_program_create("shadow", face_vertex, NULL, depth_fragment, &meshes->depth_program, error);
    if (status == SB_OK)
        status = sb_program_create("edges", line_vertex, NULL, line_fragment, &meshes->line_program, error);
    return status;
}

static void set_shift(GLuint program, const struct part *part, const sb_frame *frame)
{
    sb_vec3 moved = sb_vec(0, 0, 0);
    if (frame) moved = sb_frame_displacement(frame, part->body, part->name);
    const float shift[3] = {(float)moved.x, (float)moved.y, (float)moved.z};
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
        sb_uniform_float(program, "kind",
                         part->moves     ? SB_MESHES_MOVING
                         : part->terrain ? SB_MESHES_TERRAIN
                                         : SB_MESHES_BODY);
        sb_gl.DrawArrays(GL_TRIANGLES, part->first_corner, part->corners);
    }
    sb_gl.Disable(GL_CULL_FACE);
    end_cut(view);
}

void sb_meshes_draw_edges(const sb_meshes *meshes, const sb_view *view, const sb_frame *frame,
                          const sb_edge_water *water)
{
    GLuint program = meshes->line_program;
    float matrix[16];
    sb_view_matrix(view, meshes->origin, matrix);
    sb_gl.UseProgram(program);
    sb_uniform_mat4(program, "view", matrix);
    sb_uniform_mat4(program, "projection", view->projection);
    sb_uniform_float(program, "fade", 1.2 / view->far);
    sb_uniform_float(program, "solid", water->solid);
    sb_uniform_vec2(program, "clip", (double)-view->projection[10], (double)view->projection[14]);
    sb_uniform_texture(program, "surface", 0, water->surface);
    sb_uniform_texture(program, "cover", 1, water->cover);
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
