#include "lives.h"

#include "base/memory.h"
#include "statistics.h"

#include <dirent.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double sb_soak_share = 0.03, sb_soak_bytes = 4e6, sb_soak_shortest = 90;

enum { FEWEST = 4 }; /* fewest samples for a median */

/* Number of entries in /proc/PID/fd; 0: the process has ended. */
static unsigned count_descriptors(pid_t process)
{
    char path[64];
    unsigned count = 0;
    snprintf(path, sizeof path, "/proc/%ld/fd", (long)process);
    DIR *folder = opendir(path);
    for (const struct dirent *entry; folder && (entry = readdir(folder));) count += entry->d_name[0] != '.';
    if (folder) closedir(folder);
    return count;
}

/* VmRSS in kilobytes; 0: the process has ended. */
static uint64_t read_resident(pid_t process)
{
    char path[64], line[256];
    uint64_t kilobytes = 0;
    snprintf(path, sizeof path, "/proc/%ld/status", (long)process);
    FILE *in = fopen(path, "r");
    while (in && kilobytes == 0 && fgets(line, sizeof line, in))
        if (strncmp(line, "VmRSS:", 6) == 0) kilobytes = strtoull(line + 6, NULL, 10);
    if (in) fclose(in);
    return kilobytes;
}

sb_status sb_soak_measure(pid_t process, sb_soak_sample *sample, sb_error *error)
{
    sample->resident = 1024 * read_resident(process);
    sample->descriptors = count_descriptors(process);
    return sample->resident > 0 && sample->descriptors > 0
               ? SB_OK
               : sb_fail(error, SB_FAILED, "process %ld: cannot read its memory and descriptors in /proc",
                         (long)process);
}

sb_status sb_soak_add(sb_soak_life *life, const sb_soak_sample *sample, sb_error *error)
{
    if (sb_grow((void **)&life->samples, &life->capacity, life->count + 1, sizeof *sample) != 0)
        return sb_fail_memory(error, "samples");
    life->samples[life->count++] = *sample;
    return SB_OK;
}

/* Time of the first sample after a streamed step; the end of the process if there is none. */
static double first_streamed(const sb_soak_life *life)
{
    for (size_t i = 0; i < life->count; i++)
        if (life->samples[i].step > 0) return life->samples[i].seconds;
    return life->seconds;
}

/* Medians of the samples between two fractions of the time since the first streamed step. False: too few samples. */
static bool middle(const sb_soak_life *life, double from, double to, double *resident, double *descriptors)
{
    const double begin = first_streamed(life), span = life->seconds - begin;
    double *bytes = sb_alloc(life->count, sizeof *bytes), *open = sb_alloc(life->count, sizeof *open);
    size_t n = 0;
    for (size_t i = 0; bytes && open && i < life->count; i++) {
        const double at = life->samples[i].seconds - begin;
        if (at < from * span || at > to * span) continue;
        bytes[n] = (double)life->samples[i].resident;
        open[n++] = life->samples[i].descriptors;
    }
    const bool enough = n >= FEWEST;
    if (enough) {
        *resident = sb_median(bytes, n);
        *descriptors = sb_median(open, n);
    }
    sb_free(bytes);
    sb_free(open);
    return enough;
}

sb_soak_growth sb_soak_growth_of(const sb_soak_life *life)
{
    sb_soak_growth g = {0};
    for (size_t i = 0; i < life->count; i++) {
        const sb_soak_sample *s = &life->samples[i];
        g.peak = (double)s->resident > g.peak ? (double)s->resident : g.peak;
        g.descriptors_peak = s->descriptors > g.descriptors_peak ? s->descriptors : g.descriptors_peak;
    }
    g.judged = life->seconds - first_streamed(life) >= sb_soak_shortest &&
               middle(life, 1.0 / 3, 0.5, &g.early, &g.descriptors_early) &&
               middle(life, 5.0 / 6, 1, &g.late, &g.descriptors_late);
    return g;
}

bool sb_soak_passed(const sb_soak_life *life, char why[400])
{
    const sb_soak_growth g = sb_soak_growth_of(life);
    why[0] = '\0';
    if (life->end == SB_SOAK_FAILED)
        snprintf(why, 400, "%s", life->message);
    else if (g.judged && g.late - g.early > sb_soak_share * g.early + sb_soak_bytes)
        snprintf(why, 400, "memory grew by %.1f MB", 1e-6 * (g.late - g.early));
    else if (g.judged && g.descriptors_late > g.descriptors_early)
        snprintf(why, 400, "descriptors grew from %.0f to %.0f", g.descriptors_early, g.descriptors_late);
    else if (g.judged && life->frames == 0)
        snprintf(why, 400, "the subscriber received no frame");
    return why[0] == '\0';
}
