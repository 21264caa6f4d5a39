/* The answers of the web server, as docs/live.md describes them. */
#include "web_fixture.h"

#include "output/json_check.h"
#include "stream/points.h"
#include "web/records.h"

#define HOST "Host: localhost\r\n"

static char *get(site *s, const char *url)
{
    char request[512];
    snprintf(request, sizeof request, "GET %s HTTP/1.1\r\n" HOST "\r\n", url);
    return site_ask(s, request);
}

static void must_have(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("no '%s' in: %.600s", part, text);
}

static const char *json_of(const char *answer)
{
    const char *body = strstr(answer, "\r\n\r\n");
    assert_non_null(body);
    assert_true(json_valid(body + 4));
    return body + 4;
}

static double number_at(const char *json, const char *key)
{
    char pattern[64];
    snprintf(pattern, sizeof pattern, "\"%s\":", key);
    const char *at = strstr(json, pattern);
    if (!at) fail_msg("no %s in %.600s", pattern, json);
    return strtod(at + strlen(pattern), NULL);
}

static void page_and_headers(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    char *page = get(&s, "/");
    must_have(page, "HTTP/1.1 200");
    must_have(page, "Content-Type: text/html; charset=utf-8");
    must_have(page, "Content-Security-Policy: default-src 'none'; script-src 'self';");
    must_have(page, "frame-ancestors 'none'");
    must_have(page, "X-Content-Type-Options: nosniff");
    must_have(page, "Cross-Origin-Resource-Policy: same-origin");
    must_have(page, "<!doctype html>");
    free(page);
    char *head = site_ask(&s, "HEAD / HTTP/1.1\r\n" HOST "\r\n");
    must_have(head, "HTTP/1.1 200");
    assert_null(strstr(head, "<!doctype"));
    free(head);
    site_close(&s);
}

static void nothing_yet(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    assert_int_equal(site_status(&s, "GET /status", HOST, ""), 503);
    assert_int_equal(site_status(&s, "GET /scene", HOST, ""), 503);
    assert_int_equal(site_status(&s, "GET /rows", HOST, ""), 200);
    assert_int_equal(site_status(&s, "GET /dygraphs.map", HOST, ""), 404);
    site_close(&s);
}

static void status_has_the_members(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    sb_frame *frame = fixture_frame(3, 1.25, 500, 2);
    site_publish(&s, frame);
    char *answer = get(&s, "/status");
    const char *json = json_of(answer);
    must_have(answer, "Content-Type: application/json");
    must_have(json,
              "{\"run\":\"a run\",\"time_s\":1.25,\"step\":1237,\"state\":\"running\",\"eta_s\":33.25,\"loss\":0,");
    assert_near(number_at(json, "iterations"), 17, 0);
    assert_near(number_at(json, "lost_particles"), 3, 0);
    assert_near(number_at(json, "density_error"), 4e-4, 0);
    assert_near(number_at(json, "fluid_particles"), 500, 0);
    must_have(json, "\"rate\":0,\"decimation\":1,\"region_min\":[0, 0, 0],\"region_max\":[0, 0, 0]");
    must_have(json, "\"commands\":false");
    free(answer);
    sb_stream_set_state(s.stream, SB_RUN_PAUSED);
    sb_stream_finish(s.stream);
    fixture_drain(s.stream);
    answer = get(&s, "/status");
    must_have(answer, "\"state\":\"done\"");
    free(answer);
    sb_frame_release(frame);
    site_close(&s);
}

static void scene_has_meshes(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    fixture_scene f;
    fixture_scene_make(&f, 3, 2);
    sb_error error = {0};
    assert_int_equal(sb_stream_set_scene(s.stream, &f.scene, &f.model, &error), SB_OK);
    for (int i = 0; i < 50 && !sb_web_view_scene(s.view); i++) {
        sb_stream_serve(s.stream);
        fixture_drain(s.stream);
        usleep(50000);
    }
    const int client = site_connect(&s);
    static const char request[] = "GET /scene HTTP/1.1\r\n" HOST "\r\n";
    site_send(&s, client, request, sizeof request - 1);
    reply r = site_read(&s, client, 1 << 20, 5);
    const char *body = body_of(&r);
    assert_memory_equal(body, "SBS1", 4);
    uint32_t length;
    memcpy(&length, body + 4, 4);
    assert_int_equal(length % 4, 0);
    char *json = strndup(body + 8, length);
    assert_true(json_valid(json));
    must_have(json, "\"name\":\"building-0\"");
    must_have(json, "\"name\":\"flight\"");
    must_have(json, "\"name\":\"gauge-1\"");
    must_have(json, "\"wavemakers\":[\"piston\",\"slide\"]");
    /* Two tetrahedra of four vertices and four triangles; the third body has no mesh. */
    assert_int_equal(r.size - (size_t)(body - r.bytes), 8 + length + 2 * 12 * (4 + 4));
    float vertex;
    memcpy(&vertex, body + 8 + length, 4);
    assert_near((double)vertex, f.model.bodies[0].mesh.vertices[0].x - f.scene.domain.min.x, 1e-4);
    free(json);
    free(r.bytes);
    close(client);
    fixture_scene_free(&f);
    site_close(&s);
}

/* The first record of the stream has the particles as they came. */
static void frames_have_the_particles(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    sb_frame *frame = fixture_frame(3, 1.25, 9000, 6);
    site_publish(&s, frame);
    const sb_live_frame *live = sb_live_get_frame(sb_web_view_live(s.view));
    assert_non_null(live);
    const int client = site_connect(&s);
    static const char request[] = "GET /frames HTTP/1.1\r\n" HOST "\r\n";
    site_send(&s, client, request, sizeof request - 1);
    reply r = site_read(&s, client, 1 << 20, 0.5);
    must_have(r.bytes, "Transfer-Encoding: chunked");
    char *body = body_of(&r);
    bool complete;
    const size_t size = site_unchunk(body, r.size - (size_t)(body - r.bytes), &complete);
    uint32_t heads[4], record;
    double time, run;
    memcpy(&record, body + 4, 4);
    memcpy(&time, body + 8, 8);
    memcpy(&run, body + 32, 8);
    memcpy(heads, body + 72, sizeof heads);
    assert_memory_equal(body, "SBF1", 4);
    assert_int_equal(record, size);
    assert_near(time, 1.25, 0);
    assert_near(run, (double)sb_stream_run_id(s.stream), 0);
    assert_int_equal(heads[0], 9000);
    assert_int_equal(heads[2], 2);
    assert_int_equal(heads[3], 2); /* bodies 1 and 5 have moved */
    const size_t points = SB_WEB_RECORD_HEAD + 2 * SB_WEB_RECORD_PART + 2 * SB_WEB_RECORD_MOVED;
    assert_int_equal(record, points + 8 * 9000);
    assert_memory_equal(body + points, live->points, 8 * 9000);
    assert_false(complete);
    free(r.bytes);
    close(client);
    sb_frame_release(frame);
    site_close(&s);
}

static void rows_continue(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    fixture_scene f;
    fixture_scene_make(&f, 3, 2);
    sb_error error = {0};
    assert_int_equal(sb_stream_set_scene(s.stream, &f.scene, &f.model, &error), SB_OK);
    for (int i = 1; i <= 3; i++) {
        sb_measure_records rows = fixture_rows(&f, 0.5 * i);
        sb_stream_measure(s.stream, &rows);
        fixture_rows_free(&rows);
    }
    sb_stream_serve(s.stream);
    fixture_drain(s.stream);
    char *answer = get(&s, "/rows");
    const char *json = json_of(answer);
    must_have(json, "\"names\":[\"building-0\",\"building-1\"],\"rows\":[[0.5,");
    must_have(json, "\"names\":[\"gauge-0\",\"gauge-1\"]");
    const double generation = number_at(json, "generation");
    free(answer);
    char url[64];
    snprintf(url, sizeof url, "/rows?forces=%.0f.2&gauges=%.0f.3", generation, generation);
    answer = get(&s, url);
    json = json_of(answer);
    must_have(json, "\"from\":2");
    must_have(json, "\"rows\":[[1.5,");
    must_have(json, "\"rows\":[],\"more\":false"); /* of the gauges */
    free(answer);
    answer = get(&s, "/rows?forces=99.2&gauges=x");
    must_have(json_of(answer), "\"rows\":[[0.5,");
    free(answer);
    fixture_scene_free(&f);
    site_close(&s);
}

/* Takes nine of ten messages. */
static void take_most(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    static unsigned count;
    if (++count % 10 != 0) site_take(received, channel, user);
}

/* One message in ten is lost: the status says so, and newer frames come. */
static void losses_are_reported(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    lcm_subscription_set_queue_capacity(lcm_subscribe(sb_stream_provider(stream), "test_.*", take_most, s.view),
                                        100000);
    for (uint64_t i = 1; i <= 60; i++) {
        sb_frame *frame = fixture_frame(i, (double)i, 9000, 1); /* two parts */
        fixture_publish(stream, frame);
        fixture_drain(stream);
        sb_frame_release(frame);
    }
    char *answer = get(&s, "/status");
    const double loss = number_at(json_of(answer), "loss");
    print_message("loss %g, %g frames complete, %g not\n", loss, number_at(answer, "frames"),
                  number_at(answer, "frames_incomplete"));
    assert_true(loss > 0.05 && loss < 0.15);
    assert_true(number_at(answer, "frames") > 20 && number_at(answer, "frames_incomplete") > 3);
    assert_true(number_at(answer, "frames") < 60);
    free(answer);
    sb_stream_destroy(stream);
    site_close(&s);
}

static void dygraphs_is_optional(void **state)
{
    (void)state;
    site s;
    const sb_web_settings settings = {.plot_folder = SB_SOURCE_DIR "/tests/web"};
    site_open(&s, &settings);
    assert_int_equal(site_status(&s, "GET /dygraphs.js", HOST, ""), 404);
    sb_frame *frame = fixture_frame(3, 1.25, 10, 1);
    site_publish(&s, frame);
    char *answer = get(&s, "/status");
    must_have(answer, "\"plots\":false");
    free(answer);
    sb_frame_release(frame);
    site_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_and_headers),          cmocka_unit_test(nothing_yet),
        cmocka_unit_test(status_has_the_members),    cmocka_unit_test(scene_has_meshes),
        cmocka_unit_test(frames_have_the_particles), cmocka_unit_test(rows_continue),
        cmocka_unit_test(losses_are_reported),       cmocka_unit_test(dygraphs_is_optional),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
