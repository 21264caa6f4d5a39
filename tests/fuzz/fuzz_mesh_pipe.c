/* Fuzzes the data that the mesh-reading child process sends to its parent. */
#include "fuzz.h"

#include "base/clock.h"
#include "base/memory.h"
#include "geometry/mesh/child.h"
#include "scene/name.h"

#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static void check_places(const sb_mesh *mesh)
{
    for (size_t k = 0; k < mesh->vertex_count; ++k) FUZZ_CHECK(sb_isfinite(mesh->vertices[k]));
    for (size_t k = 0; k < 3 * mesh->triangle_count; ++k)
        FUZZ_CHECK(mesh->triangles[k / 3][k % 3] < mesh->vertex_count);
}

/* Checks the meshes as received, and after the orientation and the closing that a solid's meshes undergo. */
static void check_meshes(sb_mesh *meshes, size_t count)
{
    FUZZ_CHECK(count > 0);
    for (size_t i = 0; i < count; ++i) {
        sb_mesh *mesh = &meshes[i];
        const size_t faces = mesh->triangle_count;
        FUZZ_CHECK(faces > 0 && memchr(mesh->name, 0, sizeof mesh->name));
        FUZZ_CHECK(strspn(mesh->name, sb_name_letters) == strlen(mesh->name));
        FUZZ_CHECK(mesh->name[0] != '.' && mesh->name[0] != '-');
        check_places(mesh);
        FUZZ_CHECK(sb_mesh_orient(mesh, SB_ROLE_SOLID, NULL) == SB_OK && sb_mesh_close(mesh, NULL) == SB_OK);
        FUZZ_CHECK(mesh->triangle_count == faces + mesh->closed);
        check_places(mesh);
        sb_mesh_free(mesh);
    }
    sb_free(meshes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    int pipe = memfd_create("mesh-pipe", MFD_CLOEXEC);
    FUZZ_CHECK(pipe >= 0 && write(pipe, data, size) == (ssize_t)size && lseek(pipe, 0, SEEK_SET) == 0);
    sb_mesh_link from = {.path = "some.obj", .pipe = pipe, .watch = -1, .deadline = sb_clock() + 60, .room = 1 << 20};
    sb_mesh *meshes = NULL;
    size_t count = 0;
    sb_error error = {0};
    sb_status status = sb_mesh_receive(&from, &meshes, &count, &error);
    close(pipe);
    FUZZ_CHECK(from.end != SB_MESH_LINK_LATE);
    if (status == SB_OK)
        check_meshes(meshes, count);
    else if (from.end == SB_MESH_LINK_OK)
        fuzz_check_refusal(status, &error);
    else
        FUZZ_CHECK(status == SB_FAILED || status == SB_BAD_INPUT);
    return 0;
}
