/* What a function that can fail returns, and the one line that says why. */
#ifndef SB_BASE_STATUS_H
#define SB_BASE_STATUS_H

typedef enum sb_status {
    SB_OK = 0,
    SB_BAD_INPUT = 1,   /* scene, mesh, flag, checkpoint: the user can mend it */
    SB_FAILED = 2,      /* the run failed: diverged, out of memory, disk */
    SB_INTERRUPTED = 3, /* stopped on request, all files complete */
} sb_status;

/* Zero-initialised is "no error". text: one line naming the object, the value and what was expected. */
typedef struct sb_error {
    sb_status status;
    char text[1024];
} sb_error;

/* Fills *error (may be NULL) and returns status, so that a failing function ends in one line; the text is made one, for
   it may quote a hostile file. */
sb_status sb_fail(sb_error *error, sb_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Puts "?" for the control characters of UTF-8 text, and for those that turn its direction: what is left is one line,
 * and no orders to a terminal. */
void sb_one_line(char *text);

/* SB_FAILED with "out of memory" and what the bytes were for. */
sb_status sb_fail_memory(sb_error *error, const char *purpose);

/* What clang's analyzer cannot see from another file: that a failure is one. */
#ifdef __clang_analyzer__
#define sb_fail(error, status, ...) ((void)(sb_fail)(error, status, __VA_ARGS__), (status))
#define sb_fail_memory(error, purpose) ((void)(sb_fail_memory)(error, purpose), SB_FAILED)
#endif

#endif
