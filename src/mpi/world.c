#include "mpi/world.h"

#include "base/clock.h"
#include "base/memory.h"
#include "mpi/parts.h"
#include "mpi/starter.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <time.h>

static const double LIBRARY_SECONDS = 5; /* that MPI may take to begin, to end, or to end all ranks */

void sb_world_end(const world *w, const char *format, ...)
{
    char line[SB_WORLD_TEXT + 200];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    sb_world_guard(LIBRARY_SECONDS, NULL); /* what it flushes may belong to a thread that hangs */
    w->fatal(line);
    abort();
}

void sb_world_check(world *w, int code, const char *what)
{
    char text[MPI_MAX_ERROR_STRING] = "";
    int length;
    if (code == MPI_SUCCESS) return;
    MPI_Error_string(code, text, &length);
    sb_world_end(w, "rank %d on %s: %s: MPI reports: %.300s", w->ranks.rank, sb_world_host(&w->ranks, w->ranks.rank),
                 what, text);
}

/* ---- waiting ---- */

static const double LOOK_SECONDS = 0.25; /* between two looks at the other processes */
static const double GAP_SECONDS = 1;     /* between two looks, above which this process was stopped itself */
static const double LATER_SECONDS = 2;   /* by which other ranks wait longer than rank 0, so that one line is printed */

static void look_for_failure(world *w)
{
    sb_world_take_notes(w);
    if (w->ends) sb_world_abort(NULL); /* silently: one line is enough */
    const double later = w->ranks.rank == 0 ? 0 : LATER_SECONDS;
    if (w->heard_when > 0 && sb_clock() > w->heard_when + SB_WORLD_ALONE + later)
        sb_world_end(w, "rank %d on %s: %s", w->heard.rank, sb_world_host(&w->ranks, w->heard.rank), w->heard.text);
}

static void look_for_ended(const world *w, double waited)
{
    const int gone = waited > LOOK_SECONDS * (1 + w->place) ? sb_world_vanished(w) : -1;
    if (gone < 0) return;
    sb_world_end(w,
                 "rank %d on %s: its process %lld has ended: all ranks end; the last checkpoint stands, to continue it "
                 "add --resume",
                 gone, sb_world_host(&w->ranks, gone), (long long)w->peers[gone].process);
}

static void look_at_deadline(const world *w, double waited, int rank)
{
    const double later = w->ranks.rank == 0 ? 0 : LATER_SECONDS + 0.1 * w->ranks.rank;
    char whom[SB_WORLD_HOST + 40] = "the other ranks";
    if (waited <= w->deadline + later) return;
    if (rank >= 0) snprintf(whom, sizeof whom, "rank %d on %s", rank, sb_world_host(&w->ranks, rank));
    sb_world_end(w,
                 "rank %d on %s has waited %.3g s for %s, expected less than --rank-deadline %g: all ranks end; the "
                 "last checkpoint stands, to continue it add --resume",
                 w->ranks.rank, sb_world_host(&w->ranks, w->ranks.rank), waited, whom, w->deadline);
}

/* A rank that sleeps between its looks is woken at once when the cores are shared with other processes; one that only
   yields its core waits for all of them each time. */
static void nap(const world *w, double waited)
{
    static const struct timespec SHORTEST = {.tv_nsec = 10 * 1000}, SHORT = {.tv_nsec = 40 * 1000},
                                 LONG = {.tv_nsec = 100 * 1000}; /* ns */
    static const double SOON = 0.01;                             /* s */
    nanosleep(waited > SOON ? &LONG : w->crowded ? &SHORT : &SHORTEST, NULL);
}

void sb_world_idle(world *w, wait *state, int rank)
{
    enum { FEW = 20, MANY = 1000 }; /* looks before the first nap; a look takes a tenth of a microsecond */
    if (state->turns++ < (w->crowded ? FEW : MANY)) return;
    const double now = sb_clock();
    if (!(state->begun > 0)) state->begun = state->looked = now;
    if (now > state->looked + LOOK_SECONDS) {
        if (now > state->looked + GAP_SECONDS) state->begun += now - state->looked;
        state->looked = now;
        look_for_failure(w);
        look_for_ended(w, now - state->begun);
        if (!state->without_limit) look_at_deadline(w, now - state->begun, rank);
    }
    nap(w, now - state->begun);
}

/* ---- begin and end ---- */

/* Begins MPI, with a guard that sb_world_join ends. The starter's number of this process names it in the line for one
   that waits too long. */
static bool begin_mpi(double deadline)
{
    char late[160];
    int provided = 0;
    snprintf(late, sizeof late,
             "rank %d has waited for the begin of MPI, expected less than --rank-deadline %g s: all ranks end",
             sb_world_started_as(), deadline);
    sb_world_guard(deadline + LIBRARY_SECONDS + (sb_world_started_as() > 0 ? LATER_SECONDS : 0), late);
    const int code = MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided);
    return code == MPI_SUCCESS && provided >= MPI_THREAD_FUNNELED;
}

/* Ends MPI, whose last call waits for all ranks. */
static void end_mpi(const world *w)
{
    char late[SB_WORLD_HOST + 160];
    snprintf(late, sizeof late,
             "rank %d has waited for the end of MPI in the others, expected less than --rank-deadline %g s: all ranks "
             "end",
             w->ranks.rank, w->deadline);
    sb_world_guard(w->deadline + LIBRARY_SECONDS + (w->ranks.rank > 0 ? LATER_SECONDS : 0), late);
    MPI_Finalize();
    sb_world_unguard();
}

static void set_up(world *w)
{
    enum { SLACK = 1000 }; /* ns */
    MPI_Comm_rank(MPI_COMM_WORLD, &w->ranks.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &w->ranks.count);
    MPI_Comm_dup(MPI_COMM_WORLD, &w->data);
    MPI_Comm_dup(MPI_COMM_WORLD, &w->control);
    MPI_Comm_set_errhandler(w->data, MPI_ERRORS_RETURN);
    MPI_Comm_set_errhandler(w->control, MPI_ERRORS_RETURN);
    w->ranks.transport = &sb_world_transport;
    w->ranks.context = w;
    prctl(PR_SET_TIMERSLACK, SLACK); /* naps are shorter than the usual slack */
}

sb_status sb_world_join(double deadline, sb_world_fatal *fatal, sb_ranks **ranks, sb_error *error)
{
    *ranks = NULL;
    if (!sb_world_started()) return SB_OK;
    /* Open MPI yields the core at each look when there are more ranks than cores. With other processes on the cores
       each yield costs milliseconds; sb_world_idle sleeps instead. */
    setenv("OMPI_MCA_mpi_yield_when_idle", "0", 0);
    if (!begin_mpi(deadline)) return sb_fail(error, SB_FAILED, "MPI: cannot begin with threads beside it");
    world *w = sb_alloc(1, sizeof *w);
    if (!w) return sb_fail_memory(error, "the ranks");
    w->deadline = deadline;
    w->fatal = fatal;
    set_up(w);
    sb_world_unguard();
    sb_status status = SB_OK;
    const int started = sb_world_started_count();
    if (w->ranks.count == 1 && started > 1)
        status = sb_fail(error, SB_FAILED,
                         "started as one of %d processes, but MPI finds only this one: expected the starter of the MPI "
                         "that this program was built with, as mpirun of Open MPI or srun --mpi=pmix",
                         started);
    else if (w->ranks.count > SB_RANKS_MAX)
        status = sb_fail(error, SB_BAD_INPUT, "%d ranks, expected at most %d", w->ranks.count, SB_RANKS_MAX);
    else if (w->ranks.count > 1)
        status = sb_world_meet(w, error);
    if (status == SB_OK && w->ranks.count > 1)
        *ranks = &w->ranks;
    else
        sb_world_leave(&w->ranks);
    return status;
}

void sb_world_leave(sb_ranks *ranks)
{
    if (!ranks) return;
    world *w = ranks->context;
    if (w->peers && w->ranks.count > 1) sb_world_gather_at_end(w);
    MPI_Comm_free(&w->data);
    MPI_Comm_free(&w->control);
    end_mpi(w);
    sb_free(w->peers);
    sb_free(w->requests);
    sb_free(w->partners);
    sb_free(w->done);
    sb_free(w);
}

void sb_world_abort(sb_ranks *ranks)
{
    sb_world_guard(LIBRARY_SECONDS, NULL);
    if (ranks) sb_world_tell_end(ranks->context);
    MPI_Abort(MPI_COMM_WORLD, SB_FAILED);
}
