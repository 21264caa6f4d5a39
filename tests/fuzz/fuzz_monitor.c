/* Fuzzes what the monitor shows. The input is a sequence of messages as in fuzz_stream.c, which the monitor takes from
   the channel that the length's highest four bits name. Each panel is then drawn at sizes that the input chooses. */
#include "fuzz.h"

#include "layout.h"

#include <string.h>

static sb_monitor_state state;
static sb_view view;
static sb_cells cells;

static void check_cells(void)
{
    for (int i = 0; i < cells.width * cells.height; i++) {
        const wchar_t glyph = cells.cells[i].glyph;
        FUZZ_CHECK(glyph >= 0x20 && glyph != 0x7f && (glyph < 0x7f || (cells.utf8 && glyph >= 0xa0)));
        FUZZ_CHECK(cells.cells[i].style < SB_STYLES);
    }
}

static void draw(int width, int height)
{
    FUZZ_CHECK(sb_cells_resize(&cells, width, height) == SB_OK);
    for (int panel = 0; panel < SB_PANELS; panel++) {
        view.panel = (sb_panel_kind)panel;
        sb_layout_draw(&cells, &state, &view, state.last_data + 0.1 * panel);
        check_cells();
        FUZZ_CHECK(view.page <= (size_t)height);
    }
}

static void on_reply(void *user, const sb_reply_message *reply)
{
    (void)user;
    sb_view_note(&view, state.last_data, "%s", reply->text);
}

/* What is printed has no control characters but the ends of lines. */
static void print(void)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    FUZZ_CHECK(out);
    sb_layout_line(out, &state);
    FUZZ_CHECK(sb_layout_print(out, &state, 100, false, state.last_data) == SB_OK);
    FUZZ_CHECK(fclose(out) == 0);
    for (size_t i = 0; i < size; i++) FUZZ_CHECK(text[i] == '\n' || (text[i] >= 0x20 && text[i] < 0x7f));
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const sb_live_calls calls = {.user = &state,
                                 .restarted = sb_monitor_on_restart,
                                 .scene = sb_monitor_on_scene,
                                 .status = sb_monitor_on_status,
                                 .forces = sb_monitor_on_forces,
                                 .gauges = sb_monitor_on_gauges,
                                 .part = sb_monitor_on_part,
                                 .frame = sb_monitor_on_frame,
                                 .reply = on_reply};
    if (size < 4) return 0;
    const int width = 1 + data[0], height = 1 + data[1] % 80;
    cells.utf8 = data[2] & 1;
    sb_monitor_state_start(&state, 0);
    view = (sb_view){.help = data[2] & 2, .scroll = {data[3], data[3], data[3], data[3], data[3]}};
    data += 4;
    size -= 4;
    sb_live *live = sb_live_create(&calls);
    FUZZ_CHECK(live);
    for (double time = 0; size > 2; time += 0.7) {
        const int kind = data[0] >> 4;
        size_t length = (size_t)(data[0] & 0xf) << 8 | data[1];
        data += 2;
        size -= 2;
        if (length > size) length = size;
        sb_live_take(live, (sb_channel_kind)kind, data, length, time);
        sb_monitor_state_sample(&state, sb_live_count(live), time);
        data += length;
        size -= length;
    }
    draw(width, height);
    draw(80, 24);
    print();
    sb_live_destroy(live);
    sb_cells_free(&cells);
    return 0;
}
