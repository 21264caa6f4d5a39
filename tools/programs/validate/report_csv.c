/* Writes results.csv: every figure of every run. */
#include "report.h"
#include "sheet.h"

#include <inttypes.h>
#include <math.h>

static void put_figure(FILE *out, const sb_figure *f)
{
    sb_sheet_put(out, f->quantity);
    fputc(',', out);
    sb_sheet_put(out, f->unit);
    fputc(',', out);
    sb_put_field(out, f->reference);
    sb_put_field(out, f->value);
    sb_put_field(out, f->error);
    sb_sheet_put(out, f->error_unit);
    fputc(',', out);
    sb_put_field(out, f->limit);
    fprintf(out, "%s,", isnan(f->limit) ? "reported" : f->pass ? "pass" : "FAIL");
}

/* The last columns: what the report says about a figure outside its row of the table. */
static void put_remarks(FILE *out, const sb_figure *f)
{
    const bool band = f->low < f->high;
    sb_put_field(out, band ? f->low : (double)NAN);
    sb_put_field(out, band ? f->high : (double)NAN);
    sb_sheet_put(out, f->note);
    fputc('\n', out);
}

static void put_run(FILE *out, const sb_result *r)
{
    for (size_t i = 0; i < r->figures.count; i++) {
        fprintf(out, "%s,%.6g,%s,%d,%s,", r->request.of->name, r->request.plan->resolution,
                sb_request_preset(&r->request), r->request.seed,
                r->request.plan->judged && !r->request.preset ? "yes" : "no");
        put_figure(out, &r->figures.rows[i]);
        fprintf(out, "%zu,%zu,%.2f,%.1f,%s,%s,%016" PRIx64 ",", r->run.view.particles, r->run.view.steps,
                r->run.view.iterations, r->run.view.wall, r->run.commit, r->request_hash, r->defaults_hash);
        if (r->run.threads > 0) fprintf(out, "%d", r->run.threads);
        fputc(',', out);
        sb_sheet_put(out, r->run.machine);
        fprintf(out, ",%s,", r->run.build);
        put_remarks(out, &r->figures.rows[i]);
    }
}

void sb_report_csv(FILE *out, const void *what)
{
    const sb_report *report = what;
    fputs("case,resolution_m,preset,seed,judged,quantity,unit,reference,value,error,error_unit,"
          "target,verdict,particles,steps,sweeps_per_step,run_time_s,commit,request,defaults,threads,machine,build,"
          "reference_low,reference_high,note\n",
          out);
    for (size_t c = 0; c < report->count; c++) {
        const sb_case_results *results = &report->cases[c];
        for (size_t i = 0; i < results->count; i++)
            if (results->runs[i].state == SB_RESULT_DONE) put_run(out, &results->runs[i]);
        for (size_t i = 0; i < results->across.count; i++) {
            fprintf(out, "%s,,default,1,yes,", results->of->name);
            put_figure(out, &results->across.rows[i]);
            fputs(",,,,,,,,,,", out);
            put_remarks(out, &results->across.rows[i]);
        }
    }
}
