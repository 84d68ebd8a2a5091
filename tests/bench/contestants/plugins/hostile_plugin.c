/* A plug-in that misbehaves as the environment variable HOSTILE_PLUGIN says. C99, so that the header is seen by
   a C compiler. Without the variable it answers that nothing is anywhere. */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include "core/contestant.h"

static int is(const char* what) {
  const char* const wanted = getenv("HOSTILE_PLUGIN");
  return wanted != NULL && strcmp(wanted, what) == 0;
}

static void hang(void) {
  volatile int forever = 1;
  while (forever) {
  }
}

__attribute__((constructor)) static void loaded(void) {
  if (is("crash on load")) abort();
#ifdef __SSE__
  if (is("flush to zero")) _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

static int the_detector;

static void* build(const touchmark_plugin_mesh* mesh, const touchmark_plugin_setting* settings,
                   size_t setting_count, char* error, size_t error_size) {
  if (is("crash in build")) abort();
  if (is("hang in build")) hang();
  if (is("refuse to build") || setting_count != 2 || strcmp(settings[1].key, "cell") != 0) {
    snprintf(error, error_size, "%zu triangles\nare <too> many & more, cell %g", mesh->triangle_count,
             settings[1].number);
    return NULL;
  }
  if (is("refuse without a word")) return NULL;
  return &the_detector;
}

static void destroy(void* detector) { (void)detector; }

static size_t bytes(const void* detector) {
  (void)detector;
  return 1;
}

static void accuracy(const void* detector, touchmark_plugin_accuracy* said) {
  (void)detector;
  if (is("accuracy of NaN")) said->relative = NAN;
}

static int touches(const void* detector, void* session, const touchmark_plugin_probe* probe) {
  (void)detector, (void)session, (void)probe;
  return 0;
}

static int nearest(const void* detector, void* session, const touchmark_plugin_probe* probe, double reach,
                   touchmark_plugin_contact* contact) {
  (void)detector, (void)session, (void)probe, (void)reach;
  if (is("crash in a query")) abort();
  if (is("exit in a query")) exit(7);
  if (is("hang in a query")) hang();
  if (is("sleep in a query")) {
    const struct timespec while_ = {0, 1000000};
    nanosleep(&while_, NULL);
  }
  if (is("answer nothing but NaN")) {
    contact->distance = contact->point[0] = contact->normal[2] = NAN;
    return 1;
  }
  if (is("name a triangle that is none")) {
    contact->triangle = 4000000000u;
    contact->normal[0] = 1;
    return 1;
  }
  if (is("leave the contact as it was")) return -1;
  return 0;
}

static void* no_session(const void* detector) {
  (void)detector;
  return NULL;
}
static void destroy_session(const void* detector, void* session) { (void)detector, (void)session; }

static const touchmark_plugin_option options[] = {
    {"mode", TOUCHMARK_PLUGIN_CHOICE, "idle|lazy", "idle", "how it misbehaves"},
    {"cell", TOUCHMARK_PLUGIN_LENGTH, NULL, "10%", "of nothing"},
};
static const touchmark_plugin_option bad_default[] = {
    {"mode", TOUCHMARK_PLUGIN_CHOICE, "idle|lazy", "eager", "one that it does not take"},
};
static const touchmark_plugin_option reserved[] = {{"side", TOUCHMARK_PLUGIN_CHOICE, "off|on", "off", "the program's"}};
static const touchmark_plugin_option bad_kind[] = {{"mode", 9, NULL, "1", "of no kind"}};

TOUCHMARK_PLUGIN_EXPORT const touchmark_plugin* touchmark_plugin_entry(void) {
  static touchmark_plugin plugin;
  plugin.version = is("another version") ? 2 : is("version 0") ? 0 : TOUCHMARK_PLUGIN_VERSION;
  plugin.name = is("the name of another") ? "grid-group" : is("a bad name") ? "a:b" : "hostile";
  plugin.summary = "misbehaves";
  plugin.guarantee = is("a bad guarantee") ? "perfect" : is("approximate") ? "approximate" : "exact";
  plugin.option_count = is("options at NULL") ? 5 : is("a bad default") || is("a bad kind") || is("a reserved key") ? 1 : 2;
  plugin.options = is("options at NULL") ? NULL : is("a bad default") ? bad_default : is("a bad kind") ? bad_kind : is("a reserved key") ? reserved : options;
  plugin.build = is("no build") ? NULL : build;
  plugin.destroy = destroy;
  plugin.bytes = bytes;
  plugin.accuracy = accuracy;
  plugin.touches = is("no query") ? NULL : touches;
  plugin.nearest = is("no query") ? NULL : nearest;
  if (is("no session")) {
    plugin.create_session = no_session;
    plugin.destroy_session = destroy_session;
  }
  if (is("hang on load")) hang();
  return is("NULL") ? NULL : &plugin;
}
