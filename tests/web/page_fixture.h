/* A synthetic run in a process of its own, and its page in Chromium. SB_SCREENSHOTS=FOLDER keeps pictures of the page.
 */
#ifndef SB_TESTS_WEB_PAGE_FIXTURE_H
#define SB_TESTS_WEB_PAGE_FIXTURE_H

#include "chromium.h"
#include "web_fixture.h"

#include "control/command.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>

enum { PARTICLES = 80000, MANY = 300000 };
#define INTERVAL 0.1 /* s between frames */

/* ---- the synthetic run, in a process of its own ---- */

typedef struct source {
    site site;
    fixture_scene scene;
    bool paused;
    int steps; /* to do although it is paused */
    int64_t commands;
} source;

static source here;

static inline sb_status obey(void *user, const char *json, size_t size, int64_t *id, sb_error *error)
{
    (void)user;
    sb_command command;
    const sb_status status = sb_command_from_json(json, size, &command, error);
    if (status != SB_OK) return status;
    *id = ++here.commands;
    if (strstr(json, "\"pause\""))
        here.paused = true;
    else if (strstr(json, "\"resume\""))
        here.paused = false;
    else if (strstr(json, "\"step\""))
        here.steps = 1;
    else if (strstr(json, "\"checkpoint\""))
        return sb_fail(error, SB_BAD_INPUT, "no such command");
    else { /* the reply is the command; one wave maker is refused */
        sb_reply_message answer = {.id = *id, .refused = strstr(json, "slide")};
        snprintf(answer.text, sizeof answer.text, "%s", json);
        sb_stream_reply(here.site.stream, &answer);
    }
    sb_stream_set_state(here.site.stream, here.paused ? SB_RUN_PAUSED : SB_RUN_RUNNING);
    return SB_OK;
}

/* Water 10 m deep in 400 m x 300 m with a wave that travels in x. */
static inline void fill(sb_frame *frame, double time)
{
    const size_t layers = 5, across = (size_t)sqrt((double)frame->count / (double)layers * 0.75),
                 rest = layers * across;
    frame->spacing = 300.0 / (double)across;
    frame->status.time = time;
    for (size_t i = 0; i < frame->count; i++) {
        const double x = 400 * (double)(i / rest) / ((double)frame->count / (double)rest);
        const double y = 300 * (double)(i / layers % across) / (double)across, part = (double)(i % layers) / 5;
        const double rise = sin(0.05 * x - 2 * time);
        frame->position[3 * i] = (float)x;
        frame->position[3 * i + 1] = (float)y;
        frame->position[3 * i + 2] = (float)(part * (12 + 5 * rise));
        frame->velocity[3 * i] = (float)(4 + 4 * rise);
        frame->velocity[3 * i + 1] = frame->velocity[3 * i + 2] = 0;
        frame->pressure[i] = (float)(9810 * 12 * (1 - part));
        frame->id[i] = (uint32_t)i;
    }
}

/* A house on a quay, instead of the fixture's tetrahedra. */
static inline void build(fixture_scene *f)
{
    fixture_scene_make(f, 3, 2);
    f->scene.domain = (sb_domain){.min = {0, 0, 0}, .max = {400, 300, 60}};
    f->scene.render.speed_max = 8;
    f->cameras[0].keys[0] = (sb_camera_key){.eye = {200, -260, 160}, .target = {200, 150, 0}, .fov = 45};
    f->cameras[1].key_count = 2;
    f->keys[1] = (sb_camera_key){.time = 0, .eye = {-100, 150, 80}, .target = {200, 150, 10}, .fov = 45};
    f->keys[2] = (sb_camera_key){.time = 60, .eye = {500, 150, 80}, .target = {200, 150, 10}, .fov = 45};
    const double boxes[2][6] = {{300, 0, 0, 400, 300, 9}, {330, 120, 9, 360, 180, 40}};
    for (size_t b = 0; b < 2; b++) {
        sb_mesh *mesh = &f->model.bodies[b].mesh;
        sb_mesh_free(mesh);
        assert_int_equal(sb_mesh_alloc(mesh, 8, 12, NULL), SB_OK);
        for (size_t v = 0; v < 8; v++)
            mesh->vertices[v] = sb_vec(boxes[b][v & 1 ? 3 : 0], boxes[b][v & 2 ? 4 : 1], boxes[b][v & 4 ? 5 : 2]);
        static const uint32_t corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
        memcpy(mesh->triangles, corners, sizeof corners);
        for (int k = 0; k < 3; k++) f->model.bodies[b].color[k] = b ? 0.8F : 0.6F;
    }
    snprintf(f->model.bodies[1].name, sizeof f->model.bodies[1].name, "<b>reactor</b>");
}

static inline void publish(sb_frame *frame, double time)
{
    fill(frame, time);
    frame->index++;
    const sb_stream_progress progress = fixture_progress(frame);
    sb_stream_set_progress(here.site.stream, &progress);
    sb_measure_records rows = fixture_rows(&here.scene, time);
    for (size_t k = 0; k < rows.force_count; k++)
        ((sb_force_record *)(uintptr_t)rows.forces)[k].force = sb_vec(1e6 * (1 + sin(time + (double)k)), 1e5, 2e5);
    sb_stream_measure(here.site.stream, &rows);
    fixture_rows_free(&rows);
    sb_stream_publish(here.site.stream, frame);
}

static inline void run_source(int port, size_t particles)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const sb_web_settings settings = {.port = port, .token = TOKEN, .command = obey};
    site_open(&here.site, &settings);
    build(&here.scene);
    sb_error error = {0};
    if (sb_stream_set_scene(here.site.stream, &here.scene.scene, &here.scene.model, &error) != SB_OK) _exit(1);
    sb_frame *frame = fixture_frame(0, 0, particles, 3);
    frame->origin = sb_vec(0, 0, 0);
    for (double time = 0, next = sb_clock();;) {
        if (!here.paused || here.steps > 0) {
            publish(frame, time += INTERVAL);
            here.steps = 0;
        }
        next += INTERVAL;
        while (sb_clock() < next) {
            sb_stream_serve(here.site.stream);
            fixture_drain(here.site.stream);
            site_work(&here.site, 0.01);
        }
    }
}

/* The page is on this port; the process is started again on the same one. */
static inline int free_port(void)
{
    site s;
    site_open(&s, NULL);
    const int port = sb_web_server_port(s.server);
    site_close(&s);
    return port;
}

static inline pid_t start_source(int port, size_t particles)
{
    const pid_t made = fork();
    if (made == 0) run_source(port, particles);
    return made;
}

static inline void stop_source(pid_t process)
{
    kill(process, SIGKILL);
    waitpid(process, NULL, 0);
}

/* ---- the page ---- */

/* The browser of all tests of a program; NULL: Chromium is not there. */
static chromium *browser;

static int start_browser(void **state)
{
    (void)state;
    if (chromium_is_there()) browser = chromium_start(1280, 800);
    return 0;
}

static int stop_browser(void **state)
{
    (void)state;
    if (browser) chromium_stop(browser);
    return 0;
}

static inline void screenshot(const char *name)
{
    const char *folder = getenv("SB_SCREENSHOTS");
    char path[512];
    snprintf(path, sizeof path, "%s/%s.png", folder ? folder : "", name);
    if (folder) chromium_screenshot(browser, path);
}

static inline void open_page(int port)
{
    char url[64];
    snprintf(url, sizeof url, "http://127.0.0.1:%d/", port);
    chromium_open(browser, url);
    chromium_await(browser,
                   "window.shorebreak !== undefined && shorebreak.times.frames > 2 && "
                   "shorebreak.view.scene !== undefined && shorebreak.times.pictures > 2",
                   30);
}

/* Draws the newest frame and returns a number that depends on all pixels, and the share of them that are blue. */
static const char pixels[] =
    "(() => { const v = shorebreak.view, p = v.picture, gl = p.gl; v.draw();"
    " const w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, b = new Uint8Array(4 * w * h);"
    " gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, b); let hash = 7, blue = 0;"
    " for (let i = 0; i < b.length; i += 4) { hash = (hash * 31 + b[i] + 3 * b[i + 1] + 7 * b[i + 2]) >>> 0;"
    " if (b[i + 2] > b[i] + 40) blue++; } return [hash, blue / (w * h)]; })()";

static inline double picture_of(int which)
{
    char expression[1024];
    snprintf(expression, sizeof expression, "%s[%d]", pixels, which);
    return chromium_number(browser, expression);
}

static inline int skip_without_chromium(void)
{
    if (chromium_is_there()) return 0;
    print_message("skipped: /usr/bin/chromium is not there (Debian's package chromium)\n");
    return 1;
}

#define SKIP_WITHOUT_CHROMIUM()                                                                                        \
    do {                                                                                                               \
        (void)state;                                                                                                   \
        if (skip_without_chromium()) skip();                                                                           \
    } while (0)

static inline void click(const char *id)
{
    chromium_press(browser, id);
}

#endif
