/* Reads a mesh file with assimp. Only this file and files.c use assimp. They run in a child process
   (child.c): a file that makes assimp crash or hang ends only that child. */
#include "base/library.h"
#include "base/memory.h"
#include "geometry/mesh/child.h"
#include "geometry/mesh/fence.h"
#include "geometry/mesh/files.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

/* Functions that are looked up in the child, so that the parent never maps the library and its dependencies. */
typedef struct assimp {
    __typeof__(aiCreatePropertyStore) *create_settings;
    __typeof__(aiSetImportPropertyInteger) *set_integer;
    __typeof__(aiImportFileExWithProperties) *import;
    __typeof__(aiGetErrorString) *error;
} assimp;

/* The transform p -> m p + t, in double precision so that the files' single-precision numbers are not rounded twice. */
typedef struct placement {
    double m[3][3], t[3];
} placement;

typedef struct sender {
    const struct aiScene *scene;
    int pipe;
    bool failed; /* a failure was sent, or the pipe is closed */
} sender;

bool sb_mesh_link_send(int pipe, const void *bytes, size_t size)
{
    const char *at = bytes;
    while (size > 0) {
        ssize_t written = write(pipe, at, size);
        if (written < 0 && errno != EINTR) return false;
        if (written < 0) continue;
        at += written;
        size -= (size_t)written;
    }
    return true;
}

static void send_bytes(sender *to, const void *bytes, size_t size)
{
    to->failed = to->failed || !sb_mesh_link_send(to->pipe, bytes, size);
}

static void send_record(sender *to, sb_mesh_record_kind kind, uint64_t vertices, uint64_t triangles, const char *name)
{
    sb_mesh_record record = {.magic = SB_MESH_RECORD_MAGIC, .kind = kind, .vertices = vertices, .triangles = triangles};
    size_t length = strlen(name);
    if (length > sizeof record.name - 1) {
        length = sizeof record.name - 1;
        while (length > 0 && ((unsigned char)name[length] & 0xc0) == 0x80)
            --length; /* cuts between characters, not within a character of several bytes */
    }
    memcpy(record.name, name, length);
    send_bytes(to, &record, sizeof record);
}

static void send_failure(sender *to, const char *text)
{
    send_record(to, SB_MESH_RECORD_FAILURE, strlen(text), 0, "");
    send_bytes(to, text, strlen(text));
    to->failed = true;
}

static placement compose(const placement *outer, const struct aiMatrix4x4 *inner)
{
    const double m[3][4] = {{(double)inner->a1, (double)inner->a2, (double)inner->a3, (double)inner->a4},
                            {(double)inner->b1, (double)inner->b2, (double)inner->b3, (double)inner->b4},
                            {(double)inner->c1, (double)inner->c2, (double)inner->c3, (double)inner->c4}};
    placement both = *outer;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            both.m[i][j] = 0;
            for (int k = 0; k < 3; ++k) both.m[i][j] += outer->m[i][k] * m[k][j];
            both.t[i] += outer->m[i][j] * m[j][3];
        }
    }
    return both;
}

static sb_vec3 apply(const placement *p, struct aiVector3D v)
{
    double x = (double)v.x, y = (double)v.y, z = (double)v.z;
    return sb_vec(p->m[0][0] * x + p->m[0][1] * y + p->m[0][2] * z + p->t[0],
                  p->m[1][0] * x + p->m[1][1] * y + p->m[1][2] * z + p->t[1],
                  p->m[2][0] * x + p->m[2][1] * y + p->m[2][2] * z + p->t[2]);
}

static bool mirrors(const placement *p)
{
    const double(*m)[3] = p->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
}

static const struct aiMesh *mesh_of(const sender *to, const struct aiNode *node, unsigned i)
{
    return to->scene->mMeshes[node->mMeshes[i]];
}

/* Copies a node's triangles. The vertices of its parts are numbered consecutively. Invalid indices become
   UINT32_MAX, which the parent refuses. */
static void gather(const sender *to, const struct aiNode *node, const placement *at, sb_mesh *mesh)
{
    const int second = mirrors(at) ? 2 : 1; /* a mirrored triangle would face inwards */
    size_t vertex = 0, triangle = 0;
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        const struct aiMesh *part = mesh_of(to, node, i);
        size_t base = vertex;
        for (unsigned j = 0; j < part->mNumVertices; ++j) mesh->vertices[vertex++] = apply(at, part->mVertices[j]);
        for (unsigned j = 0; j < part->mNumFaces; ++j) {
            const struct aiFace *face = &part->mFaces[j];
            if (face->mNumIndices != 3) continue;
            uint32_t *corner = mesh->triangles[triangle++];
            for (int k = 0; k < 3; ++k) {
                unsigned index = face->mIndices[k];
                int slot = k == 0 ? 0 : k == 1 ? second : 3 - second;
                corner[slot] = index < part->mNumVertices ? (uint32_t)(base + index) : UINT32_MAX;
            }
        }
    }
}

static void send_node_mesh(sender *to, const struct aiNode *node, const placement *at, const char *name)
{
    size_t vertices = 0, triangles = 0;
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] >= to->scene->mNumMeshes) {
            send_failure(to, "a node refers to a mesh that does not exist");
            return;
        }
        const struct aiMesh *part = mesh_of(to, node, i);
        vertices += part->mVertices ? part->mNumVertices : 0;
        for (unsigned j = 0; part->mVertices && j < part->mNumFaces; ++j) triangles += part->mFaces[j].mNumIndices == 3;
    }
    if (triangles == 0) return;
    sb_mesh mesh;
    if (vertices >= UINT32_MAX || sb_mesh_alloc(&mesh, vertices, triangles, NULL) != SB_OK) {
        send_failure(to, "too many vertices");
        return;
    }
    gather(to, node, at, &mesh);
    send_record(to, SB_MESH_RECORD_MESH, vertices, triangles, name);
    send_bytes(to, mesh.vertices, vertices * sizeof *mesh.vertices);
    send_bytes(to, mesh.triangles, triangles * sizeof *mesh.triangles);
    sb_mesh_free(&mesh);
}

/* Returns a node's name, or for a node without a name that of its parent. The file's name, which assimp gives to the
   root, and assimp's placeholders do not count as names. */
static const char *name_of(const struct aiNode *node, const char *above)
{
    const char *own = node->mName.data;
    if (own[0] == '\0' || own[0] == '<' || own[0] == '$' || strcmp(own, "defaultobject") == 0 ||
        (!node->mParent && node->mNumMeshes == 0))
        return above;
    return own;
}

static void send_nodes(sender *to, const struct aiNode *node, const placement *above, const char *name)
{
    placement at = compose(above, &node->mTransformation);
    name = name_of(node, name);
    send_node_mesh(to, node, &at, name);
    for (unsigned i = 0; i < node->mNumChildren && !to->failed; ++i) send_nodes(to, node->mChildren[i], &at, name);
}

static sb_status load(assimp *ai, sb_error *error)
{
    const sb_library_function functions[] = {
        {"aiCreatePropertyStore", &ai->create_settings},
        {"aiSetImportPropertyInteger", &ai->set_integer},
        {"aiImportFileExWithProperties", &ai->import},
        {"aiGetErrorString", &ai->error},
    };
    return sb_library_load("libassimp.so.5", functions, sizeof functions / sizeof functions[0], error);
}

static const struct aiScene *read_scene(const assimp *ai, sb_mesh_files *files)
{
    struct aiPropertyStore *settings = ai->create_settings();
    /* Lines and points enclose nothing. The axes stay those of the file, because the scene gives the upward axis. */
    ai->set_integer(settings, AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    ai->set_integer(settings, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
    ai->set_integer(settings, AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, 1);
    return ai->import(files->path, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure,
                      &files->io, settings);
}

void sb_mesh_send_file(const char *path, int mesh, int pipe)
{
    sender to = {.pipe = pipe};
    assimp ai;
    sb_mesh_files files;
    sb_error error = {0};
    sb_status status = load(&ai, &error);
    if (status == SB_OK) status = sb_mesh_files_begin(&files, path, mesh, &error);
    if (status != SB_OK) {
        send_failure(&to, error.text);
        return;
    }
    sb_mesh_fence(files.root);
    to.scene = read_scene(&ai, &files);
    if (files.refusal[0]) {
        send_failure(&to, files.refusal);
        return;
    }
    if (!to.scene) {
        /* This message of assimp would repeat the path. */
        const char *reason = ai.error();
        bool unknown = strncmp(reason, "No suitable reader", 18) == 0;
        send_failure(&to, unknown ? "its content does not match the format that its name gives" : reason);
        return;
    }
    const placement file = {.m = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (to.scene->mRootNode) send_nodes(&to, to.scene->mRootNode, &file, "");
    if (!to.failed) send_record(&to, SB_MESH_RECORD_END, 0, 0, "");
}
