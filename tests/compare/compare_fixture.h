/* Makes folders of runs with chosen scenes, forces and maps, for comparisons. */
#ifndef SB_TESTS_COMPARE_FIXTURE_H
#define SB_TESTS_COMPARE_FIXTURE_H

#include "../check.h"
#include "../output/folder.h"

#include "compare/compare.h"

#include <stdio.h>
#include <sys/stat.h>

typedef struct made_run {
    const char *name;
    int seed;
    double wall;        /* m, the height of the wall */
    double factor;      /* of all forces, levels and depths */
    double resolution;  /* m; 0: 0.1 */
    double duration;    /* s; 0: 10 */
    const char *status; /* NULL: done */
    const char *ground; /* file of the terrain; NULL: ground.obj */
    const char *body;   /* name of the second body; NULL: barn */
    int rows;           /* of forces.csv; 0: 100 */
    bool no_map;
} made_run;

static inline FILE *open_text(const char *run, const char *file)
{
    char name[256];
    snprintf(name, sizeof name, "%s/%s", run, file);
    FILE *stream = fopen(in_folder(name), "w");
    assert_non_null(stream);
    return stream;
}

static inline void make_scene(const made_run *r, double resolution, double duration)
{
    FILE *f = open_text(r->name, "scene.yaml");
    fprintf(f,
            "# A scene as shorebreak understood it.\ntitle: \"A basin\"\ndimensions: 3\nresolution: %g # m\n"
            "duration: %g # s\n"
            "domain:\n  min: [0, 0, 0] # m\n  max: [4, 4, 1] # m\nnumerics:\n  seed: %d\nwater:\n  boxes:\n"
            "    - min: [0, 0, 0] # m\n      max: [1, 1, 0.5] # m\n",
            resolution, duration, r->seed);
    fprintf(f,
            "bodies:\n  - name: \"ground\"\n    shape: mesh\n    role: terrain\n    file: \"/somewhere/%s\"\n"
            "  - name: \"wall\"\n    shape: box\n    role: solid\n    min: [1, 0, 0] # m\n    max: [1.2, 4, %g] # m\n"
            "measure:\n  interval: 0.1 # s\n",
            r->ground ? r->ground : "ground.obj", r->wall);
    assert_int_equal(fclose(f), 0);
}

/* Two bodies with forces that grow with time: (3, 4, 0) k t factor N, their overturning moments (5, 12) k t factor N m,
   from t = 1 s on; and the third, "dry", without any. */
static inline void make_tables(const made_run *r)
{
    const int rows = r->rows ? r->rows : 100;
    FILE *f = open_text(r->name, "forces.csv");
    fputs("time_s,body,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm\n", f);
    for (int row = 1; row <= rows; row++) {
        const double t = 10.0 * row / rows, s = t < 1 ? 0 : t * r->factor;
        fprintf(f, "%.9g,house,%.9g,%.9g,0,%.9g,%.9g,0\n", t, 3 * s, 4 * s, 5 * s, 12 * s);
        fprintf(f, "%.9g,%s,%.9g,%.9g,0,%.9g,%.9g,0\n", t, r->body ? r->body : "barn", 6 * s, 8 * s, 10 * s, 24 * s);
        fprintf(f, "%.9g,dry,0,0,0,0,0,0\n", t);
    }
    assert_int_equal(fclose(f), 0);
    f = open_text(r->name, "gauges.csv");
    fprintf(f, "time_s,gauge,eta_m,z_m\n0,near,,0.5\n0.1,near,,%g\n0.2,near,,0.4\n", 0.6 * r->factor);
    assert_int_equal(fclose(f), 0);
    f = open_text(r->name, "overtopping.csv");
    fprintf(f, "time_s,plane,volume_m3,flux_m3_s\n1,crest,%g,1\n2,crest,%g,1\n", 7 * r->factor, 2 * r->factor);
    assert_int_equal(fclose(f), 0);
    f = open_text(r->name, "runup.csv");
    fprintf(f, "time_s,line,x_m,y_m,z_m,front_m,apart_m\n1,up,1,1,%g,2,0\n", 3 * r->factor);
    assert_int_equal(fclose(f), 0);
}

/* 4 x 4 cells of 1 m; the depth of column c and row r (from the south) is (c + 10 r) factor, and the cells of row 3 are
   dry where the wall is higher than 1 m. The cells of the columns 2 and 3 were dry at the start. */
static inline void make_maps(const made_run *r)
{
    char name[256];
    snprintf(name, sizeof name, "%s/maps", r->name);
    mkdir(in_folder(name), 0777);
    FILE *depth = open_text(r->name, "maps/max_depth.asc"), *arrival = open_text(r->name, "maps/arrival_time.asc");
    static const char head[] = "ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n";
    fputs(head, depth);
    fputs(head, arrival);
    for (int row = 3; row >= 0; row--)
        for (int c = 0; c < 4; c++) {
            const bool dry = row == 3 && r->wall > 1;
            fprintf(depth, "%.9g%c", dry ? -9999 : (c + 10 * row) * r->factor, c < 3 ? ' ' : '\n');
            fprintf(arrival, "%d%c", dry ? -9999 : c < 2 ? 0 : 5, c < 3 ? ' ' : '\n');
        }
    assert_int_equal(fclose(depth), 0);
    assert_int_equal(fclose(arrival), 0);
}

static inline void make_run_of(made_run r)
{
    const double resolution = r.resolution > 0 ? r.resolution : 0.1, duration = r.duration > 0 ? r.duration : 10;
    mkdir(in_folder(r.name), 0777);
    make_scene(&r, resolution, duration);
    make_tables(&r);
    if (!r.no_map) make_maps(&r);
    FILE *f = open_text(r.name, "run.jsonl");
    fputs("{\"event\":\"start\",\"version\":\"0.1.0\"}\n", f);
    assert_int_equal(fclose(f), 0);
    f = open_text(r.name, "summary.json");
    fprintf(f,
            "{\"version\":\"0.1.0\",\"title\":\"A basin\",\"status\":\"%s\",\"simulated_s\":%g,\"dimensions\":3,"
            "\"resolution_m\":%g,\"bodies\":[{\"name\":\"house\",\"flow_layers\":2,\"too_coarse\":true,\"gap_m\":null,"
            "\"narrow_gap\":false,\"moment_point_m\":[1.5,1.5,0],\"min_m\":[1,1,0],\"max_m\":[2,2,1]},"
            "{\"name\":\"barn\",\"flow_layers\":6,\"too_coarse\":false,\"gap_m\":null,\"narrow_gap\":false}]}\n",
            r.status ? r.status : "done", duration, resolution);
    assert_int_equal(fclose(f), 0);
}

/* Compares runs of the folder into "out"; returns the status. text: of the terminal, freed with free; may be NULL. */
static inline sb_status compare_runs(const char *const *names, size_t count, char **text, sb_error *error)
{
    static char paths[8][SB_PATH_MAX];
    const char *directories[8];
    size_t size = 0;
    assert_true(count <= 8);
    for (size_t i = 0; i < count; i++) {
        snprintf(paths[i], sizeof paths[i], "%s", in_folder(names[i]));
        directories[i] = paths[i];
    }
    FILE *stream = text ? open_memstream(text, &size) : NULL;
    const sb_compare_options options = {.text = stream};
    const sb_status status = sb_compare_write(directories, count, in_folder("out"), &options, error);
    if (stream) fclose(stream);
    return status;
}

static inline void assert_has(const char *text, const char *expected)
{
    if (!strstr(text, expected)) fail_msg("no \"%s\" in:\n%.3000s", expected, text);
}

#endif
