#include "plant.h"

#define AT(field) offsetof(sb_plant_options, field)

const sb_plant_option sb_plant_option_table[] = {
    {"grade", "level that the plant stands on", AT(grade), 10, 2, 30},
    {"quay", "deck of the quay in the harbour", AT(quay), 4.5, 1, 20},
    {"breakwater", "crest of the breakwaters", AT(breakwater), 5.7, 1, 20},
    {"hill", "highest ground behind the plant", AT(hill), 35, 5, 80},
    {"reactor", "height of the reactor buildings over the grade", AT(reactor), 45, 30, 80},
    {"stack", "height of the exhaust stacks over the grade", AT(stack), 120, 40, 180},
    {"harbour", "depth of the dredged harbour, positive downwards", AT(harbour), 8, 6, 12},
    {.name = NULL},
};

sb_plant_options sb_plant_defaults(void)
{
    sb_plant_options options = {0};
    for (const sb_plant_option *row = sb_plant_option_table; row->name; row++)
        *(double *)((char *)&options + row->offset) = row->value;
    return options;
}

sb_status sb_plant_check(const sb_plant_options *options, sb_error *error)
{
    for (const sb_plant_option *row = sb_plant_option_table; row->name; row++) {
        double value = *(const double *)((const char *)options + row->offset);
        if (!(value >= row->least && value <= row->most))
            return sb_fail(error, SB_BAD_INPUT, "%s: %g m is not between %g and %g m", row->name, value, row->least,
                           row->most);
    }
    if (options->quay > options->grade)
        return sb_fail(error, SB_BAD_INPUT, "quay: %g m is above the grade of %g m", options->quay, options->grade);
    if (options->hill < options->grade)
        return sb_fail(error, SB_BAD_INPUT, "hill: %g m is below the grade of %g m", options->hill, options->grade);
    return SB_OK;
}
