#include "output/log/progress.h"

#include "base/clock.h"

#include <math.h>
#include <unistd.h>

void sb_progress_duration(char out[32], double seconds)
{
    if (!isfinite(seconds) || seconds < 0 || seconds > 1e7) {
        snprintf(out, 32, "?");
        return;
    }
    long s = lround(seconds);
    if (s >= 3600)
        snprintf(out, 32, "%ldh %02ldm", s / 3600, s / 60 % 60);
    else if (s >= 60)
        snprintf(out, 32, "%ldm %02lds", s / 60, s % 60);
    else
        snprintf(out, 32, "%lds", s);
}

void sb_progress_percent(char out[32], double percent)
{
    if (fabs(percent) < 0.005)
        snprintf(out, 32, "0.00");
    else
        snprintf(out, 32, "%+.2f", percent);
}

void sb_progress_begin(sb_progress *progress, FILE *stream, double duration)
{
    double now = sb_clock();
    *progress = (sb_progress){.stream = stream, .duration = duration, .started = now, .shown = now, .eta = -1};
    progress->terminal = stream && isatty(fileno(stream));
    progress->mark_wall[0] = progress->mark_wall[1] = now;
}

void sb_progress_resume(sb_progress *progress, double time)
{
    progress->mark_wall[0] = progress->mark_wall[1] = sb_clock();
    progress->mark_time[0] = progress->mark_time[1] = time;
}

double sb_progress_wall(const sb_progress *progress)
{
    return sb_clock() - progress->started;
}

double sb_progress_eta(const sb_progress *progress)
{
    return progress->eta;
}

/* Estimates the end from the speed of the last 15 to 30 s, because steps become slower when the wave strikes land. */
static void estimate(sb_progress *progress, double now, double time)
{
    enum { WINDOW = 15 };
    if (now - progress->mark_wall[1] > WINDOW) {
        progress->mark_wall[0] = progress->mark_wall[1];
        progress->mark_time[0] = progress->mark_time[1];
        progress->mark_wall[1] = now;
        progress->mark_time[1] = time;
    }
    double advanced = time - progress->mark_time[0], left = progress->duration - time;
    progress->eta = !(left > 0) ? 0 : advanced > 0 ? left * (now - progress->mark_wall[0]) / advanced : -1;
}

static bool is_time(sb_progress *progress, double now)
{
    if (!progress->stream || now - progress->shown < (progress->terminal ? 0.2 : 10.0)) return false;
    progress->shown = now;
    return true;
}

static void end_line(sb_progress *progress)
{
    if (progress->open) fputc('\n', progress->stream);
    progress->open = false;
    fflush(progress->stream);
}

void sb_progress_break(sb_progress *progress)
{
    if (progress->stream) end_line(progress);
}

void sb_progress_paused(sb_progress *progress, double seconds)
{
    progress->mark_wall[0] += seconds;
    progress->mark_wall[1] += seconds;
    progress->settling_begun += seconds;
}

void sb_progress_plan(sb_progress *progress, int settling, int done, double steps)
{
    progress->settling_begun = sb_clock();
    progress->settling_before = done;
    progress->settling_steps = settling;
    progress->steps = steps;
}

/* Estimates the end from the time per settling step so far. The number of settling steps is at most `most`. */
static void estimate_settling(sb_progress *progress, double now, int done, int most)
{
    const int made = done - progress->settling_before;
    const double expected = fmin(fmax(progress->settling_steps, done), most);
    if (made > 0 && progress->steps > 0)
        progress->eta = (now - progress->settling_begun) / made * (expected - done + progress->steps);
}

void sb_progress_settling(void *context, int done, int most, double speed)
{
    sb_progress *progress = context;
    char wall[32], eta[32];
    const double now = sb_clock();
    estimate_settling(progress, now, done, most);
    if (!is_time(progress, now)) return;
    sb_progress_duration(wall, sb_progress_wall(progress));
    sb_progress_duration(eta, progress->eta < 0 ? (double)NAN : progress->eta);
    fprintf(progress->stream, "%ssettling: step %d of at most %d  max %.3f m/s  %s elapsed, %s left%s",
            progress->terminal ? "\r" : "", done, most, speed, wall, eta, progress->terminal ? "\033[K" : "\n");
    fflush(progress->stream);
    progress->open = progress->terminal;
}

void sb_progress_settled(sb_progress *progress)
{
    sb_progress_break(progress);
}

static void print(sb_progress *progress, const sb_step_report *report)
{
    char eta[32], wall[32];
    sb_progress_duration(eta, progress->eta < 0 ? (double)NAN : progress->eta);
    sb_progress_duration(wall, sb_progress_wall(progress));
    double percent = progress->duration > 0 ? 100 * report->time / progress->duration : 100;
    fprintf(progress->stream, "%s%5.1f %%  t %.3f s  dt %.4f s  %d iterations  max %.1f m/s  %s elapsed, %s left%s",
            progress->terminal ? "\r" : "", percent < 100 ? percent : 100, report->time, report->time_step,
            report->iterations, report->max_speed, wall, eta, progress->terminal ? "\033[K" : "\n");
    fflush(progress->stream); /* errors are ignored: the run continues without a reader */
    progress->open = progress->terminal;
}

void sb_progress_update(sb_progress *progress, const sb_step_report *report)
{
    double now = sb_clock();
    estimate(progress, now, report->time);
    if (is_time(progress, now)) print(progress, report);
}

void sb_progress_end(sb_progress *progress, const sb_step_report *report)
{
    if (!progress->stream) return;
    print(progress, report);
    end_line(progress);
}
