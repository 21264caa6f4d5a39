/* Plots of the maps. */
#include "base/file.h"
#include "base/input.h"
#include "output/plot_parts.h"

#include <unistd.h>

#define FROM_ZERO "set cbrange [0:*]\n"

static const struct {
    const char *name, *label, *palette, *range;
} maps[] = {
    {"max_depth", "greatest depth (m)", "0 '#ffffff', 0.02 '#deebf7', 0.4 '#6baed6', 1 '#08306b'", FROM_ZERO},
    {"max_speed", "greatest speed (m/s)", "0 '#ffffe5', 0.5 '#fe9929', 1 '#662506'", FROM_ZERO},
    {"max_momentum_flux", "greatest momentum flux (m^3/s^2)", "0 '#fff7f3', 0.5 '#f768a1', 1 '#49006a'", FROM_ZERO},
    {"arrival_time", "arrival time (s)", "0 '#440154', 0.5 '#21918c', 1 '#fde725'", ""},
};

static int draw_map(const char *program, const char *directory, size_t k, const sb_scene *scene, sb_runlog *log)
{
    char grid[SB_PATH_MAX], script[SB_PATH_MAX], title[512];
    sb_error error = {0};
    snprintf(grid, sizeof grid, "%.4000s/maps/%s.asc", directory, maps[k].name);
    if (access(grid, R_OK) != 0) return 0;
    double columns, rows, x, y, cell;
    FILE *in = NULL;
    bool read =
        sb_input_open(grid, &in, NULL) == SB_OK &&
        fscanf(in, "ncols %lf nrows %lf xllcorner %lf yllcorner %lf cellsize %lf", &columns, &rows, &x, &y, &cell) == 5;
    if (in) fclose(in);
    FILE *out = read && rows > 1 ? sb_plot_open(directory, maps[k].name, "gp", script, &error) : NULL;
    if (!out) return 0;
    snprintf(title, sizeof title, "%.300s: %s", scene->title ? scene->title : "", maps[k].label);
    fprintf(out,
            "set terminal pngcairo noenhanced size 1100,900 font 'Sans,11'\n"
            "set output '" SB_PLOT_PART "'\nset size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\n"
            "set palette defined (%s)\nset cblabel '%s'\nset tics out nomirror\nunset key\n%s"
            "set xrange [%.12g:%.12g]\nset yrange [%.12g:%.12g]\nset title ",
            maps[k].palette, maps[k].label, maps[k].range, x, x + columns * cell, y, y + rows * cell);
    sb_plot_quote(out, title);
    fprintf(out,
            "\nplot 'maps/%s.asc' skip 6 matrix using (%.12g+($1+0.5)*%.12g):"
            "(%.12g-($2+0.5)*%.12g):($3==-9999?NaN:$3) with image\n",
            maps[k].name, x, cell, y + rows * cell, cell);
    sb_status status = fclose(out) == 0 ? sb_plot_draw(program, directory, "maps", maps[k].name, &error)
                                        : sb_fail(&error, SB_FAILED, "cannot write the gnuplot script");
    unlink(script);
    if (status != SB_OK)
        sb_runlog_warning(log, "maps/%s.png: %s", maps[k].name, error.text);
    else
        sb_runlog_event(log, "plot", "maps/%s.png", maps[k].name);
    return status == SB_OK;
}

int sb_plot_maps(const char *program, const char *directory, const sb_scene *scene, sb_runlog *log)
{
    int drawn = 0;
    for (size_t k = 0; k < sizeof maps / sizeof *maps; k++) drawn += draw_map(program, directory, k, scene, log);
    return drawn;
}
