/* The listening socket, the connections and their deadlines. */
#include "web/server_state.h"

#include "base/clock.h"
#include "base/memory.h"

#include <errno.h>
#include <linux/tcp.h>
#include <netdb.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum {
    PORTS = 20,             /* ports that are tried */
    SEND_BUFFER = 256 << 10 /* bytes: a larger one would hold old frames of a slow client */
};

static int bind_port(const struct addrinfo *found, int port)
{
    struct sockaddr_storage address = {0};
    memcpy(&address, found->ai_addr, found->ai_addrlen);
    if (found->ai_family == AF_INET6)
        ((struct sockaddr_in6 *)&address)->sin6_port = htons((uint16_t)port);
    else
        ((struct sockaddr_in *)&address)->sin_port = htons((uint16_t)port);
    const int made = socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (made < 0) return -1;
    const int on = 1, buffer = SEND_BUFFER;
    setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    setsockopt(made, SOL_SOCKET, SO_SNDBUF, &buffer, sizeof buffer);
    if (found->ai_family == AF_INET6) setsockopt(made, IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof on);
    if (bind(made, (const struct sockaddr *)&address, found->ai_addrlen) == 0 && listen(made, SB_WEB_BACKLOG) == 0)
        return made;
    const int reason = errno;
    close(made);
    errno = reason;
    return -1;
}

static int port_of(int listener)
{
    struct sockaddr_storage address = {0};
    socklen_t size = sizeof address;
    char port[16] = "";
    if (getsockname(listener, (struct sockaddr *)&address, &size) != 0 ||
        getnameinfo((const struct sockaddr *)&address, size, NULL, 0, port, sizeof port, NI_NUMERICSERV) != 0)
        return 0;
    return (int)strtol(port, NULL, 10);
}

int sb_web_listen(sb_web_server *server, sb_error *error)
{
    const struct addrinfo wanted = {.ai_flags = AI_NUMERICHOST | AI_PASSIVE, .ai_socktype = SOCK_STREAM};
    struct addrinfo *found = NULL;
    if (getaddrinfo(server->address, NULL, &wanted, &found) != 0) {
        sb_fail(error, SB_BAD_INPUT, "%.100s: expected an address of this machine in numbers, such as 127.0.0.1",
                server->address);
        return -1;
    }
    const int first = server->settings.port, count = server->settings.next_port ? PORTS : 1;
    int made = -1;
    for (int port = first; made < 0 && port < first + count && port <= UINT16_MAX; port++) {
        made = bind_port(found, port);
        if (made < 0 && errno != EADDRINUSE && errno != EACCES) break;
    }
    if (made < 0)
        sb_fail(error, SB_FAILED, "cannot listen on %.100s port %d: %s; choose another port", server->address, first,
                strerror(errno));
    else
        server->port = port_of(made);
    freeaddrinfo(found);
    return made;
}

static sb_web_client *begin(sb_web_server *server, struct MHD_Connection *connection)
{
    sb_web_client *client = sb_alloc(1, sizeof *client);
    const union MHD_ConnectionInfo *info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
    if (!client || !info) {
        sb_free(client);
        return NULL;
    }
    *client = (sb_web_client){.next = server->clients,
                              .server = server,
                              .connection = connection,
                              .socket = info->connect_fd,
                              .begun = sb_clock()};
    struct sockaddr_storage address = {0};
    socklen_t size = sizeof address;
    if (getsockname(client->socket, (struct sockaddr *)&address, &size) != 0 ||
        getnameinfo((const struct sockaddr *)&address, size, client->address, sizeof client->address, NULL, 0,
                    NI_NUMERICHOST) != 0)
        *client->address = '\0';
    if (server->clients) server->clients->previous = client;
    server->clients = client;
    server->counts.clients++;
    return client;
}

/* Whether a connection has sent something that libmicrohttpd refused: it does not report it. */
static bool was_malformed(const sb_web_client *client)
{
    struct tcp_info info = {0};
    socklen_t size = sizeof info;
    if (client->understood || client->late) return false;
    /* The end of the connection counts as one byte. */
    return getsockopt(client->socket, IPPROTO_TCP, TCP_INFO, &info, &size) == 0 && info.tcpi_bytes_received > 1;
}

static void end(sb_web_server *server, sb_web_client *client)
{
    server->counts.malformed += was_malformed(client);
    if (client->next) client->next->previous = client->previous;
    if (client->previous)
        client->previous->next = client->next;
    else
        server->clients = client->next;
    server->counts.clients--;
    server->counts.streams -= client->streams;
    sb_web_blob_release(client->record);
    sb_free(client->body);
    sb_free(client);
}

void sb_web_on_connection(void *user, struct MHD_Connection *connection, void **context,
                          enum MHD_ConnectionNotificationCode code)
{
    if (code == MHD_CONNECTION_NOTIFY_STARTED)
        *context = begin(user, connection);
    else if (*context) {
        end(user, *context);
        *context = NULL;
    }
}

sb_web_client *sb_web_client_of(struct MHD_Connection *connection)
{
    const union MHD_ConnectionInfo *info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return info ? info->socket_context : NULL;
}

void sb_web_check_deadlines(sb_web_server *server, double now)
{
    for (sb_web_client *client = server->clients; client; client = client->next) {
        const double limit = client->answered ? SB_WEB_ANSWER_SECONDS : server->settings.request_seconds;
        if (client->streams || client->late || now < client->begun + limit) continue;
        client->late = true;
        server->counts.late++;
        shutdown(client->socket, SHUT_RDWR); /* libmicrohttpd then ends the connection */
    }
}
