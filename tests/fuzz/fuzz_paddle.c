/* Fuzzes a paddle's table of times and displacements: a table that is read must give finite displacements. */
#include "fuzz.h"

#include "base/file.h"
#include "physics/wavemakers/wavemaker.h"

#include <math.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[SB_PATH_MAX];
    snprintf(path, sizeof path, "%s", fuzz_save("paddle.txt", data, size));
    sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("file"), .file = path, .gravity = 9.81};
    sb_paddle paddle;
    sb_error error = {0};
    sb_status status = sb_paddle_create(&law, &paddle, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return 0;
    }
    FUZZ_CHECK(paddle.duration > 0 && isfinite(paddle.duration));
    for (int i = -1; i <= 65; ++i) FUZZ_CHECK(isfinite(sb_paddle_displacement(&paddle, paddle.duration * i / 64)));
    for (int i = 0; i < 1075; ++i) /* rows may differ by the smallest representable time */
        FUZZ_CHECK(isfinite(sb_paddle_displacement(&paddle, ldexp(paddle.duration, -i))));
    sb_paddle_destroy(&paddle);
    return 0;
}
