/* Positions of the buildings. North is -y. Seen from the sea, units 6 and 5 are on the right, then units 1 to 4.
   Buildings are at least 14 m apart, so that water can pass between them at a spacing of 6 m. All extend below the
   ground. */
#include "plant.h"

#include "base/memory.h"
#include "form.h"

#include <stdbool.h>
#include <stdio.h>

enum { BODIES_MAX = 48 };
#define ROOT 4.0 /* m below the grade */

typedef struct plant_site {
    const sb_plant_options *options;
    sb_mesh meshes[BODIES_MAX];
    size_t count;
    sb_status status;
    sb_error *error;
} plant_site;

static void add(plant_site *site, sb_form *form, const char *name)
{
    if (site->status == SB_OK && site->count == BODIES_MAX)
        site->status = sb_fail(site->error, SB_FAILED, "%s: more than %d bodies", name, BODIES_MAX);
    sb_mesh mesh = {0};
    sb_status status = sb_form_finish(form, name, &mesh, site->error);
    if (site->status == SB_OK && status == SB_OK) {
        site->meshes[site->count++] = mesh;
        return;
    }
    sb_mesh_free(&mesh);
    if (site->status == SB_OK) site->status = status;
}

static void add_loft(plant_site *site, const char *name, const sb_ring *rings, size_t count)
{
    sb_form form = {0};
    sb_form_loft(&form, rings, count);
    add(site, &form, name);
}

static void add_box(plant_site *site, const char *name, const double x[2], const double y[2], double height)
{
    double grade = site->options->grade;
    sb_ring rings[] = {sb_ring_rectangle(x[0], x[1], y[0], y[1], grade - ROOT),
                       sb_ring_rectangle(x[0], x[1], y[0], y[1], grade + height)};
    add_loft(site, name, rings, 2);
}

/* A reactor building, 45 m square, with its two top floors set back by 3 m. On its sea side the turbine hall: an annex,
   the hall and a hipped roof. */
static void add_unit(plant_site *site, int number, double y)
{
    char name[SB_NAME_MAX];
    double grade = site->options->grade, low = grade - ROOT;
    double top = grade + site->options->reactor, shoulder = top - 12;
    sb_ring reactor[] = {sb_ring_rectangle(928, 973, y - 22.5, y + 22.5, low),
                         sb_ring_rectangle(928, 973, y - 22.5, y + 22.5, shoulder),
                         sb_ring_rectangle(931, 970, y - 19.5, y + 19.5, shoulder),
                         sb_ring_rectangle(931, 970, y - 19.5, y + 19.5, top)};
    snprintf(name, sizeof name, "reactor-%d", number);
    add_loft(site, name, reactor, 4);
    sb_ring hall[] = {sb_ring_rectangle(866, 914, y - 33, y + 33, low),
                      sb_ring_rectangle(866, 914, y - 33, y + 33, grade + 13),
                      sb_ring_rectangle(877, 913, y - 32, y + 32, grade + 13),
                      sb_ring_rectangle(877, 913, y - 32, y + 32, grade + 24),
                      sb_ring_rectangle(885, 906, y - 25, y + 25, grade + 28)};
    snprintf(name, sizeof name, "turbine-%d", number);
    add_loft(site, name, hall, 5);
}

static void add_stack(plant_site *site, const char *name, double x, double y)
{
    double grade = site->options->grade, height = site->options->stack;
    sb_ring rings[] = {sb_ring_circle(x, y, 6.5, grade - ROOT), sb_ring_circle(x, y, 6.5, grade + 6),
                       sb_ring_circle(x, y, 5.0, grade + 18), sb_ring_circle(x, y, 4.0, grade + height)};
    add_loft(site, name, rings, 4);
}

static void add_tank(plant_site *site, int number, double x, double y)
{
    char name[SB_NAME_MAX];
    double grade = site->options->grade;
    sb_ring rings[] = {sb_ring_circle(x, y, 12, grade - ROOT), sb_ring_circle(x, y, 12, grade + 13),
                       sb_ring_circle(x, y, 2, grade + 16)};
    snprintf(name, sizeof name, "tank-%d", number);
    add_loft(site, name, rings, 3);
}

/* A vertical prism over an outline. */
static void add_prism(plant_site *site, const char *name, sb_ring outline, double low, double high)
{
    sb_ring rings[] = {outline, outline};
    rings[0].z = low;
    rings[1].z = high;
    add_loft(site, name, rings, 2);
}

/* In the harbour: the wall of the quay, and in front of it the intake, a comb with bays towards the sea. */
static void add_waterfront(plant_site *site)
{
    const sb_plant_options *options = site->options;
    double low = -options->harbour - ROOT;
    add_prism(site, "quay", sb_ring_rectangle(SB_PLANT_SHORE, 822, 234, 856, 0), low, options->quay);
    sb_ring comb = {.count = 16,
                    .x = {805, 805, 778, 778, 792, 792, 778, 778, 792, 792, 778, 778, 792, 792, 778, 778},
                    .y = {612, 708, 708, 696, 696, 680, 680, 668, 668, 652, 652, 640, 640, 624, 624, 612}};
    add_prism(site, "intake", comb, low, options->quay + 1);
}

/* Three walls around a space that is open towards the sea. */
static void add_cavity(plant_site *site)
{
    double grade = site->options->grade;
    sb_ring walls = {
        .count = 8, .x = {866, 910, 910, 866, 866, 898, 898, 866}, .y = {431, 431, 489, 489, 476, 476, 444, 444}};
    add_prism(site, "cavity", walls, grade - ROOT, grade + 18);
}

/* Two breakwaters from the shore around the harbour, with an entrance of 100 m between their heads. */
static void add_breakwaters(plant_site *site)
{
    static const double north[][2] = {{852, 200}, {800, 200}, {700, 200}, {640, 270}, {620, 450}};
    static const double south[][2] = {{852, 890}, {800, 890}, {690, 890}, {610, 800}, {580, 560}};
    static const struct {
        const char *name;
        const double (*line)[2];
    } arms[] = {{"breakwater-north", north}, {"breakwater-south", south}};
    for (size_t a = 0; a < 2; a++) {
        double foot[5];
        for (size_t i = 0; i < 5; i++)
            foot[i] = sb_plant_ground(site->options, arms[a].line[i][0], arms[a].line[i][1]) - 3;
        /* On land the ground may be high; the foot must be below the crest. */
        for (size_t i = 0; i < 5; i++) foot[i] = foot[i] < -3 ? foot[i] : -3;
        sb_dike dike = {arms[a].line, foot, 5, site->options->breakwater, 12, 1.5};
        sb_form form = {0};
        sb_form_dike(&form, &dike);
        add(site, &form, arms[a].name);
    }
}

static void add_all(plant_site *site)
{
    static const double unit_y[6] = {540, 620, 700, 780, 380, 300};
    static const double tank_at[8][2] = {{890, 846}, {930, 846}, {970, 846}, {890, 886},
                                         {930, 886}, {970, 886}, {900, 232}, {940, 232}};
    add_breakwaters(site);
    add_waterfront(site);
    for (int i = 0; i < 6; i++) add_unit(site, i + 1, unit_y[i]);
    add_stack(site, "stack-1", 1002, 580);
    add_stack(site, "stack-2", 1002, 740);
    add_stack(site, "stack-3", 1002, 340);
    for (int i = 0; i < 8; i++) add_tank(site, i + 1, tank_at[i][0], tank_at[i][1]);
    add_cavity(site);
    add_box(site, "office", (double[2]){938, 968}, (double[2]){430, 490}, 22);
    add_box(site, "radwaste", (double[2]){996, 1020}, (double[2]){635, 690}, 18);
}

sb_status sb_plant_build(const sb_plant_options *options, sb_mesh **meshes, size_t *count, sb_error *error)
{
    plant_site here = {.options = options, .error = error};
    sb_mesh *out = NULL;
    sb_status status = sb_plant_check(options, error);
    if (status != SB_OK) return status;
    here.status = sb_plant_terrain(options, &here.meshes[0], error);
    here.count = here.status == SB_OK;
    if (here.status == SB_OK) add_all(&here);
    if (here.status == SB_OK && !(out = sb_alloc(here.count, sizeof *out)))
        here.status = sb_fail_memory(error, "the plant's meshes");
    if (here.status != SB_OK) {
        for (size_t i = 0; i < here.count; i++) sb_mesh_free(&here.meshes[i]);
        return here.status;
    }
    for (size_t i = 0; i < here.count; i++) out[i] = here.meshes[i];
    *meshes = out;
    *count = here.count;
    return SB_OK;
}

void sb_plant_free(sb_mesh *meshes, size_t count)
{
    for (size_t i = 0; i < count; i++) sb_mesh_free(&meshes[i]);
    sb_free(meshes);
}
