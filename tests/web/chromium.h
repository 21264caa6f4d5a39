/* Drives Chromium without a screen over its DevTools protocol, through a pipe. WebGL2 is drawn in software. */
#ifndef SB_TESTS_WEB_CHROMIUM_H
#define SB_TESTS_WEB_CHROMIUM_H

#include <jansson.h>
#include <stdbool.h>

typedef struct chromium chromium;

/* Whether the program is installed. */
bool chromium_is_there(void);

/* Starts it with one page of this size. Failures of these functions fail the test. */
chromium *chromium_start(int width, int height);
void chromium_stop(chromium *browser);

void chromium_open(chromium *browser, const char *url);
/* phone: with touch, and two pixels of the screen for each of the page. */
void chromium_resize(chromium *browser, int width, int height, bool phone);

/* The value of an expression of JavaScript, which may be a promise. */
double chromium_number(chromium *browser, const char *expression);
bool chromium_true(chromium *browser, const char *expression);
/* Free with free(). */
char *chromium_text(chromium *browser, const char *expression);
/* Waits until the expression is true; fails with it otherwise. */
void chromium_await(chromium *browser, const char *expression, double seconds);
/* Clicks the button with this id when it can be pressed: a click on a disabled button does nothing. A button that waits
   for a state of the run is disabled until the page has heard of that state. */
void chromium_press(chromium *browser, const char *id);

/* type: mousePressed, mouseMoved, mouseReleased. */
void chromium_mouse(chromium *browser, const char *type, double x, double y);
void chromium_wheel(chromium *browser, double x, double y, double by);
void chromium_screenshot(chromium *browser, const char *path);

/* Messages on the console of level error, and exceptions, since the start; "" for none. */
const char *chromium_errors(chromium *browser);

#endif
