/* Which requests the server answers: checks of headers, from untrusted text. */
#ifndef SB_WEB_ALLOW_H
#define SB_WEB_ALLOW_H

#include <stdbool.h>

enum { SB_WEB_TOKEN_MIN = 16, SB_WEB_TOKEN_MAX = 256 }; /* characters of a token */

/* Whether the header Host names this server: `address`, numeric, at which the connection arrived; localhost; or `name`
   (NULL: none). Any port, because a tunnel may lead here. A page of another site whose name was made to lead to this
   address (DNS rebinding) has that name in the header. host NULL: the header is missing, which is not allowed. */
bool sb_web_allow_host(const char *host, const char *address, const char *name);

/* Whether a request comes from this server's own page, or from no page. origin, site, mode: the headers Origin,
   Sec-Fetch-Site and Sec-Fetch-Mode, or NULL; host: the header Host. Other sites may link to the page. */
bool sb_web_allow_origin(const char *origin, const char *site, const char *mode, const char *host, bool is_page);

/* Whether a token is the expected one. The time does not depend on the first difference. given NULL: no. */
bool sb_web_allow_token(const char *given, const char *expected);

/* Whether an address of numbers belongs to the machine's loopback interface. */
bool sb_web_is_loopback(const char *address);

#endif
