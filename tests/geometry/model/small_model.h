/* A small scene that the tests of the model modify, and the model built from it. */
#ifndef SB_TESTS_SMALL_MODEL_H
#define SB_TESTS_SMALL_MODEL_H

#include "base/memory.h"
#include "geometry/model/model.h"
#include "physics/wavemakers/wavemaker.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static sb_scene scene;
static sb_body bodies[16];
static sb_wavemaker_use wavemaker;
static sb_model model;
static sb_error error;

static int set_up(void **state)
{
    (void)state;
    memset(&scene, 0, sizeof scene);
    memset(bodies, 0, sizeof bodies);
    memset(&wavemaker, 0, sizeof wavemaker);
    wavemaker.law = (sb_wavemaker_parameters){.kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 1};
    memset(&error, 0, sizeof error);
    scene.dimensions = 3;
    scene.resolution = 0.5;
    scene.duration = 10;
    scene.fluid = (sb_fluid_properties){.density = 1000, .gravity = 9.81};
    scene.domain.min = sb_vec(0, 0, 0);
    scene.domain.max = sb_vec(10, 6, 5);
    scene.domain.side[SB_Z_MAX] = SB_SIDE_OPEN;
    scene.sea = (sb_sea){true, 3, {2, 3, 2}};
    scene.numerics.support = 2;
    scene.numerics.wall_offset = 0.5;
    scene.numerics.wall_spacing = 1;
    scene.bodies = bodies;
    scene.wavemakers = &wavemaker;
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    sb_model_free(&model);
    return 0;
}

static sb_body *add_box(const char *name, sb_vec3 min, sb_vec3 max)
{
    sb_body *body = &bodies[scene.body_count++];
    snprintf(body->name, sizeof body->name, "%s", name);
    body->shape = SB_SHAPE_BOX;
    body->color[0] = -1;
    body->min = min;
    body->max = max;
    return body;
}

/* Adds a body with a mesh file; the caller may change its shape. */
static inline sb_body *add_file(const char *name, char *path)
{
    sb_body *body = add_box(name, sb_vec(0, 0, 0), sb_vec(0, 0, 0));
    body->shape = SB_SHAPE_MESH;
    body->file = path;
    body->up = 'z';
    body->scale = 1;
    return body;
}

static void build(void)
{
    sb_model_free(&model);
    sb_status status = sb_model_build(&scene, &model, &error);
    if (status != SB_OK) print_message("%s\n", error.text);
    assert_int_equal(status, SB_OK);
}

static inline bool warned(const char *first, const char *second)
{
    for (size_t i = 0; i < model.warning_count; ++i)
        if (strstr(model.warnings[i], first) && strstr(model.warnings[i], second)) return true;
    return false;
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)

#endif
