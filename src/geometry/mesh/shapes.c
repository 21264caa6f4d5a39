/* Makes meshes of analytic shapes with as few triangles as possible. */
#include "geometry/mesh/mesh.h"

#include <math.h>
#include <string.h>

enum { SEGMENTS_MIN = 12, SEGMENTS_MAX = 8192 };

/* Sets the corners of a box. Bits 1, 2, 4 of a vertex number i select max instead of min in x, y, z. */
static void set_corners(sb_mesh *mesh, sb_vec3 min, sb_vec3 max)
{
    for (int i = 0; i < 8; ++i)
        mesh->vertices[i] = sb_vec(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
}

/* Divides the quadrilateral a b c d into two triangles of the same orientation. */
static void set_quad(uint32_t (*triangles)[3], const uint32_t corner[4])
{
    const uint32_t two[2][3] = {{corner[0], corner[1], corner[2]}, {corner[0], corner[2], corner[3]}};
    memcpy(triangles, two, sizeof two);
}

/* Faces counter-clockwise seen from outside: the floor, four sides, and last the lid. */
static const uint32_t box_faces[6][4] = {{0, 2, 3, 1}, {0, 1, 5, 4}, {1, 3, 7, 5},
                                         {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}};

static sb_status check_extent(const char *what, sb_vec3 min, sb_vec3 max, sb_error *error)
{
    if (sb_isfinite(min) && sb_isfinite(max) && min.x < max.x && min.y < max.y && min.z < max.z) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%s from (%g, %g, %g) to (%g, %g, %g): expected min < max along every axis",
                   what, min.x, min.y, min.z, max.x, max.y, max.z);
}

sb_status sb_mesh_box(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error)
{
    sb_mesh box;
    sb_status status = check_extent("box", min, max, error);
    if (status == SB_OK) status = sb_mesh_alloc(&box, 8, 12, error);
    if (status != SB_OK) return status;
    set_corners(&box, min, max);
    for (size_t face = 0; face < 6; ++face) set_quad(box.triangles + 2 * face, box_faces[face]);
    *mesh = box;
    return SB_OK;
}

sb_status sb_mesh_basin(sb_vec3 min, sb_vec3 max, sb_mesh *mesh, sb_error *error)
{
    sb_mesh basin;
    sb_status status = check_extent("basin", min, max, error);
    if (status == SB_OK) status = sb_mesh_alloc(&basin, 8, 10, error);
    if (status != SB_OK) return status;
    set_corners(&basin, min, max);
    for (size_t face = 0; face < 5; ++face) {
        const uint32_t *out = box_faces[face];
        set_quad(basin.triangles + 2 * face, (const uint32_t[4]){out[3], out[2], out[1], out[0]});
    }
    basin.open_surface = true;
    *mesh = basin;
    return SB_OK;
}

/* Returns the number of segments whose sagitta r (1 - cos(pi / n)) stays below the tolerance. It is a multiple of
   four, so that the polygon has the full radius along both axes. */
static size_t segment_count(double radius, double tolerance)
{
    double share = tolerance / radius;
    double needed = share < 1 ? M_PI / acos(1 - share) : SEGMENTS_MIN;
    needed = ceil(needed / 4) * 4;
    if (!(needed > SEGMENTS_MIN)) return SEGMENTS_MIN;
    return needed < SEGMENTS_MAX ? (size_t)needed : SEGMENTS_MAX;
}

sb_status sb_mesh_cylinder(sb_vec3 base, double radius, double height, double tolerance, sb_mesh *mesh, sb_error *error)
{
    if (!(sb_isfinite(base) && isfinite(radius) && radius > 0 && isfinite(height) && height > 0))
        return sb_fail(error, SB_BAD_INPUT, "cylinder of radius %g m and height %g m: expected both > 0", radius,
                       height);
    if (!(tolerance > 0))
        return sb_fail(error, SB_BAD_INPUT, "cylinder: chord tolerance %g m: expected > 0", tolerance);
    size_t n = segment_count(radius, tolerance);
    sb_mesh cylinder;
    sb_status status = sb_mesh_alloc(&cylinder, 2 * n + 2, 4 * n, error);
    if (status != SB_OK) return status;
    /* Lower ring: 0..n-1, upper ring: n..2n-1, then the centres of both discs. */
    const uint32_t ring = (uint32_t)n, below = 2 * ring, above = below + 1;
    for (uint32_t i = 0; i < ring; ++i) {
        double angle = 2 * M_PI * i / ring;
        sb_vec3 at = sb_add(base, sb_vec(radius * cos(angle), radius * sin(angle), 0));
        cylinder.vertices[i] = at;
        cylinder.vertices[ring + i] = sb_add(at, sb_vec(0, 0, height));
        uint32_t next = (i + 1) % ring;
        uint32_t(*to)[3] = cylinder.triangles + 4 * (size_t)i;
        set_quad(to, (const uint32_t[4]){i, next, ring + next, ring + i});
        memcpy(to[2], (const uint32_t[3]){below, next, i}, sizeof to[2]);
        memcpy(to[3], (const uint32_t[3]){above, ring + i, ring + next}, sizeof to[3]);
    }
    cylinder.vertices[below] = base;
    cylinder.vertices[above] = sb_add(base, sb_vec(0, 0, height));
    *mesh = cylinder;
    return SB_OK;
}

sb_status sb_mesh_plane(sb_vec3 center, sb_vec3 normal, double width, double length, sb_mesh *mesh, sb_error *error)
{
    sb_vec3 n = sb_normalize(normal);
    if (!(sb_isfinite(center) && sb_isfinite(n) && sb_norm(n) > 0))
        return sb_fail(error, SB_BAD_INPUT, "plane with normal (%g, %g, %g): expected a direction", normal.x, normal.y,
                       normal.z);
    if (!(isfinite(width) && width > 0 && isfinite(length) && length > 0))
        return sb_fail(error, SB_BAD_INPUT, "plane of %g m x %g m: expected both > 0", width, length);
    sb_mesh plane;
    sb_status status = sb_mesh_alloc(&plane, 4, 2, error);
    if (status != SB_OK) return status;
    /* A horizontal plane has no horizontal direction of its own. Its width is along x. */
    sb_vec3 across = sb_cross(sb_vec(0, 0, 1), n);
    sb_vec3 u = sb_norm(across) > 1e-9 ? sb_normalize(across) : sb_vec(1, 0, 0);
    sb_vec3 v = sb_cross(n, u);
    for (int i = 0; i < 4; ++i) {
        sb_vec3 at = sb_madd(center, i & 1 ? width / 2 : -width / 2, u);
        plane.vertices[i] = sb_madd(at, i & 2 ? length / 2 : -length / 2, v);
    }
    set_quad(plane.triangles, (const uint32_t[4]){0, 1, 3, 2});
    plane.open_surface = true;
    *mesh = plane;
    return SB_OK;
}
