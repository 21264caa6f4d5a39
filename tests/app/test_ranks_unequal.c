/* Ranks that would compute other bits than rank 0, or that were told something else: refused, unless --mixed accepts
   it. */
#include "pair.h"

#include "base/memory.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Rank 0 is the program; rank 1 is `other`, which has one more argument if `more` is not NULL. */
static outcome run_with(const char *out, const char *other, const char *flag, const char *more)
{
    program_on_ranks("1");
    outcome o = program_run((const char *const[]){
        "run", "tank2.yaml", "--out", in_folder("%s", out), "--quiet", "--overwrite", flag, ":",  "-n", "1", other,
        "run", "tank2.yaml", "--out", in_folder("%s", out), "--quiet", "--overwrite", flag, more, NULL});
    program_on_ranks(NULL);
    return o;
}

static void unequal_options_are_refused(void **state)
{
    (void)state;
    NEEDS_MPI();
    outcome o = run_with("options", SB_BINARY_DIR "/shorebreak", "--quiet", "--set=output.plots=false");
    assert_int_equal(o.status, 1);
    assert_one_reason(o.err, "rank 1 on ");
    assert_contains(o.err, "has other options than rank 0, expected the same command line");
    outcome_free(&o);
    assert_false(exists("options"));
}

/* Copies the program, with another hash of its sources. */
static void make_other_build(const char *path)
{
    enum { HASH = 16 };
    size_t length, changed = 0;
    FILE *stream = fopen(SB_BINARY_DIR "/shorebreak", "rb");
    assert_non_null(stream);
    fseek(stream, 0, SEEK_END);
    length = (size_t)ftell(stream);
    rewind(stream);
    char *bytes = sb_alloc(length, 1);
    assert_true(bytes && fread(bytes, 1, length, stream) == length);
    fclose(stream);
    for (char *at = bytes; (at = memmem(at, length - (size_t)(at - bytes), "sources ", 8)); at += 8) {
        int digits = 0;
        while (digits < HASH && isxdigit((unsigned char)at[8 + digits])) digits++;
        if (digits < HASH || at[8 + HASH] != ',') continue;
        at[8] = at[8] == '0' ? '1' : '0';
        changed++;
    }
    assert_int_equal(changed, 1);
    stream = fopen(path, "wb");
    assert_true(stream && fwrite(bytes, 1, length, stream) == length);
    fclose(stream);
    assert_int_equal(chmod(path, 0755), 0);
    sb_free(bytes);
}

static void another_build_is_refused_and_accepted_with_mixed(void **state)
{
    (void)state;
    NEEDS_MPI();
    make_other_build(in_folder("other-build"));
    outcome o = run_with("mixed", in_folder("other-build"), "--quiet", NULL);
    assert_int_equal(o.status, 1);
    assert_one_reason(o.err, "rank 1 on ");
    assert_contains(o.err, "computes other bits than rank 0: (sources ");
    assert_contains(o.err, "add --mixed");
    outcome_free(&o);
    assert_false(exists("mixed"));
    o = run_with("mixed", in_folder("other-build"), "--mixed", NULL);
    if (o.status != 0) fail_msg("status %d: %s", o.status, o.err);
    assert_one_reason(o.err, "warning: rank 1 on ");
    assert_contains(o.err, "is of another build or processor than rank 0: the bits depend on the ranks");
    outcome_free(&o);
    assert_near(json_number_of("mixed/summary.json", "ranks"), 2, 0);
    o = run_with("mixed", SB_BINARY_DIR "/shorebreak", "--mixed", NULL); /* equal builds: no warning */
    assert_int_equal(o.status, 0);
    assert_int_equal(count_of(o.err, "shorebreak: "), 0);
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unequal_options_are_refused),
        cmocka_unit_test(another_build_is_refused_and_accepted_with_mixed),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
