/* Fuzzes commands: the input as JSON, as the text of a signed message, as a message, as a request, as the words of a
   command line, and as a record that a crashed helper has written. */
#include "fuzz.h"

#include "control/message.h"
#include "control/receiver.h"

#include <fcntl.h>
#include <string.h>

enum { RUN = 5, WORDS = 8 };

static void try_json(const char *text, size_t size)
{
    sb_command command;
    sb_error error = {0};
    const sb_status status = sb_command_from_json(text, size, &command, &error);
    if (status == SB_OK)
        FUZZ_CHECK(sb_command_is_valid(&command) && command.kind < SB_COMMANDS);
    else
        fuzz_check_refusal(status, &error);
}

static void try_message(const uint8_t *data, size_t size)
{
    sb_command_message message;
    sb_error error = {0};
    const sb_status status = sb_command_decode(data, size, &message, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return;
    }
    FUZZ_CHECK((const uint8_t *)message.text >= data && message.text_size <= SB_COMMAND_JSON_MAX);
    FUZZ_CHECK(message.signature + SB_SIGNATURE_BYTES == data + size);
}

/* A message with the text, signed, and the bytes themselves as a message: only the first may be obeyed, and once. */
static void try_receiver(const uint8_t *data, size_t size)
{
    static const sb_token token = {{1, 2, 3}};
    static int sink = -1;
    static sb_receiver *receiver;
    static int64_t counter;
    unsigned char message[SB_COMMAND_MESSAGE_MAX];
    char text[SB_COMMAND_JSON_MAX + 1] = "";
    size_t length;
    int64_t id;
    if (sink < 0) {
        sink = open("/dev/null", O_WRONLY);
        FUZZ_CHECK(sb_receiver_create(&token, RUN, 0, sink, &receiver, NULL) == SB_OK);
    }
    const sb_received before = sb_receiver_count(receiver);
    FUZZ_CHECK(sb_receiver_take_message(receiver, data, size, NULL) != SB_OK);
    FUZZ_CHECK(sb_receiver_count(receiver).obeyed == before.obeyed);
    memcpy(text, data, size < SB_COMMAND_JSON_MAX ? size : SB_COMMAND_JSON_MAX);
    FUZZ_CHECK(sb_command_encode(&token, RUN, ++counter, text, message, &length, NULL) == SB_OK);
    (void)sb_receiver_take_message(receiver, message, length, NULL);
    FUZZ_CHECK(sb_receiver_take_message(receiver, message, length, NULL) == SB_BAD_INPUT);
    (void)sb_receiver_take_json(receiver, (const char *)data, size, &id, NULL);
    const sb_received after = sb_receiver_count(receiver);
    FUZZ_CHECK(after.obeyed - before.obeyed <= 2 && after.replayed == before.replayed + 1);
    FUZZ_CHECK(after.obeyed + after.malformed + after.foreign + after.flooded ==
               before.obeyed + before.malformed + before.foreign + before.flooded + 3);
}

static void try_words(const uint8_t *data, size_t size)
{
    char bytes[300], json[SB_COMMAND_JSON_MAX];
    char *words[WORDS];
    int count = 0;
    sb_error error = {0};
    size = size < sizeof bytes - 1 ? size : sizeof bytes - 1;
    memcpy(bytes, data, size);
    bytes[size] = 0;
    for (char *word = strtok(bytes, " "); word && count < WORDS; word = strtok(NULL, " ")) words[count++] = word;
    const sb_status status = sb_command_from_words(count, words, 3, json, &error);
    if (status != SB_OK)
        fuzz_check_refusal(status, &error);
    else
        try_json(json, strlen(json));
}

static void try_record(const uint8_t *data, size_t size)
{
    sb_command command;
    if (size < sizeof command) return;
    memcpy(&command, data, sizeof command);
    if (!sb_command_is_valid(&command)) return;
    FUZZ_CHECK(strlen(command.name) < SB_COMMAND_NAME);
    FUZZ_CHECK(strcmp(sb_command_name(command.kind), "unknown") != 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    try_json((const char *)data, size);
    try_message(data, size);
    try_receiver(data, size);
    try_words(data, size);
    try_record(data, size);
    return 0;
}
