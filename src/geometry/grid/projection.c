/* Transforms coordinates with PROJ, which is loaded when the first scene needs it. */
#include "geometry/grid/projection.h"

#include "base/library.h"
#include "base/memory.h"

#include <math.h>
#include <proj.h>
#include <stdio.h>
#include <string.h>

static struct {
    PJ_CONTEXT *context;
    __typeof__(proj_context_create) *begin;
    __typeof__(proj_context_set_enable_network) *set_network;
    __typeof__(proj_log_level) *set_log;
    __typeof__(proj_create) *create;
    __typeof__(proj_get_type) *type;
    __typeof__(proj_crs_get_coordinate_system) *axes;
    __typeof__(proj_get_source_crs) *source;
    __typeof__(proj_cs_get_axis_info) *axis;
    __typeof__(proj_create_crs_to_crs_from_pj) *between;
    __typeof__(proj_normalize_for_visualization) *normalize;
    __typeof__(proj_trans) *transform;
    __typeof__(proj_destroy) *destroy;
} pj;

struct sb_projection {
    PJ *both;
};

static sb_status load(sb_error *error)
{
    const sb_library_function functions[] = {
        {"proj_context_create", &pj.begin},
        {"proj_context_set_enable_network", &pj.set_network},
        {"proj_log_level", &pj.set_log},
        {"proj_create", &pj.create},
        {"proj_get_type", &pj.type},
        {"proj_crs_get_coordinate_system", &pj.axes},
        {"proj_get_source_crs", &pj.source},
        {"proj_cs_get_axis_info", &pj.axis},
        {"proj_create_crs_to_crs_from_pj", &pj.between},
        {"proj_normalize_for_visualization", &pj.normalize},
        {"proj_trans", &pj.transform},
        {"proj_destroy", &pj.destroy},
    };
    if (pj.context) return SB_OK;
    sb_status status = sb_library_load("libproj.so.25", functions, sizeof functions / sizeof *functions, error);
    if (status != SB_OK) return status;
    pj.context = pj.begin();
    if (!pj.context) return sb_fail_memory(error, "map projections");
    pj.set_network(pj.context, 0); /* a run reads no file that its scene does not name */
    pj.set_log(pj.context, PJ_LOG_NONE);
    return SB_OK;
}

static sb_status find(const char *system, PJ **found, sb_error *error)
{
    sb_status status = load(error);
    if (status != SB_OK) return status;
    *found = pj.create(pj.context, system);
    const PJ_TYPE type = *found ? pj.type(*found) : PJ_TYPE_UNKNOWN;
    if (type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS ||
        type == PJ_TYPE_COMPOUND_CRS || type == PJ_TYPE_BOUND_CRS)
        return SB_OK;
    if (*found) pj.destroy(*found);
    *found = NULL;
    return sb_fail(error, SB_BAD_INPUT,
                   "\"%.200s\" is no coordinate system that PROJ knows, expected EPSG:<number>, or a PROJ string with "
                   "+type=crs",
                   system);
}

sb_status sb_projection_unit_of(const char *system, sb_projection_unit *unit, sb_error *error)
{
    PJ *of;
    sb_status status = find(system, &of, error);
    if (status != SB_OK) return status;
    PJ_TYPE type = pj.type(of);
    if (type == PJ_TYPE_BOUND_CRS) { /* a system with its shift to WGS 84 */
        PJ *bound = of;
        of = pj.source(pj.context, bound);
        pj.destroy(bound);
        if (!of) return sb_fail(error, SB_BAD_INPUT, "\"%.200s\" has no coordinate system within", system);
        type = pj.type(of);
    }
    PJ *axes = pj.axes(pj.context, of);
    double factor = 0;
    *unit = SB_PROJECTION_OTHER;
    if (type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS)
        *unit = SB_PROJECTION_DEGREES;
    else if (axes && pj.axis(pj.context, axes, 0, NULL, NULL, NULL, &factor, NULL, NULL, NULL) && factor == 1)
        *unit = SB_PROJECTION_METRES;
    if (axes) pj.destroy(axes);
    pj.destroy(of);
    return SB_OK;
}

void sb_projection_zone(double longitude, double latitude, char text[24])
{
    const double east = longitude - 360 * floor((longitude + 180) / 360); /* -180 to 180 */
    const int zone = (int)fmin(60, floor((east + 180) / 6) + 1);
    snprintf(text, 24, "EPSG:%d", (latitude < 0 ? 32700 : 32600) + zone);
}

sb_status sb_projection_create(const char *from, const char *to, sb_projection **projection, sb_error *error)
{
    PJ *ends[2] = {NULL, NULL}, *raw = NULL;
    sb_projection *made = sb_alloc(1, sizeof *made);
    sb_status status = made ? find(from, &ends[0], error) : sb_fail_memory(error, "a map projection");
    if (status == SB_OK) status = find(to, &ends[1], error);
    if (status == SB_OK) {
        raw = pj.between(pj.context, ends[0], ends[1], NULL, NULL);
        made->both = raw ? pj.normalize(pj.context, raw) : NULL;
        if (!made->both)
            status = sb_fail(error, SB_BAD_INPUT, "PROJ knows no transformation from %.200s to %.200s", from, to);
    }
    if (raw) pj.destroy(raw);
    for (int k = 0; k < 2; ++k)
        if (ends[k]) pj.destroy(ends[k]);
    if (status == SB_OK)
        *projection = made;
    else
        sb_free(made);
    return status;
}

void sb_projection_destroy(sb_projection *projection)
{
    if (!projection) return;
    pj.destroy(projection->both);
    sb_free(projection);
}

static void transform(const sb_projection *of, PJ_DIRECTION way, double place[2])
{
    PJ_COORD at = {.v = {place[0], place[1], 0, HUGE_VAL}};
    at = pj.transform(of->both, way, at);
    place[0] = at.v[0];
    place[1] = at.v[1];
}

void sb_projection_forward(const sb_projection *projection, double place[2])
{
    transform(projection, PJ_FWD, place);
}

void sb_projection_backward(const sb_projection *projection, double place[2])
{
    transform(projection, PJ_INV, place);
}
