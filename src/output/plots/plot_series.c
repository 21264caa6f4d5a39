/* Plots of the tables over time, with a curve for each body, gauge, probe, plane or run-up line. */
#include "base/file.h"
#include "base/memory.h"
#include "output/plots/plot_parts.h"
#include "output/tables/series.h"

#include <string.h>
#include <unistd.h>

/* One pair of axes. The value is the norm of up to three columns, with `signed_value` the first column, with `change`
   the difference of the first column from its first row. */
typedef struct panel {
    const char *label, *unit;
    bool scaled;    /* the unit may have a prefix k, M, G, T */
    bool extensive; /* per metre in 2D */
    bool signed_value, change;
    int columns[3]; /* 0: none */
} panel;

/* Scenes for which a plot is drawn: elevations are above the still-water level if the scene has one. */
typedef enum scenes { ALL_SCENES, WITH_LEVEL, WITHOUT_LEVEL } scenes;

typedef struct plot {
    const char *name, *title; /* plots/<name>.png from <name>.csv */
    bool named;
    panel panels[3];
    scenes scenes;
} plot;

static const plot plots[] = {
    {"forces",
     "Force on bodies (interval means)",
     true,
     {{"horizontal force", "N", true, true, false, false, {2, 3}},
      {"vertical force", "N", true, true, true, false, {4}}},
     ALL_SCENES},
    {"gauges",
     "Water surface at gauges, above the still-water level",
     true,
     {{"elevation above still water", "m", false, false, true, false, {2}}},
     WITH_LEVEL},
    {"gauges",
     "Water surface at gauges, absolute elevation z",
     true,
     {{"absolute elevation z", "m", false, false, true, false, {3}}},
     WITHOUT_LEVEL},
    {"probes",
     "Velocity and pressure at probes",
     true,
     {{"speed", "m/s", false, false, false, false, {2, 3, 4}}, {"pressure", "Pa", true, false, true, false, {5}}},
     ALL_SCENES},
    {"energy",
     "Energy",
     false,
     {{"kinetic", "J", true, true, true, false, {1}}, {"potential, change", "J", true, true, true, true, {2}}},
     ALL_SCENES},
    {"overtopping",
     "Volume through planes",
     true,
     {{"volume", "m^3", false, true, true, false, {2}}, {"flux", "m^3/s", false, true, true, false, {3}}},
     ALL_SCENES},
    {"runup",
     "Run-up and unconnected water",
     true,
     {{"run-up, absolute z", "m", false, false, true, false, {4}},
      {"front from first end", "m", false, false, true, false, {5}},
      {"length of unconnected water", "m", false, false, true, false, {6}}},
     ALL_SCENES},
};

/* More curves could not be distinguished. */
enum { MAX_LINES = 12, MAX_PANELS = 3 };

static double value_of(const panel *p, const sb_series_row *row, const sb_series_row *first)
{
    double a = row->values[p->columns[0]];
    if (p->change) return a - first->values[p->columns[0]];
    if (p->signed_value) return a;
    double square = 0;
    for (int k = 0; k < 3 && p->columns[k]; k++) square += row->values[p->columns[k]] * row->values[p->columns[k]];
    return sqrt(square);
}

/* Finds the greatest |value| of every name in the first panel, and in `top` that over all names for each panel. */
static void find_peaks(const plot *what, const sb_series *series, double *peaks, double top[MAX_PANELS])
{
    for (size_t i = 0; i < series->row_count; i++)
        for (int k = 0; k < MAX_PANELS && what->panels[k].label; k++) {
            double size = fabs(value_of(&what->panels[k], &series->rows[i], &series->rows[0]));
            double *peak = &peaks[series->rows[i].name];
            if (k == 0 && size > *peak) *peak = size;
            if (size > top[k]) top[k] = size;
        }
}

/* Selects the MAX_LINES names with the greatest peaks: the peaks of the others become -1. Returns their number. */
static size_t choose(double *peaks, size_t count)
{
    size_t chosen = count;
    while (chosen > MAX_LINES) {
        size_t lowest = count;
        for (size_t i = 0; i < count; i++)
            if (peaks[i] >= 0 && (lowest == count || peaks[i] < peaks[lowest])) lowest = i;
        peaks[lowest] = -1;
        chosen--;
    }
    return chosen;
}

/* Writes a block per selected name: time and one column per panel, already scaled. */
static void write_data(FILE *stream, const plot *what, const sb_series *series, const double *peaks,
                       const double scale[MAX_PANELS])
{
    for (size_t name = 0; name < series->name_count; name++) {
        if (peaks[name] < 0) continue;
        for (size_t i = 0; i < series->row_count; i++) {
            const sb_series_row *row = &series->rows[i];
            if (row->name != name) continue;
            fprintf(stream, "%.12g", row->values[0]);
            for (int k = 0; k < MAX_PANELS && what->panels[k].label; k++) {
                double value = value_of(&what->panels[k], row, &series->rows[0]);
                if (isnan(value))
                    fputs(" NaN", stream);
                else
                    fprintf(stream, " %.9g", value / scale[k]);
            }
            fputc('\n', stream);
        }
        fputs("\n\n", stream);
    }
}

static const char *prefix_of(double top, double *scale)
{
    static const struct {
        double scale;
        const char *prefix;
    } steps[] = {{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (top >= steps[i].scale) {
            *scale = steps[i].scale;
            return steps[i].prefix;
        }
    *scale = 1;
    return "";
}

static void write_style(FILE *stream, int panels)
{
    static const char *const colors[MAX_LINES] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                                  "#000000", "#7f3c8d", "#80ba5a", "#a5522d", "#666666", "#e73f74"};
    fprintf(stream,
            "set terminal pngcairo noenhanced size 1200,%d font 'Sans,11'\nset output '" SB_PLOT_PART "'\n"
            "set grid lt 1 lw 0.5 lc rgb '#dddddd'\nset border 3 lc rgb '#555555'\nset tics nomirror\n"
            "set key outside right top Left reverse\nset lmargin 12\nset rmargin 26\n",
            panels > 1 ? 800 : 500);
    for (int i = 0; i < MAX_LINES; i++) fprintf(stream, "set linetype %d lc rgb '%s' lw 1.6\n", i + 1, colors[i]);
    fprintf(stream, "set linetype cycle %d\n", MAX_LINES);
}

static void write_script(FILE *stream, const plot *what, const sb_scene *scene, const sb_series *series,
                         const double *peaks, size_t chosen, char units[MAX_PANELS][16])
{
    char title[512];
    int panels = 0;
    while (panels < MAX_PANELS && what->panels[panels].label) panels++;
    char note[64] = "";
    if (chosen < series->name_count) snprintf(note, sizeof note, " (largest %zu of %zu)", chosen, series->name_count);
    snprintf(title, sizeof title, "%.300s: %s%s", scene->title ? scene->title : "", what->title, note);
    write_style(stream, panels);
    fprintf(stream, "set multiplot layout %d,1 title ", panels);
    sb_plot_quote(stream, title);
    fputs("\nset xlabel 'time (s)'\n", stream);
    for (int k = 0; k < panels; k++) {
        fprintf(stream, "set ylabel '%s (%s)'\n%s", what->panels[k].label, units[k],
                k ? "set key off\nplot " : "plot ");
        size_t block = 0;
        for (size_t name = 0; name < series->name_count; name++) {
            if (peaks[name] < 0) continue;
            fprintf(stream, "%s'plots/%s.dat' index %zu using 1:%d with lines title ", block ? ", " : "", what->name,
                    block, k + 2);
            sb_plot_quote(stream, series->names[name]);
            block++;
        }
        fputc('\n', stream);
    }
    fputs("unset multiplot\n", stream);
}

static void choose_units(const plot *what, const sb_scene *scene, const double top[MAX_PANELS],
                         double scale[MAX_PANELS], char units[MAX_PANELS][16])
{
    for (int k = 0; k < MAX_PANELS && what->panels[k].label; k++) {
        const panel *p = &what->panels[k];
        scale[k] = 1;
        const char *prefix = p->scaled ? prefix_of(top[k], &scale[k]) : "";
        const char *width = p->extensive && scene->dimensions == 2 ? " per m" : "";
        snprintf(units[k], sizeof units[k], "%s%s%s", prefix, p->unit, width);
    }
}

static sb_status draw_series(const char *program, const char *directory, const plot *what, const sb_scene *scene,
                             const sb_series *series, sb_error *error)
{
    char data[SB_PATH_MAX] = "", script[SB_PATH_MAX] = "", units[MAX_PANELS][16] = {{0}};
    double top[MAX_PANELS] = {0}, scale[MAX_PANELS] = {0};
    double *peaks = sb_alloc(series->name_count, sizeof *peaks);
    if (!peaks) return sb_fail_memory(error, "plots");
    find_peaks(what, series, peaks, top);
    size_t chosen = choose(peaks, series->name_count);
    choose_units(what, scene, top, scale, units);
    FILE *out = sb_plot_open(directory, what->name, "dat", data, error);
    sb_status status = out ? SB_OK : SB_FAILED;
    if (out) {
        write_data(out, what, series, peaks, scale);
        if (fclose(out) != 0) status = sb_fail(error, SB_FAILED, "%.500s: cannot write", data);
        out = status == SB_OK ? sb_plot_open(directory, what->name, "gp", script, error) : NULL;
        status = out ? SB_OK : SB_FAILED;
    }
    if (out) {
        write_script(out, what, scene, series, peaks, chosen, units);
        if (fclose(out) != 0) status = sb_fail(error, SB_FAILED, "%.500s: cannot write", script);
    }
    if (status == SB_OK) status = sb_plot_draw(program, directory, "plots", what->name, error);
    if (data[0]) unlink(data);
    if (script[0]) unlink(script);
    sb_free(peaks);
    return status;
}

/* Whether any row has a value. Probes and lines that stay dry have none, and their plot would be empty. */
static bool has_values(const plot *what, const sb_series *series)
{
    for (size_t i = 0; i < series->row_count; i++)
        for (int k = 0; k < MAX_PANELS && what->panels[k].label; k++)
            if (isfinite(value_of(&what->panels[k], &series->rows[i], &series->rows[0]))) return true;
    return false;
}

static int draw_plot(const char *program, const char *directory, const plot *what, const sb_scene *scene,
                     sb_runlog *log)
{
    char path[SB_PATH_MAX];
    sb_error error = {0};
    sb_series series = {0};
    snprintf(path, sizeof path, "%.4000s/%s.csv", directory, what->name);
    if (access(path, R_OK) != 0) return 0;
    sb_status status = sb_series_read(path, what->named, &series, &error);
    int drawn = 0;
    if (status == SB_OK && series.row_count > 1 && !has_values(what, &series)) {
        sb_runlog_event(log, "skipped", "plots/%s.png: %s.csv contains dry places only", what->name, what->name);
    } else if (status == SB_OK && series.row_count > 1) {
        status = draw_series(program, directory, what, scene, &series, &error);
        drawn = status == SB_OK;
    }
    if (drawn) sb_runlog_event(log, "plot", "plots/%s.png", what->name);
    if (status != SB_OK) sb_runlog_warning(log, "plots/%s.png: %s", what->name, error.text);
    sb_series_free(&series);
    return drawn;
}

int sb_plot_series(const char *program, const char *directory, const sb_scene *scene, sb_runlog *log)
{
    int drawn = 0;
    for (size_t i = 0; i < sizeof plots / sizeof *plots; i++) {
        const scenes other = scene->sea.present ? WITHOUT_LEVEL : WITH_LEVEL;
        if (plots[i].scenes != other) drawn += draw_plot(program, directory, &plots[i], scene, log);
    }
    return drawn;
}
