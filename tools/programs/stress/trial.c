#include "trial.h"

#include "request.h"
#include "scene/presets.h"

#include "base/file.h"
#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double time_limit = 1800; /* s, on a machine that also runs other programs */

sb_trial *sb_trial_add(sb_trials *trials, const char *scene, const char *name, ...)
{
    sb_trial *trial = &trials->spare;
    if (sb_grow((void **)&trials->list, &trials->capacity, trials->count + 1, sizeof *trials->list) == 0)
        trial = &trials->list[trials->count++];
    else
        trials->incomplete = true;
    *trial = (sb_trial){.scene = scene, .ends = SB_ENDS_WELL, .time_limit = time_limit};
    va_list arguments;
    va_start(arguments, name);
    vsnprintf(trial->name, sizeof trial->name, name, arguments);
    va_end(arguments);
    return trial;
}

void sb_trial_set(sb_trial *trial, const char *setting, ...)
{
    if (trial->setting_count == SB_TRIAL_SETTINGS) return;
    va_list arguments;
    va_start(arguments, setting);
    vsnprintf(trial->settings[trial->setting_count++], SB_TRIAL_TEXT, setting, arguments);
    va_end(arguments);
}

void sb_trial_drive(sb_trial *trial, const sb_drive *drive, double number)
{
    trial->kind = SB_TRIAL_DRIVEN;
    trial->drive = drive;
    trial->number = number;
}

void sb_trials_free(sb_trials *trials)
{
    sb_free(trials->list);
    *trials = (sb_trials){0};
}

sb_status sb_trial_scene(const sb_trial *trial, const char *assets, sb_scene *scene, sb_error *error)
{
    char path[SB_PATH_MAX];
    const char *settings[SB_TRIAL_SETTINGS];
    for (size_t i = 0; i < trial->setting_count; i++) settings[i] = trial->settings[i];
    sb_status status = sb_path_join(path, assets, trial->scene, error);
    return status == SB_OK ? sb_settings_scene(path, NULL, settings, trial->setting_count, scene, error) : status;
}

double sb_trial_default(int dimensions, const char *key)
{
    const char *text = sb_preset_value(SB_PRESET_DEFAULT, dimensions, key);
    return text ? strtod(text, NULL) : 0;
}
