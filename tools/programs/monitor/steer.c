#include "steer.h"

#include <stdio.h>

/* A command that is lost on its way is sent again after half a second, a second later and so on; the run obeys it once.
 */
static const double AGAIN_SECONDS = 0.5, GIVE_UP_SECONDS = 15, REPORT_SECONDS = 2;

static const char *const words[] = {
    [SB_ACTION_PAUSE] = "pause", [SB_ACTION_RESUME] = "resume", [SB_ACTION_STEP] = "step"};

/* Reads the token at each command: a run that was resumed has another one. */
static sb_status find_target(const sb_steer *steer, int64_t followed, sb_target *target, sb_error *error)
{
    if (steer->run) return sb_target_read(steer->run, target, error);
    if (!steer->token_file)
        return sb_fail(error, SB_BAD_INPUT,
                       "a command needs the token of the run: start the run with --control, the monitor with --run "
                       "RUN_DIR");
    if (followed < 0) return sb_fail(error, SB_BAD_INPUT, "no run is seen yet, to which a command could be sent");
    target->run_id = followed;
    return sb_token_read(steer->token_file, &target->token, error);
}

sb_status sb_steer_send(sb_steer *steer, sb_listener *listener, sb_action action, int64_t followed, double now,
                        sb_error *error)
{
    char text[SB_COMMAND_JSON_MAX], word[16];
    char *const list[] = {word};
    sb_target target = {0};
    const int64_t counter = sb_target_counter();
    snprintf(word, sizeof word, "%s", words[action]);
    sb_status status = find_target(steer, followed, &target, error);
    if (status == SB_OK) status = sb_command_from_words(1, list, counter, text, error);
    if (status == SB_OK)
        status = sb_command_encode(&target.token, target.run_id, counter, text, steer->message, &steer->size, error);
    if (status == SB_OK) status = sb_listener_send_command(listener, steer->message, steer->size, error);
    if (status != SB_OK) return status;
    steer->waiting = true;
    steer->run_id = target.run_id;
    steer->counter = counter;
    steer->sent = now;
    steer->pause = AGAIN_SECONDS;
    steer->next = now + steer->pause;
    return SB_OK;
}

sb_status sb_steer_serve(sb_steer *steer, sb_listener *listener, double now, sb_error *error)
{
    if (!steer->waiting || now < steer->next) return SB_OK;
    if (now >= steer->sent + GIVE_UP_SECONDS) {
        steer->waiting = false;
        return sb_fail(error, SB_FAILED, "no reply of the run within %.0f s; does it run, and with --control?",
                       GIVE_UP_SECONDS);
    }
    steer->pause *= 2;
    steer->next = now + steer->pause;
    return sb_listener_send_command(listener, steer->message, steer->size, error);
}

static double newly(uint64_t now, uint64_t before)
{
    return now > before ? (double)(now - before) : 0;
}

void sb_steer_report(sb_steer *steer, sb_listener *listener, int64_t followed, const sb_live_counts *count, double now)
{
    if ((!steer->run && !steer->token_file) || followed < 0 || now < steer->reported + REPORT_SECONDS) return;
    const sb_live_counts before = steer->counted;
    const bool restarted = count->restarts != before.restarts || !(steer->reported > 0);
    const double lost = newly(count->lost, before.lost),
                 received = newly(count->messages - count->refused - count->foreign,
                                  before.messages - before.refused - before.foreign);
    steer->reported = now;
    steer->counted = *count;
    if (restarted || !(lost + received > 0)) return;
    if (steer->target.run_id != followed) {
        sb_target target = {0};
        if (find_target(steer, followed, &target, NULL) != SB_OK || target.run_id != followed) return;
        steer->target = target;
    }
    char text[80];
    unsigned char message[SB_COMMAND_MESSAGE_MAX];
    size_t size = 0;
    snprintf(text, sizeof text, "{\"do\":\"loss\",\"lost\":%.6f}", lost / (lost + received));
    if (sb_command_encode(&steer->target.token, followed, sb_target_counter(), text, message, &size, NULL) == SB_OK)
        (void)sb_listener_send_command(listener, message, size, NULL);
}

bool sb_steer_reply(sb_steer *steer, const sb_reply_message *reply)
{
    if (!steer->waiting || reply->head.run_id != steer->run_id || reply->counter != steer->counter) return false;
    steer->waiting = false;
    return true;
}
