/* Subscribes to a run and prints its time, the force on each body, and the first particle of each part of a frame. It
   needs LCM and the types that lcm-gen makes from lcmtypes (docs/live.md). usage: subscriber [LCM URL] */
#include <lcm/lcm.h>
#include <stdio.h>

#include "shorebreak_forces_t.h"
#include "shorebreak_frame_t.h"
#include "shorebreak_status_t.h"

static void on_status(const lcm_recv_buf_t *buffer, const char *channel, void *user)
{
    shorebreak_status_t m = {0};
    (void)channel;
    if (shorebreak_status_t_decode(buffer->data, 0, (int)buffer->data_size, &m) < 0)
        return; /* another type or version */
    printf("%s: t = %g of %g s, step %lld\n", m.run, m.time, m.duration, (long long)m.step);
    *(int *)user = m.state == 2; /* done */
    shorebreak_status_t_decode_cleanup(&m);
}

static void on_forces(const lcm_recv_buf_t *buffer, const char *channel, void *user)
{
    shorebreak_forces_t m = {0};
    (void)channel, (void)user;
    if (shorebreak_forces_t_decode(buffer->data, 0, (int)buffer->data_size, &m) < 0) return;
    for (int i = 0; i < m.n; i++) printf("  t = %g s: force on %s in x: %.4g N\n", m.time, m.names[i], m.force[3 * i]);
    shorebreak_forces_t_decode_cleanup(&m);
}

static void on_frame(const lcm_recv_buf_t *buffer, const char *channel, void *user)
{
    shorebreak_frame_t m = {0};
    (void)channel, (void)user;
    if (shorebreak_frame_t_decode(buffer->data, 0, (int)buffer->data_size, &m) < 0) return;
    const unsigned char *p = m.points; /* the first particle: x, y, z of two bytes each, speed, pressure */
    if (m.count > 0)
        printf("  frame %lld, part %d of %d: %d particles, the first one at x = %.2f m with %.2f m/s\n",
               (long long)m.frame, m.part + 1, m.part_count, m.count, m.corner[0] + m.quantum * (p[0] + 256 * p[1]),
               m.speed_max * (p[6] / 255.0) * (p[6] / 255.0));
    shorebreak_frame_t_decode_cleanup(&m);
}

int main(int count, char **arguments)
{
    int done = 0;
    lcm_t *lcm = lcm_create(count > 1 ? arguments[1] : NULL);
    if (!lcm) return 1;
    lcm_subscribe(lcm, "shorebreak_status", on_status, &done);
    lcm_subscribe(lcm, "shorebreak_forces", on_forces, NULL);
    lcm_subscription_set_queue_capacity(lcm_subscribe(lcm, "shorebreak_frame", on_frame, NULL), 1000);
    while (!done && lcm_handle(lcm) == 0) continue;
    lcm_destroy(lcm);
    return 0;
}
