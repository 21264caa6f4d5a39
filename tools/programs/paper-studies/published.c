#include "published.h"

#include <math.h>

#define NONE ((double)NAN)

/* clang-format off */
const sb_published sb_published_runs[] = {
    /* no  dr  N_f       N_b       xi      m           lambda step   sweeps T       T_c    T_q    T_a    T_p */
    { 1,   4,  180e3,    4000e3,   0.001,  4360001,    0.05,  0.041,  5.5,  2080,   112,   1145,  364,   459},
    { 2,   4,  180e3,    4000e3,   0.001,  4360001,    0.075, 0.060, 14.7,  1711,   73,    641,   239,   758},
    { 3,   4,  180e3,    4000e3,   0.001,  4360001,    0.1,   0.077, 27.9,  1776,   58,    411,   190,   1117},
    { 4,   4,  180e3,    4000e3,   0.001,  4360001,    0.2,   0.095, 44.3,  2070,   50,    354,   166,   1500},
    { 5,   4,  180e3,    4000e3,   0.001,  180001,     0.075, NONE,  NONE,  2025,   67,    961,   NONE,  NONE},
    { 6,   4,  180e3,    4000e3,   0.001,  360007,     0.075, NONE,  NONE,  1847,   69,    781,   NONE,  NONE},
    { 7,   4,  180e3,    4000e3,   0.001,  8360003,    0.075, NONE,  NONE,  1684,   76,    611,   NONE,  NONE},
    { 8,   4,  180e3,    4000e3,   0.00025, 4360001,   0.075, NONE,  44.7,  3317,   NONE,  NONE,  NONE,  2364},
    { 9,   4,  180e3,    4000e3,   0.0005, 4360001,    0.075, NONE,  26.4,  2278,   NONE,  NONE,  NONE,  1325},
    {10,   4,  180e3,    4000e3,   0.002,  4360001,    0.075, NONE,   8.7,  1424,   NONE,  NONE,  NONE,  471},
    {11,   4,  180e3,    4000e3,   0.004,  4360001,    0.075, NONE,   5.0,  1228,   NONE,  NONE,  NONE,  275},
    {12,   1,  18020e3,  18190e3,  0.001,  54230023,   0.075, 0.015, 14.7,  233317, 23578, 34580, 25479, 149680},
    {13,   2,  2040e3,   7370e3,   0.001,  11450003,   0.075, 0.030, 14.2,  16506,  1369,  3103,  2175,  9859},
    {14,   3,  660e3,    4890e3,   0.001,  6210011,    0.075, 0.046, 13.3,  4858,   350,   1628,  588,   2292},
    {15,   5,  100e3,    3330e3,   0.001,  3530011,    0.075, 0.075, 17,    1198,   34,    527,   139,   498},
    {.number = 0},
};
/* clang-format on */

static const int lambda[] = {1, 2, 3, 4, 0}, table[] = {5, 6, 2, 7, 0}, tolerance[] = {8, 9, 2, 10, 11, 0},
                 spacing[] = {15, 2, 14, 13, 12, 0};

const sb_published_set sb_published_sets[] = {
    [SB_SET_LAMBDA] = {"Time step: λ_max", "Tables 1 to 3", lambda},
    [SB_SET_TABLE] = {"Size of the hash table", "Tables 4 and 5", table},
    [SB_SET_TOLERANCE] = {"Tolerance ξ", "Tables 6 and 7", tolerance},
    [SB_SET_SPACING] = {"Spacing δr", "Tables 8 to 10", spacing},
    {.title = NULL},
};

const sb_published *sb_published_find(int number)
{
    for (const sb_published *p = sb_published_runs; p->number; p++)
        if (p->number == number) return p;
    return NULL;
}
