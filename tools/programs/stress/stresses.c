#include "stresses.h"

#define ADDRESS(name) &sb_stress_##name,

const sb_stress *const sb_stresses[] = {SB_STRESSES(ADDRESS) NULL};
