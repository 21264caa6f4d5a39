/* Fills the cross-sections of bodies in a raster, row by row. */
#include "render/slice/section.h"

#include "base/memory.h"
#include "render/slice/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SUBROWS = 4 };

/* A place at which a row passes an outline: the winding number changes by `step` towards higher columns. */
struct crossing {
    double column;
    int step;
};

/* The crossings of one body with all rows, sorted by rows. */
struct crossings {
    size_t capacity, row_capacity, touched_capacity;
    struct crossing *list;
    size_t *first;
    bool *touched; /* per row: a piece ends before the row and after the one above it, or passes it */
};

bool sb_section_project(const sb_section_piece *piece, const sb_plane_map *map, double out[2][2])
{
    double depth[2], end[2][2];
    memcpy(end, piece->end, sizeof end);
    for (int k = 0; k < 2; k++) depth[k] = map->m[2][0] * end[k][0] + map->m[2][1] * end[k][1] + map->m[2][2];
    const double near = 1e-6 * fmax(fabs(depth[0]), fabs(depth[1]));
    if (depth[0] <= near && depth[1] <= near) return false;
    for (int k = 0; k < 2; k++) {
        if (depth[k] > near) continue;
        const double s = (near - depth[k]) / (depth[1 - k] - depth[k]);
        for (int c = 0; c < 2; c++) end[k][c] += s * (end[1 - k][c] - end[k][c]);
    }
    return sb_plane_apply(map, end[0][0], end[0][1], out[0]) && sb_plane_apply(map, end[1][0], end[1][1], out[1]);
}

/* The rows whose middle line a piece passes: [low, high). */
static void rows_of(double end[2][2], int rows, int *low, int *high)
{
    const double top = fmin(end[0][1], end[1][1]) * SUBROWS - 0.5, bottom = fmax(end[0][1], end[1][1]) * SUBROWS - 0.5;
    *low = top < 0 ? 0 : top > rows ? rows : (int)ceil(top);
    *high = bottom < 0 ? 0 : bottom > rows ? rows : (int)ceil(bottom);
}

static int by_column(const void *left, const void *right)
{
    const struct crossing *a = left, *b = right;
    return a->column != b->column ? (a->column > b->column) - (a->column < b->column) : a->step - b->step;
}

/* Counts the crossings (list NULL), or adds them. */
static void visit(const sb_section_piece *pieces, size_t count, const sb_plane_map *map, int rows, bool mirrored,
                  size_t *first, struct crossing *list, bool *touched)
{
    for (size_t i = 0; i < count; i++) {
        double end[2][2];
        int low, high;
        if (!sb_section_project(&pieces[i], map, end)) continue;
        rows_of(end, rows, &low, &high);
        if (touched && low < rows) memset(touched + low, 1, (size_t)(high < rows ? high - low + 1 : rows - low));
        for (int row = low; row < high; row++) {
            if (!list) {
                first[row + 2]++;
                continue;
            }
            const double y = (row + 0.5) / SUBROWS, s = (y - end[0][1]) / (end[1][1] - end[0][1]);
            const bool rises = end[1][1] > end[0][1]; /* towards higher rows: the solid has lower columns */
            list[first[row + 1]++] =
                (struct crossing){end[0][0] + s * (end[1][0] - end[0][0]), rises != mirrored ? -1 : 1};
        }
    }
}

static sb_status find(struct crossings *c, const sb_section_piece *pieces, size_t count, const sb_plane_map *map,
                      int rows, bool mirrored, sb_error *error)
{
    if (sb_grow((void **)&c->first, &c->row_capacity, (size_t)rows + 2, sizeof *c->first) != 0 ||
        sb_grow((void **)&c->touched, &c->touched_capacity, (size_t)rows, sizeof *c->touched) != 0)
        return sb_fail_memory(error, "a slice");
    memset(c->first, 0, ((size_t)rows + 2) * sizeof *c->first);
    memset(c->touched, 0, (size_t)rows * sizeof *c->touched);
    visit(pieces, count, map, rows, mirrored, c->first, NULL, c->touched);
    for (int row = 2; row < rows + 2; row++) c->first[row] += c->first[row - 1];
    if (sb_grow((void **)&c->list, &c->capacity, c->first[rows + 1], sizeof *c->list) != 0)
        return sb_fail_memory(error, "a slice");
    visit(pieces, count, map, rows, mirrored, c->first, c->list, NULL);
    for (int row = 0; row < rows; row++)
        qsort(c->list + c->first[row], c->first[row + 1] - c->first[row], sizeof *c->list, by_column);
    return SB_OK;
}

/* Adds the share of each cell between two columns. */
static void add_span(float *cells, int width, double from, double to)
{
    from = from < 0 ? 0 : from;
    to = to > width ? width : to;
    if (!(to > from)) return;
    const int low = (int)from, high = (int)to;
    const float part = 1.0f / SUBROWS;
    if (low == high) {
        cells[low] += part * (float)(to - from);
        return;
    }
    cells[low] += part * (float)(low + 1 - from);
    for (int x = low + 1; x < high; x++) cells[x] += part;
    if (high < width) cells[high] += part * (float)(to - high);
}

/* Fills a row. Where the row begins, the winding number is such that it is nowhere below 0. */
static void fill_row(const struct crossing *list, size_t count, float *cells, int width)
{
    int winding = count > 0 && list[0].step < 0;
    double from = 0;
    for (size_t k = 0; k < count; k++) {
        if (winding > 0) add_span(cells, width, from, list[k].column);
        winding += list[k].step;
        from = list[k].column;
    }
    if (winding > 0) add_span(cells, width, from, width);
}

/* Whether a place is below the highest triangle of a terrain above or below it. */
static bool is_below(const sb_solids *solids, const struct sb_solid *terrain, sb_vec3 at)
{
    double top = -HUGE_VAL;
    for (size_t t = terrain->first; t < terrain->first + terrain->count; t++) {
        const sb_vec3 *p = solids->corners[t];
        double part[3];
        for (int k = 0; k < 3; k++) {
            const sb_vec3 u = p[(k + 1) % 3], v = p[(k + 2) % 3];
            part[k] = (u.x - at.x) * (v.y - at.y) - (u.y - at.y) * (v.x - at.x);
        }
        const double sum = part[0] + part[1] + part[2];
        const bool inside =
            (part[0] >= 0 && part[1] >= 0 && part[2] >= 0) || (part[0] <= 0 && part[1] <= 0 && part[2] <= 0);
        if (!inside || sum == 0) continue;
        top = fmax(top, (part[0] * p[0].z + part[1] * p[1].z + part[2] * p[2].z) / sum);
    }
    return at.z < top;
}

/* One body on a raster. */
struct filling {
    const sb_solids *solids;
    const struct sb_solid *solid;
    const sb_plane *plane;
    const sb_plane_map *from_raster;
    const struct crossings *inside; /* of the area in which terrain is solid */
    int width;
};

/* Whether a row without crossings is below the terrain. Rows with no piece between them are alike: *known is kept. */
static bool row_is_below(const struct filling *f, int row, int *known)
{
    const struct crossing *area = f->inside->list + f->inside->first[row];
    double place[2];
    if (f->inside->first[row + 1] - f->inside->first[row] < 2) return false;
    if (*known >= 0) return *known;
    const double column = 0.5 * (area[0].column + area[1].column);
    if (!sb_plane_apply(f->from_raster, column, (row + 0.5) / SUBROWS, place)) return false;
    *known = is_below(f->solids, f->solid, sb_plane_at(f->plane, place[0], place[1]));
    return *known;
}

static void fill_body(const struct filling *f, const struct crossings *c, int rows, float *cells, float *line)
{
    int known = -1; /* whether the last row without crossings was solid */
    for (int row = 0; row < rows; row++) {
        const size_t count = c->first[row + 1] - c->first[row], inside = f->inside->first[row];
        float *out = cells + (size_t)(row / SUBROWS) * (size_t)f->width;
        if (c->touched[row]) known = -1;
        if (!f->solid->terrain) {
            fill_row(c->list + c->first[row], count, out, f->width);
            continue;
        }
        if (f->inside->first[row + 1] - inside < 2) continue;
        memset(line, 0, (size_t)f->width * sizeof *line);
        if (count > 0)
            fill_row(c->list + c->first[row], count, line, f->width);
        else if (f->solid->open && row_is_below(f, row, &known))
            add_span(line, f->width, 0, f->width);
        const int low = (int)fmax(f->inside->list[inside].column, 0);
        const int high = (int)fmin(ceil(f->inside->list[inside + 1].column), f->width);
        for (int x = low; x < high; x++) out[x] += line[x];
    }
}

/* The area's outline as pieces, with its inside on the left. */
static size_t outline_of(const sb_plane_area *area, sb_section_piece pieces[SB_PLANE_CORNERS])
{
    for (size_t i = 0; i < area->count; i++)
        for (int k = 0; k < 2; k++) {
            pieces[i].end[0][k] = area->corner[i][k];
            pieces[i].end[1][k] = area->corner[(i + 1) % area->count][k];
        }
    return area->count;
}

static double determinant(const sb_plane_map *map)
{
    const double(*m)[3] = map->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

sb_status sb_section_fill(const sb_section *section, const sb_solids *solids, const sb_plane *plane,
                          const sb_plane_area *area, const sb_plane_map *to_raster, int width, int height,
                          float *terrain, float *bodies, sb_error *error)
{
    const size_t cells = (size_t)width * (size_t)height;
    const bool mirrored = determinant(to_raster) < 0;
    const sb_plane_map from_raster = sb_plane_inverse(to_raster);
    const int rows = height * SUBROWS;
    sb_section_piece outline[SB_PLANE_CORNERS];
    struct crossings c = {0}, inside = {0};
    float *line = sb_alloc((size_t)width, sizeof *line);
    sb_status status = line ? SB_OK : sb_fail_memory(error, "a slice");
    memset(terrain, 0, cells * sizeof *terrain);
    if (bodies != terrain) memset(bodies, 0, cells * sizeof *bodies);
    if (status == SB_OK) status = find(&inside, outline, outline_of(area, outline), to_raster, rows, mirrored, error);
    for (size_t s = 0; s < solids->count && status == SB_OK; s++) {
        const struct filling f = {solids, &solids->list[s], plane, &from_raster, &inside, width};
        const size_t first = section->first[s], count = section->first[s + 1] - first;
        if (f.solid->open && !f.solid->terrain) continue;
        if (count == 0 && !f.solid->open) continue;
        status = find(&c, section->pieces + first, count, to_raster, rows, mirrored, error);
        if (status == SB_OK) fill_body(&f, &c, rows, f.solid->terrain ? terrain : bodies, line);
    }
    for (size_t i = 0; i < cells; i++) {
        terrain[i] = terrain[i] > 1 ? 1 : terrain[i];
        if (bodies != terrain) bodies[i] = bodies[i] > 1 ? 1 : bodies[i];
    }
    sb_free(line);
    sb_free(c.list);
    sb_free(c.first);
    sb_free(c.touched);
    sb_free(inside.list);
    sb_free(inside.first);
    sb_free(inside.touched);
    return status;
}
