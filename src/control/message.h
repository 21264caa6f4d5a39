/* Commands as signed LCM messages (lcmtypes/command_t.lcm). */
#ifndef SB_CONTROL_MESSAGE_H
#define SB_CONTROL_MESSAGE_H

#include "control/command.h"
#include "control/token.h"

enum { SB_COMMAND_MESSAGE_MAX = SB_COMMAND_JSON_MAX + 128 }; /* bytes of a message */

/* A decoded message, with pointers into its bytes. */
typedef struct sb_command_message {
    int64_t run_id, counter;
    const char *text; /* JSON, not terminated */
    size_t text_size;
    const unsigned char *bytes; /* that are signed */
    size_t signed_size;
    const unsigned char *signature; /* SB_SIGNATURE_BYTES */
} sb_command_message;

/* Encodes and signs a message. text: JSON, terminated, of at most SB_COMMAND_JSON_MAX bytes. SB_FAILED without memory.
 */
sb_status sb_command_encode(const sb_token *token, int64_t run_id, int64_t counter, const char *text,
                            unsigned char message[SB_COMMAND_MESSAGE_MAX], size_t *size, sb_error *error);

/* Decodes a message from untrusted bytes; the signature is not checked. SB_BAD_INPUT as in stream/decode.h, with *out
   unchanged. */
sb_status sb_command_decode(const void *message, size_t size, sb_command_message *out, sb_error *error);

#endif
