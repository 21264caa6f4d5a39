/* The defaults whose change by 25 % is studied: no switches, bounds or seeds, and no key that the default solver does
   not read. */
#include "sensitivity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define NUMBER(key, most)                                                                                              \
    {                                                                                                                  \
#key, offsetof(sb_numerics, key), false, most                                                                  \
    }
#define COUNT(key, most)                                                                                               \
    {                                                                                                                  \
#key, offsetof(sb_numerics, key), true, most                                                                   \
    }

const sb_sensitivity_key sb_sensitivity_keys[] = {
    NUMBER(support, 4),
    NUMBER(tolerance, 0.99),
    NUMBER(warm_start, 1),
    NUMBER(source_relaxation, 1),
    NUMBER(cfl, 1),
    NUMBER(time_step_factor, 10),
    NUMBER(stress_correction, 1),
    NUMBER(hyperviscosity, 1),
    NUMBER(wall_friction, 10),
    NUMBER(wall_spacing, 1.2),
    NUMBER(wall_offset, 2),
    NUMBER(jitter, 0.5),
    COUNT(settle_steps, 1000000),
    {.key = NULL},
};

static double value_of(const sb_sensitivity_key *key, const sb_numerics *numerics)
{
    const char *at = (const char *)numerics + key->offset;
    double number;
    int count;
    if (key->whole) {
        memcpy(&count, at, sizeof count);
        return count;
    }
    memcpy(&number, at, sizeof number);
    return number;
}

void sb_sensitivity_change(const sb_sensitivity_key *key, const sb_numerics *defaults, double factor, char change[64])
{
    double value = value_of(key, defaults), changed = value * factor;
    if (changed > key->most) changed = key->most;
    if (key->whole) changed = round(changed);
    change[0] = '\0';
    if (changed != value) snprintf(change, 64, "numerics.%s=%.6g", key->key, changed);
}

void sb_sensitivity_text(const sb_sensitivity_key *key, const sb_numerics *defaults, char text[64])
{
    snprintf(text, 64, "%.6g", value_of(key, defaults));
}
