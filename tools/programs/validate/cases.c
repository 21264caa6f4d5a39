#include "cases.h"

#define ADDRESS(name) &sb_case_##name,

const sb_case *const sb_cases[] = {SB_CASES(ADDRESS) NULL};
