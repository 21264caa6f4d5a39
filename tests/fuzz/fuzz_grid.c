/* Fuzzes terrain grids. The input is read as each of the two formats. */
#include "fuzz.h"

#include "base/memory.h"
#include "geometry/mesh/mesh.h"

static void import(const char *name, const uint8_t *data, size_t size)
{
    sb_mesh mesh = {0};
    sb_error error = {0};
    char *path = sb_strdup(fuzz_save(name, data, size));
    FUZZ_CHECK(path);
    const sb_body body = {.shape = SB_SHAPE_GRID, .file = path, .scale = 1};
    const sb_status status = sb_mesh_import_grid(&body, &mesh, &error);
    sb_free(path);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return;
    }
    FUZZ_CHECK(mesh.triangle_count > 0 && mesh.told);
    for (size_t i = 0; i < mesh.vertex_count; ++i) FUZZ_CHECK(sb_isfinite(mesh.vertices[i]));
    for (size_t i = 0; i < mesh.triangle_count; ++i)
        for (int k = 0; k < 3; ++k) FUZZ_CHECK(mesh.triangles[i][k] < mesh.vertex_count);
    sb_mesh_free(&mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    import("terrain.asc", data, size);
    import("terrain.xyz", data, size);
    return 0;
}
