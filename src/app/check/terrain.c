#include "app/check/terrain.h"

#include <stdio.h>
#include <string.h>

static void print_lines(const char *line)
{
    for (size_t length; *line; line += length + (line[length] == '\n')) {
        length = strcspn(line, "\n");
        printf("    %.*s\n", (int)length, line);
    }
}

void sb_check_terrain_text(const sb_model *model)
{
    for (size_t b = 0; b < model->body_count; b++) {
        if (!model->bodies[b].mesh.told) continue;
        printf("  terrain \"%s\"\n", model->bodies[b].name);
        print_lines(model->bodies[b].mesh.told);
    }
}

void sb_check_bed_text(const sb_scene *scene, const sb_offshore_told_list *told)
{
    if (scene->offshore.terrain_count > 0)
        printf(
            "  bed                read at the centres of cells of %g m, linear between the nodes of offshore.terrain; "
            "later grids cover earlier ones\n",
            scene->offshore.cell);
    for (size_t i = 0; i < told->count; i++) {
        printf(told->items[i].is_key ? "  %s\n" : "  terrain \"%s\"\n", told->items[i].name);
        print_lines(told->items[i].text);
    }
}

void sb_check_bed_json(const sb_offshore_told_list *told, sb_json *json)
{
    sb_json_open(json, "bed", '[');
    for (size_t i = 0; i < told->count; i++) {
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", told->items[i].name);
        sb_json_text(json, "terrain", told->items[i].text);
        sb_json_close(json);
    }
    sb_json_close(json);
}
