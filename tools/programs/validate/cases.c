#include "cases.h"

#include <string.h>

#define ADDRESS(name) &sb_case_##name,

const sb_case *const sb_cases[] = {SB_CASES(ADDRESS) NULL};
bool sb_energy_item(const sb_sheet *energy, size_t k, char name[SB_FIGURE_TEXT])
{
    const char *column = energy->fields[k], *unit = strstr(column, "_J");
    if (!unit || strncmp(column, "kinetic", 7) == 0 || strncmp(column, "potential", 9) == 0) return false;
    snprintf(name, SB_FIGURE_TEXT, "%.*s", (int)(unit - column), column);
    return true;
}
