#include "output/log/profile.h"

#include "base/memory.h"

static double ratio(double a, double b)
{
    return b > 0 ? a / b : 0;
}

static double stage_sum(const sb_profile *p)
{
    double sum = 0;
    for (size_t s = 0; s < p->stage_count; s++) sum += p->stages[s].seconds;
    return sum;
}

/* Number of settling steps. The first stage is called once in each step, before and after t = 0. */
static uint64_t settling_steps(const sb_profile *p)
{
    const uint64_t calls = p->stage_count > 0 ? p->stages[0].calls : 0;
    return calls > p->steps ? calls - p->steps : 0;
}

static void print_stages(FILE *out, const sb_profile *p, double sum, double particle_steps)
{
    fprintf(out, "%-18s %9s %10s %7s %22s\n", "stage", "calls", "seconds", "share", "ns per particle-step");
    for (size_t s = 0; s < p->stage_count; s++)
        fprintf(out, "%-18s %9llu %10.3f %6.1f%% %22.2f\n", p->stages[s].name, (unsigned long long)p->stages[s].calls,
                p->stages[s].seconds, 100 * ratio(p->stages[s].seconds, sum),
                1e9 * ratio(p->stages[s].seconds, particle_steps));
    fprintf(out, "%-18s %9s %10.3f %6.1f%% %22.2f\n", "all stages", "", sum, 100.0, 1e9 * ratio(sum, particle_steps));
}

static void print_skipped(FILE *out, const sb_profile *p)
{
    const sb_saved saved = sb_saved_sum(p->skipped, SB_PROFILE_LISTS, p->stages, p->stage_count);
    fprintf(out, "not computed, because the scene does not need it:\n");
    for (size_t list = 0; list < SB_PROFILE_LISTS; list++)
        for (const sb_skipped *of = p->skipped[list]; of && of->what; of++) {
            fprintf(out, "  %s", of->what);
            if (of->passes > 0)
                fprintf(out, "; %d pass%s over particle pairs per step", of->passes, of->passes > 1 ? "es" : "");
            if (of->bytes > 0) fprintf(out, "; %.3g MB", 1e-6 * (double)of->bytes);
            fputc('\n', out);
        }
    fprintf(out, "saved: %d pass%s over particle pairs per step, about %.3g s so far; %.3g MB\n", saved.passes,
            saved.passes == 1 ? "" : "es", saved.seconds, 1e-6 * (double)saved.bytes);
}

void sb_profile_print(FILE *out, const sb_profile *p)
{
    const uint64_t settling = settling_steps(p);
    const double sum = stage_sum(p);
    const double particle_steps = p->particle_steps + (double)settling * (double)p->settling_particles;
    print_stages(out, p, sum, particle_steps);
    fprintf(
        out,
        "%llu steps after %llu settling steps, %.1f iterations per step, %.4g particle-steps per second, %d thread%s\n",
        (unsigned long long)p->steps, (unsigned long long)settling, ratio((double)p->iterations, (double)p->steps),
        ratio(particle_steps, sum), p->threads, p->threads == 1 ? "" : "s");
    fprintf(out, "%.3f s in total: %.3f s set-up, %.3f s settling, %.3f s outside stages; %.4g s simulated\n", p->wall,
            p->setup, p->settling, p->wall > p->setup + sum ? p->wall - p->setup - sum : 0, p->simulated);
    fprintf(out, "memory: simulation %.1f MB, peak of the process %.1f MB\n", (double)p->bytes / 1e6,
            (double)sb_memory_peak() / 1e6);
    print_skipped(out, p);
}
