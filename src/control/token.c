#include "control/token.h"

#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

static const char digits[] = "0123456789abcdef";

static void to_text(const sb_token *token, char text[SB_TOKEN_DIGITS + 1])
{
    for (int i = 0; i < SB_TOKEN_BYTES; i++) {
        text[2 * i] = digits[token->bytes[i] >> 4];
        text[2 * i + 1] = digits[token->bytes[i] & 15];
    }
    text[SB_TOKEN_DIGITS] = 0;
}

static bool from_text(const char *text, sb_token *token)
{
    for (int i = 0; i < SB_TOKEN_BYTES; i++) {
        const int high = g_ascii_xdigit_value(text[2 * i]), low = g_ascii_xdigit_value(text[2 * i + 1]);
        if (high < 0 || low < 0) return false;
        token->bytes[i] = (unsigned char)(16 * high + low);
    }
    return true;
}

/* The file is made new, so that nobody has it open, and nobody else can open it. */
sb_status sb_token_make(const char *path, sb_token *token, sb_error *error)
{
    char text[SB_TOKEN_DIGITS + 2];
    if (getrandom(token->bytes, sizeof token->bytes, 0) != (ssize_t)sizeof token->bytes)
        return sb_fail(error, SB_FAILED, "%.500s: the system gives no random bytes: %s", path, strerror(errno));
    to_text(token, text);
    text[SB_TOKEN_DIGITS] = '\n';
    if (unlink(path) != 0 && errno != ENOENT)
        return sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", path, strerror(errno));
    const int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (file < 0) return sb_fail(error, SB_FAILED, "%.500s: cannot create: %s", path, strerror(errno));
    const ssize_t length = SB_TOKEN_DIGITS + 1;
    const bool written = fchmod(file, 0600) == 0 && write(file, text, (size_t)length) == length;
    const int reason = errno;
    if ((close(file) == 0) & written) return SB_OK;
    unlink(path);
    return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", path, strerror(reason));
}

sb_status sb_token_read(const char *path, sb_token *token, sb_error *error)
{
    char text[SB_TOKEN_DIGITS + 2];
    struct stat found;
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (file < 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: cannot open: %s%s", path, strerror(errno),
                       errno == ENOENT ? "; expected the run to allow commands, see --control" : "");
    const bool regular = fstat(file, &found) == 0 && S_ISREG(found.st_mode);
    const ssize_t length = regular ? read(file, text, sizeof text) : -1;
    close(file);
    if (!regular) return sb_fail(error, SB_BAD_INPUT, "%.500s: is not a regular file", path);
    if (found.st_mode & (S_IRWXG | S_IRWXO))
        return sb_fail(error, SB_BAD_INPUT, "%.500s: has mode %04o, expected 0600: others may know the token", path,
                       found.st_mode & 07777u);
    const bool whole = length == SB_TOKEN_DIGITS || (length == SB_TOKEN_DIGITS + 1 && text[SB_TOKEN_DIGITS] == '\n');
    sb_token made;
    if (!whole || !from_text(text, &made))
        return sb_fail(error, SB_BAD_INPUT, "%.500s: expected a token of %d hexadecimal digits", path, SB_TOKEN_DIGITS);
    *token = made;
    return SB_OK;
}

/* Compares without a branch that depends on the bytes. */
static bool equal(const void *a, const void *b, size_t size)
{
    const volatile unsigned char *left = a, *right = b;
    unsigned char differ = 0;
    for (size_t i = 0; i < size; i++) differ = (unsigned char)(differ | (left[i] ^ right[i]));
    return differ == 0;
}

bool sb_token_matches(const sb_token *token, const char *text, size_t size)
{
    char own[SB_TOKEN_DIGITS + 1];
    to_text(token, own);
    return size == SB_TOKEN_DIGITS && equal(own, text, SB_TOKEN_DIGITS);
}

sb_status sb_token_sign(const sb_token *token, const void *message, size_t size,
                        unsigned char signature[SB_SIGNATURE_BYTES])
{
    gsize length = SB_SIGNATURE_BYTES;
    GHmac *hmac = g_hmac_new(G_CHECKSUM_SHA256, token->bytes, sizeof token->bytes);
    if (!hmac) return SB_FAILED;
    g_hmac_update(hmac, message, (gssize)size);
    g_hmac_get_digest(hmac, signature, &length);
    g_hmac_unref(hmac);
    return length == SB_SIGNATURE_BYTES ? SB_OK : SB_FAILED;
}

bool sb_signature_equal(const unsigned char a[SB_SIGNATURE_BYTES], const unsigned char b[SB_SIGNATURE_BYTES])
{
    return equal(a, b, SB_SIGNATURE_BYTES);
}
