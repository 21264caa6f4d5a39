#include "app/run/spent.h"

#include "app/run/parts.h"
#include "base/memory.h"

#include <string.h>
#include <sys/resource.h>

static double seconds_of(struct timeval time)
{
    return (double)time.tv_sec + 1e-6 * (double)time.tv_usec;
}

/* Processor time of all threads of this process, s. */
static double processor_time(void)
{
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

/* Finds the stage in the table, or adds it; NULL: the table is full. */
static sb_stage_spent *stage_named(sb_spent *spent, const char *name)
{
    for (size_t s = 0; s < spent->stage_count; s++)
        if (strcmp(spent->stage[s].name, name) == 0) return &spent->stage[s];
    if (spent->stage_count == SB_STAGES_MAX) return NULL;
    sb_stage_spent *made = &spent->stage[spent->stage_count++];
    *made = (sb_stage_spent){.calls = 0};
    snprintf(made->name, sizeof made->name, "%s", name);
    return made;
}

void sb_spent_settled(run *r)
{
    const sb_stage_time *stages;
    const size_t count = sb_sim_stages(r->sim, &stages);
    for (size_t s = 0; s < count; s++) {
        sb_stage_spent *stage = stage_named(&r->before, stages[s].name);
        if (!stage) continue;
        stage->settling_seconds += stages[s].seconds;
        stage->settling_calls += stages[s].calls;
    }
}

sb_spent sb_spent_sum(const run *r)
{
    sb_spent sum = r->before;
    const sb_stage_time *stages = NULL;
    const size_t count = r->sim ? sb_sim_stages(r->sim, &stages) : 0;
    sum.wall = sb_run_wall(r);
    sum.processor += processor_time();
    sum.setup += r->setup_seconds;
    sum.settling += r->settling_seconds;
    for (size_t s = 0; s < count; s++) {
        sb_stage_spent *stage = stage_named(&sum, stages[s].name);
        if (!stage) continue;
        stage->seconds += stages[s].seconds;
        stage->calls += stages[s].calls;
    }
    return sum;
}

void sb_spent_save(const run *r, sb_archive_out *out)
{
    const sb_spent sum = sb_spent_sum(r);
    sb_put_real(out, sum.wall);
    sb_put_real(out, sum.processor);
    sb_put_real(out, sum.setup);
    sb_put_real(out, sum.settling);
    sb_put_count(out, sum.stage_count);
    for (size_t s = 0; s < sum.stage_count; s++) {
        const sb_stage_spent *stage = &sum.stage[s];
        sb_put_text(out, stage->name);
        sb_put_real(out, stage->seconds);
        sb_put_count(out, stage->calls);
        sb_put_real(out, stage->settling_seconds);
        sb_put_count(out, stage->settling_calls);
    }
}

void sb_spent_load(run *r, sb_archive_in *in)
{
    sb_spent *before = &r->before;
    *before = (sb_spent){.wall = sb_take_real(in)};
    before->processor = sb_take_real(in);
    before->setup = sb_take_real(in);
    before->settling = sb_take_real(in);
    const uint64_t count = sb_take_count(in, SB_STAGES_MAX);
    for (uint64_t s = 0; s < count; s++) {
        char *name = sb_take_text(in);
        sb_stage_spent *stage = name ? stage_named(before, name) : NULL, none;
        sb_free(name);
        if (!stage) stage = &none;
        stage->seconds = sb_take_real(in);
        stage->calls = sb_take_count(in, UINT64_MAX);
        stage->settling_seconds = sb_take_real(in);
        stage->settling_calls = sb_take_count(in, UINT64_MAX);
    }
}
