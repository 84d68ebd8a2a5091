/// The detectors of Touchmark for C, and so for every language that calls C.
///
/// Handles are opaque: one that a create or build function returned is freed by its free function, which
/// also takes NULL. Where something is wrong, a function that makes a handle returns NULL and any other
/// returns TOUCHMARK_ERROR, and touchmark_last_error() says what in one line. Nothing is thrown. Lengths are
/// in the mesh's own units. docs/c.md has an example.
#ifndef TOUCHMARK_TOUCHMARK_H
#define TOUCHMARK_TOUCHMARK_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(TOUCHMARK_BUILDS_C)
#define TOUCHMARK_API __declspec(dllexport)
#elif defined(_WIN32)
#define TOUCHMARK_API __declspec(dllimport)
#else
#define TOUCHMARK_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Triangles in double precision, checked. Constant once made.
typedef struct touchmark_mesh touchmark_mesh;
/// A search structure over a mesh, of which it keeps a copy. Constant but for touchmark_detector_update.
typedef struct touchmark_detector touchmark_detector;
/// What one haptic point remembers between ticks. It keeps its detector alive. Only one thread may use a
/// session at a time; many threads may ask one detector with a session each.
typedef struct touchmark_session touchmark_session;

/// What queries return: found or touching, not so, or an error.
enum { TOUCHMARK_YES = 1, TOUCHMARK_NO = 0, TOUCHMARK_ERROR = -1 };

/// The side of the surface that a probe's centre is on. It is asked for when the detector is built, by
/// "side=on". Inside is behind the faces, whose corners run counter-clockwise seen from outside.
enum {
  TOUCHMARK_SIDE_UNASKED = 0,
  TOUCHMARK_SIDE_OUTSIDE = 1,
  TOUCHMARK_SIDE_INSIDE = 2,
  TOUCHMARK_SIDE_ON_SURFACE = 3,
  TOUCHMARK_SIDE_UNDECIDED = 4 /**< the mesh does not say */
};

/// The point of the mesh nearest to a probe's centre.
typedef struct touchmark_contact {
  double point[3];   ///< on the mesh
  double normal[3];  ///< unit, from the point towards the centre; the face normal where they coincide
  double distance;   ///< from the centre to the point, 0 or more
  uint32_t triangle; /**< its place among the mesh's triangles, from 0; the lowest of those equally near */
  int32_t side;      ///< one of TOUCHMARK_SIDE_...
} touchmark_contact;

/// The first touch of a ball on a straight way.
typedef struct touchmark_impact {
  double fraction;           /**< 0 to 1, rounded down; 0 where and only where it touches at the start */
  touchmark_contact contact; /**< that of the ball standing there */
} touchmark_impact;

/// Returns "MAJOR.MINOR.PATCH" of the library that is linked.
TOUCHMARK_API const char* touchmark_version(void);

/// Returns why the last function that failed on this thread did, in one line; "" if none has. Valid until
/// another one fails on this thread.
TOUCHMARK_API const char* touchmark_last_error(void);

/// Makes a mesh of `vertex_count` points, three coordinates each, and `triangle_count` triangles, three
/// numbers of points each, from 0. Both arrays are copied. Fails for no triangle, a number that names no
/// point, or a coordinate that is not finite.
TOUCHMARK_API touchmark_mesh* touchmark_mesh_create(const double* vertices, size_t vertex_count,
                                                    const uint32_t* triangles, size_t triangle_count);
/// Frees a mesh. Detectors built of it stay as they are.
TOUCHMARK_API void touchmark_mesh_free(touchmark_mesh* mesh);
/// Stores the box of the vertices that triangles use. Returns TOUCHMARK_YES or TOUCHMARK_ERROR.
TOUCHMARK_API int touchmark_mesh_bounds(const touchmark_mesh* mesh, double min[3], double max[3]);

/// Builds a detector. `text` names it and its options as on the command line: "sphere-cluster",
/// "grid-group:cell=1%,side=on"; NULL stands for "sphere-cluster". docs/c.md lists the options.
TOUCHMARK_API touchmark_detector* touchmark_detector_build(const touchmark_mesh* mesh, const char* text);
/// Frees a detector, once the last of its sessions is freed.
TOUCHMARK_API void touchmark_detector_free(touchmark_detector* detector);
/// Returns the memory that it takes, in bytes; 0 for NULL.
TOUCHMARK_API size_t touchmark_detector_bytes(const touchmark_detector* detector);
/// Takes a mesh of the same triangles with vertices elsewhere; sessions go on. No query may run meanwhile.
/// Returns TOUCHMARK_YES or TOUCHMARK_ERROR. It is as it was where the triangles are others; after any other
/// error it answers no more.
TOUCHMARK_API int touchmark_detector_update(touchmark_detector* detector, const touchmark_mesh* mesh);

/// Begins a session. Takes memory; queries do not.
TOUCHMARK_API touchmark_session* touchmark_session_create(const touchmark_detector* detector);
/// Frees a session.
TOUCHMARK_API void touchmark_session_free(touchmark_session* session);

/// Is the distance from the centre to the mesh at most the radius? A centre that is not finite touches
/// nothing.
TOUCHMARK_API int touchmark_touches(touchmark_session* session, const double center[3], double radius);
/// Stores the contact of the nearest triangle, if it is within `reach`, which may be infinite. `contact` is
/// left as it was otherwise, and may be NULL.
TOUCHMARK_API int touchmark_nearest(touchmark_session* session, const double center[3], double reach,
                                    touchmark_contact* contact);
/// Stores the first touch of a ball that moves straight from one point to the other, if there is one.
/// `impact` is left as it was otherwise, and may be NULL.
TOUCHMARK_API int touchmark_first_hit(touchmark_session* session, const double from[3], const double to[3],
                                      double radius, touchmark_impact* impact);
/// Stores a contact for each triangle within `reach`, nearest first, as many as fit into `capacity` of them,
/// and in `count` how many there are, which may be more. `contacts` may be NULL where the capacity is 0.
/// Takes memory where the capacity is larger than at any call of this session before.
TOUCHMARK_API int touchmark_contacts(touchmark_session* session, const double center[3], double reach,
                                     touchmark_contact* contacts, size_t capacity, size_t* count);
/// Does ahead what the next query would do first: best right after waking, before the device is read. It
/// changes no answer. Returns TOUCHMARK_YES or TOUCHMARK_ERROR.
TOUCHMARK_API int touchmark_prepare(touchmark_session* session);

#ifdef __cplusplus
}
#endif

#endif
