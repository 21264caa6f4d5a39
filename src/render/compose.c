/* Draws the picture from its parts. */
#include "render/compose.h"

#include <string.h>

enum { COLORS = 256 };

/* What the shader reads, and the place of a pixel. */
static const char inputs[] =
    "in vec2 screen;\n"
    "out vec4 color;\n"
    "uniform sampler2D body_colors, normals, depths, surface, cover, colors, shade, reached, occlusion, deep_colors;\n"
    "uniform vec2 clip, side_min, side_max;\n"
    "uniform float solid, shade_bias, wet, painted, loaded, depth_max, clarity, thickest, sea_level, pixels;\n"
    "ivec2 pixel() { return ivec2(gl_FragCoord.xy); }\n"
    "float depth_at(ivec2 p) { return clip.y / (2.0 * texelFetch(depths, p, 0).x - 1.0 - clip.x); }\n"
    "vec3 ray(ivec2 p) {\n"
    "  vec2 at = (vec2(p) + 0.5) / vec2(textureSize(depths, 0)) * 2.0 - 1.0;\n"
    "  return right * at.x * lens.x + up * at.y * lens.y - back;\n"
    "}\n"
    "#ifdef SHADOWS\n"
    "float sunny(vec3 p, float bias) {\n"
    "  vec3 s = (to_shadow * vec4(p, 1.0)).xyz;\n"
    "  return 1.0 - 0.65 * shading(shade, s.xy, -s.z, bias);\n"
    "}\n"
    "#else\n"
    "float sunny(vec3 p, float bias) { return 1.0; }\n"
    "#endif\n";

/* Covers of a pixel by foam, spray and bubbles, and the depth of its spray. */
static const char foam[] = "#ifdef FOAM\n"
                           "uniform sampler2D foam;\n"
                           "uniform float foaming;\n"
                           "vec4 foam_at(ivec2 p) { return foaming > 0.5 ? texelFetch(foam, p, 0) : vec4(0.0); }\n"
                           "#endif\n";

/* Colour of a body: wet where the water has been, and with the greatest depth. A body that moves has no place where the
   water has been, and colours of loads stay those of their legend: of the kinds in c.a (render/meshes.h), the first
   limit is below bodies that rest, the second below terrain. A wall that looks out of the domain has no water before
   it: the map has that of the cell inside. */
static const char body[] =
    "vec3 albedo_of(ivec2 p, vec3 place, vec3 n) {\n"
    "  vec4 c = texelFetch(body_colors, p, 0);\n"
    "  vec3 albedo = c.rgb * c.rgb;\n"
    "#ifdef REACHED\n"
    "  if (c.a < (loaded > 0.5 ? 0.75 : 0.42)) return albedo;\n"
    "  vec2 out_of_wall = n.xy * (1.5 / (512.0 * ground_frame.z)), front = place.xy + out_of_wall;\n"
    "  bool is_wall = abs(n.z) < 0.5;\n"
    "  if (is_wall && (any(lessThan(front, side_min)) || any(greaterThan(front, side_max)))) return albedo;\n"
    "  vec2 at = (place.xy - ground_frame.xy) * ground_frame.z;\n"
    "  at += n.xy * (1.0 - abs(n.z)) * 1.2 / vec2(textureSize(reached, 0));\n"
    "  float was = above(reached, at, place.z);\n"
    "  if (wet > 0.5) albedo *= mix(vec3(1.0), vec3(0.50, 0.53, 0.58), was);\n"
    "  if (painted > 0.5 && place.z > sea_level) {\n"
    "    float top = texture(reached, at).x, foot = place.z;\n"
    /* A wall shows the depth before it, from its foot or from the still water up. */
    "    if (is_wall)\n"
    "      foot = max(texture(ground_map, (front - ground_frame.xy) * ground_frame.z).x, sea_level);\n"
    "    float t = clamp((top - min(foot, place.z)) / depth_max, 0.0, 1.0);\n"
    "    vec3 paint = texture(deep_colors, vec2(t, 0.5)).rgb;\n"
    "    albedo = mix(albedo, paint * paint, 0.75 * was);\n"
    "  }\n"
    "#endif\n"
    "  return albedo;\n"
    "}\n"
    "vec3 body_at(ivec2 p, vec3 place, float open, bool in_water) {\n"
    "  vec3 n = texelFetch(normals, p, 0).xyz;\n"
    "  return lit(albedo_of(p, place, n), place, n, in_water ? 1.0 : sunny(place, shade_bias), open);\n"
    "}\n"
    "vec3 behind(ivec2 p, vec3 place, float open) {\n"
    "  if (texelFetch(body_colors, p, 0).a < 0.25) {\n"
    /* Ordered dithering hides the bands of a smooth gradient in 8 bits. */
    "    ivec2 q = p & 3;\n"
    "    float noise = float((q.x * 5 + q.y * 11 + (q.x ^ q.y) * 3) & 15) / 16.0 - 0.47;\n"
    "    vec3 c = sqrt(clamp(sky(normalize(ray(p))), 0.0, 1.0)) + noise / 255.0;\n"
    "    return c * c;\n"
    "  }\n"
    "  return hazed(body_at(p, place, open, false), place);\n"
    "}\n";

/* The water reflects the sky by Schlick's formula, and has the colour of the field otherwise. Its reflection is weaker
   than that of real water, so that colours read as values. */
static const char water[] = "vec3 normal_of(vec4 w) {\n"
                            "  vec3 n = vec3(w.zw, sqrt(max(1.0 - dot(w.zw, w.zw), 0.0)));\n"
                            "  return normalize(right * n.x + up * n.y + back * n.z);\n"
                            "}\n"
                            "vec3 water_at(ivec2 p, vec4 w, vec3 bed, float clear, float open) {\n"
                            "  vec3 place = eye + ray(p) * w.x, to_eye = -normalize(ray(p)), n = normal_of(w);\n"
                            "  float shadow = sunny(place, shade_bias);\n"
                            "  vec3 albedo = texture(colors, vec2(w.y, 0.5)).rgb;\n"
                            "#ifdef FOAM\n"
                            "  vec4 froth = foam_at(p);\n"
                            "  vec3 own = mix(albedo * albedo, vec3(0.55, 0.68, 0.72), 0.6 * froth.w);\n"
                            "  own = mix(own, vec3(1.05), froth.x);\n"
                            "  clear *= (1.0 - froth.x) * (1.0 - 0.5 * froth.w);\n"
                            "  vec3 c = mix(0.8 * lit(own, place, n, shadow, open), bed, clear);\n"
                            "#else\n"
                            "  vec3 c = mix(0.8 * lit(albedo * albedo, place, n, shadow, open), bed, clear);\n"
                            "#endif\n"
                            "  float facing = clamp(dot(n, to_eye), 0.0, 1.0);\n"
                            "  float f = 1.0 - facing; f *= f; f *= f * (1.0 - facing);\n"
                            "  vec3 mirrored = reflect(-to_eye, n);\n"
                            "  float spark = pow(max(dot(mirrored, sun), 0.0), 90.0) * shadow;\n"
                            "  mirrored.z = abs(mirrored.z);\n"
                            "#ifdef FOAM\n"
                            "  f *= 1.0 - froth.x;\n"
                            "  spark *= 1.0 - froth.x;\n"
                            "#endif\n"
                            "  c = mix(c, sky(mirrored), 0.02 + 0.34 * f) + spark * vec3(0.30, 0.28, 0.24);\n"
                            "  return hazed(c, place);\n"
                            "}\n";

/* Shallow water transmits the bed's light by exp(-thickness / clarity); refraction moves the bed. Water behind the bed
   has no thickness: the exponential of a negative one overflows, and what has no share of the pixel would make it
   black. */
static const char shallow[] =
    "float clear_of(ivec2 p, vec4 w, vec4 k, float z) {\n"
    "  float path = max(z - w.x, 0.0) * length(ray(p)), thick = k.y > 0.8 * thickest ? path : min(k.y, path);\n"
    "  return solid > 0.5 ? 0.0 : 0.85 * exp(-thick / clarity);\n"
    "}\n"
    "vec3 bed_at(ivec2 p, vec4 w, vec4 k, float z, float open) {\n"
    "  float thick = min(min(k.y, max(z - w.x, 0.0)), clarity);\n"
    "  ivec2 q = clamp(p + ivec2(w.zw * thick * 0.35 * pixels / w.x), ivec2(0), textureSize(depths, 0) - 1);\n"
    "  if (depth_at(q) < w.x || texelFetch(body_colors, q, 0).a < 0.25) q = p;\n"
    "  vec3 n = texelFetch(normals, q, 0).xyz, at = eye + ray(q) * depth_at(q);\n"
    "  vec3 c = texelFetch(body_colors, q, 0).a < 0.25 ? sky(normalize(ray(q)))\n"
    "                                                  : lit(albedo_of(q, at, n), at, n, 1.0, open);\n"
    "  return c * vec3(0.70, 0.90, 0.95);\n"
    "}\n"
    "#ifdef OCCLUSION\n"
    "float open_at() { return texture(occlusion, 0.5 * screen + 0.5).x; }\n"
    "#else\n"
    "float open_at() { return 1.0; }\n"
    "#endif\n"
    "vec4 cover_at(ivec2 p) { return solid > 0.5 ? vec4(1.0, 1e9, 0.0, 0.0) : texelFetch(cover, p, 0); }\n";

/* The shader's branches are not skipped, so that pixels are sorted first: bodies and sky, water through which nothing
   is seen, and mixtures. The kind is the depth from which each pass selects its pixels. */
enum { KIND, BEHIND, WATER, MIXTURE };
static const char *const mains[SB_COMPOSE_PASSES] = {
    [KIND] = "void main() {\n"
             "  ivec2 p = pixel();\n"
             "  vec4 w = texelFetch(surface, p, 0), k = cover_at(p);\n"
             "  float z = depth_at(p), share = w.x > 0.0 && w.x < z ? k.x : 0.0;\n"
             "  bool drops = k.z > 0.004 && k.w < z;\n"
             "#ifdef FOAM\n"
             "  drops = drops || foam_at(p).y > 0.004;\n"
             "#endif\n"
             "  gl_FragDepth = share < 0.004 && !drops ? 0.0\n"
             "               : share > 0.996 && !drops && clear_of(p, w, k, z) < 0.02 ? 0.5 : 1.0;\n"
             "}\n",
    [BEHIND] = "void main() {\n"
               "  ivec2 p = pixel();\n"
               "  color = encoded(behind(p, eye + ray(p) * depth_at(p), open_at()));\n"
               "}\n",
    [WATER] = "void main() {\n"
              "  ivec2 p = pixel();\n"
              "  color = encoded(water_at(p, texelFetch(surface, p, 0), vec3(0.0), 0.0, open_at()));\n"
              "}\n",
    [MIXTURE] = "void main() {\n"
                "  ivec2 p = pixel();\n"
                "  vec4 w = texelFetch(surface, p, 0), k = cover_at(p);\n"
                "  float z = depth_at(p), open = open_at(), share = w.x > 0.0 && w.x < z ? k.x : 0.0;\n"
                "  vec3 c = behind(p, eye + ray(p) * z, open);\n"
                "  w.x = max(w.x, 1e-6);\n"
                "  c = mix(c, water_at(p, w, bed_at(p, w, k, z, open), clear_of(p, w, k, z), open), share);\n"
                "  vec3 drop = texture(colors, vec2(w.y, 0.5)).rgb, place = eye + ray(p) * k.w;\n"
                "  drop = mix(drop * drop, vec3(0.85), 0.15 + 0.5 * w.y);\n"
                "  drop = hazed(lit(drop, place, vec3(0.0, 0.0, 1.0), 1.0, 1.0), place);\n"
                "  c = mix(c, drop, k.w < z ? 0.7 * k.z : 0.0);\n"
                "#ifdef FOAM\n"
                "  vec4 froth = foam_at(p);\n"
                "  vec3 there = eye + ray(p) * froth.z;\n"
                "  c = mix(c, hazed(lit(vec3(0.92), there, vec3(0.0, 0.0, 1.0), 1.0, 1.0), there), froth.y);\n"
                "#endif\n"
                "  color = encoded(c);\n"
                "}\n",
};

static sb_status make_program(int pass, const sb_effects *effects, GLuint *program, sb_error *error)
{
    const char *pieces[] = {effects->foam ? "#define FOAM\n" : "",
                            effects->shadows ? "#define SHADOWS\n" : "",
                            effects->occlusion ? "#define OCCLUSION\n" : "",
                            effects->reached ? "#define REACHED\n" : "",
                            sb_light_source,
                            sb_tops_source,
                            inputs,
                            foam,
                            body,
                            water,
                            shallow,
                            mains[pass]};
    char source[20000];
    size_t length = 0;
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; i++) {
        const size_t more = strlen(pieces[i]);
        if (length + more >= sizeof source) return sb_fail(error, SB_FAILED, "shader picture: too long");
        memcpy(source + length, pieces[i], more + 1);
        length += more;
    }
    return sb_program_create("picture", sb_fullscreen_vertex, NULL, source, program, error);
}

sb_status sb_compose_create(const sb_effects *effects, sb_compose *compose, sb_error *error)
{
    sb_compose made = {0};
    sb_status status = SB_OK;
    for (int pass = 0; pass < SB_COMPOSE_PASSES && status == SB_OK; pass++)
        status = make_program(pass, effects, &made.programs[pass], error);
    if (status != SB_OK) {
        sb_compose_destroy(&made);
        return status;
    }
    sb_gl.GenVertexArrays(1, &made.empty);
    for (int map = 0; map < SB_COLORMAPS; map++) {
        unsigned char texels[COLORS][3];
        for (int i = 0; i < COLORS; i++) {
            float rgb[3];
            sb_colormap(map, i / (COLORS - 1.0), rgb);
            for (int c = 0; c < 3; c++) texels[i][c] = (unsigned char)(255 * rgb[c] + 0.5f);
        }
        made.colors[map] = sb_texture_create(GL_RGB8, COLORS, 1, GL_RGB, GL_UNSIGNED_BYTE, texels, GL_LINEAR);
    }
    *compose = made;
    return SB_OK;
}

void sb_compose_destroy(sb_compose *compose)
{
    sb_gl.DeleteVertexArrays(1, &compose->empty);
    sb_gl.DeleteTextures(SB_COLORMAPS, compose->colors);
    *compose = (sb_compose){0};
}

static void bind_textures(const sb_compose *compose, const sb_parts *parts, GLuint program)
{
    sb_uniform_texture(program, "body_colors", 0, parts->scenery->color);
    sb_uniform_texture(program, "normals", 1, parts->scenery->normal);
    sb_uniform_texture(program, "depths", 2, parts->scenery->depth);
    sb_uniform_texture(program, "surface", 3, parts->water->surface);
    sb_uniform_texture(program, "cover", 6, parts->water->cover);
    sb_uniform_texture(program, "colors", 7, compose->colors[parts->map]);
    sb_uniform_texture(program, "deep_colors", 8, compose->colors[SB_COLORMAP_DEEP]);
    sb_uniform_texture(program, "shade", 9, parts->shade);
    sb_uniform_texture(program, "reached", 10, parts->reached ? parts->reached : parts->shade);
    sb_uniform_texture(program, "occlusion", 11, parts->occlusion ? parts->occlusion->texture[0] : 0);
    if (parts->foam) sb_uniform_texture(program, "foam", 12, parts->foam);
}

/* The domain's sides, m from the light's origin. */
static void bind_sides(const sb_light *light, GLuint program)
{
    const sb_ground *ground = &light->solid;
    const double far = 1e30;
    if (ground->sided) {
        sb_uniform_vec2(program, "side_min", ground->side_min[0] - light->origin.x,
                        ground->side_min[1] - light->origin.y);
        sb_uniform_vec2(program, "side_max", ground->side_max[0] - light->origin.x,
                        ground->side_max[1] - light->origin.y);
    } else {
        sb_uniform_vec2(program, "side_min", -far, -far);
        sb_uniform_vec2(program, "side_max", far, far);
    }
}

static void draw_pass(const sb_compose *compose, const sb_parts *parts, const sb_view *view, int pass, double depth)
{
    const GLuint program = compose->programs[pass];
    const sb_light *light = parts->light;
    sb_gl.UseProgram(program);
    sb_light_bind(light, view, program);
    bind_textures(compose, parts, program);
    bind_sides(light, program);
    sb_uniform_float(program, "depth", 2 * depth - 1);
    sb_uniform_vec2(program, "clip", (double)-view->projection[10], (double)view->projection[14]);
    sb_uniform_float(program, "pixels", parts->scenery->height / (2 * view->tangent));
    sb_uniform_float(program, "solid", parts->water->solid);
    sb_uniform_float(program, "shade_bias", parts->shade_bias);
    sb_uniform_float(program, "foaming", parts->foam != 0);
    sb_uniform_float(program, "wet", parts->wet);
    sb_uniform_float(program, "painted", parts->painted);
    sb_uniform_float(program, "loaded", parts->loaded);
    sb_uniform_float(program, "depth_max", parts->depth_max);
    sb_uniform_float(program, "clarity", sb_compose_clarity(light));
    sb_uniform_float(program, "thickest", parts->thickest);
    sb_uniform_float(program, "sea_level", light->sea_level - light->origin.z);
    sb_fullscreen_draw(compose->empty);
}

static void upload_kinds(const sb_parts *parts)
{
    sb_gl.ActiveTexture(GL_TEXTURE0);
    sb_gl.BindTexture(GL_TEXTURE_2D, parts->kind_depth);
    sb_gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, parts->scenery->width, parts->scenery->height, 0,
                     GL_DEPTH_COMPONENT, GL_FLOAT, parts->kinds);
}

static void find_kinds(const sb_compose *compose, const sb_parts *parts, const sb_view *view)
{
    sb_gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_pass(compose, parts, view, KIND, 0);
    sb_gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void sb_compose_draw(const sb_compose *compose, const sb_parts *parts, const sb_view *view)
{
    sb_gl.Enable(GL_DEPTH_TEST);
    sb_gl.DepthFunc(GL_ALWAYS);
    sb_gl.DepthMask(GL_TRUE);
    if (parts->kinds)
        upload_kinds(parts);
    else
        find_kinds(compose, parts, view);
    sb_gl.DepthMask(GL_FALSE);
    sb_gl.DepthFunc(GL_GREATER);
    draw_pass(compose, parts, view, BEHIND, 0.25);
    sb_gl.DepthFunc(GL_LESS);
    draw_pass(compose, parts, view, WATER, 0.25);
    draw_pass(compose, parts, view, MIXTURE, 0.75);
    sb_gl.DepthMask(GL_TRUE);
}
