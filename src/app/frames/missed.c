#include "app/frames/missed.h"

#include "app/run/parts.h"
#include "base/memory.h"

#include <inttypes.h>

/* How often trouble began among the first changes: odd changes are beginnings. */
static uint64_t beginnings(uint64_t changes)
{
    return (changes + 1) / 2;
}

static const char *are_missing(uint64_t count)
{
    return count == 1 ? "frame is missing" : "frames are missing";
}

static void report_consumer(run *r, int c)
{
    const sb_trouble trouble = sb_consumer_trouble(&r->consumers[c]);
    const char *name = r->consumers[c].work.name;
    if (trouble.changes == r->reported[c]) return;
    if (beginnings(trouble.changes) > beginnings(r->reported[c]))
        sb_run_warn(r, "%s: %.900s; the run continues%s", name, trouble.latest.text,
                    r->consumers[c].given_up ? " without them" : ", and each later frame is tried");
    if (trouble.changes % 2 == 0) {
        const uint64_t missed = sb_missed_sum(r, c).count;
        sb_run_warn(r, "%s: written again; %" PRIu64 " %s", name, missed, are_missing(missed));
    }
    r->reported[c] = trouble.changes;
}

void sb_missed_report(run *r)
{
    for (int c = 0; c < CONSUMERS; c++) report_consumer(r, c);
}

sb_missed sb_missed_sum(run *r, int consumer)
{
    const sb_trouble trouble = sb_consumer_trouble(&r->consumers[consumer]);
    sb_missed sum = r->missed[consumer];
    if (sum.count == 0) snprintf(sum.reason, sizeof sum.reason, "%s", trouble.first.text);
    sum.count += trouble.missed;
    return sum;
}

sb_status sb_missed_check(run *r, int consumer, sb_error *error)
{
    const sb_consumer *c = &r->consumers[consumer];
    const sb_missed sum = sb_missed_sum(r, consumer);
    if (sum.count > 0)
        return sb_fail(error, SB_FAILED, "%s: %.900s; %" PRIu64 " %s", c->work.name, sum.reason, sum.count,
                       are_missing(sum.count));
    return c->trouble.changes % 2 ? sb_fail(error, SB_FAILED, "%s: %.900s", c->work.name, c->trouble.latest.text)
                                  : SB_OK;
}

void sb_missed_save(run *r, sb_archive_out *out)
{
    for (int c = 0; c < CONSUMERS; c++) {
        const sb_missed sum = sb_missed_sum(r, c);
        sb_put_count(out, sum.count);
        sb_put_text(out, sum.reason);
    }
}

void sb_missed_load(run *r, sb_archive_in *in)
{
    for (int c = 0; c < CONSUMERS; c++) {
        sb_missed *missed = &r->missed[c];
        missed->count = sb_take_count(in, UINT32_MAX);
        char *reason = sb_take_text(in);
        snprintf(missed->reason, sizeof missed->reason, "%s", reason ? reason : "");
        sb_free(reason);
    }
}
