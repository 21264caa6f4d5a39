/* Runs a test once with each preset, default first. */
#ifndef SB_TESTS_PRESETS_H
#define SB_TESTS_PRESETS_H

#include "check.h"
#include "sim/tank.h"

static const sb_preset presets_default = SB_PRESET_DEFAULT, presets_paper = SB_PRESET_PAPER;

/* Two rows of a list of tests. */
#define in_both_presets(test)                                                                                          \
    {#test ", default", test, NULL, NULL, (void *)(uintptr_t)&presets_default},                                        \
    {                                                                                                                  \
#test ", paper", test, NULL, NULL, (void *)(uintptr_t)&presets_paper                                           \
    }

/* The preset that a test is run with. */
static inline sb_preset preset_of(void **state)
{
    return *(const sb_preset *)*state;
}

#endif
