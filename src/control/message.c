#include "control/message.h"

#include "stream/reader.h"

#include "shorebreak_command_t.h"

#include <string.h>

sb_status sb_command_encode(const sb_token *token, int64_t run_id, int64_t counter, const char *text,
                            unsigned char message[SB_COMMAND_MESSAGE_MAX], size_t *size, sb_error *error)
{
    shorebreak_command_t plain = {.version = SB_STREAM_VERSION,
                                  .run_id = run_id,
                                  .counter = counter,
                                  .command = (char *)text}; /* the encoder does not write through it */
    const int encoded = shorebreak_command_t_encode(message, 0, SB_COMMAND_MESSAGE_MAX, &plain);
    if (encoded < SB_SIGNATURE_BYTES)
        return sb_fail(error, SB_BAD_INPUT, "the command has %zu bytes, expected at most %d", strlen(text),
                       SB_COMMAND_JSON_MAX);
    const size_t before = (size_t)encoded - SB_SIGNATURE_BYTES;
    if (sb_token_sign(token, message, before, message + before) != SB_OK)
        return sb_fail_memory(error, "the signature of a command");
    *size = (size_t)encoded;
    return SB_OK;
}

sb_status sb_command_decode(const void *message, size_t size, sb_command_message *out, sb_error *error)
{
    sb_message_reader in = sb_reader_begin(message, size, SB_COMMAND_MESSAGE_MAX, __shorebreak_command_t_get_hash());
    sb_command_message m = {.run_id = sb_reader_int64(&in), .bytes = message};
    m.counter = sb_reader_int64(&in);
    if (m.run_id < 0 || m.run_id > SB_STREAM_RUN_MAX || m.counter < 0 || m.counter > SB_COMMAND_ID_MAX)
        sb_reader_refuse(&in, "its run id or its counter is not 0 to 2^53 - 1");
    const int32_t length = sb_reader_int32(&in); /* with the terminating zero */
    if (length < 1 || length > SB_COMMAND_JSON_MAX + 1)
        sb_reader_refuse(&in, "the length of its command is not 0 to 1024 bytes");
    const unsigned char *text = sb_reader_bytes(&in, in.problem ? 0 : (size_t)length);
    if (text && !in.problem && text[length - 1] != 0) sb_reader_refuse(&in, "its command is not terminated by a zero");
    m.signature = sb_reader_bytes(&in, SB_SIGNATURE_BYTES);
    const sb_status status = sb_reader_end(&in, "command", size, error);
    if (status != SB_OK) return status;
    m.text = (const char *)text;
    m.text_size = (size_t)length - 1;
    m.signed_size = size - SB_SIGNATURE_BYTES;
    *out = m;
    return SB_OK;
}
