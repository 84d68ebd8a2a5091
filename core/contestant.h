/// What a plug-in for the touchmark program gives it: a detector behind C functions, in a shared object that
/// `touchmark bench --plugin ./libmine.so` loads. Plain C99, so that any language can fill it in.
///
/// A plug-in exports one function, touchmark_plugin_entry, which returns a description that stays as it is.
/// All lengths are in the mesh's unit, all coordinates in its frame. Contact is closed: a probe touches where
/// the distance is at most its radius. No function may throw or jump out.
#ifndef TOUCHMARK_CONTESTANT_H
#define TOUCHMARK_CONTESTANT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The version of the structs below. A program takes plug-ins of its own version and of those before it.
#define TOUCHMARK_PLUGIN_VERSION 1u

/// In place of a triangle's index, where a detector does not know which triangle is the nearest.
#define TOUCHMARK_PLUGIN_NO_TRIANGLE UINT32_MAX

#if defined(_WIN32)
#define TOUCHMARK_PLUGIN_EXPORT __declspec(dllexport)
#else
/// Before the definition of touchmark_plugin_entry, so that it is seen whatever the compiler's flags hide.
#define TOUCHMARK_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/// The triangles. The arrays are the program's, and are gone once the call they were given to returns.
typedef struct touchmark_plugin_mesh {
  const double* vertices;     ///< x, y and z of each vertex in turn
  size_t vertex_count;        ///< 1 or more
  const uint32_t* triangles;  ///< three indices into the vertices for each triangle, all in range
  size_t triangle_count;      ///< 1 or more
} touchmark_plugin_mesh;

/// What kind of value an option takes.
typedef enum touchmark_plugin_option_kind {
  TOUCHMARK_PLUGIN_CHOICE = 0,  ///< one of some words
  TOUCHMARK_PLUGIN_NUMBER = 1,  ///< a number of 0 or more
  TOUCHMARK_PLUGIN_COUNT = 2,   ///< a whole number of 0 or more
  TOUCHMARK_PLUGIN_LENGTH = 3   ///< 0 or more, typed in mesh units or in percent of the box diagonal
} touchmark_plugin_option_kind;

/// An option that users type as `--detector NAME:KEY=VALUE`.
typedef struct touchmark_plugin_option {
  const char* key;            ///< letters, digits, '_' and '-'
  int32_t kind;               ///< a touchmark_plugin_option_kind
  const char* choices;        ///< a choice's words, parted by '|'; else NULL
  const char* default_value;  ///< as a user would type it
  const char* summary;        ///< one line for `touchmark list`
} touchmark_plugin_option;

/// The value of an option, checked. Build is given one for each option, in the order of the description.
typedef struct touchmark_plugin_setting {
  const char* key;   ///< the option's
  const char* text;  ///< as it was typed, or the default
  double number;     ///< a choice's index among its words, the number, the count, or the length in mesh units
} touchmark_plugin_setting;

/// A haptic interface point as a ball. It may be asked at any place, NaN and infinity included, which touch
/// nothing.
typedef struct touchmark_plugin_probe {
  double center[3];  ///< x, y and z
  double radius;     ///< 0 is the bare point
} touchmark_plugin_probe;

/// The straight path of a ball during one servo tick.
typedef struct touchmark_plugin_sweep {
  double from[3];  ///< the center at the start
  double to[3];    ///< the center at the end
  double radius;   ///< 0 is the bare point
} touchmark_plugin_sweep;

/// The point of the mesh that is nearest to a probe's center.
typedef struct touchmark_plugin_contact {
  double point[3];    ///< on the mesh
  double normal[3];   ///< a unit vector from the point to the center; the face's where both coincide
  double distance;    ///< from the center to the point, 0 or more
  uint32_t triangle;  ///< its index in the mesh, of several the lowest; or TOUCHMARK_PLUGIN_NO_TRIANGLE
  uint32_t reserved;  ///< leave it 0
} touchmark_plugin_contact;

/// The first touch on a sweep.
typedef struct touchmark_plugin_impact {
  double fraction;  ///< share of the path, from 0 to 1; 0 where and only where the ball touches at the start
  touchmark_plugin_contact contact;  ///< that of the probe which stands there
} touchmark_plugin_impact;

/// How far answers may be off: by `relative` times the largest difference between a coordinate of the probe's
/// center and one of the nearest triangle, plus `absolute`. Where both are 0, a detector that claims to be
/// exact is held to 48 roundings, and of any other nothing is known. The last two are 0 or 1.
typedef struct touchmark_plugin_accuracy {
  double relative;          ///< 0 or more
  double absolute;          ///< 0 or more, in mesh units
  int32_t decides_exactly;  ///< contact or not is told without any rounding
  int32_t names_exactly;    ///< the triangle named is an exactly nearest one, of several the lowest
} touchmark_plugin_accuracy;

/// A detector. A function that is NULL is one that it does not have; `build`, `destroy`, `bytes` and at least
/// one query are needed. Build and update say what is wrong as a text of one line in `error`, of at most
/// `error_size` bytes with the 0 that ends it.
typedef struct touchmark_plugin {
  uint32_t version;       ///< TOUCHMARK_PLUGIN_VERSION
  uint32_t option_count;  ///< how many there are in `options`

  const char* name;  ///< as --detector takes it: letters, digits, '_' and '-', and none of the program's own
  const char* summary;  ///< one line for `touchmark list`
  /// What it claims: "exact", "conservative" (never misses a contact) or "approximate". Where options change
  /// that, "exact; KEY=VALUE: approximate".
  const char* guarantee;
  const touchmark_plugin_option* options;  ///< NULL where there are none

  /// Returns the detector, or NULL with the reason in `error`.
  void* (*build)(const touchmark_plugin_mesh* mesh, const touchmark_plugin_setting* settings,
                 size_t setting_count, char* error, size_t error_size);
  /// Gives back what build took.
  void (*destroy)(void* detector);
  /// Returns the bytes that it takes, the copy of the mesh included.
  size_t (*bytes)(const void* detector);
  /// Fills in the accuracy, which is all 0 before. Called once after build.
  void (*accuracy)(const void* detector, touchmark_plugin_accuracy* accuracy);

  /// Returns what one haptic point remembers between ticks. It may change what an answer costs, never the
  /// answer. NULL as a function: there is none, and queries are given NULL.
  void* (*create_session)(const void* detector);
  /// Ends a session, before its detector is destroyed.
  void (*destroy_session)(const void* detector, void* session);

  /// Returns 1 where the probe touches, else 0. Queries of one detector may run in several threads, each with
  /// a session of its own.
  int (*touches)(const void* detector, void* session, const touchmark_plugin_probe* probe);
  /// Returns 1 and the contact where the distance is at most `reach`, which may be infinite, else 0. The
  /// probe's radius plays no part.
  int (*nearest)(const void* detector, void* session, const touchmark_plugin_probe* probe, double reach,
                 touchmark_plugin_contact* contact);
  /// Returns 1 and the impact where the sweep touches, both ends included, else 0.
  int (*first_hit)(const void* detector, void* session, const touchmark_plugin_sweep* sweep,
                   touchmark_plugin_impact* impact);

  /// Follows the same triangles with vertices elsewhere; sessions stay. Returns 0, or another number with the
  /// reason in `error`.
  int (*update)(void* detector, const touchmark_plugin_mesh* mesh, char* error, size_t error_size);
} touchmark_plugin;

/// What a plug-in defines, as `TOUCHMARK_PLUGIN_EXPORT const touchmark_plugin* touchmark_plugin_entry(void)`.
typedef const touchmark_plugin* (*touchmark_plugin_entry_function)(void);

#ifdef __cplusplus
}
#endif

#endif
