/* Faces of bodies, and the face on which a force acts, against a search of all triangles. */
#include "base/random.h"
#include "geometry/model/faces.h"
#include "geometry/solid/tree.h"
#include "small_model.h"

#include <math.h>

enum { PLACES = 4000 };

/* A house, a round tower beside it, ground and a wall that moves. */
static void make(sb_faces *faces, double reach)
{
    add_box("house", sb_vec(2, 2, 0), sb_vec(4, 3, 4));
    sb_body *tower = add_box("tower", sb_vec(0, 0, 0), sb_vec(0, 0, 0));
    tower->shape = SB_SHAPE_CYLINDER;
    tower->center = sb_vec(6, 3, 0);
    tower->radius = 1;
    tower->height = 4.5;
    add_box("ground", sb_vec(8, 0, 0), sb_vec(10, 6, 1))->role = SB_ROLE_TERRAIN;
    build();
    assert_int_equal(sb_faces_make(&model, scene.resolution, reach, faces, &error), SB_OK);
}

static void faces_have_the_area_of_their_body(void **state)
{
    (void)state;
    sb_faces faces;
    double area[2] = {0};
    size_t count[2] = {0}, triangles = 0;
    make(&faces, 1);
    for (size_t f = 0; f < faces.count; f++) {
        assert_true(faces.list[f].body < 2);
        area[faces.list[f].body] += faces.list[f].area;
        count[faces.list[f].body]++;
    }
    assert_int_equal(count[0], 6);
    assert_true(fabs(area[0] - 2 * (2 * 1 + 2 * 4 + 1 * 4)) < 1e-9);
    assert_true(count[1] > 10 && fabs(area[1] / (2 * M_PI * (1 + 4.5)) - 1) < 0.03);
    for (size_t t = 0; t < faces.all_count; t++) triangles += faces.of[t] != UINT32_MAX;
    assert_int_equal(triangles, faces.triangle_count);
    assert_int_equal(triangles, model.bodies[0].mesh.triangle_count + model.bodies[1].mesh.triangle_count);
    sb_faces_free(&faces);
}

static uint32_t search_all(const sb_faces *faces, size_t body, sb_vec3 at, sb_vec3 along)
{
    double least = HUGE_VAL;
    uint32_t found = UINT32_MAX;
    for (size_t k = 0; k < faces->triangle_count; k++) {
        const sb_face_triangle *t = &faces->triangles[k];
        if (faces->list[t->face].body != body) continue;
        const sb_solid_triangle plain = {.a = t->corner[0], .b = t->corner[1], .c = t->corner[2]};
        const double cost =
            sb_norm(sb_sub(at, sb_solid_nearest_on(&plain, at))) + scene.resolution * (1 - sb_dot(t->normal, along));
        if (cost < least) found = t->face;
        least = fmin(cost, least);
    }
    return found;
}

static void nearest_faces_are_those_of_a_full_search(void **state)
{
    (void)state;
    size_t met[64] = {0}, various = 0;
    sb_faces faces;
    make(&faces, 1.25);
    for (uint64_t k = 0; k < PLACES; k++) {
        double u[6];
        for (uint64_t c = 0; c < 6; c++) u[c] = sb_random(8, 6 * k + c);
        const sb_vec3 at = sb_vec(1 + 7 * u[0], 1 + 4 * u[1], 5 * u[2]); /* also farther away than the reach */
        const sb_vec3 along = sb_normalize(sb_vec(u[3] - 0.5, u[4] - 0.5, u[5] - 0.5));
        const size_t body = k % 2;
        const uint32_t face = sb_faces_nearest(&faces, body, at, along);
        assert_int_equal(face, search_all(&faces, body, at, along));
        various += met[face % 64]++ == 0;
    }
    assert_true(various > 20);
    assert_int_equal(sb_faces_nearest(&faces, 2, sb_vec(8, 3, 1), sb_vec(0, 0, 1)), UINT32_MAX);
    sb_faces_free(&faces);
}

/* Each triangle within the reach of a place is among those near it. */
static void no_near_triangle_is_left_out(void **state)
{
    (void)state;
    const double reach = 0.7;
    size_t within = 0;
    sb_faces faces;
    make(&faces, reach);
    for (uint64_t k = 0; k < PLACES; k++) {
        const sb_vec3 at =
            sb_vec(1 + 7 * sb_random(9, 3 * k), 1 + 4 * sb_random(9, 3 * k + 1), 5 * sb_random(9, 3 * k + 2));
        const uint32_t *near;
        const size_t count = sb_faces_near(&faces, at, &near);
        size_t next = 0;
        for (size_t t = 0; t < faces.triangle_count; t++) {
            const sb_vec3 *c = faces.triangles[t].corner;
            const sb_solid_triangle plain = {.a = c[0], .b = c[1], .c = c[2]};
            while (next < count && near[next] < t) next++;
            if (sb_norm(sb_sub(at, sb_solid_nearest_on(&plain, at))) > reach) continue;
            within++;
            assert_true(next < count && near[next] == t);
        }
    }
    assert_true(within > PLACES);
    sb_faces_free(&faces);
}

int main(void)
{
    const struct CMUnitTest tests[] = {CASE(faces_have_the_area_of_their_body),
                                       CASE(nearest_faces_are_those_of_a_full_search),
                                       CASE(no_near_triangle_is_left_out)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
