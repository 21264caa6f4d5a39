/* Receives the child's records. Their bytes are not trusted, because a crafted file may have gained control of the
   library that reads it. */
#include "base/clock.h"
#include "base/memory.h"
#include "base/stop.h"
#include "geometry/mesh/child.h"
#include "scene/name.h"

#include <ctype.h>
#include <errno.h>
#include <poll.h>
#include <string.h>
#include <unistd.h>

enum { MESHES_MAX = 1 << 20, FAILURE_TEXT_MAX = 400 };

/* In s. The wait is divided into intervals because a signal may arrive in another thread than the one that waits
   here. */
static const double INTERVAL = 0.1;

/* Waits for bytes from the child, its end, a signal to stop, or the deadline. */
static void await(sb_mesh_link *from)
{
    while (from->end == SB_MESH_LINK_OK) {
        double left = from->deadline - sb_clock();
        if (left <= 0) {
            from->end = SB_MESH_LINK_LATE;
            return;
        }
        if (sb_stop_signal()) {
            from->end = SB_MESH_LINK_STOPPED;
            return;
        }
        struct pollfd sources[2] = {{from->pipe, POLLIN, 0}, {from->watch, POLLIN, 0}};
        int ready = poll(sources, 2, (int)(1e3 * (left < INTERVAL ? left : INTERVAL)) + 1);
        if (ready < 0 && errno != EINTR) from->end = SB_MESH_LINK_CLOSED;
        if (ready <= 0) continue;
        if (sources[0].revents & POLLIN) return;
        /* The child may have written and ended between the checks of the two descriptors. */
        if (sources[0].revents == 0 && poll(sources, 1, 0) > 0 && sources[0].revents & POLLIN) return;
        from->end = SB_MESH_LINK_CLOSED; /* the pipe is closed, or the child ended and nothing is left to read */
        return;
    }
}

/* Reads exactly `size` bytes. Returns false if the child ended early, timed out or sent too much. */
bool sb_mesh_link_receive(sb_mesh_link *from, void *bytes, size_t size)
{
    char *at = bytes;
    while (size > 0) {
        await(from);
        if (from->end != SB_MESH_LINK_OK) return false;
        ssize_t got = read(from->pipe, at, size);
        if (got > 0) {
            at += got;
            size -= (size_t)got;
        } else if (got == 0 || (errno != EINTR && errno != EAGAIN)) {
            from->end = SB_MESH_LINK_CLOSED;
        }
    }
    return true;
}

/* Returns the length of the UTF-8 character that begins at c, or 0 if none does. */
static size_t character_length(const unsigned char *c)
{
    size_t length = c[0] < 0x80 ? 1 : c[0] < 0xc2 ? 0 : c[0] < 0xe0 ? 2 : c[0] < 0xf0 ? 3 : 4;
    if (c[0] > 0xf4) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((c[i] & 0xc0) != 0x80) return 0;
    return length;
}

void sb_mesh_link_clean(char *text)
{
    for (char *c = text; *c;) {
        const size_t length = character_length((unsigned char *)c);
        if (length == 0) *c = '?';
        if (iscntrl((unsigned char)*c)) *c = ' ';
        c += length ? length : 1;
    }
    sb_one_line(text);
    for (size_t n = strlen(text); n > 0 && text[n - 1] == ' '; --n) text[n - 1] = '\0';
}

static sb_status receive_failure(sb_mesh_link *from, const sb_mesh_record *record, sb_error *error)
{
    char text[FAILURE_TEXT_MAX + 1] = "";
    size_t size = record->vertices < FAILURE_TEXT_MAX ? (size_t)record->vertices : FAILURE_TEXT_MAX;
    if (!sb_mesh_link_receive(from, text, size)) text[0] = '\0';
    sb_mesh_link_clean(text);
    return sb_fail(error, SB_BAD_INPUT, "%.500s: not readable as a mesh: %s", from->path,
                   text[0] ? text : "no reason given");
}

static sb_status receive_mesh(sb_mesh_link *from, const sb_mesh_record *record, sb_mesh *mesh, sb_error *error)
{
    const uint64_t vertex = sizeof *mesh->vertices, triangle = sizeof *mesh->triangles;
    if (record->vertices > from->room / vertex || record->triangles > from->room / triangle ||
        record->vertices * vertex + record->triangles * triangle > from->room)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %llu vertices and %llu triangles, which exceed the memory limit",
                       from->path, (unsigned long long)record->vertices, (unsigned long long)record->triangles);
    from->room -= record->vertices * vertex + record->triangles * triangle;
    sb_status status = sb_mesh_alloc(mesh, record->vertices, record->triangles, error);
    if (status != SB_OK) return status;
    memcpy(mesh->name, record->name, sizeof mesh->name - 1);
    memcpy(mesh->original, mesh->name, sizeof mesh->original);
    if (!sb_name_fit(mesh->name)) mesh->original[0] = '\0';
    if (!sb_mesh_link_receive(from, mesh->vertices, record->vertices * vertex) ||
        !sb_mesh_link_receive(from, mesh->triangles, record->triangles * triangle))
        return SB_FAILED; /* the child's exit status gives the reason */
    sb_error reason = {0};
    status = sb_mesh_weld(mesh, &reason);
    if (status == SB_OK) return SB_OK;
    return sb_fail(error, status, "%.500s: mesh \"%s\": %s", from->path, mesh->name, reason.text);
}

typedef struct mesh_list {
    sb_mesh *items;
    size_t count, capacity;
} mesh_list;

static void free_list(mesh_list *list)
{
    for (size_t i = 0; i < list->count; ++i) sb_mesh_free(&list->items[i]);
    sb_free(list->items);
    *list = (mesh_list){0};
}

/* Receives all records up to END. A failure without a text means that the child ended; the caller reports it. */
static sb_status receive_all(sb_mesh_link *from, mesh_list *list, sb_error *error)
{
    for (;;) {
        sb_mesh_record record;
        if (!sb_mesh_link_receive(from, &record, sizeof record)) return SB_FAILED;
        if (record.magic != SB_MESH_RECORD_MAGIC || list->count >= MESHES_MAX)
            return sb_fail(error, SB_BAD_INPUT, "%.500s: the process that reads it sent invalid data, expected a mesh",
                           from->path);
        if (record.kind == SB_MESH_RECORD_END) return SB_OK;
        if (record.kind == SB_MESH_RECORD_FAILURE) return receive_failure(from, &record, error);
        if (sb_grow((void **)&list->items, &list->capacity, list->count + 1, sizeof *list->items))
            return sb_fail_memory(error, "a list of meshes");
        sb_mesh mesh = {0};
        sb_status status = receive_mesh(from, &record, &mesh, error);
        if (status == SB_OK && mesh.triangle_count > 0)
            list->items[list->count++] = mesh;
        else
            sb_mesh_free(&mesh);
        if (status != SB_OK) return status;
    }
}

sb_status sb_mesh_receive(sb_mesh_link *from, sb_mesh **meshes, size_t *count, sb_error *error)
{
    mesh_list list = {0};
    sb_status status = receive_all(from, &list, error);
    if (status == SB_OK && list.count == 0)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: it has no triangles, expected a surface mesh", from->path);
    if (status != SB_OK) {
        free_list(&list);
        return status;
    }
    *meshes = list.items;
    *count = list.count;
    return SB_OK;
}
