#include "program.h"

#include "../mpi/mpirun.h"
#include "../output/json_check.h"
#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <grp.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

static const double TIMEOUT = 300; /* s; far more than any run here takes, also with sanitizers on a busy machine */
enum { ARGUMENTS = 48 };

const char tank_2d[] = "title: Tank in 2D\n"
                       "dimensions: 2\n"
                       "resolution: 0.04\n"
                       "duration: 0.3\n"
                       "domain: {min: [0, 0], max: [2, 1]}\n"
                       "water:\n"
                       "  boxes:\n"
                       "    - {min: [0, 0], max: [0.8, 0.6]}\n"
                       "bodies:\n"
                       "  - {name: step, shape: box, min: [0.84, 0], max: [1.2, 0.2]}\n"
                       "measure:\n"
                       "  interval: 0.05\n"
                       "  gauges: [{name: wet, x: 0.4}, {name: dry, x: 1.9}]\n"
                       "  probes: [{name: deep, at: [0.4, 0.2]}]\n"
                       "output: {particle_interval: 0.1, plots: false}\n";

const char tank_3d[] = "title: Tank in 3D\n"
                       "resolution: 0.1\n"
                       "duration: 0.3\n"
                       "domain: {min: [0, 0, 0], max: [2.6, 0.8, 1]}\n"
                       "water:\n"
                       "  boxes:\n"
                       "    - {min: [0, 0, 0], max: [0.8, 0.8, 0.6]}\n"
                       "bodies:\n"
                       "  - {name: post, shape: box, min: [1.0, 0.3, 0], max: [1.3, 0.6, 0.8]}\n"
                       "  - {name: sill, shape: box, min: [1.6, 0, 0], max: [1.9, 0.8, 0.3]}\n"
                       "measure:\n"
                       "  interval: 0.05\n"
                       "  gauges: [{name: wet, x: 0.4, y: 0.4}, {name: dry, x: 2.4, y: 0.4}]\n"
                       "  probes: [{name: deep, at: [0.4, 0.4, 0.2]}]\n"
                       "render:\n"
                       "  interval: 0.1\n"
                       "  width: 160\n"
                       "  height: 90\n"
                       "  speed_max: 2\n"
                       "  video: false\n"
                       "  cameras:\n"
                       "    - {name: side, eye: [1, -3, 1.5], target: [1, 0.4, 0.3]}\n"
                       "    - {name: front, eye: [4, 0.4, 1.5], target: [1, 0.4, 0.3]}\n"
                       "output: {particle_interval: 0.1, plots: false}\n";

static char folder[512];

int program_setup(void **state)
{
    (void)state;
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.400s/shorebreak-app-XXXXXX", base && *base ? base : "/tmp");
    if (!mkdtemp(folder)) return -1;
    write_text("tank2.yaml", tank_2d);
    write_text("tank3.yaml", tank_3d);
    return 0;
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)kind;
    (void)where;
    return remove(path);
}

int program_teardown(void **state)
{
    (void)state;
    return nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

const char *in_folder(const char *format, ...)
{
    static char paths[8][1024];
    static unsigned turn;
    char *path = paths[turn++ % 8];
    int length = snprintf(path, sizeof paths[0], "%s/", folder);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(path + length, sizeof paths[0] - (size_t)length, format, arguments);
    va_end(arguments);
    return path;
}

void write_text(const char *name, const char *text)
{
    FILE *file = fopen(in_folder("%s", name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

char *text_of(const char *name)
{
    char *text = NULL;
    size_t length;
    sb_error error = {0};
    if (sb_file_read(in_folder("%s", name), 1 << 26, &text, &length, &error) != SB_OK) fail_msg("%s", error.text);
    return text;
}

bool exists(const char *name)
{
    return access(in_folder("%s", name), F_OK) == 0;
}

static void redirect(const char *name, int descriptor)
{
    int file = open(in_folder("%s", name), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(99);
    close(file);
}

/* Writing to it fails. */
static void redirect_to_closed_pipe(void)
{
    int ends[2];
    if (pipe(ends) != 0 || dup2(ends[1], STDOUT_FILENO) < 0 || dup2(ends[1], STDERR_FILENO) < 0) _exit(99);
    close(ends[0]);
    close(ends[1]);
}

/* 0: the test's own user, without a limit. */
static rlim_t processes_most;

/* Changes to a user ID that no one else has, because the system counts processes per user, and to the folder, which
   this user then owns. The program is opened first, because this user may not be allowed to read its folder. */
static void change_user(char **list)
{
    const uid_t user = 1000000000 + (uid_t)getppid();
    const struct rlimit limit = {processes_most, processes_most};
    int program = open(SB_BINARY_DIR "/shorebreak", O_RDONLY);
    if (program < 0 || chown(folder, user, user) != 0 || chdir(folder) != 0 || setgroups(0, NULL) != 0 ||
        setresgid(user, user, user) != 0 || setrlimit(RLIMIT_NPROC, &limit) != 0 || setresuid(user, user, user) != 0)
        _exit(98);
    fexecve(program, list, environ);
    _exit(99);
}

static const char *ranks; /* their number; NULL: without mpirun */

/* Fills `list` with the words of the command; returns the program to execute. */
static const char *command_of(const char *const *arguments, char *list[ARGUMENTS])
{
    const char *const before[] = {MPIRUN_WORDS(ranks), SB_BINARY_DIR "/shorebreak"};
    size_t count = 0;
    if (!ranks) list[count++] = (char *)"shorebreak";
    for (size_t k = 0; ranks && k < sizeof before / sizeof *before; k++) list[count++] = (char *)before[k];
    for (size_t k = 0; arguments[k]; k++) {
        assert_true(count < ARGUMENTS - 1);
        list[count++] = (char *)arguments[k];
    }
    list[count] = NULL;
    return ranks ? list[0] : SB_BINARY_DIR "/shorebreak";
}

void program_on_ranks(const char *count)
{
    ranks = count;
}

bool program_has_mpi(void)
{
    return access(SB_MPIRUN, X_OK) == 0;
}

static pid_t start(const char *const *arguments, bool has_reader)
{
    char *list[ARGUMENTS];
    const char *program = command_of(arguments, list);
    setenv("OMP_NUM_THREADS", "1", 1);
    setenv("OMP_WAIT_POLICY", "passive", 1);
    setenv("LSAN_OPTIONS", "print_suppressions=0", 1); /* a table would be mixed with the program's messages */
    fflush(NULL);
    pid_t process = fork();
    assert_true(process >= 0);
    if (process == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a failing test leaves no process running */
        redirect("stdout.txt", STDOUT_FILENO);
        redirect("stderr.txt", STDERR_FILENO);
        if (!has_reader) redirect_to_closed_pipe();
        if (ranks || getenv("PMI_SIZE")) mpirun_tell_sanitizers();
        if (processes_most > 0) change_user(list);
        if (chdir(folder) == 0) execv(program, list);
        _exit(99);
    }
    return process;
}

pid_t program_start(const char *const *arguments)
{
    return start(arguments, true);
}

pid_t program_start_without_reader(const char *const *arguments)
{
    return start(arguments, false);
}

/* What a process that does not end, and its children, wait for. */
static void tell_waiting(pid_t process)
{
    char path[64];
    int child;
    for (const char *const *what = (const char *const[]){"stat", "wchan", NULL}; *what; what++) {
        char text[512] = "";
        snprintf(path, sizeof path, "/proc/%d/%s", (int)process, *what);
        FILE *file = fopen(path, "r");
        if (file && !fgets(text, sizeof text, file)) text[0] = '\0';
        if (file) fclose(file);
        print_error("process %d: %s: %s\n", (int)process, *what, text);
    }
    snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)process, (int)process);
    FILE *children = fopen(path, "r");
    while (children && fscanf(children, "%d", &child) == 1) tell_waiting(child);
    if (children) fclose(children);
}

outcome program_finish(pid_t process)
{
    int how = 0;
    double deadline = sb_clock() + TIMEOUT;
    pid_t ended = 0;
    while ((ended = waitpid(process, &how, WNOHANG)) == 0 && sb_clock() < deadline) usleep(2000);
    if (ended == 0) {
        tell_waiting(process);
        kill(process, SIGKILL);
        waitpid(process, &how, 0);
        fail_msg("the program did not end within %g s; its output:\n%s%s", TIMEOUT, text_of("stdout.txt"),
                 text_of("stderr.txt"));
    }
    assert_int_equal(ended, process);
    return (outcome){.status = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how),
                     .out = text_of("stdout.txt"),
                     .err = text_of("stderr.txt")};
}

outcome program_run(const char *const *arguments)
{
    return program_finish(program_start(arguments));
}

outcome program_run_limited(rlim_t bytes, const char *const *arguments)
{
    struct rlimit kept, limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &kept), 0);
    limit = kept;
    limit.rlim_cur = bytes;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    pid_t process = program_start(arguments);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &kept), 0);
    return program_finish(process);
}

bool program_can_change_user(void)
{
    return geteuid() == 0;
}

outcome program_run_crowded(rlim_t processes, const char *const *arguments)
{
    assert_int_equal(chmod(in_folder("tank2.yaml"), 0644), 0);
    assert_int_equal(chmod(in_folder("tank3.yaml"), 0644), 0);
    processes_most = processes;
    pid_t process = program_start(arguments);
    processes_most = 0;
    return program_finish(process);
}

void outcome_free(outcome *o)
{
    sb_free(o->out);
    sb_free(o->err);
    *o = (outcome){0};
}

outcome program_expect(int status, const char *const *arguments)
{
    outcome o = program_run(arguments);
    if (o.status != status) {
        print_error("shorebreak");
        for (size_t i = 0; arguments[i]; i++) print_error(" %s", arguments[i]);
        fail_msg("exit status %d, expected %d; its output:\n%s%s", o.status, status, o.out, o.err);
    }
    return o;
}

void assert_contains(const char *text, const char *expected)
{
    if (!strstr(text, expected)) fail_msg("\"%s\" is not in:\n%s", expected, text);
}

void assert_one_line(const char *text, const char *expected)
{
    const char *end = strchr(text, '\n');
    if (!end || end[1] != '\0') fail_msg("expected one line, not:\n%s", text);
    if (strncmp(text, "shorebreak: ", 12) != 0) fail_msg("no \"shorebreak: \" before %s", text);
    assert_contains(text, expected);
}

double json_number_of(const char *name, const char *key)
{
    char *text = text_of(name);
    if (!json_valid(text)) fail_msg("%s is not valid JSON:\n%s", name, text);
    const char *value = json_find(text, key);
    if (!value || !json_number_text(value)) fail_msg("%s: %s is not a number", name, key);
    double number = strtod(value, NULL);
    sb_free(text);
    return number;
}

static const char *wanted;
static bool found;

static int look(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)where;
    size_t length = strlen(path), tail = strlen(wanted);
    if (kind == FTW_F && length >= tail && strcmp(path + length - tail, wanted) == 0) found = true;
    return 0;
}

bool any_ending(const char *name, const char *ending)
{
    wanted = ending;
    found = false;
    assert_int_equal(nftw(in_folder("%s", name), look, 16, FTW_PHYS), 0);
    return found;
}

double mean_of(const char *path, const char *item, int column, double from)
{
    char cell[32];
    snprintf(cell, sizeof cell, ",%s,", item);
    char *table = text_of(path), *save = NULL;
    double sum = 0;
    int rows = 0;
    for (char *row = strtok_r(table, "\n", &save); row; row = strtok_r(NULL, "\n", &save)) {
        const char *at = strstr(row, cell);
        if (!at || strtod(row, NULL) < from) continue;
        at += strlen(cell) - 1;
        for (int c = 1; at && c < column; c++) at = strchr(at + 1, ',');
        assert_non_null(at);
        sum += strtod(at + 1, NULL);
        rows++;
    }
    sb_free(table);
    assert_true(rows > 0);
    return sum / rows;
}
