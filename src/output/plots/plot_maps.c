/* Plots of the maps. */
#include "base/file.h"
#include "base/input.h"
#include "output/maps/maps.h"
#include "output/plots/plot_parts.h"

#include <unistd.h>

static int draw_map(const char *program, const char *directory, const sb_map_row *row, const char *name,
                    const sb_scene *scene, sb_runlog *log)
{
    char grid[SB_PATH_MAX], script[SB_PATH_MAX], title[512];
    sb_error error = {0};
    snprintf(grid, sizeof grid, "%.4000s/maps/%s.asc", directory, name);
    if (access(grid, R_OK) != 0) return 0;
    double columns, rows, x, y, cell;
    FILE *in = NULL;
    bool read =
        sb_input_open(grid, &in, NULL) == SB_OK &&
        fscanf(in, "ncols %lf nrows %lf xllcorner %lf yllcorner %lf cellsize %lf", &columns, &rows, &x, &y, &cell) == 5;
    if (in) fclose(in);
    FILE *out = read && rows > 1 ? sb_plot_open(directory, name, "gp", script, &error) : NULL;
    if (!out) return 0;
    snprintf(title, sizeof title, "%.300s: %s%s", scene->title ? scene->title : "",
             name == row->grid_name ? "grid, " : "", row->label);
    fprintf(out,
            "set terminal pngcairo noenhanced size 1100,900 font 'Sans,11'\n"
            "set output '" SB_PLOT_PART "'\nset size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\n"
            "set palette defined (%s)\nset cblabel '%s'\nset tics out nomirror\nunset key\n%s"
            "set xrange [%.12g:%.12g]\nset yrange [%.12g:%.12g]\nset title ",
            row->palette, row->label, row->from_zero ? "set cbrange [0:*]\n" : "", x, x + columns * cell, y,
            y + rows * cell);
    sb_plot_quote(out, title);
    fprintf(out,
            "\nplot 'maps/%s.asc' skip 6 matrix using (%.12g+($1+0.5)*%.12g):"
            "(%.12g-($2+0.5)*%.12g):($3==-9999?NaN:$3) with image\n",
            name, x, cell, y + rows * cell, cell);
    sb_status status = fclose(out) == 0 ? sb_plot_draw(program, directory, "maps", name, &error)
                                        : sb_fail(&error, SB_FAILED, "cannot write the gnuplot script");
    unlink(script);
    if (status != SB_OK)
        sb_runlog_warning(log, "maps/%s.png: %s", name, error.text);
    else
        sb_runlog_event(log, "plot", "maps/%s.png", name);
    return status == SB_OK;
}

int sb_plot_maps(const char *program, const char *directory, const sb_scene *scene, sb_runlog *log)
{
    int drawn = 0;
    for (const sb_map_row *row = sb_map_rows; row->name; row++) {
        if (!row->drawn) continue;
        drawn += draw_map(program, directory, row, row->name, scene, log) +
                 draw_map(program, directory, row, row->grid_name, scene, log);
    }
    return drawn;
}
