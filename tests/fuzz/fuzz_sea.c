/* Fuzzes the files of given water: a table or a record that is read must give finite water, below its greatest surface.
 */
#include "fuzz.h"

#include "base/file.h"
#include "sea/sea.h"

#include <math.h>
#include <string.h>

static void check(const sb_sea_source *sea)
{
    const double top = sb_sea_greatest_surface(sea);
    FUZZ_CHECK(isfinite(top) && isfinite(sb_sea_greatest_speed(sea)) && *sb_sea_about(sea));
    for (int i = -1; i <= 33; ++i)
        for (int j = -1; j <= 3; ++j) {
            sb_sea_point at;
            sb_sea_at(sea, i / 32.0, 5, 2.5 * j, 0.5 * j, -1, &at);
            FUZZ_CHECK(isfinite(at.surface) && at.surface <= top + 1e-6 * (1 + fabs(top)));
            for (int axis = 0; axis < 3; ++axis)
                FUZZ_CHECK(isfinite(at.velocity[axis]) && isfinite(at.acceleration[axis]));
        }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[SB_PATH_MAX];
    snprintf(path, sizeof path, "%s", fuzz_save("table.csv", data, size));
    for (int kind = SB_GIVEN_TABLE; kind <= SB_GIVEN_RECORD; ++kind) {
        sb_scene scene = {.dimensions = 3,
                          .resolution = 0.1,
                          .duration = 1,
                          .fluid = {.density = 1000, .gravity = 9.81},
                          .domain = {.min = {5, 0, -1}, .max = {15, 5, 1e6}},
                          .given = {.source = (sb_given_source)kind, .file = path, .plane = "p"}};
        sb_sea_source *sea = NULL;
        sb_error error = {0};
        const sb_status status = sb_sea_create(&scene, NULL, &sea, &error);
        if (status == SB_OK)
            check(sea);
        else
            fuzz_check_refusal(status, &error);
        sb_sea_destroy(sea);
    }
    return 0;
}
