/* Forks the child process that reads a mesh file or a grid, limits what it may do, and reports how it ended. */
#include "geometry/mesh/child.h"

#include "base/clock.h"
#include "base/input.h"
#include "base/stop.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/pidfd.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* File descriptors in the child. */
enum { OWN_PIPE = 3, OWN_FILE, OWN_ABOVE };

/* Elapsed time may exceed processor time because of the disk and other programs: the limit of elapsed time in units
   of the limit of processor time. */
enum { CLOCK_FACTOR = 5 };

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { LIMIT_MEMORY = 0 }; /* sanitizers map terabytes without using them */
#else
enum { LIMIT_MEMORY = 1 };
#endif

/* ------------------------------------------------------------------ the child, after the fork */

/* At `most` the kernel refuses memory, or sends SIGXCPU for processor time. One unit later it kills the process. */
static void limit(__rlimit_resource_t what, rlim_t most)
{
    struct rlimit now;
    if (getrlimit(what, &now) != 0) return;
    now.rlim_cur = now.rlim_max < most ? now.rlim_max : most;
    now.rlim_max = now.rlim_max < most + 1 ? now.rlim_max : most + 1;
    setrlimit(what, &now);
}

/* Removes the parent's signal handlers. Only the parent acts on Ctrl-C and on a closed terminal. */
static void reset_signals(void)
{
    for (int number = 1; number < NSIG; ++number)
        if (number != SIGKILL && number != SIGSTOP)
            signal(number, number == SIGINT || number == SIGHUP ? SIG_IGN : SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
}

static _Noreturn void run_child(const char *path, int mesh, int to, const sb_mesh_limits *limits, uint64_t mapped,
                                const sb_mesh_task *task)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_DUMPABLE, 0);
    reset_signals();
    int null = open("/dev/null", O_RDWR);
    if (null < 0 || dup2(null, STDIN_FILENO) < 0 || dup2(null, STDOUT_FILENO) < 0 || dup2(null, STDERR_FILENO) < 0)
        _exit(1);
    /* run_reader gives both descriptors higher numbers than these. All other descriptors of the parent are closed. */
    if (dup2(to, OWN_PIPE) < 0 || dup2(mesh, OWN_FILE) < 0) _exit(1);
    close_range(OWN_FILE + 1, ~0U, 0);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_CPU, limits->seconds);
    if (LIMIT_MEMORY) limit(RLIMIT_AS, mapped + limits->memory);
    alarm(limits->seconds * CLOCK_FACTOR);
    task->send(path, OWN_FILE, OWN_PIPE, task->wanted);
    _exit(0);
}

/* ----------------------------------------------------------------------------- the parent */

/* Returns this process's address space in bytes, with which a forked child begins. */
static uint64_t mapped_bytes(void)
{
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (fscanf(file, "%lu", &pages) != 1) pages = 0;
    fclose(file);
    return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

/* Waits for the child and returns its status; `stop` kills it first. Returns 0 if the status is unknown because
   another part of the process has collected the child (SIGCHLD ignored, or a handler that waits for all children). */
static int finish_child(const sb_mesh_link *from, bool stop)
{
    if (stop && (from->watch < 0 || pidfd_send_signal(from->watch, SIGKILL, NULL, 0) != 0)) kill(from->child, SIGKILL);
    int how = 0;
    while (waitpid(from->child, &how, 0) < 0)
        if (errno != EINTR) return 0;
    return how;
}

static sb_status explain_end(const sb_mesh_link *from, int how, const sb_mesh_limits *limits, const char *what,
                             sb_error *error)
{
    int by = WIFSIGNALED(how) ? WTERMSIG(how) : 0;
    bool late = from->end == SB_MESH_LINK_LATE || by == SIGALRM;
    if (late || by == SIGXCPU)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: reading it timed out after %u s%s, expected a valid "
                       "%s file",
                       from->path, late ? limits->seconds * CLOCK_FACTOR : limits->seconds,
                       late ? "" : " of processor time", what);
    if (by)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: reading it crashed (%s), expected a valid %s file that needs at most "
                       "%.1f GiB of memory",
                       from->path, strsignal(by), what, (double)limits->memory / 0x1p30);
    return sb_fail(error, SB_BAD_INPUT, "%.500s: reading it ended early, expected a valid %s file", from->path, what);
}

/* Forks with all signals blocked, so that no handler of the parent runs in the child. */
static sb_status run_reader(const char *path, int mesh, const sb_mesh_limits *limits, const sb_mesh_task *task,
                            sb_mesh_link *from, sb_error *error)
{
    int ends[2];
    uint64_t mapped = mapped_bytes();
    if (pipe2(ends, O_CLOEXEC) != 0)
        return sb_fail(error, SB_FAILED, "%.500s: cannot create a pipe to the process that reads it: %s", path,
                       strerror(errno));
    /* If the parent's standard streams are closed, the pipe may have one of their numbers. It is moved above them. */
    int high = fcntl(ends[1], F_DUPFD_CLOEXEC, OWN_ABOVE), file = fcntl(mesh, F_DUPFD_CLOEXEC, OWN_ABOVE);
    close(ends[1]);
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    pid_t child = high < 0 || file < 0 ? -1 : fork();
    if (child == 0) run_child(path, file, high, limits, mapped, task);
    int reason = errno;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (high >= 0) close(high);
    if (file >= 0) close(file);
    if (child < 0) {
        close(ends[0]);
        return sb_fail(error, SB_FAILED, "%.500s: cannot start a process that reads it: %s", path, strerror(reason));
    }
    int watch = pidfd_open(child, 0);
    *from = (sb_mesh_link){.path = path,
                           .child = child,
                           .pipe = ends[0],
                           .watch = watch,
                           .deadline = sb_clock() + limits->seconds * CLOCK_FACTOR + 1,
                           .room = limits->memory};
    return SB_OK;
}

static bool has_known_ending(const char *path)
{
    static const char *const known[] = {".obj", ".stl", ".ply", ".gltf", ".glb", ".dae"};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof known / sizeof *known; ++i)
        if (strcasecmp(dot, known[i]) == 0) return true;
    return false;
}

/* Opens the mesh file. The file that is read is thus the file whose size was checked. */
static sb_status open_mesh(const char *path, int *mesh, uint64_t *size, sb_error *error)
{
    struct stat found;
    sb_status status = sb_input_descriptor(path, mesh, error);
    if (status != SB_OK) return status;
    if (!has_known_ending(path))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: unknown format, expected .obj, .stl, .ply, .gltf, .glb or .dae",
                         path);
    else if (fstat(*mesh, &found) != 0)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read: %s", path, strerror(errno));
    else if (found.st_size == 0)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: is empty, expected a mesh", path);
    if (status == SB_OK) *size = (uint64_t)found.st_size;
    if (status != SB_OK) close(*mesh);
    return status;
}

sb_status sb_mesh_child_run(const char *path, int file, const sb_mesh_limits *limits, const sb_mesh_task *task,
                            sb_error *error)
{
    sb_mesh_link from = {0};
    char doing[40];
    sb_status status = run_reader(path, file, limits, task, &from, error);
    if (status != SB_OK) return status;
    status = task->receive(&from, task->wanted, task->into, error);
    int how = finish_child(&from, status != SB_OK && from.end != SB_MESH_LINK_CLOSED);
    close(from.pipe);
    if (from.watch >= 0) close(from.watch);
    snprintf(doing, sizeof doing, "while a %s was read", task->what);
    if (from.end == SB_MESH_LINK_STOPPED) return sb_stop_fail(error, doing);
    if (from.end != SB_MESH_LINK_OK) return explain_end(&from, how, limits, task->what, error);
    return status;
}

typedef struct received {
    sb_mesh *meshes;
    size_t count;
} received;

static void send_meshes(const char *path, int file, int pipe, const void *wanted)
{
    (void)wanted;
    sb_mesh_send_file(path, file, pipe);
}

static sb_status receive_meshes(sb_mesh_link *from, const void *wanted, void *into, sb_error *error)
{
    (void)wanted;
    received *to = into;
    return sb_mesh_receive(from, &to->meshes, &to->count, error);
}

static sb_status import_open(const char *path, int mesh, const sb_mesh_limits *limits, sb_mesh **meshes, size_t *count,
                             sb_error *error)
{
    received made = {0};
    const sb_mesh_task task = {"mesh", send_meshes, receive_meshes, NULL, &made};
    sb_status status = sb_mesh_child_run(path, mesh, limits, &task, error);
    if (status != SB_OK) return status;
    *meshes = made.meshes;
    *count = made.count;
    return SB_OK;
}

sb_status sb_mesh_import_within(const char *path, const sb_mesh_limits *limits, sb_mesh **meshes, size_t *count,
                                sb_error *error)
{
    int mesh;
    uint64_t size = 0;
    sb_status status = open_mesh(path, &mesh, &size, error);
    if (status != SB_OK) return status;
    status = import_open(path, mesh, limits, meshes, count, error);
    close(mesh);
    return status;
}

sb_status sb_mesh_import(const char *path, sb_mesh **meshes, size_t *count, sb_error *error)
{
    int mesh;
    uint64_t size = 0;
    sb_status status = open_mesh(path, &mesh, &size, error);
    if (status != SB_OK) return status;
    /* A million triangles take 1 to 3 s. A small glTF file may refer to a large buffer file. */
    const uint64_t megabytes = size >> 20;
    const sb_mesh_limits limits = {.memory = UINT64_C(4) << 30,
                                   .seconds = 20 + (megabytes < 600 ? (unsigned)megabytes : 600)};
    status = import_open(path, mesh, &limits, meshes, count, error);
    close(mesh);
    return status;
}
