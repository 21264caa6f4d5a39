/* Fuzzes the scene.yaml of a run as a comparison reads it: every key and value is a text that can be found again. */
#include "fuzz.h"

#include "base/memory.h"
#include "compare/scene_values.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = sb_alloc(size + 1, 1);
    FUZZ_CHECK(text);
    memcpy(text, data, size);
    sb_scene_values values;
    FUZZ_CHECK(sb_scene_values_read(text, &values, NULL) == SB_OK);
    for (size_t i = 0; i < values.count; i++) {
        FUZZ_CHECK(*values.values[i].key && *values.values[i].value);
        if (i < 100) FUZZ_CHECK(sb_scene_values_find(&values, values.values[i].key));
        (void)sb_scene_values_matter(values.values[i].key);
    }
    sb_scene_values_free(&values);
    sb_free(text);
    return 0;
}
