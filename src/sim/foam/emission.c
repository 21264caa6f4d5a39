/* New particles of foam. */
#include "base/memory.h"
#include "base/random.h"
#include "sim/exchange/exchange.h"
#include "sim/foam/foam.h"

#include <math.h>
#include <string.h>

/* Uses of random numbers: which ones, and those of each new particle. */
enum { WHETHER, RADIUS, ANGLE, WAY, LIFE, USES };
enum { NUMBERS = 1 << 13 }; /* random numbers of a particle of water in a step: USES times those that it emits */

static double random_of(const sb_sim *sim, uint32_t id, uint64_t number)
{
    return sb_random(sim->state.step, (uint64_t)id * NUMBERS + number);
}

/* The factor on expected numbers: 1 up to half of the largest count, then less, and never more than there is room for.
   Sums of whole numbers do not depend on the threads. */
static double thinning(const sb_sim *sim)
{
    const size_t n = sim->state.n;
    const double most = sim->scene->foam.most, room = most - (double)sim->foam->count;
    uint64_t all = 0;
#pragma omp parallel for schedule(static) reduction(+ : all)
    for (size_t i = 0; i < n; i++) all += sim->work.emission[i];
    sim->exchange->count(sim, &all, 1);
    const double wanted = (double)all / SB_FOAM_ONE;
    return fmin(fmin(1, 2 * room / most), wanted > 0 ? room / wanted : 1);
}

/* Numbers of new particles: before those of this domain, of this domain with those before, and of all. */
typedef struct numbers {
    size_t begin, end, all;
} numbers;

static size_t limited(uint64_t sum, size_t room)
{
    return sum < room ? (size_t)sum : room;
}

/* The numbers of the domains, from those that each would emit with enough room; sizes: bytes that each has emitted. */
static numbers numbers_of(const sb_sim *sim, uint64_t own, size_t room, size_t *sizes)
{
    uint64_t all[SB_RANKS_MAX], sum = 0;
    numbers found = {0};
    sb_ranks_gather(sim->ranks, &own, sizeof own, all);
    for (int r = 0; r < sb_ranks_count(sim->ranks); r++) {
        const size_t begin = limited(sum, room), end = limited(sum + all[r], room);
        if (r == sb_ranks_own(sim->ranks)) found = (numbers){begin, end, 0};
        sizes[r] = (end - begin) * sizeof *sim->foam->particle;
        sum += all[r];
    }
    found.all = limited(sum, room);
    return found;
}

/* Replaces expected numbers by whole ones, and these by the number before each. */
static numbers number(sb_sim *sim, double factor, size_t room, size_t *sizes)
{
    const size_t n = sim->state.n;
    uint32_t *emission = sim->work.emission;
    uint64_t own = 0; /* a whole number, as in thinning */
#pragma omp parallel for schedule(static) reduction(+ : own)
    for (size_t i = 0; i < n; i++) {
        if (emission[i] == 0) continue;
        emission[i] = (uint32_t)(factor * emission[i] / SB_FOAM_ONE + random_of(sim, sim->state.id[i], WHETHER));
        own += emission[i];
    }
    const numbers found = numbers_of(sim, own, room, sizes);
    size_t sum = found.begin;
    for (size_t i = 0; i < n; i++) {
        const uint32_t one = emission[i];
        emission[i] = (uint32_t)sum;
        sum += one <= room - sum ? one : room - sum;
    }
    return found;
}

/* Two unit vectors across a velocity and each other; in 2D the second is 0. */
static void across(const sb_sim *sim, sb_f4 way, sb_f4 out[2])
{
    if (sim->constant.dimension == 2) {
        out[0] = (sb_f4){-way[2], 0, way[0], 0};
        out[1] = (sb_f4){0};
        return;
    }
    const bool steep = fabsf(way[2]) > 0.7f;
    const sb_f4 side = steep ? (sb_f4){-way[2], 0, way[0], 0} : (sb_f4){-way[1], way[0], 0, 0};
    out[0] = side / sb_splat(sqrtf(sb_sum3(side * side)));
    out[1] = (sb_f4){way[1] * out[0][2] - way[2] * out[0][1], way[2] * out[0][0] - way[0] * out[0][2],
                     way[0] * out[0][1] - way[1] * out[0][0], 0};
}

/* The k-th new particle of a particle of water: within its volume, anywhere along its way in this step, and spread
   across it as fast as its water is mixed, at sqrt(g dr) at most. */
static sb_foam_particle new_particle(const sb_sim *sim, size_t i, uint32_t k)
{
    const uint32_t id = sim->state.id[i];
    double chance[USES];
    for (int use = RADIUS; use < USES; use++)
        chance[use] = random_of(sim, id, (uint64_t)USES * (k + 1) + (uint64_t)use);
    const sb_foam_law *law = &sim->foam->law;
    const sb_f4 v = sim->work.end_velocity[i];
    const float speed = sqrtf(sb_sum3(v * v)), dt = (float)sim->state.time_step;
    const float radius = (float)sqrt(chance[RADIUS]), angle = (float)(2 * M_PI * chance[ANGLE]);
    sb_f4 axis[2] = {{0}, {0}};
    if (speed > 0) across(sim, v / sb_splat(speed), axis);
    const sb_f4 aside = (axis[0] * sb_splat(cosf(angle)) + axis[1] * sb_splat(sinf(angle))) * sb_splat(radius);
    const sb_f4 way = aside * sb_splat(0.5f * sim->constant.spacing) + v * sb_splat(dt * (float)chance[WAY]);
    sb_foam_particle made = {.kind = SB_FOAM_FLOATS, .id = sim->foam->next_id + sim->work.emission[i] + k};
    made.position = sb_space_wrap(&sim->space, sb_foam_displaced(sim, sim->state.position[i], way));
    made.velocity = v + aside * sb_splat(0.5f * law->trapped.to);
    made.velocity[3] = law->lifetime * (float)(1 + 2 * chance[LIFE]) / 3;
    return made;
}

/* Gives all domains the new particles of each. Returns 0, or -1 without memory in any domain. */
static int share_new(sb_sim *sim, numbers new, const size_t *sizes)
{
    sb_foam *foam = sim->foam;
    if (!sb_ranks_several(sim->ranks)) return 0;
    const size_t length = sizes[sim->ranks->rank];
    sb_foam_particle *own = sb_alloc_untouched(length, 1);
    if (!sb_ranks_any(sim->ranks, !own)) {
        if (length > 0) memcpy(own, foam->particle + foam->count + new.begin, length);
        sb_ranks_spread(sim->ranks, own, foam->particle + foam->count, sizes);
        sb_free(own);
        return 0;
    }
    sb_free(own);
    return -1;
}

int sb_foam_emit(sb_sim *sim)
{
    sb_foam *foam = sim->foam;
    const size_t n = sim->state.n, room = (size_t)sim->scene->foam.most - foam->count;
    const uint32_t *emission = sim->work.emission;
    size_t sizes[SB_RANKS_MAX];
    const numbers new = number(sim, thinning(sim), room, sizes);
    const int grown = sb_grow((void **)&foam->particle, &foam->capacity, foam->count + new.all, sizeof *foam->particle);
    if (sb_ranks_any(sim->ranks, grown != 0)) return -1;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        const uint32_t end = i + 1 < n ? emission[i + 1] : (uint32_t) new.end;
        for (uint32_t k = 0; k < end - emission[i]; k++)
            foam->particle[foam->count + emission[i] + k] = new_particle(sim, i, k);
    }
    if (share_new(sim, new, sizes) != 0) return -1;
    foam->count += new.all;
    foam->next_id += (uint32_t) new.all;
    return 0;
}
