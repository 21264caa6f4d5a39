/* Restricts the process by system calls: the C library has no functions for Landlock, and a library for seccomp is
   not justified by one list. A crafted file that gains control of the parser thus gains access to the mesh's folder
   at most. */
#include "geometry/mesh/fence.h"

#include "geometry/mesh/mesh.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__x86_64__)
#define OWN_ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define OWN_ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

/* ------------------------------------------------------------------------------ Landlock */

/* Returns all access rights that this Landlock version handles, so that none stays allowed: 13 in version 1, and one
   more in versions 2 (refer), 3 (truncate) and 5 (ioctl on devices). */
static uint64_t rights_of(long version)
{
    uint64_t rights = (UINT64_C(1) << 13) - 1;
    if (version >= 2) rights |= UINT64_C(1) << 13;
    if (version >= 3) rights |= UINT64_C(1) << 14;
    if (version >= 5) rights |= UINT64_C(1) << 15;
    return rights;
}

static long landlock_version(void)
{
    return syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION);
}

static void fence_files(const char *folder)
{
    const long version = landlock_version();
    if (version < 1) return;
    const struct landlock_ruleset_attr handled = {.handled_access_fs = rights_of(version)};
    const int rules = (int)syscall(SYS_landlock_create_ruleset, &handled, sizeof handled.handled_access_fs, 0);
    const int place = open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
    const struct landlock_path_beneath_attr beneath = {.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE,
                                                       .parent_fd = place};
    if (rules >= 0 && place >= 0 && syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0) == 0)
        syscall(SYS_landlock_restrict_self, rules, 0);
    if (place >= 0) close(place);
    if (rules >= 0) close(rules);
}

/* ------------------------------------------------------------------------------- seccomp */

#ifdef OWN_ARCHITECTURE

#define LOAD(member) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, member))
#define ALLOW BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)
#define REFUSE BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM)
#define CALL(name) BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##name, 0, 1), ALLOW
/* Allows a call if none of its flags, argument `n`, writes or creates a file. All these flags are in the low half of
   the argument. */
#define OPEN(name, n)                                                                                                  \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##name, 0, 4), LOAD(args[n]),                                              \
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND | (O_TMPFILE & ~O_DIRECTORY), 1, \
                 0),                                                                                                   \
        ALLOW, REFUSE

/* The system calls that parsing needs: memory, reading, the pipe, time, and termination, also by a crash. The
   sanitizers' runtimes need a few more, which are harmless. */
static const struct sock_filter allowed[] = {LOAD(arch),
                                             BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, OWN_ARCHITECTURE, 1, 0),
                                             REFUSE,
                                             LOAD(nr),
                                             OPEN(openat, 2),
#ifdef SYS_open
                                             OPEN(open, 1),
                                             CALL(stat),
                                             CALL(lstat),
                                             CALL(readlink),
                                             CALL(access),
#endif
                                             CALL(newfstatat),
                                             CALL(statx),
                                             CALL(fstat),
                                             CALL(readlinkat),
                                             CALL(faccessat),
                                             CALL(faccessat2),
                                             CALL(getcwd),
                                             CALL(read),
                                             CALL(readv),
                                             CALL(pread64),
                                             CALL(lseek),
                                             CALL(close),
                                             CALL(fcntl),
                                             CALL(fadvise64),
                                             CALL(write),
                                             CALL(writev),
                                             CALL(mmap),
                                             CALL(munmap),
                                             CALL(mremap),
                                             CALL(mprotect),
                                             CALL(madvise),
                                             CALL(brk),
                                             CALL(futex),
                                             CALL(sched_yield),
                                             CALL(sched_getaffinity),
                                             CALL(getpid),
                                             CALL(gettid),
                                             CALL(getuid),
                                             CALL(geteuid),
                                             CALL(getrusage),
                                             CALL(sysinfo),
                                             CALL(uname),
                                             CALL(clock_gettime),
                                             CALL(gettimeofday),
                                             CALL(nanosleep),
                                             CALL(clock_nanosleep),
                                             CALL(getrandom),
                                             CALL(rt_sigaction),
                                             CALL(rt_sigprocmask),
                                             CALL(rt_sigreturn),
                                             CALL(sigaltstack),
                                             CALL(restart_syscall),
                                             CALL(tgkill),
                                             CALL(exit),
                                             CALL(exit_group),
                                             REFUSE};

static void fence_calls(void)
{
    const struct sock_fprog program = {.len = sizeof allowed / sizeof *allowed,
                                       .filter = (struct sock_filter *)(uintptr_t)allowed};
    syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program);
}

#else

static void fence_calls(void) {}

#endif

/* ---------------------------------------------------------------------------------------- */

void sb_mesh_fence(const char *folder)
{
    /* The kernel lets an unprivileged process restrict itself only after no_new_privs. */
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    fence_files(folder);
    fence_calls();
}

const char *sb_mesh_fence_gaps(void)
{
    const bool files = landlock_version() >= 1;
#ifdef OWN_ARCHITECTURE
    const uint32_t action = SECCOMP_RET_ERRNO;
    const bool calls = syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
#else
    const bool calls = false;
#endif
    return files && calls ? NULL
           : files        ? "seccomp: not available, mesh files are read without it"
           : calls        ? "Landlock: not available, mesh files are read without it"
                          : "Landlock and seccomp: not available, mesh files are read without them";
}
