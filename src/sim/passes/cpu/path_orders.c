#include "sim/passes/cpu/path_orders.h"

#include "sim/search/around.h"

#include <string.h>

enum { PLACES = SB_REFLECTIONS_MAX, PAIRS = PLACES * (PLACES - 1) / 2, ORDERS = 24 };

/* All orders of four places; the first two and six are those of two and three places. */
static const uint8_t ORDER[ORDERS][PLACES] = {
    {0, 1, 2, 3}, {1, 0, 2, 3}, {0, 2, 1, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {2, 1, 0, 3}, {0, 1, 3, 2}, {1, 0, 3, 2},
    {0, 2, 3, 1}, {1, 2, 3, 0}, {2, 0, 3, 1}, {2, 1, 3, 0}, {0, 3, 1, 2}, {1, 3, 0, 2}, {0, 3, 2, 1}, {1, 3, 2, 0},
    {2, 3, 0, 1}, {2, 3, 1, 0}, {3, 0, 1, 2}, {3, 1, 0, 2}, {3, 0, 2, 1}, {3, 1, 2, 0}, {3, 2, 0, 1}, {3, 2, 1, 0}};
static const int ORDERS_OF[PLACES + 1] = {1, 1, 2, 6, 24};

/* A path: how its facets stand to each other, by pair of places. */
typedef struct word {
    int count, orders;
    const size_t *by;
    float sectors[PLACES][PLACES]; /* 0: the same facet */
    bool blunt;                    /* two facets meet at more than a right angle */
} word;

/* What becomes of the sum over orders: its value, and its derivative by the measure of each order. */
typedef struct shares {
    float value, by_measure[ORDERS];
} shares;

static float clamp(float x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* Bit of a pair of places p < q. */
static uint32_t bit(int p, int q)
{
    return (uint32_t)1 << (q * (q - 1) / 2 + p);
}

/* Pairs of places that an order turns round. */
static uint32_t turned(const word *w, int order)
{
    uint32_t pairs = 0;
    for (int m = 1; m < w->count; m++)
        for (int k = 0; k < m; k++)
            if (ORDER[order][k] > ORDER[order][m]) pairs |= bit(ORDER[order][m], ORDER[order][k]);
    return pairs;
}

/* Part of a path that comes back to a facet: none if the reflections between can be exchanged with it. kept: pairs of
   places that cannot. */
static float returning(const word *w, uint32_t kept)
{
    float part = 1;
    for (int q = 2; q < w->count; q++)
        for (int p = q - 2; p >= 0; p--) {
            if (w->sectors[p][q] != 0) continue;
            int between = 0, which = 0;
            for (int r = p + 1; r < q; r++)
                if (kept & bit(p, r)) between++, which = r;
            const float most = w->count == 4 && w->sectors[0][2] == 0 && w->sectors[1][3] == 0 ? 3.5f : 2.5f;
            if (between == 0) return 0;
            if (between == 1) part = fminf(part, clamp(w->sectors[p][which] - most));
            break;
        }
    return part;
}

/* Adds the share of the first order among those that keep the order of the pairs `kept`. */
static void add_share(const word *w, uint32_t kept, uint32_t distinct, float part, const float *measure, shares *out)
{
    float sum = 0, same = 0;
    bool counts[ORDERS];
    for (int k = 0; k < w->orders; k++) {
        const uint32_t turns = turned(w, k);
        counts[k] = (turns & kept) == 0;
        sum += counts[k] ? measure[k] : 0;
        same += (turns & distinct) == 0;
    }
    if (!(sum > 0)) return;
    const float value = part * same * measure[0] / sum;
    out->value += value;
    out->by_measure[0] += part * same / sum;
    for (int k = 0; k < w->orders; k++) out->by_measure[k] -= counts[k] ? value / sum : 0;
}

/* Sums over the cases in which pairs at less than a right angle can be exchanged (as at a right angle) or not (from 72
   degrees down), each with its part. measure: of each order. */
static shares sum_cases(const word *w, const float *measure)
{
    shares out = {0};
    uint32_t sure = 0, distinct = 0, mask[PAIRS];
    float part[PAIRS], all = 1;
    int open = 0;
    for (int q = 1; q < w->count; q++)
        for (int p = 0; p < q; p++) {
            const float sectors = w->sectors[p][q];
            if (sectors != 2) distinct |= bit(p, q);
            const float apart = sectors == 0 ? 1 : clamp(2 * sectors - 4);
            bool repeated = false; /* the same two facets in other places */
            for (int n = 0; n < q * (q - 1) / 2 + p && !repeated; n++) {
                int b = 1, a = n;
                while (a >= b) a -= b++;
                const bool same =
                    (w->by[a] == w->by[p] && w->by[b] == w->by[q]) || (w->by[a] == w->by[q] && w->by[b] == w->by[p]);
                if (!same) continue;
                repeated = true;
                for (int k = 0; k < open; k++)
                    if (mask[k] & bit(a, b)) mask[k] |= bit(p, q);
            }
            if (apart == 1) sure |= bit(p, q);
            if (!repeated && sectors != 0) all *= clamp(2 * sectors - 3);
            if (repeated || apart == 0 || apart == 1) continue;
            mask[open] = bit(p, q);
            part[open++] = apart;
        }
    if (all == 0) return out;
    for (uint32_t chosen = 0; chosen < (uint32_t)1 << open; chosen++) {
        uint32_t kept = sure;
        float share = all;
        for (int k = 0; k < open; k++) {
            const bool apart = chosen >> k & 1;
            share *= apart ? part[k] : 1 - part[k];
            kept |= apart ? mask[k] : 0;
        }
        share *= returning(w, kept);
        if (share > 0) add_share(w, kept, distinct, share, measure, &out);
    }
    return out;
}

/* ---- blunt corners ---- */

static sb_f4 image_by(const sb_near *near, const word *w, const uint8_t *order, sb_f4 at)
{
    for (int k = 0; k < w->count; k++) at = sb_reflect(near->facet[w->by[order[k]]].plane, at);
    return at;
}

/* By how much a path is longer than the straight line: a quarter of the difference of the squares. */
static float excess(sb_f4 self, sb_f4 source, sb_f4 image)
{
    const sb_f4 path = self - image, line = self - source;
    return 0.25f * (sb_sum3(path * path) - sb_sum3(line * line));
}

/* Adds the derivatives of an order's excess, times `scale`: by self, and by the planes of the facets along their
   normals. */
static void add_slopes(const sb_near *near, const word *w, const uint8_t *order, sb_f4 self, sb_f4 source, float scale,
                       sb_f4 *own, float *plane)
{
    const sb_f4 image = image_by(near, w, order, source), keep = {1, 1, 1, 0};
    *own += (source - image) * keep * sb_splat(0.5f * scale);
    sb_f4 way = self - image;
    for (int k = w->count; k-- > 0;) {
        const sb_f4 normal = near->facet[w->by[order[k]]].plane;
        const float along = sb_sum3(way * normal);
        plane[order[k]] -= scale * along;
        way -= normal * sb_splat(2 * along);
    }
}

/* Derivatives of a share that depends on places. */
static void find_slopes(const sb_near *near, const word *w, sb_f4 self, sb_f4 source, const shares *of,
                        const float *length, sb_path_share *out)
{
    sb_f4 own = {0};
    float plane[PLACES] = {0};
    for (int k = 0; k < w->orders; k++)
        if (length[k] > 0 && of->by_measure[k] != 0)
            add_slopes(near, w, ORDER[k], self, source, 2 * length[k] * of->by_measure[k], &own, plane);
    for (int k = 0; k < w->count; k++) {
        const sb_f4 normal = near->facet[w->by[k]].plane * (sb_f4){1, 1, 1, 0};
        out->at[k] = k;
        out->own[k] = k == 0 ? own : (sb_f4){0};
        out->other[k] = -normal * sb_splat(plane[k]) - out->own[k];
    }
    out->facets = w->count;
}

bool sb_path_order_share(const sb_near *near, const size_t *by, int count, sb_f4 self, sb_f4 source, sb_path_share *out)
{
    word w = {.count = count, .orders = ORDERS_OF[count], .by = by};
    for (int q = 1; q < count; q++)
        for (int p = 0; p < q; p++) {
            w.sectors[p][q] = w.sectors[q][p] = by[p] == by[q] ? 0 : near->sectors[by[p]][by[q]];
            w.blunt |= by[p] != by[q] && w.sectors[p][q] < 2;
        }
    float measure[ORDERS], length[ORDERS];
    for (int k = 0; k < w.orders; k++) measure[k] = 1;
    if (w.blunt) {
        float most = 0;
        for (int k = 0; k < w.orders; k++) {
            length[k] = excess(self, source, image_by(near, &w, ORDER[k], source));
            most = fmaxf(most, length[k]);
        }
        if (!(most > 0)) return false;
        for (int k = 0; k < w.orders; k++) measure[k] = length[k] > 0 ? length[k] * length[k] : 0;
    }
    const shares s = sum_cases(&w, measure);
    *out = (sb_path_share){.value = s.value};
    if (s.value > 0 && w.blunt) find_slopes(near, &w, self, source, &s, length, out);
    return s.value > 0;
}
