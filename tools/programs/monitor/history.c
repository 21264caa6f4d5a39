#include "history.h"

#include <math.h>

static double larger(double a, double b)
{
    return fabs(b) > fabs(a) ? b : a;
}

static void join_pairs(sb_history *history)
{
    for (int i = 0; i < SB_HISTORY / 2; i++)
        history->value[i] = larger(history->value[2 * i], history->value[2 * i + 1]);
    history->count = SB_HISTORY / 2;
    history->stride *= 2;
}

void sb_history_add(sb_history *history, double value)
{
    if (history->count == 0) history->stride = 1;
    if (history->count > 0 && history->held < history->stride) {
        double *newest = &history->value[history->count - 1];
        *newest = larger(*newest, value);
        history->held++;
        return;
    }
    if (history->count == SB_HISTORY) join_pairs(history);
    history->value[history->count++] = value;
    history->held = 1;
}
