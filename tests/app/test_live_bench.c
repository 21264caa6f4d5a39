/* tools/live-bench for some seconds: clients that read well get every frame soon, whatever the others do. */
#include "program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char scene[] = "title: Tank\n"
                            "resolution: 0.04\n"
                            "duration: 1000\n"
                            "domain: {min: [0, 0, 0], max: [2.6, 0.8, 1]}\n"
                            "water: {boxes: [{min: [0, 0, 0], max: [0.8, 0.8, 0.6]}]}\n"
                            "bodies: [{name: post, shape: box, min: [1.0, 0.3, 0], max: [1.3, 0.6, 0.8]}]\n"
                            "numerics: {settle_steps: 0}\n"
                            "measure: {interval: 0.05}\n"
                            "stream: {interval: 0.01}\n"
                            "output: {plots: false}\n";

/* The number before `word`. */
static double number_before(const char *text, const char *word)
{
    const char *at = strstr(text, word);
    if (!at) fail_msg("no '%s' in: %s", word, text);
    while (at > text && strchr(" 0123456789.", at[-1])) at--;
    return strtod(at, NULL);
}

static void eight_clients(void **state)
{
    (void)state;
    char line[2048], text[4096];
    write_text("bench.yaml", scene);
    snprintf(line, sizeof line, "exec '%s/shorebreak-live-bench' --seconds 3 --scene '%s' --out '%s' 2>&1",
             SB_BINARY_DIR, in_folder("bench.yaml"), in_folder("bench"));
    FILE *pipe = popen(line, "r");
    assert_non_null(pipe);
    text[fread(text, 1, sizeof text - 1, pipe)] = '\0';
    const int status = pclose(pipe);
    if (strstr(text, "multicast")) skip();
    print_message("%s", text);
    /* Whether the times met their bars depends on what else the machine does. */
    if (status != 0 && status != 1 << 8) fail_msg("status %d: %s", status, text);
    assert_true(number_before(text, " at the clients that read well") >= 20);
    assert_true(number_before(text, " MB were read") > 1);
    const char *late = strstr(text, "at most by ");
    assert_non_null(late);
    assert_true(strtod(late + 11, NULL) < 5);
    assert_non_null(strstr(text, "MB at the end: met"));
    assert_true(strtod(strstr(text, "clients joined ") + 15, NULL) >= 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(eight_clients)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
