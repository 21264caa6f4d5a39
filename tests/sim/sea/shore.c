#include "sim/sea/shore.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { TEXT = 128 };

static void write_vector(char text[TEXT], int dimensions, sb_vec3 v)
{
    if (dimensions == 2)
        snprintf(text, TEXT, "[%.17g, %.17g]", v.x, v.z);
    else
        snprintf(text, TEXT, "[%.17g, %.17g, %.17g]", v.x, v.y, v.z);
}

sb_status shore_try(shore *s, const shore_form *f, const char *sea, sb_error *error)
{
    char flat[8], spacing[32], max[TEXT], low[TEXT], inside[TEXT], water[2 * TEXT];
    snprintf(flat, sizeof flat, "%d", f->dimensions);
    snprintf(spacing, sizeof spacing, "%.17g", f->spacing);
    write_vector(max, f->dimensions, f->size);
    write_vector(low, f->dimensions, sb_vec(0, 0, 0));
    write_vector(inside, f->dimensions, sb_vec(f->size.x / 2, f->size.y / 2, f->depth - f->spacing));
    snprintf(water, sizeof water, "{level: %.17g, seed: %s}", f->depth, inside);
    sb_override set[] = {{"dimensions", flat},
                         {"resolution", spacing},
                         {"domain.min", low},
                         {"domain.max", max},
                         {"domain.sides", f->sides},
                         {"water", water},
                         {"bodies", f->bodies ? f->bodies : "[]"},
                         {"sea", sea ? sea : "{source: none}"}};
    *s = (shore){.model = {.dimensions = 0}};
    sb_status status =
        sb_scene_read(SB_SOURCE_DIR "/tests/sim/tank.yaml", NULL, set, sizeof set / sizeof *set, &s->scene, error);
    return status == SB_OK ? sb_model_build(&s->scene, &s->model, error) : status;
}

void shore_make(shore *s, const shore_form *form, const char *sea)
{
    sb_error error = {0};
    if (shore_try(s, form, sea, &error) == SB_OK) return;
    fprintf(stderr, "no shore: %s\n", error.text);
    abort();
}

void shore_free(shore *s)
{
    sb_model_free(&s->model);
    sb_scene_free(&s->scene);
}

sb_sim *shore_sim(shore *s)
{
    sb_error error = {0};
    sb_sim *sim = NULL;
    sb_status status = sb_sim_create(&s->scene, &s->model, NULL, &sim, &error);
    if (status == SB_OK) status = sb_sim_settle(sim, &error);
    if (status == SB_OK) return sim;
    fprintf(stderr, "no simulation: %s\n", error.text);
    abort();
}

void shore_run(sb_sim *sim, double until)
{
    sb_error error = {0};
    while (sim->state.time < until)
        if (sb_sim_step(sim, &error) != SB_OK) {
            fprintf(stderr, "no step: %s\n", error.text);
            abort();
        }
}

double shore_volume(const sb_sim *sim)
{
    return (double)sim->state.n * (double)sim->constant.mass / (double)sim->constant.rest_density;
}

double shore_depth(const sb_sim *sim, double x, double reach)
{
    double sum = 0;
    const double width = sim->constant.dimension == 2 ? 1 : sim->model->max.y - sim->model->min.y;
    for (size_t i = 0; i < sim->state.n; i++) {
        const double d = sb_space_position(&sim->space, sim->state.position[i]).x - x;
        if (fabs(d) < reach) sum += 0.5 * (1 + cos(M_PI * d / reach));
    }
    return sum * (double)sim->constant.mass / (double)sim->constant.rest_density / (reach * width);
}
