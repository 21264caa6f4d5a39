/* A run on several ranks (docs/mpi.md). Rank 0 leads: it is the run as it is on one rank, with its files, messages and
   commands. What all ranks compute together it does by the functions below: they give an order, by which the other
   ranks, which only follow, call the same functions of simulation and measurements. On one rank they call them at once.
   Private to src/app. */
#ifndef SB_APP_CLUSTER_H
#define SB_APP_CLUSTER_H

#include "app/run/state.h"

struct sb_run_options; /* app/run.h */

/* From now on signals that ask for a stop are only noted: sb_stop_watch, and SIGUSR1 of a starter such as mpirun. */
void sb_cluster_watch(void);

/* The checks and samples of the scene, and the model. */
sb_status sb_cluster_build(run *r, sb_error *error);
/* The simulation; its first step is checked unless the run is resumed. */
sb_status sb_cluster_create(run *r, bool resume, sb_error *error);
/* The measurements, with the pressures that they need. find: the pressures are to be found first. */
sb_status sb_cluster_measure(run *r, bool find, sb_error *error);
/* sb_sim_settle_watched, in rank 0 with this watch, whose context is the run. */
sb_status sb_cluster_settle(run *r, sb_settle_watch *watch, sb_error *error);
sb_status sb_cluster_step(run *r, sb_error *error);
/* The step of the measurements, after the pressures that they need. */
sb_status sb_cluster_observe(run *r, sb_error *error);
void sb_cluster_find_pressures(run *r);
/* NULL without memory. */
sb_frame *sb_cluster_snapshot(run *r);
/* Gives rank 0 a frame of its own particles, NULL without memory, and lets each other rank write its own as a piece of
   the particle file of this number. The status and *error are those of the pieces. */
sb_status sb_cluster_write_pieces(run *r, uint64_t number, sb_frame **frame, sb_error *error);
uint64_t sb_cluster_hash(run *r);
sb_energy sb_cluster_energy(run *r);
sb_status sb_cluster_trigger(run *r, size_t wavemaker, sb_error *error);

/* Saves simulation and, unless the water settles, measurements. */
void sb_cluster_save(run *r, bool settling, sb_archive_out *out);
/* Loads them from the checkpoint of this step, which `in` is, already open. Another rank opens the file of the same
   name, which must have the same contents. */
sb_status sb_cluster_load(run *r, bool settling, uint64_t step, sb_archive_in *in, sb_error *error);

/* Between two steps: stops all ranks at the same step if one of them was told to. Call it before sb_stop_signal is
   read. */
void sb_cluster_heed(run *r);
/* While rank 0 waits on purpose, as in a pause: lets the others tell the signals that they have received. */
void sb_cluster_stay(run *r);

/* Logs the number of ranks and their hosts, as the event "ranks". Nothing on one rank. */
void sb_cluster_log_start(run *r);
/* Finds how the ranks share the work so far, and logs it as the event "load". Nothing on one rank. */
void sb_cluster_log(run *r);
/* Heap bytes of the simulation; on several ranks in all of them, when they were logged last. */
size_t sb_cluster_bytes(const run *r);
/* Prints what was logged last, for --profile. Nothing on one rank. */
void sb_cluster_print(const run *r);

/* Frees simulation and measurements. */
void sb_cluster_release(run *r);
/* Rank 0 needs the others no more. Before the run's end. */
void sb_cluster_dismiss(run *r);

/* Follows the orders of rank 0 until the run ends. The other ranks call it instead of sb_run. Rank 0 knows how it
 * ended.
 */
void sb_cluster_follow(const sb_scene *scene, const char *directory, const struct sb_run_options *options);

#endif
