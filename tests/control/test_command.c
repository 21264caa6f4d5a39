/* Commands from JSON and from words: valid ones, one fault each, random bytes. */
#include "check.h"

#include "control/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static sb_command good(const char *text)
{
    sb_command command;
    sb_error error = {0};
    /* In a block of its size, so that ASan detects a read beyond it. */
    const size_t size = strlen(text);
    char *bytes = malloc(size);
    memcpy(bytes, text, size);
    const sb_status status = sb_command_from_json(bytes, size, &command, &error);
    free(bytes);
    if (status != SB_OK) fail_msg("%s: %s", text, error.text);
    assert_true(sb_command_is_valid(&command));
    return command;
}

static void test_valid(void **state)
{
    (void)state;
    assert_int_equal(good("{\"do\":\"pause\"}").kind, SB_COMMAND_PAUSE);
    assert_int_equal(good("{\"do\":\"resume\"}").kind, SB_COMMAND_RESUME);
    assert_int_equal(good("{\"do\":\"stop\"}").kind, SB_COMMAND_STOP);
    assert_int_equal(good("{\"do\":\"checkpoint\",\"id\":9007199254740991}").id, SB_COMMAND_ID_MAX);
    assert_int_equal(good("{\"do\":\"step\"}").count, 1);
    assert_int_equal(good(" { \"steps\" : 10 , \"do\" : \"step\" } ").count, 10);
    assert_int_equal(good("{\"do\":\"decimation\",\"decimation\":4}").count, 4);
    assert_near(good("{\"do\":\"rate\",\"rate\":2.5}").number[0], 2.5, 0);
    assert_near(good("{\"do\":\"rate\",\"rate\":0}").number[0], 0, 0);
    assert_int_equal(good("{\"do\":\"region\",\"off\":true}").off, 1);
    const sb_command region = good("{\"do\":\"region\",\"min\":[0,1,-2],\"max\":[10,1.5,3e2]}");
    assert_int_equal(region.off, 0);
    assert_near(region.number[2], -2, 0);
    assert_near(region.number[5], 300, 0);
    assert_string_equal(good("{\"do\":\"picture\",\"camera\":\"shore\"}").name, "shore");
    const sb_command picture = good("{\"do\":\"picture\",\"eye\":[1,2,3],\"target\":[4,5,6]}");
    assert_string_equal(picture.name, "");
    assert_near(picture.number[3], 4, 0);
    assert_string_equal(good("{\"do\":\"trigger\",\"wavemaker\":\"paddle\"}").name, "paddle");
    assert_near(good("{\"do\":\"loss\",\"lost\":0.125}").number[0], 0.125, 0);
}

static void test_faults(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } faults[] = {
        {"", "not JSON"},
        {"pause", "not JSON"},
        {"{\"do\":\"pause\"} x", "not JSON"},
        {"{\"do\":\"rate\",\"rate\":NaN}", "not JSON"},
        {"{\"do\":\"rate\",\"rate\":1e999}", "not JSON"},
        {"{\"do\":\"pause\",\"do\":\"stop\"}", "not JSON: duplicate"},
        {"{\"do\":\"p\xff\"}", "not JSON"},
        {"[]", "expected one JSON object"},
        {"{}", "do: is missing"},
        {"{\"do\":7}", "do: is missing"},
        {"{\"do\":\"jump\"}", "do: \"jump\", expected"},
        {"{\"do\":\"puase\"}", "did you mean pause?"},
        {"{\"do\":\"counts\"}", "do: \"counts\", expected"},
        {"{\"do\":\"loss\"}", "lost: is missing"},
        {"{\"do\":\"loss\",\"lost\":1.5}", "lost: 1.5, expected a number from 0 to 1"},
        {"{\"do\":\"pause\",\"steps\":3}", "steps: is not a member of the command pause"},
        {"{\"do\":\"step\",\"steps\":0}", "steps: 0, expected a whole number from 1 to 1000000000"},
        {"{\"do\":\"step\",\"steps\":1.5}", "steps: 1.5, expected a whole number"},
        {"{\"do\":\"step\",\"steps\":\"10\"}", "steps: \"10\", expected a whole number"},
        {"{\"do\":\"step\",\"steps\":99999999999999999999}", "not JSON: too big integer"},
        {"{\"do\":\"step\",\"id\":-1}", "id: -1, expected a whole number"},
        {"{\"do\":\"step\",\"id\":9007199254740992}", "id: 9007199254740992, expected"},
        {"{\"do\":\"rate\"}", "rate: is missing"},
        {"{\"do\":\"rate\",\"rate\":-1}", "rate: -1, expected a number from 0 to 1000"},
        {"{\"do\":\"rate\",\"rate\":null}", "rate: null, expected a number"},
        {"{\"do\":\"decimation\",\"decimation\":0}", "decimation: 0, expected"},
        {"{\"do\":\"region\"}", "region: expected either min and max, or off"},
        {"{\"do\":\"region\",\"min\":[0,0,0]}", "region: expected either"},
        {"{\"do\":\"region\",\"off\":true,\"min\":[0,0,0],\"max\":[1,1,1]}", "region: expected either"},
        {"{\"do\":\"region\",\"off\":false}", "off: false, expected true"},
        {"{\"do\":\"region\",\"min\":[0,0],\"max\":[1,1,1]}", "min: [0,0], expected three numbers"},
        {"{\"do\":\"region\",\"min\":[0,0,\"a\"],\"max\":[1,1,1]}", "min: [0,0,\"a\"], expected three numbers"},
        {"{\"do\":\"region\",\"min\":[0,0,0],\"max\":[1,0,1]}", "max: 0 in y, expected more than min, 0"},
        {"{\"do\":\"region\",\"min\":[0,0,0],\"max\":[1,1,1e300]}", "max: [1,1,1e300], expected three numbers"},
        {"{\"do\":\"picture\"}", "picture: expected either camera, or eye and target"},
        {"{\"do\":\"picture\",\"camera\":\"a\",\"eye\":[0,0,0],\"target\":[1,0,0]}", "picture: expected either"},
        {"{\"do\":\"picture\",\"eye\":[0,0,0],\"target\":[0,0,0]}", "target: is the same point as eye"},
        {"{\"do\":\"picture\",\"camera\":\"\"}", "camera: \"\", expected a name"},
        {"{\"do\":\"picture\",\"camera\":\"a\\u0000b\"}", "not JSON"},
        {"{\"do\":\"trigger\"}", "wavemaker: is missing"},
        {"{\"do\":\"trigger\",\"wavemaker\":[1]}", "wavemaker: [1], expected a name"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        sb_command command, before;
        sb_error error = {0};
        memset(&command, 0x5a, sizeof command);
        before = command;
        const size_t size = strlen(faults[i].text);
        assert_int_equal(sb_command_from_json(faults[i].text, size, &command, &error), SB_BAD_INPUT);
        assert_memory_equal(&command, &before, sizeof command);
        if (!strstr(error.text, faults[i].message))
            fail_msg("%s: \"%s\", expected \"%s\"", faults[i].text, error.text, faults[i].message);
    }
}

static void test_size(void **state)
{
    (void)state;
    static char text[SB_COMMAND_JSON_MAX + 1];
    sb_command command;
    sb_error error;
    memset(text, ' ', sizeof text);
    memcpy(text, "{\"do\":\"pause\"}", 14);
    assert_int_equal(sb_command_from_json(text, SB_COMMAND_JSON_MAX, &command, NULL), SB_OK);
    assert_int_equal(sb_command_from_json(text, SB_COMMAND_JSON_MAX + 1, &command, &error), SB_BAD_INPUT);
    memset(text, '[', sizeof text);
    assert_int_equal(sb_command_from_json(text, SB_COMMAND_JSON_MAX, &command, &error), SB_BAD_INPUT);
    const int length = snprintf(text, sizeof text, "{\"do\":\"trigger\",\"wavemaker\":\"%0*d\"}", SB_COMMAND_NAME, 1);
    assert_int_equal(sb_command_from_json(text, (size_t)length, &command, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "expected a name of 1 to 127 bytes"));
}

/* Valid commands of which some bytes are changed, and bytes that are all random. */
static void test_random(void **state)
{
    (void)state;
    static const char *const seeds[] = {"{\"do\":\"step\",\"steps\":10,\"id\":7}",
                                        "{\"do\":\"region\",\"min\":[0,1,-2],\"max\":[10,1.5,3e2]}",
                                        "{\"do\":\"picture\",\"camera\":\"shore\"}"};
    uint64_t random = 1;
    size_t accepted = 0;
    for (int round = 0; round < 100000; round++) {
        char text[80];
        sb_command command;
        const char *seed = seeds[round % 3];
        const size_t size = strlen(seed);
        memcpy(text, seed, size);
        const int changes = round % 4 == 3 ? 80 : 1 + round % 4;
        for (int c = 0; c < changes; c++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            text[(random >> 40) % size] = (char)(random >> 32);
        }
        if (sb_command_from_json(text, size, &command, NULL) != SB_OK) continue;
        accepted++;
        assert_true(sb_command_is_valid(&command));
    }
    assert_in_range(accepted, 100, 60000); /* a changed digit or letter of a name is valid */
}

static void test_words(void **state)
{
    (void)state;
    static const struct {
        const char *words[7];
        int count;
        const char *expected; /* JSON, or a part of the message */
    } lines[] = {
        {{"pause"}, 1, "{\"do\":\"pause\",\"id\":5}"},
        {{"step"}, 1, "{\"do\":\"step\",\"id\":5}"},
        {{"step", "10"}, 2, "{\"do\":\"step\",\"id\":5,\"steps\":10}"},
        {{"rate", "0.5"}, 2, "{\"do\":\"rate\",\"id\":5,\"rate\":0.5}"},
        {{"region", "off"}, 2, "{\"do\":\"region\",\"id\":5,\"off\":true}"},
        {{"region", "0", "0", "0", "1", "1", "1"}, 7, "{\"do\":\"region\",\"id\":5,\"min\":[0,0,0],\"max\":[1,1,1]}"},
        {{"picture", "0", "0", "9", "1", "1", "1"},
         7,
         "{\"do\":\"picture\",\"id\":5,\"eye\":[0,0,9],\"target\":[1,1,1]}"},
        {{"picture", "12"}, 2, "{\"do\":\"picture\",\"id\":5,\"camera\":\"12\"}"},
        {{"trigger", "paddle"}, 2, "{\"do\":\"trigger\",\"id\":5,\"wavemaker\":\"paddle\"}"},
        {{"step", "ten"}, 2, "steps: \"ten\", expected a whole number"},
        {{"rate", "nan"}, 2, "rate: \"nan\", expected a number"},
        {{"rate", "1e999"}, 2, "rate: \"1e999\", expected a number"},
        {{"jump"}, 1, "do: \"jump\", expected"},
        {{"pause", "now"}, 2, "pause: a wrong number of values"},
        {{"rate"}, 1, "rate: a wrong number of values"},
        {{"region", "0", "0"}, 3, "region: a wrong number of values"},
        {{"pause", "0", "0", "0", "1", "1", "1"}, 7, "pause: a wrong number of values"},
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char text[SB_COMMAND_JSON_MAX];
        sb_error error = {0};
        char *words[7];
        memcpy(words, lines[i].words, sizeof words);
        const sb_status status = sb_command_from_words(lines[i].count, words, 5, text, &error);
        const char *got = status == SB_OK ? text : error.text;
        const bool same =
            status == SB_OK ? strcmp(got, lines[i].expected) == 0 : strstr(got, lines[i].expected) != NULL;
        if (!same) fail_msg("%s: \"%s\", expected \"%s\"", words[0], got, lines[i].expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_valid), cmocka_unit_test(test_faults),
                                       cmocka_unit_test(test_size), cmocka_unit_test(test_random),
                                       cmocka_unit_test(test_words)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
