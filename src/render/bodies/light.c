/* Computes the shadow map and the ground map, and defines the shaders' light model. */
#include "render/bodies/light.h"

#include "base/memory.h"
#include "render/bodies/meshes.h"

#include <string.h>

enum { SHADOW_SIDE = 2048, GROUND_SIDE = 512 };

/* Unit vector towards the sun. It is high and to the side, so that waves and walls have a bright and a dark face. */
static const float sun[3] = {0.30f, -0.62f, 0.725f};

const char sb_light_source[] = "uniform vec3 eye, sun, ground_frame, right, up, back;\n"
                               "uniform vec2 lens;\n"
                               "uniform sampler2DShadow shadow_map;\n"
                               "uniform sampler2D ground_map;\n"
                               "uniform mat4 to_shadow;\n"
                               "uniform float haze;\n"
                               "vec3 sky(vec3 d) {\n"
                               "  float up = clamp(d.z, 0.0, 1.0), down = clamp(-d.z, 0.0, 1.0);\n"
                               "  vec3 c = mix(vec3(0.72, 0.79, 0.84), vec3(0.12, 0.28, 0.56), 1.0 - exp(-3.5 * up));\n"
                               "  float g = max(dot(d, sun), 0.0); g *= g; g *= g;\n"
                               "  c += g * vec3(0.10, 0.08, 0.05);\n"
                               "  return mix(c, vec3(0.47, 0.53, 0.58), 1.0 - exp(-3.0 * down));\n"
                               "}\n"
                               /* Fraction of the sky that is visible from a point: on the ground the value of the
                                  ground map, on a wall the value of the ground in front of it; it rises to 1 with the
                                  height above that ground. */
                               "float openness(vec3 p, vec3 n) {\n"
                               "  vec2 out_of_wall = n.xy * (1.5 / (512.0 * ground_frame.z));\n"
                               "  vec2 map = texture(ground_map, (p.xy + out_of_wall - ground_frame.xy) * "
                               "ground_frame.z).xy;\n"
                               "  return mix(map.y, 1.0, clamp((p.z - map.x) * 0.03, 0.0, 1.0));\n"
                               "}\n"
                               "#ifdef SHADOWS\n"
                               "float sunlit(vec3 p, vec3 n) {\n"
                               "  vec3 s = (to_shadow * vec4(p + n * (0.002 / ground_frame.z), 1.0)).xyz;\n"
                               "  return texture(shadow_map, s);\n"
                               "}\n"
                               "#else\n"
                               "float sunlit(vec3 p, vec3 n) { return 1.0; }\n"
                               "#endif\n"
                               /* sunny: fraction of the sun that the water lets through; open: fraction of the sky that
                                  near surfaces leave. */
                               "vec3 lit(vec3 albedo, vec3 p, vec3 n, float sunny, float open) {\n"
                               "  float direct = max(dot(n, sun), 0.0);\n"
                               "  if (direct > 0.0) direct *= min(sunlit(p, n), sunny) * mix(1.0, open, 0.35);\n"
                               "  vec3 dome = mix(vec3(0.22, 0.21, 0.19), vec3(0.30, 0.37, 0.47), 0.5 + 0.5 * n.z);\n"
                               "  return albedo * (direct * vec3(1.22, 1.13, 0.98) + openness(p, n) * open * dome);\n"
                               "}\n"
                               "vec3 hazed(vec3 color, vec3 p) {\n"
                               "  return mix(vec3(0.70, 0.77, 0.82), color, exp(-haze * distance(p, eye)));\n"
                               "}\n"
                               "vec4 encoded(vec3 color) { return vec4(sqrt(clamp(color, 0.0, 1.0)), 1.0); }\n";

/* Writes the orthographic clip matrix of a view along -back that encloses the box, which is in m relative to the
   origin. */
static void ortho_clip(sb_vec3 right, sb_vec3 up, sb_vec3 back, sb_vec3 min, sb_vec3 max, float clip[16])
{
    const sb_vec3 axes[3] = {right, up, back};
    memset(clip, 0, 16 * sizeof *clip);
    clip[15] = 1;
    for (int row = 0; row < 3; row++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int corner = 0; corner < 8; corner++) {
            double at = sb_dot(
                axes[row], sb_vec(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z));
            low = at < low ? at : low;
            high = at > high ? at : high;
        }
        double half = 0.505 * (high - low) + 1e-6, middle = 0.5 * (high + low);
        double sign = row == 2 ? -1 : 1;
        clip[row] = (float)(sign * axes[row].x / half);
        clip[4 + row] = (float)(sign * axes[row].y / half);
        clip[8 + row] = (float)(sign * axes[row].z / half);
        clip[12 + row] = (float)(-sign * middle / half);
    }
}

static sb_status draw_depth_map(const sb_meshes *meshes, GLuint texture, int side, const float clip[16],
                                sb_error *error)
{
    GLuint framebuffer;
    sb_gl.GenFramebuffers(1, &framebuffer);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
    sb_gl.DrawBuffer(GL_NONE);
    sb_gl.ReadBuffer(GL_NONE);
    sb_status status = sb_framebuffer_check("shadow", error);
    if (status == SB_OK) {
        sb_gl.Viewport(0, 0, side, side);
        sb_gl.Enable(GL_DEPTH_TEST);
        sb_gl.DepthFunc(GL_LESS);
        sb_gl.DepthMask(GL_TRUE);
        sb_gl.Disable(GL_CULL_FACE);
        sb_gl.ClearDepth(1);
        sb_gl.Clear(GL_DEPTH_BUFFER_BIT);
        sb_gl.Enable(GL_POLYGON_OFFSET_FILL);
        sb_gl.PolygonOffset(1.5f, 2);
        sb_meshes_draw_depth(meshes, clip);
        sb_gl.Disable(GL_POLYGON_OFFSET_FILL);
    }
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    sb_gl.DeleteFramebuffers(1, &framebuffer);
    return status;
}

/* Returns the sine of the largest elevation angle of the surroundings in one direction (dx, dy), seen from a cell. */
static float horizon(const float *height, int n, double cell, int x, int y, int dx, int dy)
{
    double steepest = 0, length = sqrt((double)(dx * dx + dy * dy)) * cell;
    /* The steps grow with the distance, because near walls have the largest effect. */
    for (int step = 1; step <= 24; step += 1 + step / 3) {
        int px = x + step * dx, py = y + step * dy;
        if (px < 0 || py < 0 || px >= n || py >= n) break;
        double rise = (double)(height[py * n + px] - height[y * n + x]);
        double slope = rise / (step * length);
        steepest = slope > steepest ? slope : steepest;
    }
    return (float)(steepest / sqrt(1 + steepest * steepest));
}

void sb_light_openness(const float *height, int n, double cell, float *openness)
{
    static const int directions[12][2] = {{1, 0},  {2, 1},   {1, 2},   {0, 1},  {-1, 2}, {-2, 1},
                                          {-1, 0}, {-2, -1}, {-1, -2}, {0, -1}, {1, -2}, {2, -1}};
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++) {
            float blocked = 0;
            for (int d = 0; d < 12; d++) blocked += horizon(height, n, cell, x, y, directions[d][0], directions[d][1]);
            openness[y * n + x] = 1 - blocked / 12;
        }
}

static void soften(const float *in, int n, float *out)
{
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++) {
            float sum = 0, weight = 0;
            for (int v = y > 0 ? y - 1 : y; v <= y + 1 && v < n; v++)
                for (int u = x > 0 ? x - 1 : x; u <= x + 1 && u < n; u++) {
                    sum += in[v * n + u];
                    weight += 1;
                }
            out[y * n + x] = sum / weight;
        }
}

/* Draws the bodies' heights as seen from above, and computes from them the visible fraction of the sky. */
static sb_status make_ground(const sb_meshes *meshes, sb_vec3 min, sb_vec3 max, sb_light *light, sb_error *error)
{
    enum { N = GROUND_SIDE, CELLS = N * N };
    double side = max.x - min.x > max.y - min.y ? max.x - min.x : max.y - min.y;
    side = side > 0 ? side : 1;
    max.x = min.x + side;
    max.y = min.y + side;
    float clip[16];
    ortho_clip(sb_vec(1, 0, 0), sb_vec(0, 1, 0), sb_vec(0, 0, 1), min, max, clip);
    float *height = sb_alloc(CELLS, sizeof *height);
    float *open = sb_alloc(CELLS, sizeof *open);
    float *map = sb_alloc(CELLS, 2 * sizeof *map);
    GLuint depth = 0;
    sb_status status = SB_OK;
    if (!height || !open || !map) {
        status = sb_fail_memory(error, "the ground map");
        goto done;
    }
    depth = sb_texture_create(GL_DEPTH_COMPONENT32F, N, N, GL_DEPTH_COMPONENT, GL_FLOAT, NULL, GL_NEAREST);
    status = draw_depth_map(meshes, depth, N, clip, error);
    if (status != SB_OK) goto done;
    sb_gl.BindTexture(GL_TEXTURE_2D, depth);
    sb_gl.GetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, height);
    /* clip z = 2 depth - 1 = clip[10] z + clip[14]; where there is no body, this gives the lowest height. */
    for (size_t i = 0; i < CELLS; i++) height[i] = (2 * height[i] - 1 - clip[14]) / clip[10];
    sb_light_openness(height, N, side / N, map);
    soften(map, N, open);
    for (size_t i = 0; i < CELLS; i++) {
        map[2 * i] = height[i];
        map[2 * i + 1] = open[i];
    }
    light->ground = sb_texture_create(GL_RG32F, N, N, GL_RG, GL_FLOAT, map, GL_LINEAR);
    /* ortho_clip adds a margin of one per cent. */
    light->ground_frame[0] = (float)(min.x - 0.005 * side);
    light->ground_frame[1] = (float)(min.y - 0.005 * side);
    light->ground_frame[2] = (float)(1 / (1.01 * side));
    light->solid.side = N;
    light->solid.height = height;
    light->solid.x = min.x - 0.005 * side;
    light->solid.y = min.y - 0.005 * side;
    light->solid.per_cell = N / (1.01 * side);
    height = NULL;
done:
    sb_gl.DeleteTextures(1, &depth);
    sb_free(height);
    sb_free(open);
    sb_free(map);
    return status;
}

static sb_status make_shadow(const sb_meshes *meshes, sb_vec3 min, sb_vec3 max, sb_light *light, sb_error *error)
{
    sb_vec3 back = sb_vec((double)sun[0], (double)sun[1], (double)sun[2]);
    sb_vec3 right = sb_normalize(sb_cross(sb_vec(0, 0, 1), back)), up = sb_cross(back, right);
    float clip[16];
    ortho_clip(right, up, back, min, max, clip);
    light->shadow = sb_texture_create(GL_DEPTH_COMPONENT32F, SHADOW_SIDE, SHADOW_SIDE, GL_DEPTH_COMPONENT, GL_FLOAT,
                                      NULL, GL_LINEAR);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    /* Scales from -1..1 to 0..1. */
    for (int i = 0; i < 16; i++) light->to_shadow[i] = i % 4 == 3 ? clip[i] : 0.5f * clip[i] + (i >= 12 ? 0.5f : 0);
    return draw_depth_map(meshes, light->shadow, SHADOW_SIDE, clip, error);
}

double sb_light_size(sb_vec3 min, sb_vec3 max)
{
    const double size = sb_norm(sb_sub(max, min));
    return size > 0 ? size : 1;
}

sb_status sb_light_create(const sb_meshes *meshes, sb_vec3 origin, sb_vec3 min, sb_vec3 max, double sea_level,
                          sb_light *light, sb_error *error)
{
    sb_light made = {.origin = origin, .sea_level = sea_level, .solid.origin = origin};
    min = sb_sub(min, origin);
    max = sb_sub(max, origin);
    made.size = sb_light_size(min, max);
    sb_status status = make_shadow(meshes, min, max, &made, error);
    if (status == SB_OK) status = make_ground(meshes, min, max, &made, error);
    if (status == SB_OK)
        *light = made;
    else
        sb_light_destroy(&made);
    return status;
}

void sb_light_destroy(sb_light *light)
{
    sb_gl.DeleteTextures(1, &light->shadow);
    sb_gl.DeleteTextures(1, &light->ground);
    sb_free(light->solid.height);
    *light = (sb_light){0};
}

static void set_axis(GLuint program, const char *name, sb_vec3 axis)
{
    const float value[3] = {(float)axis.x, (float)axis.y, (float)axis.z};
    sb_uniform_vec3(program, name, value);
}

void sb_light_bind_rays(const sb_view *view, GLuint program)
{
    set_axis(program, "right", view->right);
    set_axis(program, "up", view->up);
    set_axis(program, "back", view->back);
    sb_uniform_vec2(program, "lens", view->tangent * view->aspect, view->tangent);
}

void sb_light_bind(const sb_light *light, const sb_view *view, GLuint program)
{
    sb_vec3 eye = sb_sub(view->eye, light->origin);
    const float place[3] = {(float)eye.x, (float)eye.y, (float)eye.z};
    sb_uniform_vec3(program, "eye", place);
    sb_uniform_vec3(program, "sun", sun);
    sb_uniform_vec3(program, "ground_frame", light->ground_frame);
    sb_uniform_mat4(program, "to_shadow", light->to_shadow);
    sb_light_bind_rays(view, program);
    sb_uniform_float(program, "haze", 0.13 / light->size);
    sb_uniform_texture(program, "shadow_map", 4, light->shadow);
    sb_uniform_texture(program, "ground_map", 5, light->ground);
}
