/* The table of cases, in the order of the report. */
#include "case.h"

const sb_case *const sb_cases[] = {
    NULL,
};
