/* A run's stream from a process of its own, over UDP on this machine, for tests of what subscribers do. */
#ifndef SB_TESTS_PUBLISHER_FIXTURE_H
#define SB_TESTS_PUBLISHER_FIXTURE_H

#include "stream/stream_fixture.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Forks a process that publishes ten frames per second from frame `first` on, once a byte can be read from `start`.
   It ends with the test. */
static inline pid_t fixture_publisher(const char *url, uint64_t first, int start)
{
    const pid_t made = fork();
    if (made != 0) return made;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    char byte;
    if (read(start, &byte, 1) != 1) _exit(0);
    fixture_scene f;
    fixture_scene_make(&f, 4, 2);
    sb_stream *stream = fixture_stream(url, 0, 1);
    sb_stream_set_scene(stream, &f.scene, &f.model, NULL);
    for (uint64_t index = first;; index++) {
        sb_frame *frame = fixture_frame(index, 0.1 * (double)index, 5000, 4);
        const sb_force_record force = {.body = 0, .time = frame->status.time, .force = sb_vec(1e6, 0, 0)};
        const sb_measure_records rows = {.force_count = 1, .forces = &force};
        sb_stream_measure(stream, &rows);
        fixture_publish(stream, frame);
        sb_frame_release(frame);
        usleep(100000);
    }
}

/* Kills a process of the test and waits for its end. */
static inline void fixture_kill(pid_t process)
{
    kill(process, SIGKILL);
    waitpid(process, NULL, 0);
}

/* Whether this machine has a route for multicast packets, by publishing on the URL. */
static inline bool fixture_has_route(const char *url)
{
    char copy[128];
    snprintf(copy, sizeof copy, "%s", url);
    sb_stream_settings settings = {.enabled = true, .url = copy, .prefix = "test", .decimation = 1};
    sb_stream *stream = NULL;
    if (sb_stream_create(&settings, "a run", &stream, NULL) != SB_OK) return false;
    sb_stream_destroy(stream);
    return true;
}

#endif
