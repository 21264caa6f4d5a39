/* The token of a run: 32 random bytes, which a command must prove to know. It is in RUN_DIR/control.token and is never
   sent over LCM. */
#ifndef SB_CONTROL_TOKEN_H
#define SB_CONTROL_TOKEN_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_TOKEN_BYTES = 32, SB_TOKEN_DIGITS = 2 * SB_TOKEN_BYTES, SB_SIGNATURE_BYTES = 32 };

#define SB_TOKEN_FILE "control.token"

typedef struct sb_token {
    unsigned char bytes[SB_TOKEN_BYTES];
} sb_token;

/* Draws a token and writes it to the file, in hexadecimal digits and a newline, with mode 0600. An earlier file is
   replaced. */
sb_status sb_token_make(const char *path, sb_token *token, sb_error *error);

/* Reads a token. SB_BAD_INPUT if the file is not a regular one, others than its owner may read it, or it has no token.
 */
sb_status sb_token_read(const char *path, sb_token *token, sb_error *error);

/* Whether the text is the token in hexadecimal digits. The time does not depend on where they differ. */
bool sb_token_matches(const sb_token *token, const char *text, size_t size);

/* The signature of a message: HMAC-SHA256 (RFC 2104) by the token's 32 bytes. SB_FAILED without memory. */
sb_status sb_token_sign(const sb_token *token, const void *message, size_t size,
                        unsigned char signature[SB_SIGNATURE_BYTES]);

/* Whether two signatures are equal, in a time that does not depend on where they differ. */
bool sb_signature_equal(const unsigned char a[SB_SIGNATURE_BYTES], const unsigned char b[SB_SIGNATURE_BYTES]);

#endif
