#include "report.h"

#include "markdown.h"

#include <inttypes.h>
#include <stdio.h>

static void put_head(FILE *out, const sb_soak_report *r)
{
    const sb_soak_options *o = r->options;
    fprintf(out,
            "# Soak test\n\n"
            "Commit %s, %s.\n"
            "Made by `tools/soak --minutes %.4g --spacing %.4g --life %.4g --duration %.4g` "
            "([explanation](../robustness.md#the-soak)).\n\n",
            r->store->commit, r->store->machine, o->minutes, o->spacing, o->life, o->duration);
    fprintf(
        out,
        "The plant runs with pictures, particle files and a live subscriber. It is stopped by SIGTERM and resumed; a "
        "new run is\n"
        "started when it has finished. Each row of the table is one process.\n\n"
        "- Memory is resident memory. Early: median from one third to one half of the time since the first streamed "
        "step, after\n"
        "  the warm-up. Late: median of the last sixth. Late minus early may be at most %.0f %% of early plus %.0f MB, "
        "for buffers\n"
        "  that follow the wave.\n"
        "- The number of file descriptors may not grow.\n"
        "- Every process must stop or finish without an error, and its frames must arrive.\n"
        "- The growth of processes that end less than %.0f s after their first step is not judged.\n\n",
        100 * sb_soak_share, 1e-6 * sb_soak_bytes, sb_soak_shortest);
}

static void put_growth(FILE *out, const sb_soak_growth *g)
{
    if (g->judged)
        fprintf(out, " %.1f | %.1f | %.1f | %.0f | %.0f |", 1e-6 * g->early, 1e-6 * g->late, 1e-6 * g->peak,
                g->descriptors_early, g->descriptors_late);
    else
        fprintf(out, " – | – | %.1f | – | – |", 1e-6 * g->peak);
}

static void put_life(FILE *out, const sb_soak_life *life)
{
    static const char *const ends[] = {"stopped", "finished", "**failed**"};
    char why[400];
    const sb_soak_growth g = sb_soak_growth_of(life);
    fprintf(out, "| %.1f | %.1f | %s | %" PRIu64 " | %" PRIu64 " |", life->begun / 60, life->seconds / 60,
            life->resumed ? "resumed" : "new", life->first_step, life->last_step);
    put_growth(out, &g);
    fprintf(out, " %u | %" PRIu64 " | %" PRIu64 " | %s | %s |\n", g.descriptors_peak, life->frames, life->chunks_lost,
            ends[life->end], sb_soak_passed(life, why) ? "" : why);
}

static void put_sum(FILE *out, const sb_soak_report *r)
{
    size_t stopped = 0, finished = 0, resumed = 0;
    uint64_t steps = 0;
    for (size_t i = 0; i < r->count; i++) {
        const sb_soak_life *life = &r->lives[i];
        stopped += life->end == SB_SOAK_STOPPED;
        finished += life->end == SB_SOAK_FINISHED;
        resumed += life->resumed;
        steps += life->last_step - life->first_step;
    }
    fprintf(out,
            "%.1f minutes, %zu processes: %zu stopped, %zu resumed, %zu finished; %" PRIu64 " steps, %" PRIu64
            " frames received. The growth of %zu processes was judged: %s.\n\n",
            r->seconds / 60, r->count, stopped, resumed, finished, steps, r->frames, r->judged,
            r->failed > 0 || r->frames == 0 ? "**something grew or failed**" : "nothing grew and nothing failed");
}

void sb_soak_put(FILE *out, const void *what)
{
    const sb_soak_report *report = what;
    put_head(out, report);
    put_sum(out, report);
    fprintf(out, "| start, min | duration, min | run | first step | last step | early, MB | late, MB | peak, MB | "
                 "descriptors early | late | most | frames | chunks lost | end | problem |\n");
    sb_put_rule(out, 15);
    for (size_t i = 0; i < report->count; i++) put_life(out, &report->lives[i]);
}

void sb_soak_put_samples(FILE *out, const void *what)
{
    const sb_soak_report *report = what;
    fprintf(out, "life,wall_s,resident_bytes,descriptors,step\n");
    for (size_t i = 0; i < report->count; i++)
        for (size_t k = 0; k < report->lives[i].count; k++) {
            const sb_soak_sample *s = &report->lives[i].samples[k];
            fprintf(out, "%zu,%.2f,%" PRIu64 ",%u,%" PRIu64 "\n", i + 1, report->lives[i].begun + s->seconds,
                    s->resident, s->descriptors, s->step);
        }
}
