/* The status that a function returns when it can fail, and the one-line message that explains a failure. */
#ifndef SB_BASE_STATUS_H
#define SB_BASE_STATUS_H

typedef enum sb_status {
    SB_OK = 0,
    SB_BAD_INPUT = 1,   /* a scene, mesh, flag or checkpoint is wrong: the user can correct it */
    SB_FAILED = 2,      /* the run failed: it diverged, memory ran out, or the disk failed */
    SB_INTERRUPTED = 3, /* the run was stopped on request; all files are complete */
} sb_status;

/* A zero-initialised struct means "no error". text: one line that names the object, the value and what was expected. */
typedef struct sb_error {
    sb_status status;
    char text[1024];
} sb_error;

/* Fills *error (may be NULL) and returns status, so that a failing function can end with one statement. Control
   characters in the text are replaced, because the text may quote an untrusted file. */
sb_status sb_fail(sb_error *error, sb_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Replaces the control characters of UTF-8 text, and the characters that change its direction, by "?". The text is then
   one line and contains no terminal commands. */
void sb_one_line(char *text);

/* Fails with SB_FAILED, "out of memory for" and the purpose of the memory. */
sb_status sb_fail_memory(sb_error *error, const char *purpose);

/* Makes the returned status visible to clang's analyzer, which does not look into other files. */
#ifdef __clang_analyzer__
#define sb_fail(error, status, ...) ((void)(sb_fail)(error, status, __VA_ARGS__), (status))
#define sb_fail_memory(error, purpose) ((void)(sb_fail_memory)(error, purpose), SB_FAILED)
#endif

#endif
