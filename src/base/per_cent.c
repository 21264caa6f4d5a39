#include "base/per_cent.h"

#include <stdio.h>

const char *sb_per_cent(double share, char text[32])
{
    if (100 * share < 0.01) return "below 0.01 %";
    snprintf(text, 32, "%.*g %%", share < 0.995 ? 2 : 3, 100 * share);
    return text;
}
